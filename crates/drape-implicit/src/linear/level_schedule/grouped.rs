//! Grouped items: a flat list of items ordered by group.

/// Items by group, in their given order within each group.
#[derive(Debug)]
pub(super) struct Grouped<T> {
    /// Index of the first item of each group, and the end of the last group.
    first: Vec<usize>,
    items: Vec<T>,
}

impl<T: Copy + Default> Grouped<T> {
    /// Groups `items`, which are pairs of a group's number and an item. There are `groups` groups.
    pub(super) fn new(groups: usize, items: impl Iterator<Item = (usize, T)> + Clone) -> Self {
        let mut first = vec![0; groups + 1];
        for (group, _) in items.clone() {
            first[group + 1] += 1;
        }
        for group in 0..groups {
            first[group + 1] += first[group];
        }

        let mut end = first.clone();
        let mut sorted = vec![T::default(); first[groups]];
        for (group, item) in items {
            sorted[end[group]] = item;
            end[group] += 1;
        }
        Self { first, items: sorted }
    }

    /// Returns the items of `group`.
    pub(super) fn group(&self, group: usize) -> &[T] {
        &self.items[self.first[group]..self.first[group + 1]]
    }
}
