//! Symmetric sparse matrix of 3x3 blocks, into which a system assembles its stiffness.

use core::ops::Range;

use crate::check::check_length;
use crate::error::Error;
use crate::linear::block::{self, Block};
use crate::linear::sparsity::Sparsity;
use crate::threads;

/// A matrix with more blocks than this is written by several threads, each with at most this
/// number.
const PARALLEL_BLOCKS: usize = 16_384;

/// Symmetric sparse matrix of 3x3 blocks with the upper half stored. Entries of a stiffness are in
/// N/m.
///
/// Blocks are row-major and in the order of the [`Sparsity`]. A block above the diagonal also
/// represents its transpose below the diagonal. Diagonal blocks are stored whole.
///
/// ```
/// use drape_implicit::{BlockMatrix, Sparsity};
///
/// // A spring of 100 N/m along x between two particles.
/// let mut stiffness = BlockMatrix::zeros(Sparsity::from_pairs(2, [[0, 1]])?);
/// let mut block = [0.0; 9];
/// block[0] = 100.0;
/// stiffness.add(0, 0, &block);
/// stiffness.add(1, 1, &block);
/// stiffness.add(0, 1, &block.map(|entry| -entry));
///
/// let mut product = [0.0; 6];
/// stiffness.multiply(&[0.0, 0.0, 0.0, 0.01, 0.0, 0.0], &mut product)?;
/// assert_eq!(product, [-1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
/// # Ok::<(), drape_implicit::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct BlockMatrix {
    sparsity: Sparsity,
    blocks: Vec<Block>,
    couplings: Vec<Coupling>,
    /// Whether each particle is held.
    held: Vec<bool>,
    /// Row and column of the first block that was refused.
    outside: Option<[usize; 2]>,
}

/// Block of two different particles for which the sparsity has no slot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupling {
    /// Particle of the row.
    pub row: u32,
    /// Particle of the column.
    pub column: u32,
    /// Entries, row-major, in N/m.
    pub block: [f64; 9],
}

/// Failure of a factorisation or solve: the matrix is not positive definite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NotDefinite;

impl BlockMatrix {
    /// Returns the matrix of zeros on `sparsity`.
    #[must_use]
    pub fn zeros(sparsity: Sparsity) -> Self {
        let blocks = vec![block::ZERO; sparsity.block_count()];
        let held = vec![false; sparsity.particle_count()];
        Self { sparsity, blocks, couplings: Vec::new(), held, outside: None }
    }

    /// Returns the sparsity of the matrix.
    #[must_use]
    pub fn sparsity(&self) -> &Sparsity {
        &self.sparsity
    }

    /// Returns the blocks, one per slot of the [`Sparsity`].
    #[must_use]
    pub fn blocks(&self) -> &[[f64; 9]] {
        &self.blocks
    }

    /// Returns the blocks mutably, one per slot of the [`Sparsity`].
    pub fn blocks_mut(&mut self) -> &mut [[f64; 9]] {
        &mut self.blocks
    }

    /// Returns all entries, nine per slot of the [`Sparsity`].
    #[must_use]
    pub fn values(&self) -> &[f64] {
        self.blocks.as_flattened()
    }

    /// Returns all entries mutably, nine per slot of the [`Sparsity`].
    pub fn values_mut(&mut self) -> &mut [f64] {
        self.blocks.as_flattened_mut()
    }

    /// Sets every entry to zero and removes all couplings.
    pub fn clear(&mut self) {
        threads::for_each_chunk(&mut self.blocks, PARALLEL_BLOCKS, |blocks| {
            blocks.fill(block::ZERO)
        });
        self.couplings.clear();
        self.held.fill(false);
        self.outside = None;
    }

    /// Adds `value` to the block of `slot`.
    ///
    /// A slot that the sparsity does not have counts as a block outside the sparsity, in the row
    /// and the column one beyond the last: see [`add`](Self::add).
    pub fn add_block(&mut self, slot: usize, value: &[f64; 9]) {
        let Some(block) = self.blocks.get_mut(slot) else {
            let beyond = self.sparsity.particle_count();
            self.outside = self.outside.or(Some([beyond; 2]));
            return;
        };
        for (entry, value) in block.iter_mut().zip(value) {
            *entry += value;
        }
    }

    /// Adds `value` to the block in row `i` and column `j`, and its transpose to the mirror image.
    /// Rows and columns are numbers of particles. `value` is row-major.
    ///
    /// Give each pair once, in either order. A block outside the sparsity is not added. Then
    /// [`outside_sparsity`](Self::outside_sparsity) returns the first such row and column, and the
    /// step ends with an error.
    pub fn add(&mut self, i: usize, j: usize, value: &[f64; 9]) {
        match self.sparsity.slot(i, j) {
            Some(slot) if i <= j => self.add_block(slot, value),
            Some(slot) => self.add_block(slot, &block::transposed(value)),
            None => self.outside = self.outside.or(Some([i, j])),
        }
    }

