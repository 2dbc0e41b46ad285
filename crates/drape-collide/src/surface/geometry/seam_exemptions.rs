//! Pairs that are exempt from contact because a seam joins them.

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
        let tie = |tie: &[u32; 3]| {
            let [own, a, b] = tie.map(|vertex| class[vertex as usize]);
            Tie { own, ends: [a, b] }
        };
        let mut ties: Vec<Tie> = ties.iter().map(tie).collect();
        ties.sort_unstable();
        SeamExemptions { class, ties }
    }

    /// Class of a vertex.
    pub(crate) fn class(&self, vertex: u32) -> u32 {
        self.class[vertex as usize]
    }

    /// Returns whether two primitives, given by the classes of their vertices, are exempt: they
    /// share a vertex, or one has a vertex that is tied to two of the other.
    #[inline]
    pub(crate) fn exempt(&self, one: &[u32], other: &[u32]) -> bool {
        one.iter().any(|class| other.contains(class))
            || !self.ties.is_empty() && (self.is_tied(one, other) || self.is_tied(other, one))
    }

    #[cold]
    fn is_tied(&self, one: &[u32], other: &[u32]) -> bool {
        let ends = |class: &u32| {
            let place = self.ties.binary_search_by_key(class, |tie| tie.own).ok()?;
            Some(self.ties[place].ends)
        };
        let on = |class| ends(class).is_some_and(|ends| ends.iter().all(|end| other.contains(end)));
        one.iter().any(on)
    }
}
