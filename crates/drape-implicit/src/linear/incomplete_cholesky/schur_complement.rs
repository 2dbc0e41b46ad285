//! Schur complement: the remaining matrix after the elimination of some rows.

use core::ops::Range;

use crate::linear::lane_block::Blocks;
use crate::linear::lanes::{Double, LANES, Number, Single, narrowed};
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::level_schedule::part::MatrixPart;
use crate::linear::level_schedule::run::{BlockAddress, Run};
use crate::linear::packed_matrix::PackedMatrix;

/// Schur complement of the eliminated rows, for a part or for the separators.
///
/// Blocks are stored in columns of numbers, so that a batch of blocks can begin at any row: see
/// [`Run::numbers`]. Numbers are in single precision, like the packed matrix: a factorisation takes
/// a fifth less time than in double precision.
#[derive(Debug)]
pub(crate) struct SchurComplement {
    numbers: Vec<f32>,
    /// Numbers of the layout that are stored first: the rows of the part, or of the separators.
    group: Range<usize>,
    /// Numbers of the layout that are stored second: separators from which the part subtracts.
    separators: Range<usize>,
}

impl SchurComplement {
    /// Allocates the Schur complement of `part`.
    pub(crate) fn for_part(layout: &BatchLayout, part: &MatrixPart) -> Self {
        Self::new(layout, part.group.numbers.clone(), part.separator_numbers.clone())
    }

    /// Allocates the Schur complement of all separators of `layout`.
    pub(crate) fn for_separators(layout: &BatchLayout) -> Self {
        let end = layout.separators.iter().map(|separator| separator.numbers.end).max();
        let group = layout.part_numbers..end.unwrap_or(layout.part_numbers);
        Self::new(layout, group, 0..0)
    }

    fn new(layout: &BatchLayout, group: Range<usize>, separators: Range<usize>) -> Self {
        // A batch of updates may extend beyond the last column by the length of a run, with zeros.
        let margin = layout.runs.iter().map(Run::len).max().unwrap_or(0) + LANES;
        Self { numbers: vec![0.0; group.len() + separators.len() + margin], group, separators }
    }

    /// Returns the index of the layout's `number` in this Schur complement.
    #[inline(always)]
    pub(crate) fn index_of(&self, number: usize) -> usize {
        if self.group.contains(&number) {
            number - self.group.start
        } else {
            number - self.separators.start + self.group.len()
        }
    }

    /// Sets the numbers of the separators to zero.
    pub(crate) fn clear_separators(&mut self) {
        self.numbers[self.group.len()..].fill(0.0);
    }

    /// Adds the separators' numbers in the Schur complement of `part` to this Schur complement of
    /// the separators.
    pub(crate) fn add_part(&mut self, part: &Self) {
        let added = &part.numbers[part.group.len()..][..part.separators.len()];
        let first = part.separators.start.saturating_sub(self.group.start);
        for (number, added) in self.numbers[first..].iter_mut().zip(added) {
            *number += added;
        }
    }

    /// Copies the rows of `run` from the matrix `packed`, with the main diagonal times `factor`.
    #[inline(always)]
    pub(crate) fn load(
        &mut self,
        layout: &BatchLayout,
        run: &Run,
        packed: &PackedMatrix,
        factor: f64,
    ) {
        let factor = Double::splat(factor);
        for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
            let mut main = packed.main_diagonal(row);
            for entry in &mut main {
                *entry = *entry * factor;
            }
            self.store_batch(run.numbers + batch * LANES, run.len(), &narrowed(&main));
            for (diagonal, block) in packed.off_diagonal[run.blocks_of(batch)].iter().enumerate() {
                self.store_batch(run.number(diagonal, batch), run.len(), block);
            }
            for index in layout.irregular_of[run.batches + batch].clone() {
                let first = self.index_of(run.irregular_address(index).first as usize);
                self.numbers[first..first + 9].copy_from_slice(&packed.irregular[index]);
            }
        }
    }

    /// Writes batches of `values`, a `stride` apart, beginning at the layout's number `first`.
    #[inline(always)]
    fn store_batch<const N: usize>(&mut self, first: usize, stride: usize, values: &[Single; N]) {
        let first = self.index_of(first);
        for (k, value) in values.iter().enumerate() {
            value.store(&mut self.numbers, first + k * stride);
        }
    }

    /// Returns batches of numbers, a `stride` apart, beginning at the layout's number `first`.
    #[inline(always)]
    fn load_batch<const N: usize>(&self, first: usize, stride: usize) -> [Single; N] {
        let first = self.index_of(first);
        let mut values = [Single::ZERO; N];
        for (k, value) in values.iter_mut().enumerate() {
            *value = Single::load(&self.numbers, first + k * stride);
        }
        values
    }

    /// Returns the upper halves of the pivots of `batch`, counted within `run`.
    #[inline(always)]
    pub(crate) fn pivots(&self, run: &Run, batch: usize) -> [Single; 6] {
        self.load_batch(run.numbers + batch * LANES, run.len())
    }

    /// Returns the blocks of `batch` on `diagonal`, both counted within `run`.
    #[inline(always)]
    pub(crate) fn off_diagonal(&self, run: &Run, diagonal: usize, batch: usize) -> Blocks<Single> {
        self.load_batch(run.number(diagonal, batch), run.len())
    }

    /// Subtracts `values` from batches of numbers, a `stride` apart, beginning at the index
    /// `first`.
    #[inline(always)]
    pub(crate) fn subtract<const N: usize>(
        &mut self,
        first: usize,
        stride: usize,
        values: &[Single; N],
    ) {
        for (k, value) in values.iter().enumerate() {
            let at = first + k * stride;
            (Single::load(&self.numbers, at) - *value).store(&mut self.numbers, at);
        }
    }

    /// Returns the block at an address.
    #[inline(always)]
    pub(crate) fn block_at(&self, BlockAddress { first, stride }: BlockAddress) -> Blocks<f32> {
        let first = self.index_of(first as usize);
        let mut block = [0.0; 9];
        for (k, entry) in block.iter_mut().enumerate() {
            *entry = self.numbers[first + k * stride as usize];
        }
        block
    }

    /// Subtracts `values` from the block at an address.
    #[inline(always)]
    pub(crate) fn subtract_at<const N: usize>(
        &mut self,
        BlockAddress { first, stride }: BlockAddress,
        values: &[f32; N],
    ) {
        let first = self.index_of(first as usize);
        for (k, value) in values.iter().enumerate() {
            self.numbers[first + k * stride as usize] -= value;
        }
    }
}