    /// Adds `value` to the block in row `i` and column `j`, inside or outside the sparsity.
    ///
    /// This method serves couplings that change from step to step, such as contact. Give each pair
    /// once, in either order. A block outside the sparsity is part of the matrix but not of its
    /// preconditioner, so conjugate gradients take more iterations. A particle outside the matrix
    /// is an error, as in [`add`](Self::add).
    pub fn add_coupling(&mut self, i: usize, j: usize, value: &[f64; 9]) {
        let particles = self.sparsity.particle_count();
        if i >= particles || j >= particles || self.sparsity.slot(i, j).is_some() {
            return self.add(i, j, value);
        }
        self.couplings.push(Coupling { row: i as u32, column: j as u32, block: *value });
    }

    /// Returns the blocks outside the [`Sparsity`], in the order in which they were added.
    #[must_use]
    pub fn couplings(&self) -> &[Coupling] {
        &self.couplings
    }

    /// Returns row and column of the first block since the last [`clear`](Self::clear) that
    /// [`add`](Self::add) refused.
    #[must_use]
    pub fn outside_sparsity(&self) -> Option<[usize; 2]> {
        self.outside
    }

    /// Writes the product `A x` into `y`, both with three entries per particle.
    ///
    /// # Errors
    /// [`Error::Dimension`] if `x` or `y` has another length.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) -> Result<(), Error> {
        let length = 3 * self.sparsity.particle_count();
        check_length("x", length, x.len())?;
        check_length("y", length, y.len())?;
        self.write_product(x, y);
        Ok(())
    }

    /// Writes the product `A x` into `y`, both with three entries per particle.
    pub(crate) fn write_product(&self, x: &[f64], y: &mut [f64]) {
        y.fill(0.0);
        let x = block::triples(x);
        let y = block::triples_mut(y);

        // A block above the diagonal contributes to its row and, transposed, to its column.
        for row in 0..self.sparsity.particle_count() {
            let slots = self.sparsity.row(row);
            let x_of_row = x[row];
            let mut sum = [0.0; 3];
            block::add_product(&self.blocks[slots.start], &x_of_row, &mut sum);
            let above = slots.start + 1..slots.end;
            let columns = &self.sparsity.columns()[above.clone()];
            for (&column, block) in columns.iter().zip(&self.blocks[above]) {
                let column = column as usize;
                block::add_product(block, &x[column], &mut sum);
                block::add_transposed_product(block, &x_of_row, &mut y[column]);
            }
            for (y, sum) in y[row].iter_mut().zip(sum) {
                *y += sum;
            }
        }

        for Coupling { row, column, block } in &self.couplings {
            let (row, column) = (*row as usize, *column as usize);
            block::add_product(block, &x[column], &mut y[row]);
            block::add_transposed_product(block, &x[row], &mut y[column]);
        }
    }

    /// Returns whether `particle` is held. The row and column of a held particle are empty except
    /// for its inertia.
    pub(crate) fn is_held(&self, particle: usize) -> bool {
        self.held[particle]
    }

    /// Turns a stiffness into the system matrix of a step: removes all entries from the rows and
    /// columns of `held` particles, and adds the `inertia` of each particle, in N/m, to the
    /// diagonal.
    pub(crate) fn add_inertia(&mut self, inertia: &[f64], held: &[bool]) {
        let rows = Rows { sparsity: &self.sparsity, rows: 0..inertia.len(), inertia, held };
        rows.add_inertia(&mut self.blocks);
        self.held.copy_from_slice(held);
        self.couplings
            .retain(|coupling| !held[coupling.row as usize] && !held[coupling.column as usize]);
    }
}

/// Consecutive rows of a matrix, with the inertia of all particles.
struct Rows<'a> {
    sparsity: &'a Sparsity,
    rows: Range<usize>,
    inertia: &'a [f64],
    held: &'a [bool],
}

