//! Stand-in for the sparse Cholesky factorisation in a build without the feature `cholesky`.

use std::convert::Infallible;

use crate::error::Error;
use crate::linear::block_matrix::{BlockMatrix, NotDefinite};
use crate::linear::sparsity::Sparsity;

/// Factorisation that does not exist.
#[derive(Debug)]
pub(crate) struct Cholesky(Infallible);

/// Kernel of the factorisation.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kernel {
    /// Blocks of columns.
    Vector,
    /// Single numbers.
    Scalar,
}

impl Cholesky {
    /// Returns [`Error::WithoutCholesky`].
    pub(crate) fn new(_: &Sparsity, _: Kernel) -> Result<Self, Error> {
        Err(Error::WithoutCholesky)
    }

    /// Is never called, because no factorisation exists.
    pub(crate) fn factorise(&mut self, _: &BlockMatrix) -> Result<(), NotDefinite> {
        match self.0 {}
    }

    /// Is never called, because no factorisation exists.
    pub(crate) fn solve(&mut self, _: &mut [f64]) {
        match self.0 {}
    }
}
