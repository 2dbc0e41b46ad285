//! Exempt intersections: those of the two sides of a seam that closes.

use super::open_seams::LEAST;
use super::pinch::vertices_of;
use super::surface_contact::SurfaceContact;
use crate::error::Error;
use crate::surface::exact::{Intersection, exempt_intersections};
use crate::vector::{Vector, at, cross, norm, subtract};

/// Exempt intersections: those of the two sides of a seam that counts as closed before its vertices are
/// one point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SeamIntersections {
    /// Number of edges that meet a triangle.
    pub count: usize,
    /// Widest gap of the seams at these intersections, in m; no side is deeper in the other.
    pub depth: f64,
}

impl SurfaceContact {
    /// Returns the exempt intersections at the free vertices' positions, in m.
    ///
    /// # Errors
    /// Positions that are not finite.
    pub fn seam_intersections(&self, positions: &[f64]) -> Result<SeamIntersections, Error> {
        let mut found = SeamIntersections::default();
        if !self.surface.separations.seam_gaps.contains(&0.0) {
            return Ok(found);
        }
        let all = self.placed(positions);
        for intersection in exempt_intersections(&self.surface, &all)? {
            let [narrowest, widest] = self.gaps_at(intersection, &all);
            // Those with a common point meet there.
            if narrowest >= LEAST {
                found.count += 1;
                found.depth = found.depth.max(widest);
            }
        }
        Ok(found)
    }

    /// Returns the narrowest and the widest gap of the seams that join an edge and a triangle, in m.
    fn gaps_at(&self, intersection: Intersection, all: &[f64]) -> [f64; 2] {
        let seams = &self.surface.primitives().seams;
        let vertices = vertices_of(&self.surface, intersection);
        let classes = vertices.map(|vertex| seams.class(vertex));
        let (edge, triangle) = vertices.split_at(2);
        let point = |of: &[u32], class: u32| {
            let vertex = of.iter().find(|&&vertex| seams.class(vertex) == class)?;
            Some(at(all, *vertex as usize))
        };
        // Distance of a tied vertex from the edge on which it comes to lie.
        let off_edge = |own: Vector, class: u32, of: &[u32]| {
            let [a, b] = seams.ends(class)?.map(|end| point(of, end));
            let (a, along) = (a?, subtract(b?, a?));
            Some(norm(cross(along, subtract(own, a))) / norm(along))
        };
        let gap = |class: u32| match [edge, triangle].map(|of| point(of, class)) {
            [Some(one), Some(other)] => Some(norm(subtract(one, other))),
            [Some(own), None] => off_edge(own, class, triangle),
            [None, Some(own)] => off_edge(own, class, edge),
            [None, None] => None,
        };
        let gaps = seams.joints(&classes[..2], &classes[2..]).filter_map(gap);
        gaps.fold([f64::INFINITY, 0.0], |[least, most], gap| [least.min(gap), most.max(gap)])
    }
}
