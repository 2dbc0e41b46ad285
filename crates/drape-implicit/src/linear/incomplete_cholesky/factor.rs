//! Finished factor `Uᵀ D U`.

use core::ops::Range;

use crate::linear::lane_block::{Blocks, SymmetricBlocks, determinant, inverse};
use crate::linear::lanes::{Double, LANES, Single};
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::level_schedule::part::Group;
use crate::linear::level_schedule::run::Run;
use crate::linear::packed_matrix::PackedMatrix;

/// Factor `Uᵀ D U` of a matrix. `U` is unit upper triangular with the sparsity of the matrix.
///
/// All numbers except the inverse pivots are in single precision: memory access limits the speed of
/// a preconditioner, which does not need more digits. Both triangular solves use one `U`, so the
/// product is symmetric and positive.
#[derive(Debug)]
pub(crate) struct Factor {
    /// Blocks of `U` on diagonals, in the order of the packed matrix.
    pub upper: Vec<Blocks<Single>>,
    /// Irregular entries of `U`.
    pub irregular: Vec<Blocks<f32>>,
    /// Inverse pivots `D⁻¹`, by batch.
    pub inverse_pivots: Vec<SymmetricBlocks<Double>>,
    /// Whether the factor is `D` alone, with the identity as `U`.
    pub is_diagonal: bool,
}

/// Consecutive rows of a factor.
pub(crate) struct FactorRows<'a> {
    upper: &'a mut [Blocks<Single>],
    irregular: &'a mut [Blocks<f32>],
    inverse_pivots: &'a mut [SymmetricBlocks<Double>],
    /// Indices of the first block, irregular entry and batch in the whole factor.
    first: [usize; 3],
}

impl FactorRows<'_> {
    /// Splits the rows into the rows before `group`, and the rows of `group` and after it.
    pub(crate) fn split_before(self, group: &Group) -> (Self, Self) {
        let Self { upper, irregular, inverse_pivots, first } = self;
        let next = [group.blocks.start, group.irregular.start, group.batches.start];
        let (upper, later_upper) = upper.split_at_mut(next[0] - first[0]);
        let (irregular, later_irregular) = irregular.split_at_mut(next[1] - first[1]);
        let (inverse_pivots, later_pivots) = inverse_pivots.split_at_mut(next[2] - first[2]);
        let later = Self {
            upper: later_upper,
            irregular: later_irregular,
            inverse_pivots: later_pivots,
            first: next,
        };
        (Self { upper, irregular, inverse_pivots, first }, later)
    }

    /// Returns the inverse pivots of `batch`, counted within `run`.
    #[inline(always)]
    pub(crate) fn inverse_pivot_of(
        &mut self,
        run: &Run,
        batch: usize,
    ) -> &mut SymmetricBlocks<Double> {
        &mut self.inverse_pivots[run.batches + batch - self.first[2]]
    }

    /// Returns the blocks of `batch`, counted within `run`, on the diagonals.
    #[inline(always)]
    pub(crate) fn upper_of(&mut self, run: &Run, batch: usize) -> &mut [Blocks<Single>] {
        let blocks = run.blocks_of(batch);
        &mut self.upper[blocks.start - self.first[0]..blocks.end - self.first[0]]
    }

    /// Returns the blocks of `batch`, counted within `run`, on the diagonals, and the given range
    /// of `irregular` entries.
    #[inline(always)]
    pub(crate) fn rows_of(
        &mut self,
        run: &Run,
        batch: usize,
        irregular: Range<usize>,
    ) -> (&[Blocks<Single>], &mut [Blocks<f32>]) {
        let [blocks, entries, _] = self.first;
        let upper = run.blocks_of(batch);
        (
            &self.upper[upper.start - blocks..upper.end - blocks],
            &mut self.irregular[irregular.start - entries..irregular.end - entries],
        )
    }
}

impl Factor {
    pub(crate) fn new(layout: &BatchLayout) -> Self {
        Self {
            upper: vec![[Single::ZERO; 9]; layout.slots.len()],
            irregular: vec![[0.0; 9]; layout.irregular.len()],
            inverse_pivots: vec![[Double::ZERO; 6]; layout.main_slots.len()],
            is_diagonal: false,
        }
    }

    /// Returns all rows of the factor.
    pub(crate) fn rows(&mut self) -> FactorRows<'_> {
        let Self { upper, irregular, inverse_pivots, .. } = self;
        FactorRows { upper, irregular, inverse_pivots, first: [0; 3] }
    }

    /// Sets this factor to the factor of the main diagonal of `packed` alone.
    #[inline(always)]
    pub(crate) fn use_diagonal(&mut self, layout: &BatchLayout, packed: &PackedMatrix) {
        self.is_diagonal = true;
        let batches = layout.runs.iter().flat_map(|run| (run.start..run.end).step_by(LANES));
        for (pivot, row) in self.inverse_pivots.iter_mut().zip(batches) {
            let main = packed.main_diagonal(row);
            *pivot = inverse(&main, determinant(&main));
        }
    }
}
