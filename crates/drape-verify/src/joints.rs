//! Joints of the cloth: vertices that are one point, and vertices that lie on an edge.
//!
//! The manifest lists the vertices that a run sews. While a seam is open, its two sides are
//! separate cloths: only vertices that are one point in a frame are joined. A run counts a seam as
//! closed some steps before it merges the vertices of the seam. During these steps the sides may
//! intersect within the remaining gap.

use std::collections::BTreeMap;

use crate::distance::point_segment;
use crate::triangle::Vertex;

/// Classes of vertices that are joined.
#[derive(Debug, Clone)]
pub(crate) struct Joints {
    /// Class of each vertex. The class is the smallest vertex that is joined to the vertex.
    classes: Vec<u32>,
    /// Classes of the two ends of the edge to which a vertex is tied, by the class of the vertex.
    between: BTreeMap<u32, [u32; 2]>,
}

/// Vertices that a run sews.
#[derive(Debug, Clone, Default)]
pub(crate) struct SewnVertices {
    /// Pairs of vertices that become one point.
    pub(crate) pairs: Vec<[u32; 2]>,
    /// Vertices that are tied to an edge, each with the two ends of the edge.
    pub(crate) ties: Vec<[u32; 3]>,
    /// Gap at which a run counts a seam as closed, in m.
    pub(crate) closed_gap: f64,
}

impl SewnVertices {
    /// Returns the joints of a garment with `vertex_count` vertices whose seams are all closed.
    pub(crate) fn closed(&self, vertex_count: usize) -> Joints {
        Joints::new(vertex_count, self.pairs.iter().copied(), self.ties.iter().copied())
    }

    /// Returns the joints of the seam vertices that are at most `gap` apart, in m, at `positions`,
    /// in m. A tied vertex may also be off its edge by rounding.
    pub(crate) fn joined_within(&self, gap: f64, positions: &[[f64; 3]]) -> Joints {
        let pairs = self.pairs.iter().copied();
        let closed_pairs = pairs.filter(|&[a, b]| edge_distance([a, b, b], positions) <= gap);
        let ties = self.ties.iter().copied();
        let closed_ties = ties.filter(|&tie| {
            edge_distance(tie, positions) <= gap.max(rounding(positions[tie[0] as usize]))
        });
        Joints::new(positions.len(), closed_pairs, closed_ties)
    }
}

/// Returns the distance, in m, of the vertex `vertex` from the edge between the vertices `a` and
/// `b`.
fn edge_distance([vertex, a, b]: [u32; 3], positions: &[[f64; 3]]) -> f64 {
    let [point, a, b] = [vertex, a, b].map(|vertex| positions[vertex as usize]);
    point_segment(point, [a, b]).distance()
}

/// Returns the distance from its edge, in m, that a tied vertex at `position` may have by rounding.
fn rounding(position: [f64; 3]) -> f64 {
    /// Rounding of the point that the run computes, over the largest coordinate or 1 m.
    const ROUNDING: f64 = 8.0 * f64::EPSILON;

    let size = position.into_iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    ROUNDING * size
}

impl Joints {
    /// Returns the joints of `vertex_count` vertices that `pairs` and `ties` join.
    fn new(
        vertex_count: usize,
        pairs: impl Iterator<Item = [u32; 2]>,
        ties: impl Iterator<Item = [u32; 3]>,
    ) -> Joints {
        let pairs: Vec<[u32; 2]> = pairs.collect();
        let classes = classes(vertex_count, &pairs);
        let between = ties.map(|tie| {
            let [tied, a, b] = tie.map(|vertex| classes[vertex as usize]);
            (tied, [a, b])
        });
        Joints { between: between.collect(), classes }
    }

    /// Returns the [`Vertex`] of vertex `vertex`. Its number is its class.
    pub(crate) fn vertex(&self, vertex: u32) -> Vertex {
        let number = self.classes[vertex as usize];
        Vertex { number, between: self.between.get(&number).copied() }
    }

    /// Returns the class of vertex `vertex`.
    pub(crate) fn class(&self, vertex: usize) -> usize {
        self.classes[vertex] as usize
    }
}

/// Returns the class of each of `vertex_count` vertices: the smallest vertex to which it is joined,
/// directly or through further vertices.
fn classes(vertex_count: usize, pairs: &[[u32; 2]]) -> Vec<u32> {
    let mut classes: Vec<u32> = (0..vertex_count as u32).collect();
    loop {
        let mut settled = true;
        for &[a, b] in pairs {
            let [a, b] = [a as usize, b as usize];
            let least = classes[a].min(classes[b]);
            settled &= classes[a] == least && classes[b] == least;
            (classes[a], classes[b]) = (least, least);
        }
        if settled {
            return classes;
        }
    }
}
