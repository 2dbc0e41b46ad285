//! Partial sums: contributions of one chunk to its rows and to the rows of other chunks.

use super::chunk::{Chunk, leading_to};
use crate::linear::lanes::Double;
use crate::linear::vector::add_scaled;

/// Contributions of a chunk to the rows of its window, with `N` numbers per row. The window of a
/// chunk is the set of rows to which the chunk contributes: its own rows, and the rows with the
/// numbers of the columns in which it has blocks.
#[derive(Clone, Debug)]
pub(crate) struct PartialSum<const N: usize>(pub [Vec<f64>; N]);

impl<const N: usize> PartialSum<N> {
    /// Allocates zeros for the window of `chunk`.
    pub(crate) fn new(chunk: &Chunk) -> Self {
        Self(core::array::from_fn(|_| vec![0.0; chunk.window.len()]))
    }

    pub(crate) fn clear(&mut self) {
        for column in &mut self.0 {
            column.fill(0.0);
        }
    }

    /// Adds `batch`, one number per column and lane, to a batch of rows. `first` is the first row,
    /// counted within the window.
    #[inline(always)]
    pub(crate) fn add_batch(&mut self, first: usize, batch: [Double; N]) {
        for (column, lanes) in self.0.iter_mut().zip(batch) {
            (Double::load(column, first) + lanes).store(column, first);
        }
    }

    /// Adds `numbers`, one per column, to `row`, counted within the window.
    #[inline(always)]
    pub(crate) fn add(&mut self, row: usize, numbers: [f64; N]) {
        for (column, number) in self.0.iter_mut().zip(numbers) {
            column[row] += number;
        }
    }
}

/// Adds the contributions of all other chunks to the `rows` of `chunk`, times `factor`. `sums`
/// returns the partial sums of a chunk.
#[inline(always)]
pub(crate) fn add_from_other_chunks<'a, const N: usize>(
    rows: &mut [&mut [f64]; N],
    factor: f64,
    (chunks, chunk): (&[Chunk], &Chunk),
    sums: impl Fn(&Chunk) -> &'a PartialSum<N>,
) {
    for (other, shared) in leading_to(chunks, chunk.index) {
        for (rows, sum) in rows.iter_mut().zip(&sums(other).0) {
            let sum = &sum[shared.start - other.window.start..][..shared.len()];
            add_scaled(&mut rows[shared.start - chunk.rows.start..], factor, sum);
        }
    }
}

/// Contribution of a chunk's blocks to the product of the matrix and a vector.
#[derive(Debug)]
pub(crate) struct PartialProduct {
    pub rows: PartialSum<3>,
    /// Contribution of each irregular entry to the row of its column, if this row is outside the
    /// chunk.
    pub pushes: Vec<[f64; 3]>,
    /// Dot product of the contribution with the vector.
    pub curvature: f64,
}

impl PartialProduct {
    /// Allocates zeros for `chunk`.
    pub(crate) fn new(chunk: &Chunk) -> Self {
        Self {
            rows: PartialSum::new(chunk),
            pushes: vec![[0.0; 3]; chunk.irregular.len()],
            curvature: 0.0,
        }
    }
}
