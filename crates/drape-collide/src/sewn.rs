use crate::topology::equivalence_classes;

/// What is sewn together in a surface, so that it touches without a contact.
#[derive(Debug, Clone)]
pub(crate) struct Sewn {
    /// The smallest of the vertices that are one with each vertex.
    class: Vec<u32>,
    /// The classes of vertices that lie between two others, and of these, sorted.
    ties: Vec<(u32, [u32; 2])>,
}

impl Sewn {
    pub(crate) fn new(vertices: usize, seam_pairs: &[[u32; 2]], ties: &[[u32; 3]]) -> Sewn {
        let class = equivalence_classes(vertices, seam_pairs);
        let tie = |tie: &[u32; 3]| {
            let [own, a, b] = tie.map(|vertex| class[vertex as usize]);
            (own, [a, b])
        };
        let mut ties: Vec<(u32, [u32; 2])> = ties.iter().map(tie).collect();
        ties.sort_unstable();
        Sewn { class, ties }
    }

    pub(crate) fn class(&self, vertex: u32) -> u32 {
        self.class[vertex as usize]
    }

    /// Whether two primitives, by the classes of their vertices, touch where they are sewn: they share a vertex, or one
    /// has a vertex that lies between two of the other.
    #[inline]
    pub(crate) fn joins(&self, one: &[u32], other: &[u32]) -> bool {
        one.iter().any(|class| other.contains(class))
            || !self.ties.is_empty() && (self.hangs(one, other) || self.hangs(other, one))
    }

    #[cold]
    fn hangs(&self, one: &[u32], other: &[u32]) -> bool {
        let ends = |class: &u32| {
            let place = self.ties.binary_search_by_key(class, |tie| tie.0).ok()?;
            Some(self.ties[place].1)
        };
        let on = |class| ends(class).is_some_and(|ends| ends.iter().all(|end| other.contains(end)));
        one.iter().any(on)
    }
}
