//! Matrix laid out for vector instructions, in the order of elimination.

use crate::linear::block::{self, Block};
use crate::linear::block_matrix::{BlockMatrix, Coupling};
use crate::linear::lane_block::{
    Blocks, SymmetricBlocks, product, symmetric_part, symmetric_product, transposed_product,
};
use crate::linear::lanes::{Columns, Double, LANES, Single, widened};
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::level_schedule::row_order::ABSENT;

/// Places of a symmetric block's upper half in the block.
const UPPER_HALF: [usize; 6] = [0, 1, 2, 4, 5, 8];

/// Block of a row without a particle.
const IDENTITY: Block = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// Blocks of a matrix in batches.
///
/// The off-diagonal blocks are in single precision, because a product is bound by memory. The
/// symmetric part of what rounding takes from the sum of a row is added to its main diagonal: the
/// soft motions of a stiff system, translations first of all, would otherwise meet a stiffness that
/// is not there. The antisymmetric part of the rounding and its moments remain; they are as large
/// as what rounding does to the forces.
#[derive(Debug)]
pub(crate) struct PackedMatrix {
    /// Off-diagonal blocks by run, batch and diagonal.
    pub off_diagonal: Vec<Blocks<Single>>,
    pub irregular: Vec<Blocks<f32>>,
    /// Upper halves of the main diagonal, by row. Rows without a particle have the identity.
    main_diagonal: [Vec<f64>; 6],
    /// Blocks outside the sparsity, between rows.
    couplings: Vec<Coupling>,
}

impl PackedMatrix {
    pub(crate) fn new(layout: &BatchLayout) -> Self {
        Self {
            off_diagonal: vec![[Single::ZERO; 9]; layout.slots.len()],
            irregular: vec![[0.0; 9]; layout.irregular.len()],
            main_diagonal: core::array::from_fn(|_| vec![0.0; layout.rows]),
            couplings: Vec::new(),
        }
    }

    /// Copies a matrix on the sparsity of the layout.
    #[inline(always)]
    pub(crate) fn pack(&mut self, layout: &BatchLayout, matrix: &BlockMatrix) {
        let blocks = matrix.blocks();
        self.couplings.clear();
        self.couplings.extend(matrix.couplings().iter().map(|coupling| Coupling {
            row: layout.order.row_of[coupling.row as usize],
            column: layout.order.row_of[coupling.column as usize],
            ..*coupling
        }));
        for column in &mut self.main_diagonal {
            column.fill(0.0);
        }
        for run in &layout.runs {
            let diagonals = &layout.diagonals[run.diagonals.clone()];
            for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
                let slots = &layout.main_slots[run.batches + batch];
                for (column, place) in self.main_diagonal.iter_mut().zip(UPPER_HALF) {
                    let column = &mut column[row..row + LANES];
                    for (entry, &slot) in column.iter_mut().zip(slots) {
                        *entry += pick(blocks, slot, &IDENTITY)[place];
                    }
                }
                let slots = &layout.slots[run.blocks_of(batch)];
                let above = &mut self.off_diagonal[run.blocks_of(batch)];
                for ((diagonal, slots), above) in diagonals.iter().zip(slots).zip(above) {
                    let mut block = [Double::ZERO; 9];
                    for (lane, &slot) in slots.iter().enumerate() {
                        let source = pick(blocks, slot, &block::ZERO);
                        for (entry, value) in block.iter_mut().zip(source) {
                            entry.0[lane] = *value;
                        }
                    }
                    let lost = round(&block, above);
                    for (column, lost) in self.main_diagonal.iter_mut().zip(lost) {
                        for at in [row, row + diagonal.offset] {
                            (Double::load(column, at) + lost).store(column, at);
                        }
                    }
                }
                let own = layout.irregular_of[run.batches + batch].clone();
                for (entry, short) in
                    layout.irregular[own.clone()].iter().zip(&mut self.irregular[own])
                {
                    let mut lost = block::ZERO;
                    let block = &blocks[entry.slot as usize];
                    for ((lost, short), value) in lost.iter_mut().zip(short).zip(block) {
                        *short = *value as f32;
                        *lost = *value - f64::from(*short);
                    }
                    for (column, lost) in self.main_diagonal.iter_mut().zip(symmetric_part(&lost)) {
                        column[row + entry.lane as usize] += lost;
                        column[entry.column as usize] += lost;
                    }
                }
            }
        }
    }

    /// Blocks on the main diagonal of the batch that begins at a row.
    #[inline(always)]
    pub(crate) fn main_diagonal(&self, row: usize) -> SymmetricBlocks<Double> {
        let mut main = [Double::ZERO; 6];
        for (main, column) in main.iter_mut().zip(&self.main_diagonal) {
            *main = Double::load(column, row);
        }
        main
    }

    /// Adds `A x` to `y`, both by rows, with zeros in the rows without a particle.
    #[inline(always)]
    pub(crate) fn add_product(&self, layout: &BatchLayout, x: &Columns<f64>, y: &mut Columns<f64>) {
        for run in &layout.runs {
            let diagonals = &layout.diagonals[run.diagonals.clone()];
            for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
                let here = x.load(row);
                let mut sum = symmetric_product(&self.main_diagonal(row), here);
                let blocks = &self.off_diagonal[run.blocks_of(batch)];
                for (diagonal, block) in diagonals.iter().zip(blocks) {
                    let column = row + diagonal.offset;
                    let wide = widened(block);
                    let there = product(&wide, x.load(column));
                    for (sum, there) in sum.iter_mut().zip(there) {
                        *sum = *sum + there;
                    }
                    let back = transposed_product(&wide, here);
                    let old = y.load(column);
                    y.store(column, [old[0] + back[0], old[1] + back[1], old[2] + back[2]]);
                }
                let old = y.load(row);
                y.store(row, [old[0] + sum[0], old[1] + sum[1], old[2] + sum[2]]);
                let own = layout.irregular_of[run.batches + batch].clone();
                for (entry, block) in layout.irregular[own.clone()].iter().zip(&self.irregular[own])
                {
                    let mut wide = block::ZERO;
                    for (wide, entry) in wide.iter_mut().zip(block) {
                        *wide = (*entry).into();
                    }
                    let (row, column) = (row + entry.lane as usize, entry.column as usize);
                    y.add(row, product(&wide, x.at(column)));
                    y.add(column, transposed_product(&wide, x.at(row)));
                }
            }
        }
        for Coupling { row, column, block } in &self.couplings {
            let [row, column] = [*row as usize, *column as usize];
            for axis in 0..3 {
                for other in 0..3 {
                    let entry = block[3 * axis + other];
                    y.0[axis][row] += entry * x.0[other][column];
                    y.0[other][column] += entry * x.0[axis][row];
                }
            }
        }
    }
}