impl Rows<'_> {
    /// Adds the inertia to `blocks`, the blocks of the rows, and clears the blocks of held
    /// particles. Divides many blocks among threads.
    fn add_inertia(self, blocks: &mut [Block]) {
        let Self { sparsity, rows, inertia, held } = self;
        let offsets = &sparsity.offsets()[rows.start..];
        if blocks.len() > PARALLEL_BLOCKS && rows.len() > 1 {
            let half = rows.len() / 2;
            let middle = rows.start + half;
            let (first, second) = blocks.split_at_mut(offsets[half] - offsets[0]);
            let first_rows = Rows { sparsity, rows: rows.start..middle, inertia, held };
            let second_rows = Rows { sparsity, rows: middle..rows.end, inertia, held };
            threads::join(|| first_rows.add_inertia(first), || second_rows.add_inertia(second));
            return;
        }

        for (row, range) in rows.zip(offsets.windows(2)) {
            let columns = &sparsity.columns()[sparsity.row(row)];
            let blocks = &mut blocks[range[0] - offsets[0]..range[1] - offsets[0]];
            for (block, &column) in blocks.iter_mut().zip(columns) {
                if held[row] || held[column as usize] {
                    *block = block::ZERO;
                }
            }
            for k in [0, 4, 8] {
                blocks[0][k] += inertia[row];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> BlockMatrix {
        let sparsity = Sparsity::from_pairs(3, [[0, 1], [0, 2]]).unwrap();
        let mut matrix = BlockMatrix::zeros(sparsity);
        for (k, value) in matrix.values_mut().iter_mut().enumerate() {
            *value = (k as f64 * 0.7).sin();
        }
        // Diagonal blocks of a symmetric matrix are symmetric.
        for row in 0..3 {
            let slot = matrix.sparsity().row(row).start;
            let b = matrix.blocks()[slot];
            let t = block::transposed(&b);
            matrix.add_block(slot, &t);
        }
        matrix
    }

    #[test]
    fn multiplication_agrees_with_the_dense_matrix() {
        let matrix = sample();
        let mut dense = vec![vec![0.0; 9]; 9];
        for row in 0..3 {
            for slot in matrix.sparsity().row(row) {
                let column = matrix.sparsity().columns()[slot] as usize;
                for r in 0..3 {
                    for c in 0..3 {
                        dense[3 * row + r][3 * column + c] = matrix.blocks()[slot][3 * r + c];
                        dense[3 * column + c][3 * row + r] = matrix.blocks()[slot][3 * r + c];
                    }
                }
            }
        }
        let x: Vec<f64> = (0..9).map(|k| (k as f64).cos()).collect();
        let mut y = vec![f64::NAN; 9];
        matrix.write_product(&x, &mut y);
        for (row, y) in dense.iter().zip(&y) {
            let expected: f64 = row.iter().zip(&x).map(|(a, x)| a * x).sum();
            assert!((y - expected).abs() < 1e-14, "{y} against {expected}");
        }
    }

    #[test]
    fn a_block_given_below_the_diagonal_lands_transposed_above_it() {
        let mut matrix = BlockMatrix::zeros(Sparsity::from_pairs(2, [[0, 1]]).unwrap());
        let value = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        matrix.add(1, 0, &value);
        assert_eq!(matrix.blocks()[1], block::transposed(&value));
        assert_eq!(matrix.outside_sparsity(), None);
    }

    #[test]
    fn a_block_outside_the_sparsity_is_remembered() {
        let mut matrix = BlockMatrix::zeros(Sparsity::from_pairs(3, [[0, 1]]).unwrap());
        matrix.add(2, 1, &[1.0; 9]);
        matrix.add(0, 2, &[1.0; 9]);
        assert_eq!(matrix.outside_sparsity(), Some([2, 1]));
        matrix.clear();
        assert_eq!(matrix.outside_sparsity(), None);
    }

    #[test]
    fn couplings_outside_the_sparsity_count_and_are_removed_with_the_held() {
        let mut matrix = BlockMatrix::zeros(Sparsity::from_pairs(3, [[0, 1]]).unwrap());
        let value = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        matrix.add_coupling(2, 0, &value);
        matrix.add_coupling(1, 0, &value);
        assert_eq!(matrix.blocks()[1], block::transposed(&value), "has room");
        let x = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let mut y = [f64::NAN; 9];
        matrix.write_product(&x, &mut y);
        assert_eq!(y, [4.0, 5.0, 6.0, 1.0, 4.0, 7.0, 1.0, 4.0, 7.0]);
        matrix.add_coupling(0, 3, &value);
        assert_eq!(matrix.outside_sparsity(), Some([0, 3]));
        matrix.add_inertia(&[0.0; 3], &[false, false, true]);
        assert!(matrix.couplings().is_empty());
    }

    #[test]
    fn held_particles_keep_nothing_but_their_inertia() {
        let mut matrix = sample();
        let free = matrix.blocks()[0];
        matrix.add_inertia(&[2.0, 3.0, 5.0], &[false, true, false]);
        assert_eq!(matrix.blocks()[1], block::ZERO, "coupling to the held particle");
        assert_eq!(matrix.blocks()[3], [3.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 3.0]);
        assert_eq!(matrix.blocks()[0][0], free[0] + 2.0);
        assert_eq!(matrix.blocks()[0][1], free[1]);
    }
}
