use crate::detector::array;
use crate::error::Error;
use crate::order::Run;
use crate::predicate::segment_meets_triangle;
use crate::surface::Surface;
use crate::tree::{Bounds, Probe, Tree};
use crate::vector::at;
use rayon::prelude::*;

/// Runs of edges that one thread looks after at a time.
const CHUNK: usize = 64;

/// An edge and a triangle that meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Intersection {
    /// The edge, by number in the surface.
    pub edge: u32,
    /// The triangle, by number in the surface.
    pub triangle: u32,
}

/// All edges that meet a triangle at flat positions, sorted: exact, and touching counts.
///
/// Left out are edges that share a vertex with the triangle, directly or through what is sewn, and
/// pairs without a free vertex. Two triangles without a common vertex that meet always have such a
/// crossing. The answer is exact for the positions as they are rounded (Shewchuk 1997, "Adaptive
/// Precision Floating-Point Arithmetic", through the crate `robust`), unless coordinates differ
/// from each other by less than 1e-60 m but not at all.
///
/// # Errors
///
/// If there are not three coordinates for each vertex, or one is not finite or beyond 1000 km.
pub fn intersections(surface: &Surface, positions: &[f64]) -> Result<Vec<Intersection>, Error> {
    surface.check_positions(positions)?;
    let place = |vertex: u32| at(positions, vertex as usize);
    let order = &surface.triangle_order;
    let mut tree = Tree::default();
    tree.fit(order, |triangle| {
        Bounds::around(surface.triangles()[triangle as usize].map(place), 0.0)
    });
    let runs = |runs: &[Run]| {
        let mut found = Vec::new();
        for run in runs {
            let ends = |k: usize| surface.edges()[run.first as usize + k];
            let segment = |k: usize| ends(k).map(place);
            let probe = Probe {
                bounds: array(run.count, Bounds::EMPTY, |k| Bounds::around(segment(k), 0.0)),
                only_free: !surface.is_free(&ends(0)),
                after: None,
            };
            let classes = array(run.count, [0; 2], |k| ends(k).map(|end| surface.sewn.class(end)));
            let first = found.len();
            tree.visit(order, &probe, |k, slot| {
                let triangle = order.items[slot];
                let corners = surface.triangles()[triangle as usize].map(place);
                let joined = surface.sewn.joins(&classes[k], &surface.triangle_classes[slot]);
                if !joined && segment_meets_triangle(segment(k), corners) {
                    found.push(Intersection { edge: run.first + k as u32, triangle });
                }
            });
            found[first..].sort_unstable();
        }
        found
    };
    let chunks = surface.edge_runs.par_chunks(CHUNK).with_max_len(1).map(runs);
    let chunks: Vec<Vec<Intersection>> = chunks.collect();
    Ok(chunks.concat())
}
