//! Sparsity of the stiffness matrix. The kernels write its blocks, and the system of equations
//! takes them over.

/// Block sparsity of the stiffness matrix of a cloth, upper triangle: one 3 × 3 block for each pair
/// of particles that a connector joins.
///
/// Row `i` has the columns `columns[offsets[i]..offsets[i + 1]]` in rising order, the first of
/// which is `i` itself. Block `k` occupies the nine numbers `9k..9k + 9` of the values, row by row.
/// Rows and columns count particles, not coordinates.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Sparsity {
    /// Index of the first block of each row, with one entry more than there are particles.
    pub offsets: Vec<usize>,
    /// Column of each block.
    pub columns: Vec<usize>,
}

impl Sparsity {
    /// Returns the sparsity of `pairs` among `particle_count` particles, the lower number first.
    pub(crate) fn new(particle_count: usize, pairs: impl Iterator<Item = [u32; 2]>) -> Self {
        let mut rows: Vec<Vec<usize>> = (0..particle_count).map(|i| vec![i]).collect();
        for [first, second] in pairs {
            rows[first as usize].push(second as usize);
        }
        let mut sparsity = Self { offsets: vec![0], columns: Vec::new() };
        for mut row in rows {
            row.sort_unstable();
            row.dedup();
            sparsity.columns.extend(row);
            sparsity.offsets.push(sparsity.columns.len());
        }
        sparsity
    }

    /// Returns the index of the block of `row` and `column`, which is not below `row`, if a
    /// connector joins the two particles.
    pub(crate) fn block(&self, row: u32, column: u32) -> Option<usize> {
        let row = row as usize;
        let columns = &self.columns[self.offsets[row]..self.offsets[row + 1]];
        let index = columns.binary_search(&(column as usize)).ok()?;
        Some(self.offsets[row] + index)
    }

    /// Returns the columns of the blocks of each row, in the order of the rows. The function
    /// `Sparsity::from_rows` of `drape-implicit` takes these rows.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[usize]> {
        self.offsets.windows(2).map(|ends| &self.columns[ends[0]..ends[1]])
    }

    /// Returns the number of blocks, the length of `columns`.
    #[must_use]
    pub fn block_count(&self) -> usize {
        self.columns.len()
    }
}
