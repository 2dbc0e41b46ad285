//! Open seams: their two sides are two cloths, which keep less from each other the nearer they come.

use super::active_pairs::ActivePair;
use super::surface_contact::SurfaceContact;
use crate::error::Error;
use crate::surface::contact_surface::Surface;
use crate::surface::exact::{Intersection, exempt_intersections};
use crate::surface::geometry::Separations;
use crate::surface::placement::Placement;
use crate::vector::{at, cross, norm, subtract};

/// Least gap at which the sides of a seam are two cloths, in m: nearer ones are one point.
///
/// It is some thousand times the rounding of coordinates of 1 m.
const LEAST: f64 = 1e-12;

/// Intersections of the sides of seams that count as closed while their vertices are not one point yet.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SeamIntersections {
    /// Number of edges that meet a triangle.
    pub count: usize,
    /// Widest gap of the seams at them, in m: the sides are nowhere deeper in each other.
    pub depth: f64,
}

/// Open seams of a surface, with the largest gap that contact assumes between the sides of each.
///
/// It is limited where the sides lie nearer to each other at the start than the gap is wide.
#[derive(Debug, Default, Clone)]
pub(super) struct OpenSeams {
    /// Widest gap of each class of vertices, in m; empty if no seam is open.
    widest: Vec<f64>,
    /// Gaps of the classes in the last step, in m.
    gaps: Vec<f64>,
}

impl OpenSeams {
    /// Opens the seams of a surface without limits.
    pub(super) fn open(&mut self, surface: &Surface) {
        self.widest.clear();
        self.widest.resize(surface.vertex_count(), f64::INFINITY);
    }

    /// Closes all seams.
    pub(super) fn close(&mut self) {
        self.widest.clear();
    }

    /// Returns whether these may be gaps of the classes, in m: none if all seams are closed.
    pub(super) fn may_have(&self, gaps: &[f64]) -> bool {
        gaps.len() == self.widest.len() && gaps.iter().all(|gap| *gap >= 0.0)
    }

    /// Limits the gaps to what the sides of the seams are apart, so that none repels the other.
    pub(super) fn limit<'a>(
        &mut self,
        surface: &Surface,
        active: impl Iterator<Item = &'a ActivePair>,
    ) {
        let seams = &surface.primitives().seams;
        for ActivePair { pair, gap } in active {
            let classes = pair.vertices.map(|vertex| seams.class(vertex));
            let (one, other) = classes.split_at(pair.first_vertices());
            let widest = Separations::widest_seam_gap(gap.distance()).max(LEAST);
            for class in seams.joints(one, other) {
                let own = &mut self.widest[class as usize];
                *own = own.min(widest);
            }
        }
    }

    /// Returns the gap of each class from those at the free vertices, in m; none if all seams are
    /// closed.
    pub(super) fn gaps_of_classes(&mut self, surface: &Surface, gaps: &[f64]) -> &[f64] {
        let Self { widest, gaps: of_classes } = self;
        of_classes.clear();
        of_classes.resize(widest.len(), f64::INFINITY);
        if widest.is_empty() {
            return of_classes;
        }
        let seams = &surface.primitives().seams;
        for (vertex, &gap) in gaps.iter().enumerate() {
            let class = seams.class(vertex as u32) as usize;
            let gap = if gap < LEAST { 0.0 } else { gap.min(widest[class]) };
            of_classes[class] = of_classes[class].min(gap);
        }
        of_classes
    }
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
