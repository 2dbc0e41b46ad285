//! Partition of numbers into sets: nodes or breakpoints that count as one.

/// Partition of numbers into sets (union-find). The root of a set is its smallest number.
#[derive(Debug, Clone)]
pub(crate) struct Partition {
    parent: Vec<usize>,
}

impl Partition {
    /// Returns the partition of the numbers below `count` into sets of one number each.
    pub fn new(count: usize) -> Self {
        Self { parent: (0..count).collect() }
    }

    /// Returns the root of the set that contains `number`.
    pub fn root(&self, mut number: usize) -> usize {
        while self.parent[number] != number {
            number = self.parent[number];
        }
        number
    }

    /// Unites the sets of `a` and `b`.
    pub fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b)] = a.min(b);
    }

    /// Returns the number of sets.
    pub fn set_count(&self) -> usize {
        self.parent.iter().enumerate().filter(|(k, parent)| k == *parent).count()
    }
}
