//! Sparsity of a symmetric matrix of 3x3 blocks: the list of coupled particles.

use crate::error::Error;

/// Sparsity of a symmetric matrix of 3x3 blocks: the pairs of particles whose forces depend on each
/// other's positions.
///
/// Only the upper half is stored. Row `i` begins with column `i` (the diagonal block). The columns
/// `j > i` coupled to row `i` follow in ascending order. The index of a block in the list of all
/// blocks is its *slot*.
///
/// ```
/// use drape_implicit::Sparsity;
///
/// // A chain of three particles.
/// let sparsity = Sparsity::from_pairs(3, [[0, 1], [2, 1]])?;
/// assert_eq!(sparsity.columns(), [0, 1, 1, 2, 2]);
/// assert_eq!(sparsity.slot(1, 2), Some(3));
/// assert_eq!(sparsity.slot(0, 2), None);
/// # Ok::<(), drape_implicit::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sparsity {
    offsets: Vec<usize>,
    columns: Vec<u32>,
}

impl Sparsity {
    /// Returns the sparsity with the row `offsets`, one more than particles and starting at 0, and
    /// the `columns` of all blocks.
    ///
    /// # Errors
    /// [`Error::Sparsity`] if a row does not begin with its diagonal, is not ascending, or has a
    /// column outside the matrix.
    pub fn new(offsets: Vec<usize>, columns: Vec<u32>) -> Result<Self, Error> {
        let rows = offsets.len().saturating_sub(1);
        if offsets.first() != Some(&0) {
            return malformed(0, "the first row offset must be 0");
        }
        if offsets.last() != Some(&columns.len()) {
            return malformed(rows, "the last row offset must be the number of columns listed");
        }
        if i32::try_from(columns.len()).is_err() {
            return malformed(rows, "more than 2³¹ blocks");
        }

        for row in 0..rows {
            if offsets[row + 1] <= offsets[row] || offsets[row + 1] > columns.len() {
                return malformed(row, "row offsets must grow: each row has at least its diagonal");
            }
            let list = &columns[offsets[row]..offsets[row + 1]];
            if list[0] as usize != row {
                return malformed(row, "the first block of a row must be its diagonal");
            }
            if list.windows(2).any(|pair| pair[0] >= pair[1]) {
                return malformed(row, "the columns of a row must ascend without repeats");
            }
            if list[list.len() - 1] as usize >= rows {
                return malformed(row, "a column lies outside the matrix");
            }
        }

        Ok(Self { offsets, columns })
    }

    /// Returns the sparsity for a number of `particles` with the coupled `pairs`, in any order and
    /// with any repeats.
    ///
    /// # Errors
    /// [`Error::Sparsity`] if a pair names a particle that does not exist.
    pub fn from_pairs(
        particles: usize,
        pairs: impl IntoIterator<Item = [usize; 2]>,
    ) -> Result<Self, Error> {
        let mut rows: Vec<Vec<u32>> = vec![Vec::new(); particles];
        for [i, j] in pairs {
            let (low, high) = (i.min(j), i.max(j));
            let fault = "a pair names a particle that does not exist";
            let column = u32::try_from(high).ok().filter(|_| high < particles);
            let column = column.ok_or(Error::Sparsity { row: high, fault })?;
            if low < high {
                rows[low].push(column);
            }
        }

        let mut offsets = Vec::with_capacity(particles + 1);
        let mut columns = Vec::new();
        offsets.push(0);
        for (row, list) in rows.iter_mut().enumerate() {
            list.sort_unstable();
            list.dedup();
            columns.push(row as u32);
            columns.append(list);
            offsets.push(columns.len());
        }
        Self::new(offsets, columns)
    }

