//! Edges of a triangulation, with the triangles beside them.

use std::collections::BTreeMap;

use crate::mesh_io::Triangulation;

/// Side of an edge: the triangle there, and whether the corners of the triangle run from the
/// smaller to the larger vertex number of the edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Side {
    pub(crate) triangle: u32,
    pub(crate) rises: bool,
}

/// Edges with their sides, in the order of their vertex numbers.
#[derive(Debug, Default)]
pub(crate) struct Edges {
    sides: BTreeMap<[u32; 2], Vec<Side>>,
}

impl Edges {
    /// Returns the edges of `triangles`.
    pub(crate) fn new(triangles: &[[u32; 3]]) -> Edges {
        let mut sides: BTreeMap<[u32; 2], Vec<Side>> = BTreeMap::new();
        for (triangle, corners) in triangles.iter().enumerate() {
            for k in 0..3 {
                let (from, to) = (corners[k], corners[(k + 1) % 3]);
                let side = Side { triangle: triangle as u32, rises: from < to };
                sides.entry([from.min(to), from.max(to)]).or_default().push(side);
            }
        }
        Edges { sides }
    }

    /// Returns all edges with their sides.
    pub(crate) fn iter(&self) -> impl Iterator<Item = ([u32; 2], &[Side])> {
        self.sides.iter().map(|(edge, sides)| (*edge, &sides[..]))
    }

    /// Returns the sides of an edge, empty for an edge that no triangle has.
    pub(crate) fn sides(&self, [a, b]: [u32; 2]) -> &[Side] {
        self.sides.get(&[a.min(b), a.max(b)]).map_or(&[], |sides| &sides[..])
    }

    /// Returns the number of the part of each triangle. Triangles that share an edge belong to one
    /// part. `triangle_count` is the number of triangles.
    pub(crate) fn parts(&self, triangle_count: usize) -> Vec<u32> {
        let mut parts: Vec<u32> = (0..triangle_count as u32).collect();
        for (_, sides) in self.iter() {
            for pair in sides.windows(2) {
                let [a, b] = [pair[0], pair[1]].map(|side| root(&mut parts, side.triangle));
                parts[a.max(b) as usize] = a.min(b);
            }
        }
        (0..triangle_count as u32).map(|triangle| root(&mut parts, triangle)).collect()
    }
}

/// Returns the first triangle of the part of `triangle`, and shortens the path to it in `parts`.
fn root(parts: &mut [u32], triangle: u32) -> u32 {
    let mut top = triangle;
    while parts[top as usize] != top {
        parts[top as usize] = parts[parts[top as usize] as usize];
        top = parts[top as usize];
    }
    top
}

/// Returns six times the signed volume between `triangle` and the point `origin`, in m³.
pub(crate) fn volume_six(mesh: &Triangulation, triangle: [u32; 3], origin: [f64; 3]) -> f64 {
    use crate::vector::{cross, dot, subtract};
    let [a, b, c] = mesh.corners(triangle).map(|corner| subtract(corner, origin));
    dot(a, cross(b, c))
}
