//! Edges of a triangulation, with the triangles on their sides.

use std::collections::BTreeMap;

use crate::mesh_io::Triangulation;

/// Side of a triangle: the triangle, and whether its corners run from the smaller to the larger
/// vertex number of the edge.
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
    /// Returns the edges of some triangles.
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

    /// Returns the edges with their sides.
    pub(crate) fn iter(&self) -> impl Iterator<Item = ([u32; 2], &[Side])> {
        self.sides.iter().map(|(edge, sides)| (*edge, &sides[..]))
    }

    /// Returns the sides of an edge.
    pub(crate) fn sides(&self, [a, b]: [u32; 2]) -> &[Side] {
        self.sides.get(&[a.min(b), a.max(b)]).map_or(&[], |sides| &sides[..])
    }

    /// Returns for each triangle the number of its part: of the triangles that share edges with it,
    /// and theirs.
    pub(crate) fn parts(&self, triangles: usize) -> Vec<u32> {
        let mut parts: Vec<u32> = (0..triangles as u32).collect();
        for (_, sides) in self.iter() {
            for pair in sides.windows(2) {
                let [one, other] = [pair[0], pair[1]].map(|side| root(&mut parts, side.triangle));
                parts[one.max(other) as usize] = one.min(other);
            }
        }
        (0..triangles as u32).map(|triangle| root(&mut parts, triangle)).collect()
    }
}

/// Returns the first triangle of the part of a triangle, and shortens the way to it.
fn root(parts: &mut [u32], triangle: u32) -> u32 {
    let mut top = triangle;
    while parts[top as usize] != top {
        parts[top as usize] = parts[parts[top as usize] as usize];
        top = parts[top as usize];
    }
    top
}

/// Returns six times the volume between a triangle and a point, in m³.
pub(crate) fn volume_six(mesh: &Triangulation, triangle: [u32; 3], origin: [f64; 3]) -> f64 {
    use crate::vector::{cross, dot, subtract};
    let [a, b, c] = triangle.map(|vertex| subtract(mesh.vertices[vertex as usize], origin));
    dot(a, cross(b, c))
}
