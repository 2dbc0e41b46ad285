//! Inspection of positions: intersections that the test of a step exempts, and vertices inside
//! bodies.

use super::open_seams::LEAST;
use super::pinch::vertices_of;
use super::surface_contact::SurfaceContact;
use crate::error::{Error, check_index};
use crate::surface::exact::{Intersection, encloses, exempt_intersections, intersections};
use crate::surface::geometry::SeamExemptions;
use crate::surface::pair::{PairKind, closest, distance};
use crate::surface::placement::Placement;
use crate::vector::{Vector, at};

/// Intersections between the two sides of seams that contact took for closed before their vertices
/// were one point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SeamIntersections {
    /// Number of edges that meet a triangle to which a closed seam joins them. They are exempt.
    pub exempt: usize,
    /// Number of edges that meet a triangle although the gap of their seam is wider than the gap of
    /// a closed seam.
    pub open: usize,
    /// Largest depth of an exempt intersection, in m: the shortest distance by which the edge
    /// would have to move to leave the triangle. It is at most the gap of a closed seam.
    pub penetration: f64,
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
        Ok(self.are_inside_bodies(&[vertex])?[0])
    }

    /// Returns for each of the free `vertices` whether it is inside a body.
    ///
    /// # Errors
    /// One of `vertices` is not a free vertex.
    pub fn are_inside_bodies(self, vertices: &[usize]) -> Result<Vec<bool>, Error> {
        let surface = &self.contact.surface;
        for &vertex in vertices {
            check_index("free vertex", vertex, surface.free_count())?;
        }

        let all = self.placed();
        let bodies = surface.free_count()..surface.vertex_count();
        let mut groups: Vec<u32> = bodies.map(|v| surface.primitives().group(v as u32)).collect();
        groups.dedup();
        let is_inside = |&vertex: &usize| {
            groups.iter().any(|&group| encloses(surface, group, at(&all, vertex), &all))
        };
        Ok(vertices.iter().map(is_inside).collect())
    }

    /// Returns the intersections between the two sides of seams that contact takes for closed. A
    /// seam is closed where the distance of its vertices from each other, or of a tied vertex from
    /// its edge, is at most `closed_gap`, in m.
    ///
    /// # Errors
    /// Positions are not finite.
    pub fn seam_intersections(self, closed_gap: f64) -> Result<SeamIntersections, Error> {
        let mut result = SeamIntersections::default();
        let surface = &self.contact.surface;
        if !surface.separations.seam_gaps.contains(&0.0) {
            return Ok(result);
        }
        let all = self.placed();
        let intersections = exempt_intersections(surface, &all)?;
        if intersections.is_empty() {
            return Ok(result);
        }

        let seams = &surface.primitives().seams;
        let [met, closed] = [LEAST, closed_gap].map(|gap| seams.within(gap, &all));
        for intersection in intersections {
            let vertices = vertices_of(surface, intersection);
            let are_joined = |seams: &SeamExemptions| {
                let classes = vertices.map(|vertex| seams.class(vertex));
                seams.join(&classes[..2], &classes[2..])
            };
            // Primitives with a common point meet there.
            if are_joined(&met) {
                continue;
            }
            if are_joined(&closed) {
                result.exempt += 1;
                let depth = penetration(vertices.map(|vertex| at(&all, vertex as usize)));
                result.penetration = result.penetration.max(depth);
            } else {
                result.open += 1;
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
}

/// Returns the shortest distance by which an edge that meets a triangle would have to move to leave
/// it, in m. `points` are the two ends of the edge and the three corners of the triangle.
fn penetration([a, b, c, d, e]: [Vector; 5]) -> f64 {
    // The edge leaves the triangle where one of its ends passes the face, or over a side.
    let ends = [a, b].map(|end| (PairKind::VertexFace, [end, c, d, e]));
    let sides = [[c, d], [d, e], [e, c]].map(|[p, q]| (PairKind::EdgeEdge, [a, b, p, q]));
    let ways = ends.into_iter().chain(sides);
    ways.map(|(kind, points)| distance(&closest(kind, points))).fold(f64::INFINITY, f64::min)
}
