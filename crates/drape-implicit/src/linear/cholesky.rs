//! Sparse Cholesky factorisation by faer, on one thread. The sparsity is ordered and analysed once.

use faer::Conj;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, amd};
use faer::sparse::{FaerError, SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};
use faer::{MatMut, Par, Side};

use crate::error::Error;
use crate::linear::block_matrix::{BlockMatrix, NotDefinite};
use crate::linear::sparsity::Sparsity;

/// One thread: faer's parallel factorisation was never faster for such matrices, on two cores or on
/// many, and its global default uses every core of the machine.
const PARALLEL: Par = Par::Seq;

/// Factor `L` of a matrix, with work space.
pub(crate) struct Cholesky {
    symbolic: SymbolicCholesky<usize>,
    lower: SymbolicSparseColMat<usize>,
    entries: Vec<f64>,
    factor: Vec<f64>,
    memory: MemBuffer,
}

/// Kernel of the column updates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kernel {
    /// Many columns at once with the vector instructions of the machine, on which the last bits
    /// depend.
    Vector,
    /// One number after another. Every machine computes equal bits.
    Scalar,
}

impl Kernel {
    fn threshold(self) -> SupernodalThreshold {
        match self {
            Self::Vector => SupernodalThreshold::AUTO,
            Self::Scalar => SupernodalThreshold::FORCE_SIMPLICIAL,
        }
    }
}

impl core::fmt::Debug for Cholesky {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Cholesky").field("factor", &self.factor.len()).finish_non_exhaustive()
    }
}

impl Cholesky {
    /// Orders and analyses `sparsity`.
    ///
    /// # Errors
    /// [`Error::TooLarge`].
    pub(crate) fn new(sparsity: &Sparsity, kernel: Kernel) -> Result<Self, Error> {
        let blocks = sparsity.block_count();
        let lower = scalar_lower(sparsity);
        let size = lower.nrows();

        let Ordering { forward, inverse } =
            minimum_degree(sparsity).map_err(|_| Error::TooLarge { blocks })?;
        let symbolic = factorize_symbolic_cholesky(
            lower.as_ref(),
            Side::Lower,
            SymmetricOrdering::Custom(PermRef::new_checked(&forward, &inverse, size)),
            CholeskySymbolicParams {
                supernodal_flop_ratio_threshold: kernel.threshold(),
                ..Default::default()
            },
        )
        .map_err(|_| Error::TooLarge { blocks })?;

        // Factorisation and solution share one work space.
        let factorise = symbolic.factorize_numeric_llt_scratch::<f64>(PARALLEL, Default::default());
        let solve = symbolic.solve_in_place_scratch::<f64>(1, PARALLEL);
        let memory = MemBuffer::try_new(StackReq::or(factorise, solve))
            .map_err(|_| Error::TooLarge { blocks })?;

        Ok(Self {
            entries: vec![0.0; lower.col_ptr()[size]],
            factor: vec![0.0; symbolic.len_val()],
            symbolic,
            lower,
            memory,
        })
    }

    /// Factorises `matrix`, which has the analysed sparsity.
    pub(crate) fn factorise(&mut self, matrix: &BlockMatrix) -> Result<(), NotDefinite> {
        fill_lower(matrix, &mut self.entries);
        self.symbolic
            .factorize_numeric_llt(
                &mut self.factor,
                SparseColMatRef::new(self.lower.as_ref(), &self.entries),
                Side::Lower,
                LltRegularization::default(),
                PARALLEL,
                MemStack::new(&mut self.memory),
                Default::default(),
            )
            .map(|_| ())
            .map_err(|_| NotDefinite)
    }

    /// Solves for `x`, which holds the right side on entry.
    pub(crate) fn solve(&mut self, x: &mut [f64]) {
        let rows = x.len();
        LltRef::new(&self.symbolic, &self.factor).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(x, rows, 1),
            PARALLEL,
            MemStack::new(&mut self.memory),
        );
    }
}

/// Permutation of the unknowns and its inverse.
struct Ordering {
    forward: Vec<usize>,
    inverse: Vec<usize>,
}

