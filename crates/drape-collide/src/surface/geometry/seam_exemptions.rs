//! Pairs that a seam joins: exempt from contact once it is closed.

use super::topology::equivalence_classes;

/// Vertex that a seam ties to a point between two others, by classes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Tie {
    own: u32,
    ends: [u32; 2],
}

/// Vertices that seams join or tie.
#[derive(Debug, Clone)]
pub(crate) struct SeamExemptions {
    /// Class of each vertex: the smallest of the vertices that seams join with it.
    class: Vec<u32>,
    /// Class of each vertex with tied vertices too: they share it with those that they lie between.
    moving_class: Vec<u32>,
    /// Tied vertices, sorted.
    ties: Vec<Tie>,
}

impl SeamExemptions {
    /// Makes the exemptions of seam pairs and ties among so many vertices.
    pub(crate) fn new(
        vertices: usize,
        seam_pairs: &[[u32; 2]],
        ties: &[[u32; 3]],
    ) -> SeamExemptions {
        let class = equivalence_classes(vertices, seam_pairs);
        let tied = ties.iter().flat_map(|&[own, a, b]| [[own, a], [own, b]]);
        let moving: Vec<[u32; 2]> = seam_pairs.iter().copied().chain(tied).collect();
        let moving_class = equivalence_classes(vertices, &moving);
        let tie = |tie: &[u32; 3]| {
            let [own, a, b] = tie.map(|vertex| class[vertex as usize]);
            Tie { own, ends: [a, b] }
        };
        let mut ties: Vec<Tie> = ties.iter().map(tie).collect();
        ties.sort_unstable();
        SeamExemptions { class, moving_class, ties }
    }

    /// Class of a vertex.
    pub(crate) fn class(&self, vertex: u32) -> u32 {
        self.class[vertex as usize]
    }

    /// Class of a vertex, tied vertices included: its vertices move together where seams are closed.
    pub(crate) fn moving_class(&self, vertex: u32) -> u32 {
        self.moving_class[vertex as usize]
    }

    /// Returns whether two primitives, given by the classes of their vertices, are joined: they
    /// share a vertex, or one has a vertex that is tied to two of the other.
    #[inline]
    pub(crate) fn join(&self, one: &[u32], other: &[u32]) -> bool {
        one.iter().any(|class| other.contains(class))
            || !self.ties.is_empty() && (self.is_tied(one, other) || self.is_tied(other, one))
    }

    /// Returns the classes at which two primitives are joined, each from one or two sides.
    pub(crate) fn joints<'a>(
        &'a self,
        one: &'a [u32],
        other: &'a [u32],
    ) -> impl Iterator<Item = u32> + 'a {
        let shared = one.iter().filter(|class| other.contains(class));
        let tied = one.iter().filter(|class| self.lies_on(class, other));
        let tied = tied.chain(other.iter().filter(|class| self.lies_on(class, one)));
        shared.chain(tied).copied()
    }

    #[cold]
    fn is_tied(&self, one: &[u32], other: &[u32]) -> bool {
        one.iter().any(|class| self.lies_on(class, other))
    }

    /// Returns whether the vertices of a class are tied to two of a primitive's.
    fn lies_on(&self, class: &u32, primitive: &[u32]) -> bool {
        self.ends(*class).is_some_and(|ends| ends.iter().all(|end| primitive.contains(end)))
    }

    /// Returns the classes of the two vertices between which the vertices of a class are tied; none if
    /// they are not tied.
    pub(crate) fn ends(&self, class: u32) -> Option<[u32; 2]> {
        let place = self.ties.binary_search_by_key(&class, |tie| tie.own).ok()?;
        Some(self.ties[place].ends)
    }
}
