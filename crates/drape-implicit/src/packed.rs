//! A matrix laid out for vector instructions.

use crate::BlockMatrix;
use crate::block::{self, Block};
use crate::block_matrix::Coupling;
use crate::lane_block::{Blocks, Halves, half_product, product, symmetric, transposed_product};
use crate::lanes::{Columns, Double, LANES, Single, widened};
use crate::waves::{NOWHERE, Waves};

/// Places of a symmetric block's upper half in the block.
const HALF: [usize; 6] = [0, 1, 2, 4, 5, 8];

/// The block of a row without a particle.
const IDENTITY: Block = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// The blocks of a matrix in the order of elimination.
///
/// Those above the diagonal are kept in single precision, for a product is bound by memory. What their rounding takes
/// from the sum of a row is given back to its diagonal: the soft motions of a stiff system, translations first of all,
/// would otherwise meet a stiffness that is not there. What is left is the antisymmetric part of the rounding, and its
/// moments: of the size of what rounding does to the forces.
#[derive(Debug)]
pub(crate) struct Packed {
    /// By run, batch and diagonal.
    pub above: Vec<Blocks<Single>>,
    pub strays: Vec<Blocks<f32>>,
    /// Upper halves by row. Rows without a particle have the identity.
    own: [Vec<f64>; 6],
    /// What the sparsity had no room for, between rows.
    couplings: Vec<Coupling>,
}

impl Packed {
    pub(crate) fn new(waves: &Waves) -> Self {
        Self {
            above: vec![[Single::ZERO; 9]; waves.slots.len()],
            strays: vec![[0.0; 9]; waves.strays.len()],
            own: core::array::from_fn(|_| vec![0.0; waves.rows]),
            couplings: Vec::new(),
        }
    }

    /// Copies a matrix.
    #[inline(always)]
    pub(crate) fn pack(&mut self, waves: &Waves, matrix: &BlockMatrix) {
        let blocks = matrix.blocks();
        self.couplings.clear();
        self.couplings.extend(matrix.couplings().iter().map(|coupling| Coupling {
            row: waves.places[coupling.row as usize],
            column: waves.places[coupling.column as usize],
            ..*coupling
        }));
        for column in &mut self.own {
            column.fill(0.0);
        }
        for run in &waves.runs {
            let diagonals = &waves.diagonals[run.diagonals.clone()];
            for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
                let slots = &waves.own_slots[run.batches + batch];
                for (column, place) in self.own.iter_mut().zip(HALF) {
                    let column = &mut column[row..row + LANES];
                    for (entry, &slot) in column.iter_mut().zip(slots) {
                        *entry += pick(blocks, slot, &IDENTITY)[place];
                    }
                }
                let slots = &waves.slots[run.blocks_of(batch)];
                let above = &mut self.above[run.blocks_of(batch)];
                for ((diagonal, slots), above) in diagonals.iter().zip(slots).zip(above) {
                    let mut block = [Double::ZERO; 9];
                    for (lane, &slot) in slots.iter().enumerate() {
                        let source = pick(blocks, slot, &block::ZERO);
                        for (entry, value) in block.iter_mut().zip(source) {
                            entry.0[lane] = *value;
                        }
                    }
                    let lost = shorten(&block, above);
                    for (column, lost) in self.own.iter_mut().zip(lost) {
                        for at in [row, row + diagonal.offset] {
                            (Double::load(column, at) + lost).store(column, at);
                        }
                    }
                }
                let own = waves.batches[run.batches + batch].strays.clone();
                for (stray, short) in waves.strays[own.clone()].iter().zip(&mut self.strays[own]) {
                    let mut lost = block::ZERO;
                    let block = &blocks[stray.slot as usize];
                    for ((lost, short), value) in lost.iter_mut().zip(short).zip(block) {
                        *short = *value as f32;
                        *lost = *value - f64::from(*short);
                    }
                    for (column, lost) in self.own.iter_mut().zip(symmetric(&lost)) {
                        column[row + stray.lane as usize] += lost;
                        column[stray.column as usize] += lost;
                    }
                }
            }
        }
    }

    /// Blocks on the diagonal, from a row on.
    #[inline(always)]
    pub(crate) fn own(&self, row: usize) -> Halves<Double> {
        let mut own = [Double::ZERO; 6];
        for (own, column) in own.iter_mut().zip(&self.own) {
            *own = Double::load(column, row);
        }
        own
    }

    /// `y + A x`, both by rows, with nothing in the rows without a particle.
    #[inline(always)]
    pub(crate) fn add_product(&self, waves: &Waves, x: &Columns<f64>, y: &mut Columns<f64>) {
        for run in &waves.runs {
            let diagonals = &waves.diagonals[run.diagonals.clone()];
            for (batch, row) in (run.start..run.end).step_by(LANES).enumerate() {
                let here = x.load(row);
                let mut sum = half_product(&self.own(row), here);
                let blocks = &self.above[run.blocks_of(batch)];
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
                let own = waves.batches[run.batches + batch].strays.clone();
                for (stray, block) in waves.strays[own.clone()].iter().zip(&self.strays[own]) {
                    let mut wide = block::ZERO;
                    for (wide, entry) in wide.iter_mut().zip(block) {
                        *wide = (*entry).into();
                    }
                    let (row, column) = (row + stray.lane as usize, stray.column as usize);
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

/// Blocks in single precision. Returns the symmetric part of what they lose.
#[inline(always)]
fn shorten(block: &Blocks<Double>, above: &mut Blocks<Single>) -> Halves<Double> {
    let mut lost = [Double::ZERO; 9];
    for ((lost, above), value) in lost.iter_mut().zip(above).zip(block) {
        *above = value.narrow();
        *lost = *value - above.widen();
    }
    symmetric(&lost)
}

#[inline(always)]
fn pick<'a>(blocks: &'a [Block], slot: u32, none: &'a Block) -> &'a Block {
    if slot == NOWHERE { none } else { &blocks[slot as usize] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sparsity;

    /// Springs between the points of a lattice, with numbers that single precision has to round, and no springs to
    /// anything else.
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
        let waves = Waves::new(matrix.sparsity());
        let mut packed = Packed::new(&waves);
        packed.pack(&waves, matrix);
        let (mut columns, mut product) = (Columns::new(waves.rows), Columns::new(waves.rows));
        let entries = || (0..3 * waves.places.len()).map(|k| (k, waves.places[k / 3] as usize));
        for (k, row) in entries() {
            columns.0[k % 3][row] = x(k);
        }
        packed.add_product(&waves, &columns, &mut product);
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
