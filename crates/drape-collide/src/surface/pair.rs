//! Pairs of primitives.

use serde::{Deserialize, Serialize};

use super::distance::{Closest, edge_edge, vertex_face};
use crate::vector::{at, dot};

/// Kind of a pair of primitives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum PairKind {
    /// A vertex and a triangle.
    VertexFace,
    /// Two edges.
    EdgeEdge,
}

impl PairKind {
    /// Number of vertices of the first primitive: one, or two.
    pub(crate) fn first_vertices(self) -> usize {
        match self {
            PairKind::VertexFace => 1,
            PairKind::EdgeEdge => 2,
        }
    }
}

/// Kind and features of a pair: its place in a sorted list.
pub(crate) type PairKey = (PairKind, [u32; 2]);

/// Pair of primitives of a surface that are near each other and share no vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Kind of the primitives.
    pub kind: PairKind,
    /// Numbers of the vertex and the triangle, or of the two edges, the lower first.
    ///
    /// Kind and features together identify a pair; lists of pairs are sorted by them.
    pub features: [u32; 2],
    /// Numbers of the vertex and the three corners, or of the ends of one edge and of the other.
    pub vertices: [u32; 4],
    /// Activation distance `$\hat d$`, in m.
    pub activation_distance: f64,
    /// Minimum separation `$\xi$`, in m.
    pub min_separation: f64,
    /// Area of contact `$A$`, in m²; at an open seam larger as the range of contact is shorter.
    pub area: f64,
    /// Threshold `$\epsilon$` of `$|e_1 \times e_2|^2$` below which two edges count as parallel, in
    /// m⁴; 0 for a vertex and a triangle.
    pub parallel: f64,
    /// Lower bound of the distance on the trajectories of the detection, in m.
    pub distance: f64,
}

impl Pair {
    /// Kind and features: the order in a list.
    #[must_use]
    pub fn key(&self) -> (PairKind, [u32; 2]) {
        (self.kind, self.features)
    }

    /// Number of vertices of the first primitive: one, or two.
    #[must_use]
    pub fn first_vertices(&self) -> usize {
        self.kind.first_vertices()
    }

    /// Returns the largest sum of a number of a vertex of one primitive and one of the other, from a list
    /// by vertex; numbers beyond its end are 0.
    pub(crate) fn largest_sum(&self, list: &[f64]) -> f64 {
        let number = |vertex: u32| list.get(vertex as usize).copied().unwrap_or(0.0);
        let [a, b, c, d] = self.vertices.map(number);
        match self.kind {
            PairKind::VertexFace => a + b.max(c).max(d),
            PairKind::EdgeEdge => a.max(b) + c.max(d),
        }
    }

    /// Positions of the four vertices, in m.
    pub(crate) fn points(&self, positions: &[f64]) -> [[f64; 3]; 4] {
        self.vertices.map(|vertex| at(positions, vertex as usize))
    }

    /// Returns the distance of the two primitives at flat positions, in m.
    #[must_use]
    pub fn distance_at(&self, positions: &[f64]) -> f64 {
        distance(&closest(self.kind, self.points(positions)))
    }
}

/// Returns the closest points of two primitives of a kind.
pub(crate) fn closest(kind: PairKind, points: [[f64; 3]; 4]) -> Closest {
    match kind {
        PairKind::VertexFace => vertex_face(points),
        PairKind::EdgeEdge => edge_edge(points),
    }
}

/// Returns the distance of two closest points, in m.
pub(crate) fn distance(closest: &Closest) -> f64 {
    dot(closest.offset, closest.offset).sqrt()
}
