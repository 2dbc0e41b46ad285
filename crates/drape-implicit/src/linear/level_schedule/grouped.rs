//! Grouped items: those of each group one after the other.

/// Items by group, each group in the order in which they are given.
#[derive(Debug)]
pub(super) struct Grouped<T> {
    /// First item of each group, and the end of the last.
    first: Vec<usize>,
    items: Vec<T>,
}

impl<T: Copy + Default> Grouped<T> {
    /// Items with the numbers of their groups, of which there are so many.
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

    pub(super) fn of(&self, group: usize) -> &[T] {
        &self.items[self.first[group]..self.first[group + 1]]
    }
}
