//! Intersections of seams that close: exempt, and counted.

use super::open_seams::LEAST;
use super::surface_contact::SurfaceContact;
use crate::error::Error;
use crate::surface::exact::{Intersection, exempt_intersections};
use crate::surface::placement::Placement;
use crate::vector::{at, cross, norm, subtract};

/// Intersections of the sides of seams that count as closed while their vertices are not one point yet.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SeamIntersections {
    /// Number of edges that meet a triangle.
    pub count: usize,
    /// Widest gap of the seams at them, in m: the sides are nowhere deeper in each other.
    pub depth: f64,
}

impl SurfaceContact {
    /// Returns the intersections that are exempt at the free vertices' positions, in m: those of the sides
    /// of open seams whose gap counts as closed.
    ///
    /// # Errors
    /// Positions that are not finite.
    pub fn seam_intersections(&self, positions: &[f64]) -> Result<SeamIntersections, Error> {
        let mut found = SeamIntersections::default();
        if !self.surface.separations.seam_gaps.contains(&0.0) {
            return Ok(found);
        }
        let mut all = Placement::default();
        self.obstacles.place(positions, self.obstacles.time, &mut all);
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
    fn gaps_at(&self, Intersection { edge, triangle }: Intersection, all: &[f64]) -> [f64; 2] {
        let seams = &self.surface.primitives().seams;
        let edge = self.surface.edges()[edge as usize];
        let triangle = self.surface.triangles()[triangle as usize];
        let classes = [&edge.map(|v| seams.class(v))[..], &triangle.map(|v| seams.class(v))[..]];
        let point = |class: u32, of: usize| {
            let vertices = [&edge[..], &triangle[..]][of];
            let place = classes[of].iter().position(|own| *own == class)?;
            Some(at(all, vertices[place] as usize))
        };
        let gap = |class: u32| match [0, 1].map(|of| point(class, of)) {
            [Some(a), Some(b)] => Some(norm(subtract(a, b))),
            sides => {
                // A tied vertex and the edge on which it comes to lie.
                let own = sides[0].or(sides[1])?;
                let other = usize::from(sides[0].is_some());
                let [a, b] = seams.ends(class)?.map(|end| point(end, other));
                let (a, along) = (a?, subtract(b?, a?));
                Some(norm(cross(along, subtract(own, a))) / norm(along))
            }
        };
        let gaps = seams.joints(classes[0], classes[1]).filter_map(gap);
        gaps.fold([f64::INFINITY, 0.0], |[least, most], gap| [least.min(gap), most.max(gap)])
    }
}
