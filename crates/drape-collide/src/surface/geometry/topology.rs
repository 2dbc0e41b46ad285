//! Edges of triangles, and areas of vertices, edges and triangles.

use crate::vector::{Vector, add, at, cross, norm, scale, subtract};

/// Edges of a list of triangles.
pub(crate) struct Topology {
    /// Vertices of each edge, the lower first, sorted.
    pub(crate) edges: Vec<[u32; 2]>,
    /// Edges of each triangle.
    of_triangles: Vec<[u32; 3]>,
}

impl Topology {
    /// Finds the edges of triangles.
    pub(crate) fn new(triangles: &[[u32; 3]]) -> Topology {
        let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * triangles.len());
        for (t, [a, b, c]) in triangles.iter().enumerate() {
            for (k, (from, to)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
                sides.push(([*from.min(to), *from.max(to)], (3 * t + k) as u32));
            }
        }
        sides.sort_unstable();
        let mut edges = Vec::new();
        let mut of_triangles = vec![[0; 3]; triangles.len()];
        for group in sides.chunk_by(|a, b| a.0 == b.0) {
            for (_, side) in group {
                of_triangles[*side as usize / 3][*side as usize % 3] = edges.len() as u32;
            }
            edges.push(group[0].0);
        }
        Topology { edges, of_triangles }
    }

    /// Returns a third of the area of the triangles at each edge, in m².
    pub(crate) fn areas_of_edges(&self, triangle_areas: &[f64]) -> Vec<f64> {
        let mut areas = vec![0.0; self.edges.len()];
        for (edges, area) in self.of_triangles.iter().zip(triangle_areas) {
            for edge in edges {
                areas[*edge as usize] += area / 3.0;
            }
        }
        areas
    }
}

/// Returns the area of each triangle, in m².
pub(crate) fn areas_of_triangles(rest: &[f64], triangles: &[[u32; 3]]) -> Vec<f64> {
    let area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|v| at(rest, v as usize));
        0.5 * norm(cross(subtract(b, a), subtract(c, a)))
    };
    triangles.iter().map(area).collect()
}

/// Returns a third of the area of the triangles at each vertex, in m².
pub(crate) fn areas_of_vertices(
    triangle_areas: &[f64],
    triangles: &[[u32; 3]],
    vertices: usize,
) -> Vec<f64> {
    let mut areas = vec![0.0; vertices];
    for (corners, area) in triangles.iter().zip(triangle_areas) {
        for &corner in corners {
            areas[corner as usize] += area / 3.0;
        }
    }
    areas
}

/// Returns the area of each triangle, in m², a third of it times a factor of each corner.
pub(crate) fn weighted_areas(
    triangle_areas: &[f64],
    triangles: &[[u32; 3]],
    factor: impl Fn(usize) -> f64,
) -> Vec<f64> {
    let weighted = |(corners, area): (&[u32; 3], &f64)| {
        corners.iter().map(|&corner| area / 3.0 * factor(corner as usize)).sum()
    };
    triangles.iter().zip(triangle_areas).map(weighted).collect()
}

/// Returns the mean position of some vertices, in m.
pub(crate) fn middle(rest: &[f64], vertices: &[u32]) -> Vector {
    let sum = vertices.iter().fold([0.0; 3], |sum, &v| add(sum, at(rest, v as usize)));
    scale(sum, 1.0 / vertices.len() as f64)
}

/// Returns the smallest vertex of those that seam pairs join, directly or through others, for each
/// vertex.
///
/// # Panics
/// If a vertex of a pair is not among the vertices.
#[must_use]
pub fn equivalence_classes(vertices: usize, seam_pairs: &[[u32; 2]]) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..vertices as u32).collect();
    let root = |parent: &[u32], mut vertex: u32| {
        while parent[vertex as usize] != vertex {
            vertex = parent[vertex as usize];
        }
        vertex
    };
    for &[a, b] in seam_pairs {
        let (a, b) = (root(&parent, a), root(&parent, b));
        parent[a.max(b) as usize] = a.min(b);
    }
    // A parent is never larger than its child, so it has its root already.
    for vertex in 0..vertices {
        parent[vertex] = parent[parent[vertex] as usize];
    }
    parent
}
