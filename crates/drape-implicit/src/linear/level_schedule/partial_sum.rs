//! Partial sums: what one chunk adds to its own rows and to others'.

use super::chunk::{Chunk, leading_to};
use crate::linear::lanes::Double;
use crate::linear::vector::add_scaled;

/// Sum of what a chunk adds to the rows of its window: its own and those that its diagonals lead
/// to.
#[derive(Clone, Debug)]
pub(crate) struct PartialSum<const N: usize>(pub [Vec<f64>; N]);

impl<const N: usize> PartialSum<N> {
    pub(crate) fn new(chunk: &Chunk) -> Self {
        Self(core::array::from_fn(|_| vec![0.0; chunk.window.len()]))
    }

    pub(crate) fn clear(&mut self) {
        for column in &mut self.0 {
            column.fill(0.0);
        }
    }

    /// Adds one number per axis and lane to a batch of rows. The first row is counted within the
    /// window.
    #[inline(always)]
    pub(crate) fn add_batch(&mut self, first: usize, batch: [Double; N]) {
        for (column, lanes) in self.0.iter_mut().zip(batch) {
            (Double::load(column, first) + lanes).store(column, first);
        }
    }

    /// Adds one number per axis to a row, which is counted within the window.
    #[inline(always)]
    pub(crate) fn add(&mut self, row: usize, numbers: [f64; N]) {
        for (column, number) in self.0.iter_mut().zip(numbers) {
            column[row] += number;
        }
    }
}

/// Adds to the rows of a chunk what other chunks add to them, times a factor. `sums` are those of
/// all chunks.
#[inline(always)]
pub(crate) fn add_others<'a, const N: usize>(
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

/// Product of a chunk's blocks with a vector.
#[derive(Debug)]
pub(crate) struct PartialProduct {
    pub rows: PartialSum<3>,
    /// What each irregular entry adds to its column, where that is not a row of the chunk.
    pub pushes: Vec<[f64; 3]>,
    /// Dot product with the vector.
    pub curvature: f64,
}

impl PartialProduct {
    pub(crate) fn new(chunk: &Chunk) -> Self {
        Self {
            rows: PartialSum::new(chunk),
            pushes: vec![[0.0; 3]; chunk.irregular.len()],
            curvature: 0.0,
        }
    }
}