/// Converts blocks to single precision. Returns the symmetric part of what they lose.
#[inline(always)]
fn round(block: &Blocks<Double>, above: &mut Blocks<Single>) -> SymmetricBlocks<Double> {
    let mut lost = [Double::ZERO; 9];
    for ((lost, above), value) in lost.iter_mut().zip(above).zip(block) {
        *above = value.narrow();
        *lost = *value - above.widen();
    }
    symmetric_part(&lost)
}

#[inline(always)]
fn pick<'a>(blocks: &'a [Block], slot: u32, none: &'a Block) -> &'a Block {
    if slot == ABSENT { none } else { &blocks[slot as usize] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::sparsity::Sparsity;

    /// Springs between the points of a lattice, with numbers that single precision has to round,
    /// and no springs to anything else.
    fn lattice(n: usize) -> BlockMatrix {
        let cells = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let pairs: Vec<[usize; 2]> = cells
            .flat_map(|(i, j)| [(i, j, i, j + 1), (i, j, i + 1, j), (i, j, i + 1, j + 1)])
            .filter(|&(.., i, j)| i < n && j < n)
            .map(|(a, b, c, d)| [a * n + b, c * n + d])
            .collect();
        let mut matrix = BlockMatrix::zeros(Sparsity::from_pairs(n * n, pairs.clone()).unwrap());
        for (k, [i, j]) in pairs.into_iter().enumerate() {
            let [x, y, z] = [0.1, 0.2, 0.3].map(|phase| (k as f64 + phase).sin());
            let spring = [x * x, x * y, x * z, x * y, y * y, y * z, x * z, y * z, z * z];
            matrix.add(i, i, &spring);
            matrix.add(j, j, &spring);
            matrix.add(i, j, &spring.map(|entry| -entry));
        }
        matrix
    }

    fn multiply(matrix: &BlockMatrix, x: impl Fn(usize) -> f64) -> Vec<f64> {
        let layout = BatchLayout::new(matrix.sparsity());
        let mut packed = PackedMatrix::new(&layout);
        packed.pack(&layout, matrix);
        let (mut columns, mut product) = (Columns::new(layout.rows), Columns::new(layout.rows));
        let entries =
            || (0..3 * layout.order.row_of.len()).map(|k| (k, layout.order.row_of[k / 3] as usize));
        for (k, row) in entries() {
            columns.0[k % 3][row] = x(k);
        }
        packed.add_product(&layout, &columns, &mut product);
        entries().map(|(k, row)| product.0[k % 3][row]).collect()
    }

    #[test]
    fn the_product_is_the_matrixs_own_to_single_precision() {
        let matrix = lattice(13);
        let x: Vec<f64> = (0..3 * 13 * 13).map(|k| (k as f64).cos()).collect();
        let mut exact = vec![0.0; x.len()];
        matrix.multiply(&x, &mut exact);
        for (k, product) in multiply(&matrix, |k| x[k]).into_iter().enumerate() {
            assert!((product - exact[k]).abs() < 1e-6, "entry {k}: {product}, {}", exact[k]);
        }
    }

    #[test]
    fn rounding_gives_a_translation_no_stiffness() {
        // Rounding alone leaves 6e-8 per entry.
        let largest = |product: Vec<f64>| product.into_iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        for axis in 0..3 {
            let push = largest(multiply(&lattice(13), |k| if k % 3 == axis { 1.0 } else { 0.0 }));
            assert!(push < 1e-14, "axis {axis}: {push:e}");
        }
    }
}
