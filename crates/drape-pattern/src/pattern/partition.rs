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
        let (a, b) = (self.shortened_root(a), self.shortened_root(b));
        self.parent[a.max(b)] = a.min(b);
    }

    /// Returns the root of the set that contains `number`, and halves the way to it, so that a long
    /// chain of sets is followed once.
    fn shortened_root(&mut self, mut number: usize) -> usize {
        while self.parent[number] != number {
            self.parent[number] = self.parent[self.parent[number]];
            number = self.parent[number];
        }
        number
    }

    /// Returns the number of sets.
    pub fn set_count(&self) -> usize {
        self.parent.iter().enumerate().filter(|(k, parent)| k == *parent).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_that_are_united_from_the_last_on_have_one_root_on_a_short_way() {
        let count = 100_000;
        let mut partition = Partition::new(count);
        for number in (1..count).rev() {
            partition.unite(number, number - 1);
        }
        for number in 0..count {
            partition.unite(number, 0);
        }
        assert_eq!((partition.set_count(), partition.root(count - 1)), (1, 0));

        // The way from each number to its root.
        let steps = |number: usize| {
            let parent = |number: &usize| Some(partition.parent[*number]);
            std::iter::successors(Some(number), parent).take_while(|number| *number != 0).count()
        };
        let all: usize = (0..count).map(steps).sum();
        assert!(all < 3 * count, "{all} steps for {count} numbers");
    }
}
