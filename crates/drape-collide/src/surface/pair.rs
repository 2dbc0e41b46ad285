//! Pairs of primitives.

use serde::{Deserialize, Serialize};

use super::distance::{ClosestPoints, edge_edge, vertex_face};
use crate::error::{Error, check_index};
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
    /// Returns the number of vertices of the first primitive: one or two.
    pub(crate) fn first_vertex_count(self) -> usize {
        match self {
            PairKind::VertexFace => 1,
            PairKind::EdgeEdge => 2,
        }
    }
}

/// Kind and features of a pair, by which lists of pairs are sorted.
pub(crate) type PairKey = (PairKind, [u32; 2]);

/// Pair of primitives of a surface that are near each other and share no vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Kind of the primitives.
    pub kind: PairKind,
    /// Numbers of the vertex and the triangle, or of the two edges, the lower first.
    ///
    /// Kind and features identify a pair. Lists of pairs are sorted by both.
    pub features: [u32; 2],
    /// Numbers of the vertex and the three corners, or of the ends of both edges.
    pub vertices: [u32; 4],
    /// Activation distance `$\hat d$`, in m.
    pub activation_distance: f64,
    /// Minimum separation `$\xi$`, in m.
    pub min_separation: f64,
    /// Area of contact `$A$`, in m². At an open seam it is larger, as the range of contact is
    /// shorter.
    pub area: f64,
    /// Threshold `$\epsilon$` of `$|e_1 \times e_2|^2$` below which two edges count as parallel, in
    /// m⁴. It is 0 for a vertex and a triangle.
    pub parallel: f64,
    /// Lower bound of the distance between the two primitives along the motion that the detection
    /// searched, in m.
    pub distance: f64,
}

impl Pair {
    /// Returns kind and features: the [`PairKind`] and the place of the pair in a sorted list.
    #[must_use]
    pub fn key(&self) -> (PairKind, [u32; 2]) {
        (self.kind, self.features)
    }

    /// Returns the number of vertices of the first primitive of [`vertices`](Pair::vertices): one
    /// or two.
    #[must_use]
    pub fn first_vertex_count(&self) -> usize {
        self.kind.first_vertex_count()
    }

    /// Returns the largest sum of two entries of `list`, one of a vertex of each primitive. Entries
    /// beyond the end of `list` are 0.
    pub(crate) fn largest_sum(&self, list: &[f64]) -> f64 {
        let [a, b, c, d] =
            self.vertices.map(|vertex| list.get(vertex as usize).copied().unwrap_or(0.0));
        match self.kind {
            PairKind::VertexFace => a + b.max(c).max(d),
            PairKind::EdgeEdge => a.max(b) + c.max(d),
        }
    }

    /// Returns the points of the four vertices in the flat `positions`, in m.
    pub(crate) fn points(&self, positions: &[f64]) -> [[f64; 3]; 4] {
        self.vertices.map(|vertex| at(positions, vertex as usize))
    }

    /// Returns the distance of the two primitives at the flat `positions`, in m.
    ///
    /// # Errors
    ///
    /// A vertex of the pair has no position.
    pub fn distance_at(&self, positions: &[f64]) -> Result<f64, Error> {
        self.check_positions(positions)?;
        Ok(distance(&closest(self.kind, self.points(positions))))
    }

    /// Checks that all vertices have a place in the flat `positions`.
    pub(crate) fn check_positions(&self, positions: &[f64]) -> Result<(), Error> {
        let count = positions.len() / 3;
        self.vertices.iter().try_for_each(|&vertex| check_index("vertex", vertex as usize, count))
    }
}

/// Returns the closest points of two primitives of a pair of `kind` with the vertices `points`.
pub(crate) fn closest(kind: PairKind, points: [[f64; 3]; 4]) -> ClosestPoints {
    match kind {
        PairKind::VertexFace => vertex_face(points),
        PairKind::EdgeEdge => edge_edge(points),
    }
}

/// Returns the distance between the `closest` points, in m.
pub(crate) fn distance(closest: &ClosestPoints) -> f64 {
    dot(closest.offset, closest.offset).sqrt()
}
