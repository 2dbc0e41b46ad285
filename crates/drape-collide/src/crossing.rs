use crate::error::CollideError;
use crate::predicate::segment_meets_triangle;
use crate::surface::Surface;
use crate::tree::{Bounds, Tree};
use crate::vector::at;
use rayon::prelude::*;

/// Edges that one thread looks after at a time.
const CHUNK: usize = 256;

/// An edge and a triangle that meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Crossing {
    /// The edge, by number in the surface.
    pub edge: u32,
    /// The triangle, by number in the surface.
    pub triangle: u32,
}

/// All edges that meet a triangle at flat positions, sorted: exact, and touching counts.
///
/// Left out are edges that share a vertex with the triangle, directly or through twins, and pairs
/// without a free vertex. Two triangles without a common vertex that meet always have such a
/// crossing. The answer is exact for the positions as they are rounded (Shewchuk 1997, "Adaptive
/// Precision Floating-Point Arithmetic", through the crate `robust`), unless coordinates differ
/// from each other by less than 1e-60 m but not at all.
///
/// # Errors
///
/// If there are not three coordinates for each vertex, or one is not finite or beyond 1000 km.
pub fn crossings(surface: &Surface, positions: &[f64]) -> Result<Vec<Crossing>, CollideError> {
    surface.check_positions(positions)?;
    let place = |vertex: u32| at(positions, vertex as usize);
    let order = &surface.triangle_order;
    let mut tree = Tree::default();
    tree.fit(order, |triangle| {
        Bounds::around(surface.triangles()[triangle as usize].map(place), 0.0)
    });
    let chunk_crossings = |(chunk, edges): (usize, &[[u32; 2]])| {
        let mut found = Vec::new();
        for (k, &ends) in edges.iter().enumerate() {
            let edge = (chunk * CHUNK + k) as u32;
            let segment = ends.map(place);
            let first = found.len();
            let only_free = !surface.is_free(&ends);
            tree.visit(order, (&Bounds::around(segment, 0.0), only_free), |triangle| {
                let corners = surface.triangles()[triangle as usize];
                let shared = |&end: &u32| {
                    corners.iter().any(|&corner| surface.class(corner) == surface.class(end))
                };
                if !ends.iter().any(shared) && segment_meets_triangle(segment, corners.map(place)) {
                    found.push(Crossing { edge, triangle });
                }
            });
            found[first..].sort_unstable();
        }
        found
    };
    let chunks = surface.edges().par_chunks(CHUNK).enumerate().map(chunk_crossings);
    let chunks: Vec<Vec<Crossing>> = chunks.collect();
    Ok(chunks.concat())
}
