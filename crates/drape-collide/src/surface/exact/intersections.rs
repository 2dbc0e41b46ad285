//! Intersections of a surface with itself.

use rayon::prelude::*;

use super::predicate::segment_meets_triangle;
use crate::error::Error;
use crate::surface::broad_phase::{BodyBoxes, Bounds, Probe, Tree, array};
use crate::surface::contact_surface::Surface;
use crate::surface::geometry::{Run, share_vertex};
use crate::surface::placement::Placement;
use crate::vector::at;

/// Number of runs of edges of a chunk, for one thread at a time.
const CHUNK: usize = 64;

/// Edge and triangle that intersect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Intersection {
    /// Number of the edge in the surface.
    pub edge: u32,
    /// Number of the triangle in the surface.
    pub triangle: u32,
}

/// Returns all edges that meet a triangle at flat positions, sorted: exact, and touching counts.
///
/// Edges that share a vertex with the triangle, directly or through a closed seam, and pairs without
/// a free vertex are left out. Of two triangles without a common vertex that meet, an edge of one
/// always meets the other. The result is exact for the positions as they are rounded (\[She97\], by
/// the crate `robust`), unless coordinates differ from each other by less than 1e-60 m but not at
/// all.
///
/// # Errors
///
/// If there are not three coordinates for each vertex, or one is not finite or beyond 1000 km.
pub fn intersections(surface: &Surface, positions: &[f64]) -> Result<Vec<Intersection>, Error> {
    let mut test = IntersectionTest::default();
    test.run(surface, positions, None)?;
    Ok(test.found)
}

/// Returns the intersections, sorted, of edges with triangles that are exempt from contact because a
/// seam joins them; pairs with a common vertex are left out.
///
/// # Errors
///
/// As [`intersections`].
pub(crate) fn exempt_intersections(
    surface: &Surface,
    positions: &[f64],
) -> Result<Vec<Intersection>, Error> {
    let mut test = IntersectionTest { of_exempt: true, ..IntersectionTest::default() };
    test.run(surface, positions, None)?;
    Ok(test.found)
}

/// Intersection test with its tree and lists, which allocate only when they grow.
#[derive(Debug, Default)]
pub(crate) struct IntersectionTest {
    tree: Tree,
    body_edges: BodyBoxes,
    /// Revision of the bodies' positions that their boxes are of; none if they are not to be kept.
    fitted: Option<u64>,
    chunks: Vec<Vec<Intersection>>,
    /// Whether exempt pairs are tested, instead of all others.
    of_exempt: bool,
    /// Intersections of the last run, sorted.
    pub(crate) found: Vec<Intersection>,
}

impl IntersectionTest {
    /// Finds all edges that meet a triangle at a placement.
    pub(crate) fn run_placed(
        &mut self,
        surface: &Surface,
        placement: &Placement,
    ) -> Result<(), Error> {
        self.run(surface, placement, placement.revision())
    }

    /// Finds the same at flat positions, with the revision of the bodies' ones.
    fn run(
        &mut self,
        surface: &Surface,
        positions: &[f64],
        revision: Option<u64>,
    ) -> Result<(), Error> {
        self.found.clear();
        surface.check_positions(positions)?;
        let primitives = surface.primitives();
        let point = |vertex: u32| at(positions, vertex as usize);
        let order = &primitives.triangle_order;
        let keeps_bodies = revision.is_some() && revision == self.fitted;
        self.fitted = revision;
        self.tree.fit(order, keeps_bodies, |triangle| {
            Bounds::around(primitives.triangles[triangle as usize].map(point), 0.0)
        });
        let is_free = |edge: u32| primitives.is_free(&primitives.edges[edge as usize]);
        let chunks = primitives.edge_runs.chunks(CHUNK);
        self.body_edges.fit(chunks, keeps_bodies, is_free, |edge| {
            Bounds::around(primitives.edges[edge as usize].map(point), 0.0)
        });
        let free = self.tree.free_bounds(order);
        let (tree, body_edges, of_exempt) = (&self.tree, &self.body_edges, self.of_exempt);
        let scan = |(chunk, runs): (usize, &[Run]), found: &mut Vec<Intersection>| {
            found.clear();
            if !body_edges.may_meet(chunk, &free) {
                return;
            }
            for run in runs {
                let ends = |k: usize| primitives.edges[run.first as usize + k];
                let segment = |k: usize| ends(k).map(point);
                let probe = Probe {
                    bounds: array(run.count, Bounds::EMPTY, |k| Bounds::around(segment(k), 0.0)),
                    only_free: !primitives.is_free(&ends(0)),
                    after: None,
                };
                let class = |end: u32| primitives.seams.class(end);
                let classes = array(run.count, [0; 2], |k| ends(k).map(class));
                let first = found.len();
                tree.visit(order, &probe, |k, slot| {
                    let triangle = order.items[slot];
                    let corners = primitives.triangles[triangle as usize].map(point);
                    let vertices = [&ends(k)[..], &primitives.triangles[triangle as usize]];
                    let classes = [&classes[k][..], &primitives.triangle_classes[slot]];
                    let exempt = surface.separations.exempt(&primitives.seams, vertices, classes);
                    let is_tested = exempt == of_exempt && !(exempt && share_vertex(vertices));
                    if is_tested && segment_meets_triangle(segment(k), corners) {
                        found.push(Intersection { edge: run.first + k as u32, triangle });
                    }
                });
                found[first..].sort_unstable();
            }
        };
        let runs = primitives.edge_runs.par_chunks(CHUNK).enumerate();
        self.chunks.resize_with(runs.len(), Vec::new);
        let chunks = self.chunks.par_iter_mut();
        runs.zip(chunks).with_max_len(1).for_each(|(runs, found)| scan(runs, found));
        self.chunks.iter().for_each(|found| self.found.extend_from_slice(found));
        Ok(())
    }
}
