//! Finished factor `Uᵀ D U`.

use core::ops::Range;

use crate::linear::lane_block::{Blocks, SymmetricBlocks, determinant, inverse};
use crate::linear::lanes::{Double, LANES, Single};
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::level_schedule::part::Group;
use crate::linear::level_schedule::run::Run;
use crate::linear::packed_matrix::PackedMatrix;

/// Factor `Uᵀ D U` of a matrix, with `U` unit upper triangular on the matrix's own sparsity.
///
/// All but the inverse pivots is in single precision: a preconditioner is bound by memory and needs
/// no more. Both triangular solves use the same `U`, so the product stays symmetric and positive.
#[derive(Debug)]
pub(crate) struct Factor {
    /// `U` on diagonals, laid out as the packed matrix is.
    pub upper: Vec<Blocks<Single>>,
    /// Irregular entries of `U`.
    pub irregular: Vec<Blocks<f32>>,
    /// `D⁻¹`, by batch.
    pub inverse_pivots: Vec<SymmetricBlocks<Double>>,
    /// Whether `U` is left out.
    pub is_diagonal: bool,
}

/// Some consecutive rows of a factor.
pub(crate) struct FactorRows<'a> {
    upper: &'a mut [Blocks<Single>],
    irregular: &'a mut [Blocks<f32>],
    inverse_pivots: &'a mut [SymmetricBlocks<Double>],
    /// First of its blocks, irregular entries and batches in the factor.
    first: [usize; 3],
}

impl FactorRows<'_> {
    /// Splits the rows before those of a group from the others.
    pub(crate) fn split_before(self, group: &Group) -> (Self, Self) {
        let Self { upper, irregular, inverse_pivots, first } = self;
        let next = [group.blocks.start, group.irregular.start, group.batches.start];
        let (upper, more_upper) = upper.split_at_mut(next[0] - first[0]);
        let (irregular, more_irregular) = irregular.split_at_mut(next[1] - first[1]);
        let (inverse_pivots, more_pivots) = inverse_pivots.split_at_mut(next[2] - first[2]);
        let rest = Self {
            upper: more_upper,
            irregular: more_irregular,
            inverse_pivots: more_pivots,
            first: next,
        };
        (Self { upper, irregular, inverse_pivots, first }, rest)
    }

    /// Inverse pivots of a batch of a run.
    #[inline(always)]
    pub(crate) fn inverse_pivot_of(
        &mut self,
        run: &Run,
        batch: usize,
    ) -> &mut SymmetricBlocks<Double> {
        &mut self.inverse_pivots[run.batches + batch - self.first[2]]
    }

    /// Blocks of a batch of a run on its diagonals.
    #[inline(always)]
    pub(crate) fn upper_of(&mut self, run: &Run, batch: usize) -> &mut [Blocks<Single>] {
        let blocks = run.blocks_of(batch);
        &mut self.upper[blocks.start - self.first[0]..blocks.end - self.first[0]]
    }

    /// Blocks of a batch of a run on its diagonals, and some irregular entries.
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

    /// All rows.
    pub(crate) fn rows(&mut self) -> FactorRows<'_> {
        let Self { upper, irregular, inverse_pivots, .. } = self;
        FactorRows { upper, irregular, inverse_pivots, first: [0; 3] }
    }

    /// Makes this the factor of the main diagonal of a matrix alone.
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
