//! Joints of the cloth: vertices that are one point, and vertices on an edge between two others.
//!
//! The manifest says which vertices a run sews. While its seams are open they are apart, and the two
//! sides of a seam are two cloths: only what is one point in a frame is joined there. A run counts a
//! seam as closed some steps before it merges its vertices; from then on the sides may intersect
//! within that gap.

use std::collections::BTreeMap;

use crate::distance::{Closest, point_segment};
use crate::triangle::Vertex;

/// Distance from its edge within which a tied vertex lies on it, over the largest coordinate: the
/// rounding of the point that the run computes.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Gap at which a run counts a seam as closed, in m.
pub(crate) const CLOSED: f64 = 1e-4;

/// Vertices that are joined.
#[derive(Debug, Clone)]
pub(crate) struct Joints {
    /// Smallest of the vertices that are joined to each vertex: the representative of its class.
    class: Vec<u32>,
    /// Classes of the two ends of the edge on which a vertex lies, by the class of the vertex.
    between: BTreeMap<u32, [u32; 2]>,
}

/// Vertices that a run sews: pairs that become one, and vertices that come to lie between two others.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sewn {
    pub(crate) pairs: Vec<[u32; 2]>,
    pub(crate) ties: Vec<[u32; 3]>,
}

impl Sewn {
    /// Returns the joints of a garment whose seams are all closed.
    pub(crate) fn closed(&self, vertices: usize) -> Joints {
        Joints::new(vertices, self.pairs.iter().copied(), self.ties.iter().copied())
    }

    /// Returns the joints of the seams whose gap is at most a width, in m, at some positions, in m. A
    /// tied vertex may also lie off its edge by rounding.
    pub(crate) fn joined_within(&self, gap: f64, positions: &[[f64; 3]]) -> Joints {
        let at = |vertex: u32| positions[vertex as usize];
        let distance = |vertex: u32, edge: [u32; 2]| {
            let Closest { squared, .. } = point_segment(at(vertex), edge.map(at));
            squared.sqrt()
        };
        let pairs = self.pairs.iter().copied();
        let pairs = pairs.filter(|&[a, b]| distance(a, [b, b]) <= gap);
        let lies_on = |[own, a, b]: [u32; 3]| {
            let size = at(own).into_iter().fold(1.0, |size: f64, x| size.max(x.abs()));
            distance(own, [a, b]) <= gap.max(ROUNDING * size)
        };
        let ties = self.ties.iter().copied().filter(|&tie| lies_on(tie));
        Joints::new(positions.len(), pairs, ties)
    }
}

impl Joints {
    fn new(
        vertices: usize,
        pairs: impl Iterator<Item = [u32; 2]>,
        ties: impl Iterator<Item = [u32; 3]>,
    ) -> Joints {
        let pairs: Vec<[u32; 2]> = pairs.collect();
        let class = classes(vertices, &pairs);
        let between = ties.map(|tie| {
            let [own, a, b] = tie.map(|vertex| class[vertex as usize]);
            (own, [a, b])
        });
        Joints { between: between.collect(), class }
    }

    /// Returns a vertex with the number of its class.
    pub(crate) fn vertex(&self, vertex: u32) -> Vertex {
        let number = self.class[vertex as usize];
        Vertex { number, between: self.between.get(&number).copied() }
    }

    /// Returns the class of a vertex.
    pub(crate) fn class(&self, vertex: usize) -> usize {
        self.class[vertex] as usize
    }
}

/// Returns for each vertex the smallest vertex to which it is joined, directly or through others.
fn classes(vertices: usize, pairs: &[[u32; 2]]) -> Vec<u32> {
    let mut class: Vec<u32> = (0..vertices as u32).collect();
    loop {
        let mut settled = true;
        for &[a, b] in pairs {
            let [a, b] = [a as usize, b as usize];
            let least = class[a].min(class[b]);
            settled &= class[a] == least && class[b] == least;
            (class[a], class[b]) = (least, least);
        }
        if settled {
            return class;
        }
    }
}
