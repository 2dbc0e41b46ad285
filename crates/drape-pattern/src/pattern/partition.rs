//! Partition of numbers into sets: nodes or breakpoints that count as one.

/// Partition of numbers into sets (union-find); the root of a set is its smallest number.
#[derive(Debug, Clone)]
pub(crate) struct Partition {
    parent: Vec<usize>,
}

impl Partition {
    /// Returns the partition of the numbers below a count into single ones.
    pub fn new(count: usize) -> Self {
        Self { parent: (0..count).collect() }
    }

    /// Returns the root of the set of a number.
    pub fn root(&self, mut of: usize) -> usize {
        while self.parent[of] != of {
            of = self.parent[of];
        }
        of
    }

    /// Unites the sets of two numbers.
    pub fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b)] = a.min(b);
    }

    /// Returns the number of sets.
    pub fn sets(&self) -> usize {
        self.parent.iter().enumerate().filter(|(k, parent)| k == *parent).count()
    }
}
