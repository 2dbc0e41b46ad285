//! Incomplete Cholesky factorisation without fill, block by block, with its own fallback to block-Jacobi.

use crate::block::{self, Block};
use crate::{BlockMatrix, Pattern};

/// A pivot whose determinant is below this fraction of its original block's is refused.
///
/// Large steps leave pivots that are positive but almost zero; conjugate gradients then stagnate for thousands
/// of iterations without an error. Measured on cloth at 17 ms: without the rule more than half of the steps
/// were lost, with it none. Much larger values shift matrices that need no shift, and weaken the factor.
const PIVOT_COLLAPSE: f64 = 1e-5;

/// First relative shift of the diagonal after a refused pivot; each further one is [`SHIFT_GROWTH`] larger.
const FIRST_SHIFT: f64 = 1e-3;

/// Growth of the shift: coarse, because a factorisation costs as much as seven iterations of the solver.
const SHIFT_GROWTH: f64 = 4.0;

/// Shifts tried (the last is about 4) before the block diagonal alone is used, which cannot fail.
const SHIFTS: usize = 7;

/// An update of one block by two others of an earlier row, by their slots.
#[derive(Clone, Copy, Debug)]
struct Update {
    left: u32,
    right: u32,
    target: u32,
}

/// The factor `Uᵀ D U` of a matrix, `U` unit upper triangular on the matrix's own pattern.
///
/// `blocks` holds `D⁻¹` on the diagonal and `U` above it.
#[derive(Debug)]
pub(crate) struct Incomplete {
    blocks: Vec<Block>,
    updates: Vec<Update>,
    update_offsets: Vec<usize>,
    row: Vec<Block>,
    diagonal_only: bool,
}

/// A diagonal block is not positive definite: neither is the matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NotDefinite;

impl Incomplete {
    /// Lists the updates that a pattern needs, once.
    pub(crate) fn new(pattern: &Pattern) -> Self {
        let mut updates = Vec::new();
        let mut update_offsets = vec![0];
        let mut longest = 0;
        for row in 0..pattern.particles() {
            let slots = pattern.row(row);
            longest = longest.max(slots.len());
            for left in slots.start + 1..slots.end {
                for right in left..slots.end {
                    let (i, j) = (pattern.columns()[left], pattern.columns()[right]);
                    if let Some(target) = pattern.slot(i as usize, j as usize) {
                        let [left, right, target] = [left, right, target].map(|slot| slot as u32);
                        updates.push(Update {
                            left,
                            right,
                            target,
                        });
                    }
                }
            }
            update_offsets.push(updates.len());
        }
        Self {
            blocks: vec![block::ZERO; pattern.blocks()],
            updates,
            update_offsets,
            row: vec![block::ZERO; longest],
            diagonal_only: false,
        }
    }

    /// Factorises, shifting the diagonal as often as pivots collapse. Returns the number of shifts.
    pub(crate) fn factorise(&mut self, matrix: &BlockMatrix) -> Result<usize, NotDefinite> {
        let pattern = matrix.pattern();
        for row in 0..pattern.particles() {
            let own = &matrix.blocks()[pattern.row(row).start];
            block::definite_determinant(own).ok_or(NotDefinite)?;
        }
        self.diagonal_only = false;
        let mut shift = 0.0;
        for tried in 0..=SHIFTS {
            if self.try_factorise(matrix, 1.0 + shift) {
                return Ok(tried);
            }
            shift = if tried == 0 {
                FIRST_SHIFT
            } else {
                shift * SHIFT_GROWTH
            };
        }
        self.diagonal_only = true;
        for row in 0..pattern.particles() {
            let slot = pattern.row(row).start;
            let own = &matrix.blocks()[slot];
            self.blocks[slot] = block::symmetric_inverse(own, block::determinant(own));
        }
        Ok(SHIFTS)
    }

    fn try_factorise(&mut self, matrix: &BlockMatrix, diagonal_factor: f64) -> bool {
        let pattern = matrix.pattern();
        self.blocks.copy_from_slice(matrix.blocks());
        if diagonal_factor != 1.0 {
            for row in 0..pattern.particles() {
                for entry in &mut self.blocks[pattern.row(row).start] {
                    *entry *= diagonal_factor;
                }
            }
        }
        let scale = PIVOT_COLLAPSE * diagonal_factor.powi(3);
        for row in 0..pattern.particles() {
            let slots = pattern.row(row);
            let pivot = &self.blocks[slots.start];
            let floor = scale * block::determinant(&matrix.blocks()[slots.start]);
            let Some(det) = block::definite_determinant(pivot).filter(|&det| det >= floor) else {
                return false;
            };
            let inverse = block::symmetric_inverse(pivot, det);
            for (scaled, slot) in self.row.iter_mut().zip(slots.clone()) {
                *scaled = block::product(&inverse, &self.blocks[slot]);
            }
            let listed = self.update_offsets[row]..self.update_offsets[row + 1];
            for update in &self.updates[listed] {
                let left = self.blocks[update.left as usize];
                let right = &self.row[update.right as usize - slots.start];
                let target = &mut self.blocks[update.target as usize];
                block::subtract_transposed_product(&left, right, target);
            }
            self.blocks[slots.start] = inverse;
            let beyond = slots.start + 1..slots.end;
            let count = beyond.len();
            self.blocks[beyond].copy_from_slice(&self.row[1..=count]);
        }
        true
    }

