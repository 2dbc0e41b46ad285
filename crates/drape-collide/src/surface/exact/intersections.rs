//! Intersections of a surface with itself.

use super::predicate::segment_meets_triangle;
use crate::error::Error;
use crate::surface::broad_phase::{BodyBoxes, Bounds, BoxTree, Probe, fill_lanes};
use crate::surface::contact_surface::Surface;
use crate::surface::geometry::{PrimitiveRun, share_vertex};
use crate::surface::placement::Placement;
use crate::threads::*;
use crate::vector::at;

/// Number of runs of edges in a chunk, which one thread handles at a time.
const CHUNK: usize = 64;

/// Edge and triangle that intersect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Intersection {
    /// Number of the edge in the surface.
    pub edge: u32,
    /// Number of the triangle in the surface.
    pub triangle: u32,
}

/// Returns all edges of `surface` that meet a triangle at the flat `positions`, in m, sorted.
/// Touching counts.
///
/// Edges that share a vertex with the triangle, directly or through a closed seam, and pairs
/// without a free vertex are left out. If two triangles without a common vertex meet, an edge of
/// one meets the other. The result is exact for the rounded positions (\[She97\], by the crate
/// `robust`), unless two coordinates differ by less than 1e-60 m without being equal.
///
/// # Errors
///
/// There are not three coordinates for each vertex, or a coordinate is not finite or beyond 1000
/// km.
pub fn intersections(surface: &Surface, positions: &[f64]) -> Result<Vec<Intersection>, Error> {
    let mut test = IntersectionTest::default();
    test.run(surface, positions, None)?;
    Ok(test.intersections)
}

/// Returns the intersections of edges and triangles of `surface` that are exempt from contact
/// because a seam joins them, sorted. Pairs with a common vertex are left out.
///
/// # Errors
///
/// As for [`intersections`].
pub(crate) fn exempt_intersections(
    surface: &Surface,
    positions: &[f64],
) -> Result<Vec<Intersection>, Error> {
    let mut test = IntersectionTest { tests_exempt: true, ..IntersectionTest::default() };
    test.run(surface, positions, None)?;
    Ok(test.intersections)
}

/// Intersection test with its tree and lists, which allocate memory only when they grow.
#[derive(Debug, Default)]
pub(crate) struct IntersectionTest {
    tree: BoxTree,
    body_edges: BodyBoxes,
    /// Revision of the bodies' positions for which the boxes of the bodies were fitted; `None` if
    /// these boxes cannot be kept.
    fitted: Option<u64>,
    chunks: Vec<Vec<Intersection>>,
    /// Whether exempt pairs are tested, instead of all others.
    tests_exempt: bool,
    /// Intersections of the last run, sorted.
    pub(crate) intersections: Vec<Intersection>,
}

/// Boxes of an intersection test that have been fitted to positions.
struct FittedTest<'a> {
    surface: &'a Surface,
    positions: &'a [f64],
    tree: &'a BoxTree,
    body_edges: &'a BodyBoxes,
    /// Box around all free triangles.
    free_triangles: Bounds,
    tests_exempt: bool,
}

impl IntersectionTest {
    /// Finds all edges of `surface` that meet a triangle at `placement`.
    pub(crate) fn run_placed(
        &mut self,
        surface: &Surface,
        placement: &Placement,
    ) -> Result<(), Error> {
        self.run(surface, placement, placement.revision())
    }

    /// Finds all edges of `surface` that meet a triangle at the flat `positions`. `revision` is the
    /// revision of the bodies' positions.
    fn run(
        &mut self,
        surface: &Surface,
        positions: &[f64],
        revision: Option<u64>,
    ) -> Result<(), Error> {
        self.intersections.clear();
        surface.check_positions(positions)?;
        let primitives = surface.primitives();
        let point = |vertex: u32| at(positions, vertex as usize);

        // Boxes of bodies stay valid as long as their positions have one revision.
        let order = &primitives.triangle_order;
        let keeps_bodies = revision.is_some() && revision == self.fitted;
        self.fitted = revision;
        self.tree.fit(order, keeps_bodies, |triangle| {
            Bounds::around(primitives.triangles[triangle as usize].map(point), 0.0)
        });
        self.body_edges.fit(
            primitives.edge_runs.chunks(CHUNK),
            keeps_bodies,
            |edge| primitives.is_free(&primitives.edges[edge as usize]),
            |edge| Bounds::around(primitives.edges[edge as usize].map(point), 0.0),
        );

        // Chunks are tested in parallel and joined in their order.
        let fitted = FittedTest {
            surface,
            positions,
            tree: &self.tree,
            body_edges: &self.body_edges,
            free_triangles: self.tree.free_bounds(order),
            tests_exempt: self.tests_exempt,
        };
        let runs = primitives.edge_runs.par_chunks(CHUNK).enumerate();
        self.chunks.resize_with(runs.len(), Vec::new);
        runs.zip(self.chunks.par_iter_mut())
            .with_max_len(1)
            .for_each(|((chunk, runs), list)| fitted.test_chunk(chunk, runs, list));
        self.chunks.iter().for_each(|list| self.intersections.extend_from_slice(list));
        Ok(())
    }
}

impl FittedTest<'_> {
    /// Writes the intersections of the edges of `runs`, which are chunk number `chunk`, to `list`.
    fn test_chunk(&self, chunk: usize, runs: &[PrimitiveRun], list: &mut Vec<Intersection>) {
        list.clear();
        if self.body_edges.may_meet(chunk, &self.free_triangles) {
            for run in runs {
                self.test_run(*run, list);
            }
        }
    }

    /// Adds the intersections of the edges of `run`, sorted, to `list`.
    fn test_run(&self, run: PrimitiveRun, list: &mut Vec<Intersection>) {
        let primitives = self.surface.primitives();
        let order = &primitives.triangle_order;
        let point = |vertex: u32| at(self.positions, vertex as usize);
        let ends = fill_lanes(run.count, [0; 2], |k| primitives.edges[run.first as usize + k]);
        let segments = ends.map(|ends| ends.map(point));
        let probe = Probe {
            bounds: fill_lanes(run.count, Bounds::EMPTY, |k| Bounds::around(segments[k], 0.0)),
            only_free: !primitives.is_free(&ends[0]),
            after: None,
        };
        let classes = ends.map(|ends| ends.map(|end| primitives.seams.class(end)));

        let first = list.len();
        self.tree.visit(order, &probe, |k, slot| {
            let triangle = order.items[slot];
            let corners = &primitives.triangles[triangle as usize];
            let vertices = [&ends[k][..], &corners[..]];
            let classes = [&classes[k][..], &primitives.triangle_classes[slot]];
            let exempt = self.surface.separations.exempt(&primitives.seams, vertices, classes);
            let is_tested = exempt == self.tests_exempt && !(exempt && share_vertex(vertices));
            if is_tested && segment_meets_triangle(segments[k], corners.map(point)) {
                list.push(Intersection { edge: run.first + k as u32, triangle });
            }
        });
        list[first..].sort_unstable();
    }
}
