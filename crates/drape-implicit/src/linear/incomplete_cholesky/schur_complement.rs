//! Schur complement: the part of a matrix that is not factorised yet.

use crate::linear::lane_block::Blocks;
use crate::linear::lanes::{Double, LANES, Number, Single, narrowed};
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::level_schedule::run::{BlockAddress, Run};
use crate::linear::packed_matrix::PackedMatrix;

/// Schur complement of the rows eliminated so far.
///
/// Its blocks are in columns, so that a batch of them can begin at any row: see [`Run::numbers`].
/// It is in single precision, in which the matrix is packed too: a factorisation takes a fifth less
/// time than in double.
#[derive(Debug)]
pub(crate) struct SchurComplement(Vec<f32>);

impl SchurComplement {
    pub(crate) fn new(layout: &BatchLayout) -> Self {
        // A batch of updates may lead beyond the last column, with zeros.
        Self(vec![0.0; layout.numbers + LANES])
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
                let first = layout.irregular_address(index).first as usize;
                self.0[first..first + 9].copy_from_slice(&packed.irregular[index]);
            }
        }
    }

    /// Writes a batch of numbers that are a stride apart, from a first one on.
    #[inline(always)]
    fn put<const N: usize>(&mut self, first: usize, stride: usize, values: &[Single; N]) {
        for (k, value) in values.iter().enumerate() {
            value.store(&mut self.0, first + k * stride);
        }
    }

    #[inline(always)]
    fn get<const N: usize>(&self, first: usize, stride: usize) -> [Single; N] {
        let mut values = [Single::ZERO; N];
        for (k, value) in values.iter_mut().enumerate() {
            *value = Single::load(&self.0, first + k * stride);
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

    /// Subtracts from a batch of numbers that are a stride apart, from a first one on.
    #[inline(always)]
    pub(crate) fn subtract<const N: usize>(
        &mut self,
        first: usize,
        stride: usize,
        values: &[Single; N],
    ) {
        for (k, value) in values.iter().enumerate() {
            let at = first + k * stride;
            (Single::load(&self.0, at) - *value).store(&mut self.0, at);
        }
    }

    /// Block at an address.
    #[inline(always)]
    pub(crate) fn block_at(&self, BlockAddress { first, stride }: BlockAddress) -> Blocks<f32> {
        let mut block = [0.0; 9];
        for (k, entry) in block.iter_mut().enumerate() {
            *entry = self.0[first as usize + k * stride as usize];
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
        for (k, value) in values.iter().enumerate() {
            self.0[first as usize + k * stride as usize] -= value;
        }
    }
}
