//! Schur complement: the part of a matrix that is not factorised yet.

use core::ops::Range;

use crate::linear::lane_block::Blocks;
use crate::linear::lanes::{Double, LANES, Number, Single, narrowed};
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::level_schedule::part::Part;
use crate::linear::level_schedule::run::{BlockAddress, Run};
use crate::linear::packed_matrix::PackedMatrix;

/// Schur complement of the rows eliminated so far, of a part or of the separators.
///
/// Its blocks are in columns, so that a batch of them can begin at any row: see [`Run::numbers`].
/// It is in single precision, in which the matrix is packed too: a factorisation takes a fifth less
/// time than in double.
#[derive(Debug)]
pub(crate) struct SchurComplement {
    numbers: Vec<f32>,
    /// Range of the layout's numbers that is stored first.
    own: Range<usize>,
    /// Range of the layout's numbers that is stored after it: those of separators, from which the
    /// part subtracts.
    separators: Range<usize>,
}

impl SchurComplement {
    pub(crate) fn of_part(layout: &BatchLayout, part: &Part) -> Self {
        Self::new(layout, part.own.numbers.clone(), part.separator_numbers.clone())
    }

    pub(crate) fn of_separators(layout: &BatchLayout) -> Self {
        let end = layout.separators.iter().map(|separator| separator.numbers.end).max();
        let own = layout.part_numbers..end.unwrap_or(layout.part_numbers);
        Self::new(layout, own, 0..0)
    }

    fn new(layout: &BatchLayout, own: Range<usize>, separators: Range<usize>) -> Self {
        // A batch of updates may lead as far beyond the last column as a run is long, with zeros.
        let margin = layout.runs.iter().map(Run::len).max().unwrap_or(0) + LANES;
        Self { numbers: vec![0.0; own.len() + separators.len() + margin], own, separators }
    }

    /// Place of a number of the layout.
    #[inline(always)]
    pub(crate) fn place(&self, number: usize) -> usize {
        if self.own.contains(&number) {
            number - self.own.start
        } else {
            number - self.separators.start + self.own.len()
        }
    }

    /// Clears the numbers of the separators.
    pub(crate) fn clear_separators(&mut self) {
        self.numbers[self.own.len()..].fill(0.0);
    }

    /// Adds the numbers of the separators as a part left them, to the Schur complement of these.
    pub(crate) fn add_part(&mut self, part: &Self) {
        let added = &part.numbers[part.own.len()..][..part.separators.len()];
        let first = part.separators.start.saturating_sub(self.own.start);
        for (number, added) in self.numbers[first..].iter_mut().zip(added) {
            *number += added;
        }
    }

    /// Copies a run of a matrix, its main diagonal times a factor.
    #[inline(always)]
    pub(crate) fn load(
        &mut self,
        layout: &BatchLayout,
        run: &Run,
        packed: &PackedMatrix,
        factor: f64,
    ) {
        let factor = Double::of(factor);
        for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
            let mut main = packed.main_diagonal(row);
            for entry in &mut main {
                *entry = *entry * factor;
            }
            self.put(run.numbers + batch * LANES, run.len(), &narrowed(&main));
            for (diagonal, block) in packed.off_diagonal[run.blocks_of(batch)].iter().enumerate() {
                self.put(run.number(diagonal, batch), run.len(), block);
            }
            for index in layout.irregular_of[run.batches + batch].clone() {
                let first = self.place(run.irregular_address(index).first as usize);
                self.numbers[first..first + 9].copy_from_slice(&packed.irregular[index]);
            }
        }
    }

    /// Writes a batch of numbers that are a stride apart, from a first one on.
    #[inline(always)]
    fn put<const N: usize>(&mut self, first: usize, stride: usize, values: &[Single; N]) {
        let first = self.place(first);
        for (k, value) in values.iter().enumerate() {
            value.store(&mut self.numbers, first + k * stride);
        }
    }

    #[inline(always)]
    fn get<const N: usize>(&self, first: usize, stride: usize) -> [Single; N] {
        let first = self.place(first);
        let mut values = [Single::ZERO; N];
        for (k, value) in values.iter_mut().enumerate() {
            *value = Single::load(&self.numbers, first + k * stride);
        }
        values
    }

    /// Upper halves of the pivots of a batch of a run.
    #[inline(always)]
    pub(crate) fn pivots(&self, run: &Run, batch: usize) -> [Single; 6] {
        self.get(run.numbers + batch * LANES, run.len())
    }

    /// Blocks of a batch on a diagonal of a run.
    #[inline(always)]
    pub(crate) fn off_diagonal(&self, run: &Run, diagonal: usize, batch: usize) -> Blocks<Single> {
        self.get(run.number(diagonal, batch), run.len())
    }

    /// Subtracts from a batch of numbers that are a stride apart, from the place of a first one on.
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

    /// Block at an address.
    #[inline(always)]
    pub(crate) fn block_at(&self, BlockAddress { first, stride }: BlockAddress) -> Blocks<f32> {
        let first = self.place(first as usize);
        let mut block = [0.0; 9];
        for (k, entry) in block.iter_mut().enumerate() {
            *entry = self.numbers[first + k * stride as usize];
        }
        block
    }

    /// Subtracts from the block at an address.
    #[inline(always)]
    pub(crate) fn subtract_at<const N: usize>(
        &mut self,
        BlockAddress { first, stride }: BlockAddress,
        values: &[f32; N],
    ) {
        let first = self.place(first as usize);
        for (k, value) in values.iter().enumerate() {
            self.numbers[first + k * stride as usize] -= value;
        }
    }
}
