use crate::closest::{Closest, edge_edge, vertex_face};
use crate::vector::{at, dot};

/// Which primitives a pair is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PairKind {
    /// A vertex and a triangle.
    VertexFace,
    /// Two edges.
    EdgeEdge,
}

/// Two primitives of a surface that are near each other and share no vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Which primitives these are.
    pub kind: PairKind,
    /// The vertex and the triangle, or the two edges, the lower first, by number in the surface.
    ///
    /// PairKind and features together name a pair; lists of pairs are sorted by them.
    pub features: [u32; 2],
    /// The vertex and the three corners, or the two ends of one edge and the two of the other.
    pub vertices: [u32; 4],
    /// Distance `$r$` below which the two push each other, in m.
    pub activation_distance: f64,
    /// Distance `$\xi$` that the two always keep, in m.
    pub min_separation: f64,
    /// Area that the contact of the two stands for, in m².
    pub area: f64,
    /// Square of the sine times the lengths at rest below which two edges count as parallel, in
    /// m⁴; 0 for a vertex and a triangle.
    pub parallel: f64,
    /// Distance where the pair was detected, in m, less what its course can take off it.
    pub distance: f64,
}

impl Pair {
    /// PairKind and features: the order in a list.
    pub fn key(&self) -> (PairKind, [u32; 2]) {
        (self.kind, self.features)
    }

    /// Vertices of the first primitive: one, or two.
    pub(crate) fn first(&self) -> usize {
        match self.kind {
            PairKind::VertexFace => 1,
            PairKind::EdgeEdge => 2,
        }
    }

    /// The largest sum of two numbers of a list, of a vertex of either primitive.
    pub(crate) fn most(&self, list: &[f64]) -> f64 {
        let [a, b, c, d] = self.vertices.map(|vertex| list[vertex as usize]);
        match self.kind {
            PairKind::VertexFace => a + b.max(c).max(d),
            PairKind::EdgeEdge => a.max(b) + c.max(d),
        }
    }

    /// The four vertices' places, in m.
    pub(crate) fn places(&self, positions: &[f64]) -> [[f64; 3]; 4] {
        self.vertices.map(|vertex| at(positions, vertex as usize))
    }

    /// Distance of the two primitives at flat positions, in m.
    pub fn distance_at(&self, positions: &[f64]) -> f64 {
        distance(&closest(self.kind, self.places(positions)))
    }
}

/// The closest points of two primitives of a kind.
pub(crate) fn closest(kind: PairKind, places: [[f64; 3]; 4]) -> Closest {
    match kind {
        PairKind::VertexFace => vertex_face(places),
        PairKind::EdgeEdge => edge_edge(places),
    }
}

/// The distance of two closest points, in m.
pub(crate) fn distance(closest: &Closest) -> f64 {
    dot(closest.way, closest.way).sqrt()
}
