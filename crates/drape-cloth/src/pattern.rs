/// Which pairs of particles a cloth couples: the upper half of a symmetric matrix of 3 × 3 blocks.
///
/// Row `i` has the columns `columns[offsets[i]..offsets[i + 1]]` in rising order; the first is `i`
/// itself. Block `k` has the nine numbers `9k..9k + 9`, row by row.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Pattern {
    /// Where each row starts; one more than there are particles.
    pub offsets: Vec<usize>,
    /// Column of each block.
    pub columns: Vec<usize>,
}

impl Pattern {
    /// The pattern of the given pairs, the first of each less than the second.
    pub(crate) fn new(particles: usize, pairs: impl Iterator<Item = (u32, u32)>) -> Self {
        let mut rows: Vec<Vec<usize>> = (0..particles).map(|i| vec![i]).collect();
        for (first, second) in pairs {
            rows[first as usize].push(second as usize);
        }
        let mut pattern = Self { offsets: vec![0], columns: Vec::new() };
        for mut row in rows {
            row.sort_unstable();
            row.dedup();
            pattern.columns.extend(row);
            pattern.offsets.push(pattern.columns.len());
        }
        pattern
    }

    /// Block of a pair, the first less than or equal to the second, if it is coupled.
    pub(crate) fn block(&self, row: u32, column: u32) -> Option<usize> {
        let row = row as usize;
        let columns = &self.columns[self.offsets[row]..self.offsets[row + 1]];
        let place = columns.binary_search(&(column as usize)).ok()?;
        Some(self.offsets[row] + place)
    }

    /// Number of blocks.
    #[must_use]
    pub fn blocks(&self) -> usize {
        self.columns.len()
    }
}
