//! Exempt intersections: intersections between the two sides of a closing seam.

use super::open_seams::LEAST;
use super::pinch::vertices_of;
use super::surface_contact::SurfaceContact;
use crate::error::Error;
use crate::surface::exact::{Intersection, exempt_intersections};
use crate::vector::{Vector, at, cross, norm, subtract};

/// Exempt intersections: intersections between the two sides of a seam that counts as closed before
/// its vertices are one point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SeamIntersections {
    /// Number of edges that meet a triangle.
    pub count: usize,
    /// Widest gap of the seams at these intersections, in m. No side is deeper in the other.
    pub depth: f64,
}

impl SurfaceContact {
    /// Returns the exempt intersections at the `positions` of the free vertices, in m.
    ///
    /// # Errors
    /// Positions are not finite.
    pub fn seam_intersections(&self, positions: &[f64]) -> Result<SeamIntersections, Error> {
        let mut result = SeamIntersections::default();
        if !self.surface.separations.seam_gaps.contains(&0.0) {
            return Ok(result);
        }
        let all = self.placed(positions);
        for intersection in exempt_intersections(&self.surface, &all)? {
            let [narrowest, widest] = self.gaps_at(intersection, &all);
            // Primitives with a common point meet there.
            if narrowest >= LEAST {
                result.count += 1;
                result.depth = result.depth.max(widest);
            }
        }
        Ok(result)
    }

    /// Returns the narrowest and the widest gap of the seams that join the edge and the triangle of
    /// `intersection`, in m. `all` holds the flat positions of all vertices.
    fn gaps_at(&self, intersection: Intersection, all: &[f64]) -> [f64; 2] {
        let seams = &self.surface.primitives().seams;
        let vertices = vertices_of(&self.surface, intersection);
        let classes = vertices.map(|vertex| seams.class(vertex));
        let (edge, triangle) = vertices.split_at(2);
        let (edge_classes, triangle_classes) = classes.split_at(2);

        let mut gaps = [f64::INFINITY, 0.0];
        for class in seams.joints(edge_classes, triangle_classes) {
            let on_edge = self.point_of_class(edge, class, all);
            let on_triangle = self.point_of_class(triangle, class, all);
            let gap = match [on_edge, on_triangle] {
                [Some(a), Some(b)] => Some(norm(subtract(a, b))),
                [Some(tied), None] => self.distance_from_ends(tied, class, triangle, all),
                [None, Some(tied)] => self.distance_from_ends(tied, class, edge, all),
                [None, None] => None,
            };
            if let Some(gap) = gap {
                gaps = [gaps[0].min(gap), gaps[1].max(gap)];
            }
        }
        gaps
    }

    /// Returns the position of the first of `vertices` in `class`, in m.
    fn point_of_class(&self, vertices: &[u32], class: u32, all: &[f64]) -> Option<Vector> {
        let seams = &self.surface.primitives().seams;
        let vertex = vertices.iter().find(|&&vertex| seams.class(vertex) == class)?;
        Some(at(all, *vertex as usize))
    }

    /// Returns the distance of the point `tied` from the line through the two of `vertices` between
    /// which a seam ties its `class`, in m.
    fn distance_from_ends(
        &self,
        tied: Vector,
        class: u32,
        vertices: &[u32],
        all: &[f64],
    ) -> Option<f64> {
        let ends = self.surface.primitives().seams.ends(class)?;
        let [a, b] = ends.map(|end| self.point_of_class(vertices, end, all));
        let (a, along) = (a?, subtract(b?, a?));
        Some(norm(cross(along, subtract(tied, a))) / norm(along))
    }
}