    /// `z = (Uᵀ D U)⁻¹ r`.
    pub(crate) fn solve(&self, pattern: &Pattern, r: &[f64], z: &mut [f64]) {
        z.copy_from_slice(r);
        let z = block::triples_mut(z);
        let columns = pattern.columns();
        for row in 0..pattern.particles() {
            let slots = pattern.row(row);
            let own = z[row];
            if !self.diagonal_only {
                let beyond = slots.start + 1..slots.end;
                let negative = own.map(|x| -x);
                for (&column, factor) in columns[beyond.clone()].iter().zip(&self.blocks[beyond]) {
                    block::add_transposed_product(factor, &negative, &mut z[column as usize]);
                }
            }
            z[row] = [0.0; 3];
            block::add_product(&self.blocks[slots.start], &own, &mut z[row]);
        }
        if self.diagonal_only {
            return;
        }
        for row in (0..pattern.particles()).rev() {
            let slots = pattern.row(row);
            let beyond = slots.start + 1..slots.end;
            let mut sum = [0.0; 3];
            for (&column, factor) in columns[beyond.clone()].iter().zip(&self.blocks[beyond]) {
                block::add_product(factor, &z[column as usize], &mut sum);
            }
            for (z, sum) in z[row].iter_mut().zip(sum) {
                *z -= sum;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain: its exact factor has no fill, so the incomplete one is exact.
    fn chain(particles: usize, own: f64, coupling: f64) -> BlockMatrix {
        let pairs = (1..particles).map(|i| (i - 1, i));
        let mut matrix = BlockMatrix::zeros(Pattern::from_pairs(particles, pairs).unwrap());
        let symmetric = [own, 0.3, -0.2, 0.3, own, 0.1, -0.2, 0.1, own];
        let skewed = [coupling, 0.1, 0.0, -0.2, coupling, 0.3, 0.0, 0.4, coupling];
        for i in 0..particles {
            matrix.add(i, i, &symmetric);
            if i > 0 {
                matrix.add(i - 1, i, &skewed);
            }
        }
        matrix
    }

    #[test]
    fn on_a_chain_the_factor_is_exact() {
        let matrix = chain(20, 3.0, -1.0);
        let mut factor = Incomplete::new(matrix.pattern());
        assert_eq!(factor.factorise(&matrix), Ok(0));
        let b: Vec<f64> = (0..60).map(|k| (k as f64).sin()).collect();
        let mut x = vec![0.0; 60];
        let mut back = vec![0.0; 60];
        factor.solve(matrix.pattern(), &b, &mut x);
        matrix.multiply(&x, &mut back);
        for (b, back) in b.iter().zip(&back) {
            assert!((b - back).abs() < 1e-13, "{back} against {b}");
        }
    }

    #[test]
    fn an_indefinite_diagonal_block_is_reported() {
        let mut matrix = chain(3, 3.0, -1.0);
        matrix.add(1, 1, &[-9.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(
            Incomplete::new(matrix.pattern()).factorise(&matrix),
            Err(NotDefinite)
        );
        matrix.blocks_mut()[0][0] = f64::NAN;
        assert_eq!(
            Incomplete::new(matrix.pattern()).factorise(&matrix),
            Err(NotDefinite)
        );
    }

    #[test]
    fn collapsing_pivots_are_cured_by_a_shift() {
        // Almost singular: the coupling nearly cancels the diagonal, so pivots run to zero along the chain.
        let matrix = chain(200, 2.0, -0.999);
        let shifts = Incomplete::new(matrix.pattern()).factorise(&matrix);
        assert!(matches!(shifts, Ok(1..SHIFTS)), "{shifts:?}");
    }

    #[test]
    fn an_indefinite_matrix_with_a_definite_diagonal_ends_in_a_definite_factor() {
        let matrix = chain(30, 1.0, -30.0);
        let mut factor = Incomplete::new(matrix.pattern());
        assert_eq!(factor.factorise(&matrix), Ok(SHIFTS));
        assert!(factor.diagonal_only);
        let r: Vec<f64> = (0..90).map(|k| (k as f64).cos()).collect();
        let mut z = vec![0.0; 90];
        factor.solve(matrix.pattern(), &r, &mut z);
        assert!(crate::vector::dot(&r, &z) > 0.0);
    }
}
