//! Inspection of positions: intersections that the test of a step exempts, and vertices inside
//! bodies.

use super::open_seams::LEAST;
use super::pinch::vertices_of;
use super::surface_contact::SurfaceContact;
use crate::error::{Error, check_index};
use crate::surface::exact::{Intersection, encloses, exempt_intersections, intersections};
use crate::surface::placement::Placement;
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

/// Inspection of a [`SurfaceContact`] at the positions that [`inspect`](SurfaceContact::inspect)
/// took. Each method allocates memory, so an inspection is for the start and the end of a run.
#[derive(Debug, Clone, Copy)]
pub struct SurfaceInspection<'a> {
    contact: &'a SurfaceContact,
    /// Positions of the free vertices, in m.
    positions: &'a [f64],
}

impl<'a> SurfaceInspection<'a> {
    /// Returns the inspection of `contact` at the `positions` of the free vertices, in m.
    pub(super) fn new(
        contact: &'a SurfaceContact,
        positions: &'a [f64],
    ) -> Result<SurfaceInspection<'a>, Error> {
        contact.check_free("positions", positions)?;
        Ok(SurfaceInspection { contact, positions })
    }

    /// Like [`SurfaceContact::intersections`], but includes cloth that
    /// [`PinchPolicy::Release`](super::PinchPolicy::Release) exempts.
    ///
    /// # Errors
    /// Positions are not finite.
    pub fn intersections_with_released(self) -> Result<Vec<Intersection>, Error> {
        intersections(&self.contact.surface, &self.placed())
    }

    /// Returns whether the free `vertex` is inside a body.
    ///
    /// # Errors
    /// `vertex` is not a free vertex.
    pub fn is_inside_body(self, vertex: usize) -> Result<bool, Error> {
        let surface = &self.contact.surface;
        check_index("free vertex", vertex, surface.free_count())?;
        let all = self.placed();
        let bodies = surface.free_count()..surface.vertex_count();
        let mut groups: Vec<u32> = bodies.map(|v| surface.primitives().group(v as u32)).collect();
        groups.dedup();
        Ok(groups.iter().any(|&group| encloses(surface, group, at(&all, vertex), &all)))
    }

    /// Returns the exempt intersections between the two sides of seams.
    ///
    /// # Errors
    /// Positions are not finite.
    pub fn seam_intersections(self) -> Result<SeamIntersections, Error> {
        let mut result = SeamIntersections::default();
        let surface = &self.contact.surface;
        if !surface.separations.seam_gaps.contains(&0.0) {
            return Ok(result);
        }
        let all = self.placed();
        for intersection in exempt_intersections(surface, &all)? {
            let [narrowest, widest] = self.gaps_at(intersection, &all);
            // Primitives with a common point meet there.
            if narrowest >= LEAST {
                result.count += 1;
                result.depth = result.depth.max(widest);
            }
        }
        Ok(result)
    }

    /// Returns the [`Placement`] of all vertices.
    fn placed(self) -> Placement {
        let mut all = Placement::default();
        let obstacles = &self.contact.obstacles;
        obstacles.place(self.positions, obstacles.time, &mut all);
        all
    }

    /// Returns the narrowest and the widest gap of the seams that join the edge and the triangle of
    /// `intersection`, in m. `all` holds the flat positions of all vertices.
    fn gaps_at(self, intersection: Intersection, all: &[f64]) -> [f64; 2] {
        let seams = &self.contact.surface.primitives().seams;
        let vertices = vertices_of(&self.contact.surface, intersection);
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
    fn point_of_class(self, vertices: &[u32], class: u32, all: &[f64]) -> Option<Vector> {
        let seams = &self.contact.surface.primitives().seams;
        let vertex = vertices.iter().find(|&&vertex| seams.class(vertex) == class)?;
        Some(at(all, *vertex as usize))
    }

    /// Returns the distance of the point `tied` from the line through the two of `vertices` between
    /// which a seam ties its `class`, in m.
    fn distance_from_ends(
        self,
        tied: Vector,
        class: u32,
        vertices: &[u32],
        all: &[f64],
    ) -> Option<f64> {
        let ends = self.contact.surface.primitives().seams.ends(class)?;
        let [a, b] = ends.map(|end| self.point_of_class(vertices, end, all));
        let (a, along) = (a?, subtract(b?, a?));
        Some(norm(cross(along, subtract(tied, a))) / norm(along))
    }
}
