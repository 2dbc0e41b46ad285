//! What is left of a matrix while it is factorised.

use crate::lane_block::Blocks;
use crate::lanes::{Double, LANES, Number, Single, narrowed};
use crate::packed::Packed;
use crate::waves::{Place, Run, Waves};

/// Its blocks in columns, so that a batch of them can begin at any row: see [`Run::work`].
///
/// In single precision, in which the matrix is packed too: a factor takes a fifth less time than in double.
#[derive(Debug)]
pub(crate) struct Remainder(Vec<f32>);

impl Remainder {
    pub(crate) fn new(waves: &Waves) -> Self {
        // A batch of updates may reach beyond the last column, with zeros.
        Self(vec![0.0; waves.work + LANES])
    }

    /// Copies a run of a matrix, its diagonal larger by a factor.
    #[inline(always)]
    pub(crate) fn load(&mut self, waves: &Waves, run: &Run, packed: &Packed, factor: f64) {
        let factor = Double::of(factor);
        for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
            let mut own = packed.own(row);
            for entry in &mut own {
                *entry = *entry * factor;
            }
            self.put(run.work + batch * LANES, run.len(), &narrowed(&own));
            for (diagonal, block) in packed.above[run.blocks_of(batch)].iter().enumerate() {
                self.put(run.above(diagonal, batch), run.len(), block);
            }
            for index in waves.batches[run.batches + batch].strays.clone() {
                let at = waves.stray(index).first as usize;
                self.0[at..at + 9].copy_from_slice(&packed.strays[index]);
            }
        }
    }

    /// Batches of columns of a length, from a place on.
    #[inline(always)]
    fn put<const N: usize>(&mut self, first: usize, length: usize, values: &[Single; N]) {
        for (k, value) in values.iter().enumerate() {
            value.store(&mut self.0, first + k * length);
        }
    }

    #[inline(always)]
    fn get<const N: usize>(&self, first: usize, length: usize) -> [Single; N] {
        let mut values = [Single::ZERO; N];
        for (k, value) in values.iter_mut().enumerate() {
            *value = Single::load(&self.0, first + k * length);
        }
        values
    }

    /// Upper halves of the pivots of a batch of a run.
    #[inline(always)]
    pub(crate) fn pivots(&self, run: &Run, batch: usize) -> [Single; 6] {
        self.get(run.work + batch * LANES, run.len())
    }

    /// Blocks of a batch of a diagonal of a run.
    #[inline(always)]
    pub(crate) fn above(&self, run: &Run, (diagonal, batch): (usize, usize)) -> Blocks<Single> {
        self.get(run.above(diagonal, batch), run.len())
    }

    /// Subtracts from a batch of columns of a length, from a place on.
    #[inline(always)]
    pub(crate) fn take_off<const N: usize>(
        &mut self,
        (first, length): (usize, usize),
        values: &[Single; N],
    ) {
        for (k, value) in values.iter().enumerate() {
            let at = first + k * length;
            (Single::load(&self.0, at) - *value).store(&mut self.0, at);
        }
    }

    /// The block at a place.
    #[inline(always)]
    pub(crate) fn block_at(&self, Place { first, step }: Place) -> Blocks<f32> {
        let mut block = [0.0; 9];
        for (k, entry) in block.iter_mut().enumerate() {
            *entry = self.0[first as usize + k * step as usize];
        }
        block
    }

    /// Subtracts from the block at a place.
    #[inline(always)]
    pub(crate) fn take_off_at<const N: usize>(
        &mut self,
        Place { first, step }: Place,
        values: &[f32; N],
    ) {
        for (k, value) in values.iter().enumerate() {
            self.0[first as usize + k * step as usize] -= value;
        }
    }
}