    /// Returns the sparsity with the `rows`, in order: the columns of the blocks of each row. The
    /// first column of row `i` is `i`, and the others follow in ascending order.
    ///
    /// ```
    /// use drape_implicit::Sparsity;
    ///
    /// // A chain of three particles.
    /// let rows: [&[usize]; 3] = [&[0, 1], &[1, 2], &[2]];
    /// let sparsity = Sparsity::from_rows(rows)?;
    /// assert_eq!(sparsity, Sparsity::from_pairs(3, [[0, 1], [1, 2]])?);
    /// # Ok::<(), drape_implicit::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Sparsity`], as in [`new`](Self::new).
    pub fn from_rows<'a>(rows: impl IntoIterator<Item = &'a [usize]>) -> Result<Self, Error> {
        let (mut offsets, mut columns) = (vec![0], Vec::new());
        for (row, list) in rows.into_iter().enumerate() {
            for &column in list {
                let fault = "a column lies outside the matrix";
                columns.push(u32::try_from(column).map_err(|_| Error::Sparsity { row, fault })?);
            }
            offsets.push(columns.len());
        }
        Self::new(offsets, columns)
    }

    /// Returns the number of particles, which is the number of block rows.
    #[must_use]
    pub fn particle_count(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Returns the number of stored blocks.
    #[must_use]
    pub fn block_count(&self) -> usize {
        self.columns.len()
    }

    /// Returns the first slot of each row, and the end of the last row.
    #[must_use]
    pub fn offsets(&self) -> &[usize] {
        &self.offsets
    }

    /// Returns the column of each stored block.
    #[must_use]
    pub fn columns(&self) -> &[u32] {
        &self.columns
    }

    /// Returns the slots of `row`, beginning with the diagonal. A row that the matrix does not have
    /// has no slots.
    #[must_use]
    pub fn row(&self, row: usize) -> core::ops::Range<usize> {
        match self.offsets.get(row..) {
            Some([first, end, ..]) => *first..*end,
            _ => 0..0,
        }
    }

    /// Returns the particles coupled to `particle` that have a larger number.
    pub(crate) fn later(&self, particle: usize) -> &[u32] {
        &self.columns[self.row(particle)][1..]
    }

    /// Returns the slot that couples the particles `i` and `j`, in either order. `None` if the two
    /// are not coupled.
    #[must_use]
    pub fn slot(&self, i: usize, j: usize) -> Option<usize> {
        let (low, high) = (i.min(j), i.max(j));
        if high >= self.particle_count() {
            return None;
        }
        let row = self.row(low);
        let index = self.columns[row.clone()].binary_search(&(high as u32)).ok()?;
        Some(row.start + index)
    }
}

/// Returns the error for a malformed `row`.
fn malformed<T>(row: usize, fault: &'static str) -> Result<T, Error> {
    Err(Error::Sparsity { row, fault })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_in_any_order_give_the_sorted_upper_half() {
        let sparsity = Sparsity::from_pairs(4, [[2, 0], [0, 1], [3, 2], [0, 2], [1, 1]]).unwrap();
        assert_eq!(sparsity.offsets(), [0, 3, 4, 6, 7]);
        assert_eq!(sparsity.columns(), [0, 1, 2, 1, 2, 3, 3]);
        assert_eq!(sparsity.slot(2, 0), Some(2));
        assert_eq!(sparsity.slot(3, 3), Some(6));
        assert_eq!(sparsity.slot(1, 3), None);
        assert_eq!(sparsity.slot(1, 9), None);
    }

    #[test]
    fn malformed_sparsities_are_refused_with_their_row() {
        let cases: [(&[usize], &[u32], usize); 7] = [
            (&[], &[], 0),
            (&[1, 2], &[0, 1], 0),
            (&[0, 1], &[0, 1], 1),
            (&[0, 2, 2], &[0, 1], 1),
            (&[0, 1, 2], &[0, 0], 1),
            (&[0, 3, 4, 5], &[0, 2, 1, 1, 2], 0),
            (&[0, 2], &[0, 1], 0),
        ];
        for (offsets, columns, expected) in cases {
            match Sparsity::new(offsets.to_vec(), columns.to_vec()) {
                Err(Error::Sparsity { row, .. }) => {
                    assert_eq!(row, expected, "{offsets:?} {columns:?}")
                }
                other => panic!("{offsets:?} {columns:?} gave {other:?}"),
            }
        }
        assert!(Sparsity::from_pairs(2, [[0, 2]]).is_err());
    }

    #[test]
    fn an_empty_system_has_an_empty_sparsity() {
        let sparsity = Sparsity::from_pairs(0, []).unwrap();
        assert_eq!((sparsity.particle_count(), sparsity.block_count()), (0, 0));
    }
}