/// Returns a minimum-degree ordering of the particles of `sparsity`, expanded to three unknowns
/// each. Ordering the particles gives equal fill in half the time of ordering the unknowns.
fn minimum_degree(sparsity: &Sparsity) -> Result<Ordering, FaerError> {
    let particles = sparsity.particle_count();
    let columns: Vec<usize> = sparsity.columns().iter().map(|&column| column as usize).collect();
    let graph = SymbolicSparseColMatRef::new_checked(
        particles,
        particles,
        sparsity.offsets(),
        None,
        &columns,
    );

    let mut forward = vec![0; particles];
    let mut inverse = vec![0; particles];
    let request = amd::order_maybe_unsorted_scratch::<usize>(particles, columns.len());
    let mut memory = MemBuffer::try_new(request).map_err(|_| FaerError::OutOfMemory)?;
    let stack = MemStack::new(&mut memory);
    amd::order_maybe_unsorted(&mut forward, &mut inverse, graph, Default::default(), stack)?;
    Ok(Ordering { forward: unknowns(&forward), inverse: unknowns(&inverse) })
}

/// Returns the three unknowns of each particle in the order of `particles`.
fn unknowns(particles: &[usize]) -> Vec<usize> {
    particles.iter().flat_map(|&p| [3 * p, 3 * p + 1, 3 * p + 2]).collect()
}

/// Returns the scalar lower half of `sparsity` by columns. A block row of the upper half is,
/// transposed, three columns of the lower half.
fn scalar_lower(sparsity: &Sparsity) -> SymbolicSparseColMat<usize> {
    let size = 3 * sparsity.particle_count();
    let mut offsets = vec![0];
    let mut rows = Vec::with_capacity(9 * sparsity.block_count());
    for row in 0..sparsity.particle_count() {
        for component in 0..3 {
            rows.extend(3 * row + component..3 * row + 3);
            for slot in sparsity.row(row).skip(1) {
                let column = sparsity.columns()[slot] as usize;
                rows.extend(3 * column..3 * column + 3);
            }
            offsets.push(rows.len());
        }
    }
    SymbolicSparseColMat::new_checked(size, size, offsets, None, rows)
}

/// Writes the entries of `matrix` into `entries` in the order of [`scalar_lower`].
fn fill_lower(matrix: &BlockMatrix, entries: &mut [f64]) {
    let mut entries = entries.iter_mut();
    for row in 0..matrix.sparsity().particle_count() {
        for component in 0..3 {
            for (k, slot) in matrix.sparsity().row(row).enumerate() {
                let first = if k == 0 { component } else { 0 };
                let part = &matrix.blocks()[slot][3 * component + first..3 * component + 3];
                for (value, entry) in part.iter().zip(entries.by_ref()) {
                    *entry = *value;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A band matrix with unsymmetric blocks off the diagonal, dominated by its diagonal or not.
    fn band(own: f64) -> BlockMatrix {
        let pairs = (1..12).map(|i| [i - 1, i]).chain((4..12).map(|i| [i - 4, i]));
        let mut matrix = BlockMatrix::zeros(Sparsity::from_pairs(12, pairs.clone()).unwrap());
        for i in 0..12 {
            matrix.add(i, i, &[own, 0.2, 0.1, 0.2, own, -0.3, 0.1, -0.3, own]);
        }
        for (k, [i, j]) in pairs.enumerate() {
            let value = core::array::from_fn(|entry| (k as f64 + 1.3 * entry as f64).sin());
            matrix.add(i, j, &value);
        }
        matrix
    }

    #[test]
    fn the_factor_undoes_the_multiplication() {
        let matrix = band(10.0);
        let mut cholesky = Cholesky::new(matrix.sparsity(), Kernel::Vector).unwrap();
        assert_eq!(cholesky.factorise(&matrix), Ok(()));
        let expected: Vec<f64> = (0..36).map(|k| (k as f64).cos()).collect();
        let mut x = vec![0.0; 36];
        matrix.write_product(&expected, &mut x);
        cholesky.solve(&mut x);
        for (x, expected) in x.iter().zip(&expected) {
            assert!((x - expected).abs() < 1e-14, "{x} against {expected}");
        }
    }

    #[test]
    fn an_indefinite_matrix_is_reported() {
        let matrix = band(0.5);
        let mut cholesky = Cholesky::new(matrix.sparsity(), Kernel::Vector).unwrap();
        assert_eq!(cholesky.factorise(&matrix), Err(NotDefinite));
    }
}
