//! Edges of triangles, and areas of vertices, edges and triangles.

use crate::error::{Error, check_index};
use crate::vector::{Vector, add, at, cross, norm, scale, subtract};

/// Edges of a list of triangles.
pub(crate) struct TriangleEdges {
    /// Vertices of each edge, the lower first, sorted.
    pub(crate) edges: Vec<[u32; 2]>,
    /// Numbers of the three edges of each triangle.
    by_triangle: Vec<[u32; 3]>,
}

impl TriangleEdges {
    /// Returns the edges of `triangles`.
    pub(crate) fn new(triangles: &[[u32; 3]]) -> TriangleEdges {
        let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * triangles.len());
        for (t, [a, b, c]) in triangles.iter().enumerate() {
            for (k, (from, to)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
                sides.push(([*from.min(to), *from.max(to)], (3 * t + k) as u32));
            }
        }
        sides.sort_unstable();
        let mut edges = Vec::new();
        let mut by_triangle = vec![[0; 3]; triangles.len()];
        for group in sides.chunk_by(|a, b| a.0 == b.0) {
            for (_, side) in group {
                by_triangle[*side as usize / 3][*side as usize % 3] = edges.len() as u32;
            }
            edges.push(group[0].0);
        }
        TriangleEdges { edges, by_triangle }
    }

    /// Returns for each edge a third of the sum of `triangle_areas` beside it, in m².
    pub(crate) fn areas_of_edges(&self, triangle_areas: &[f64]) -> Vec<f64> {
        let mut areas = vec![0.0; self.edges.len()];
        for (edges, area) in self.by_triangle.iter().zip(triangle_areas) {
            for edge in edges {
                areas[*edge as usize] += area / 3.0;
            }
        }
        areas
    }
}

/// Returns the area of each of `triangles` with vertices at `rest`, in m².
pub(crate) fn areas_of_triangles(rest: &[f64], triangles: &[[u32; 3]]) -> Vec<f64> {
    triangles
        .iter()
        .map(|corners| {
            let [a, b, c] = corners.map(|v| at(rest, v as usize));
            0.5 * norm(cross(subtract(b, a), subtract(c, a)))
        })
        .collect()
}

/// Returns for each of `vertex_count` vertices a third of the sum of `triangle_areas` around it, in
/// m².
pub(crate) fn areas_of_vertices(
    triangle_areas: &[f64],
    triangles: &[[u32; 3]],
    vertex_count: usize,
) -> Vec<f64> {
    let mut areas = vec![0.0; vertex_count];
    for (corners, area) in triangles.iter().zip(triangle_areas) {
        for &corner in corners {
            areas[corner as usize] += area / 3.0;
        }
    }
    areas
}

/// Returns the area of each triangle, in m², with a third of it multiplied by the `factor` of each
/// corner.
pub(crate) fn weighted_areas(
    triangle_areas: &[f64],
    triangles: &[[u32; 3]],
    factor: impl Fn(usize) -> f64,
) -> Vec<f64> {
    triangles
        .iter()
        .zip(triangle_areas)
        .map(|(corners, area)| {
            corners.iter().map(|&corner| area / 3.0 * factor(corner as usize)).sum()
        })
        .collect()
}

/// Returns the mean of the positions `rest` of `vertices`, in m.
pub(crate) fn middle(rest: &[f64], vertices: &[u32]) -> Vector {
    let sum = vertices.iter().fold([0.0; 3], |sum, &v| add(sum, at(rest, v as usize)));
    scale(sum, 1.0 / vertices.len() as f64)
}

/// Returns the class of each of `vertex_count` vertices: the smallest number among the vertices
/// that `pairs` join with it, directly or through others.
///
/// # Errors
/// A pair names a vertex that does not exist.
pub fn equivalence_classes(vertex_count: usize, pairs: &[[u32; 2]]) -> Result<Vec<u32>, Error> {
    for &vertex in pairs.as_flattened() {
        check_index("vertex", vertex as usize, vertex_count)?;
    }
    Ok(classes(vertex_count, pairs))
}

/// Returns the classes of [`equivalence_classes`] for `pairs` of vertices that exist.
pub(crate) fn classes(vertex_count: usize, pairs: &[[u32; 2]]) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..vertex_count as u32).collect();
    for &[a, b] in pairs {
        let (a, b) = (root(&mut parent, a), root(&mut parent, b));
        parent[a.max(b) as usize] = a.min(b);
    }
    // A parent is never larger than its child, so it has its root already.
    for vertex in 0..vertex_count {
        parent[vertex] = parent[parent[vertex] as usize];
    }
    parent
}

/// Returns the root of `vertex` in the forest `parent`, in which a root is its own parent. Halves
/// the way to the root, so that a long chain is followed once.
fn root(parent: &mut [u32], mut vertex: u32) -> u32 {
    while parent[vertex as usize] != vertex {
        parent[vertex as usize] = parent[parent[vertex as usize] as usize];
        vertex = parent[vertex as usize];
    }
    vertex
}
