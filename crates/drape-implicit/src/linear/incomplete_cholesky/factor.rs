//! Finished factor `Uᵀ D U` and its triangular solves.

use crate::linear::lane_block::{
    Blocks, SymmetricBlocks, determinant, inverse, product, symmetric_product, transposed_product,
};
use crate::linear::lanes::{Columns, Double, LANES, Single, narrowed, widened};
use crate::linear::level_schedule::layout::BatchLayout;
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

impl Factor {
    pub(crate) fn new(layout: &BatchLayout) -> Self {
        Self {
            upper: vec![[Single::ZERO; 9]; layout.slots.len()],
            irregular: vec![[0.0; 9]; layout.irregular.len()],
            inverse_pivots: vec![[Double::ZERO; 6]; layout.main_slots.len()],
            is_diagonal: false,
        }
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

    /// Turns the image `r` into `(Uᵀ D U)⁻¹ r`.
    #[inline(always)]
    pub(crate) fn apply(&self, layout: &BatchLayout, image: &mut Columns<f32>) {
        if self.is_diagonal {
            for run in &layout.runs {
                let pivots = self.inverse_pivots[run.batches..].iter();
                for (row, pivot) in (run.start..run.end).step_by(LANES).zip(pivots) {
                    divide(pivot, image, row);
                }
            }
        } else {
            self.solve_lower(layout, image);
            self.solve_upper(layout, image);
        }
    }

    /// Applies `D⁻¹ U⁻ᵀ`, by forward substitution.
    #[inline(always)]
    fn solve_lower(&self, layout: &BatchLayout, image: &mut Columns<f32>) {
        let Self { upper, irregular, inverse_pivots, .. } = self;
        for run in &layout.runs {
            let diagonals = &layout.diagonals[run.diagonals.clone()];
            let starts = (run.start..run.end).step_by(LANES);
            for ((batch, row), pivot) in starts.enumerate().zip(&inverse_pivots[run.batches..]) {
                let here = image.load(row);
                let blocks = &upper[run.blocks_of(batch)];
                for (diagonal, block) in diagonals.iter().zip(blocks) {
                    let column = row + diagonal.offset;
                    let [x, y, z] = image.load(column);
                    let [a, b, c] = transposed_product(block, here);
                    image.store(column, [x - a, y - b, z - c]);
                }
                let own = layout.irregular_of[run.batches + batch].clone();
                for (entry, block) in layout.irregular[own.clone()].iter().zip(&irregular[own]) {
                    let here = image.at(row + entry.lane as usize);
                    image.subtract(entry.column as usize, transposed_product(block, here));
                }
                divide(pivot, image, row);
            }
        }
    }

    /// Applies `U⁻¹`, by backward substitution.
    #[inline(always)]
    fn solve_upper(&self, layout: &BatchLayout, image: &mut Columns<f32>) {
        let Self { upper, irregular, .. } = self;
        for run in layout.runs.iter().rev() {
            let diagonals = &layout.diagonals[run.diagonals.clone()];
            for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
                let blocks = &upper[run.blocks_of(batch)];
                let mut sum = [Single::ZERO; 3];
                for (diagonal, block) in diagonals.iter().zip(blocks) {
                    let more = product(block, image.load(row + diagonal.offset));
                    for (sum, more) in sum.iter_mut().zip(more) {
                        *sum = *sum + more;
                    }
                }
                let [x, y, z] = image.load(row);
                image.store(row, [x - sum[0], y - sum[1], z - sum[2]]);
                let own = layout.irregular_of[run.batches + batch].clone();
                for (entry, block) in layout.irregular[own.clone()].iter().zip(&irregular[own]) {
                    let there = image.at(entry.column as usize);
                    image.subtract(row + entry.lane as usize, product(block, there));
                }
            }
        }
    }
}

/// Applies inverse pivots, in double precision: stiff and soft directions may be far apart in them.
#[inline(always)]
fn divide(pivot: &SymmetricBlocks<Double>, image: &mut Columns<f32>, row: usize) {
    image.store(row, narrowed(&symmetric_product(pivot, widened(&image.load(row)))));
}
