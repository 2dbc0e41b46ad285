//! Vertices that seams join or tie. Primitives at them are exempt from contact once seams close.

use super::topology::classes;
use crate::vector::{at, dot, norm, scale, subtract};

/// Class of vertices that a seam ties to a point between two other classes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Tie {
    class: u32,
    ends: [u32; 2],
}

/// Vertices that seams join or tie.
#[derive(Debug, Clone)]
pub(crate) struct SeamExemptions {
    /// Class of each vertex: the smallest number among the vertices that seams join with it.
    class: Vec<u32>,
    /// Moving class of each vertex. A tied vertex shares it with the vertices that it lies between.
    moving_class: Vec<u32>,
    /// Ties, sorted.
    ties: Vec<Tie>,
    /// Pairs of vertices that seams join.
    seam_pairs: Vec<[u32; 2]>,
    /// Vertices that seams tie, each with the two ends of its edge.
    tied_vertices: Vec<[u32; 3]>,
}

impl SeamExemptions {
    /// Returns the exemptions of `seam_pairs` and `ties` among `vertex_count` vertices. A tie names
    /// the tied vertex first.
    pub(crate) fn new(
        vertex_count: usize,
        seam_pairs: &[[u32; 2]],
        ties: &[[u32; 3]],
    ) -> SeamExemptions {
        let class = classes(vertex_count, seam_pairs);

        // Tied vertices move together with the vertices that they lie between.
        let tied = ties.iter().flat_map(|&[vertex, a, b]| [[vertex, a], [vertex, b]]);
        let moving: Vec<[u32; 2]> = seam_pairs.iter().copied().chain(tied).collect();
        let moving_class = classes(vertex_count, &moving);

        let mut sorted_ties: Vec<Tie> = ties
            .iter()
            .map(|tie| {
                let [tied, a, b] = tie.map(|vertex| class[vertex as usize]);
                Tie { class: tied, ends: [a, b] }
            })
            .collect();
        sorted_ties.sort_unstable();
        SeamExemptions {
            class,
            moving_class,
            ties: sorted_ties,
            seam_pairs: seam_pairs.to_vec(),
            tied_vertices: ties.to_vec(),
        }
    }

    /// Returns the exemptions at the seams whose vertices are within `gap` of each other, or of
    /// their edge, at the flat `positions`. Both are in m.
    pub(crate) fn within(&self, gap: f64, positions: &[f64]) -> SeamExemptions {
        let point = |vertex: u32| at(positions, vertex as usize);
        let is_met = |&[a, b]: &[u32; 2]| norm(subtract(point(a), point(b))) <= gap;
        let is_on_edge = |&[tied, a, b]: &[u32; 3]| {
            // An edge of length 0 has no direction; the vertex is then compared with its end.
            let along = subtract(point(b), point(a));
            let from_end = subtract(point(tied), point(a));
            let fraction = (dot(from_end, along) / dot(along, along)).clamp(0.0, 1.0);
            let fraction = if fraction.is_nan() { 0.0 } else { fraction };
            norm(subtract(from_end, scale(along, fraction))) <= gap
        };
        let pairs: Vec<[u32; 2]> = self.seam_pairs.iter().copied().filter(is_met).collect();
        let ties: Vec<[u32; 3]> = self.tied_vertices.iter().copied().filter(is_on_edge).collect();
        SeamExemptions::new(self.class.len(), &pairs, &ties)
    }

    /// Returns the class of `vertex`: the smallest number among the vertices that seams join to it.
    pub(crate) fn class(&self, vertex: u32) -> u32 {
        self.class[vertex as usize]
    }

    /// Returns the class of `vertex` including ties: its vertices move together where seams are
    /// closed.
    pub(crate) fn moving_class(&self, vertex: u32) -> u32 {
        self.moving_class[vertex as usize]
    }

    /// Returns whether seams join two primitives, given by the classes `first` and `second` of
    /// their vertices. Joined primitives share a class, or one of them has a class that is tied to
    /// two classes of the other.
    #[inline]
    pub(crate) fn join(&self, first: &[u32], second: &[u32]) -> bool {
        first.iter().any(|class| second.contains(class))
            || !self.ties.is_empty() && (self.is_tied(first, second) || self.is_tied(second, first))
    }

    /// Returns the classes at which two primitives are joined. `first` has the classes of the
    /// vertices of one primitive, `second` has the classes of the other primitive. A class may be
    /// returned twice.
    pub(crate) fn joints<'a>(
        &'a self,
        first: &'a [u32],
        second: &'a [u32],
    ) -> impl Iterator<Item = u32> + 'a {
        let shared = first.iter().filter(|class| second.contains(class));
        let tied_to_second = first.iter().filter(|class| self.lies_on(class, second));
        let tied_to_first = second.iter().filter(|class| self.lies_on(class, first));
        shared.chain(tied_to_second.chain(tied_to_first)).copied()
    }

    /// Returns whether one of `classes` is tied to two classes of `primitive`.
    #[cold]
    fn is_tied(&self, classes: &[u32], primitive: &[u32]) -> bool {
        classes.iter().any(|class| self.lies_on(class, primitive))
    }

    /// Returns whether `class` is tied to two classes of `primitive`.
    fn lies_on(&self, class: &u32, primitive: &[u32]) -> bool {
        self.ends(*class).is_some_and(|ends| ends.iter().all(|end| primitive.contains(end)))
    }

    /// Returns the two classes between which `class` is tied, or `None` if it is not tied.
    fn ends(&self, class: u32) -> Option<[u32; 2]> {
        let index = self.ties.binary_search_by_key(&class, |tie| tie.class).ok()?;
        Some(self.ties[index].ends)
    }
}
