//! Conjugate gradients with the incomplete factor as preconditioner.

use crate::BlockMatrix;
use crate::incomplete::Incomplete;
use crate::vector::{add_scaled, dot, norm};

/// How conjugate gradients ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// The residual is below the target.
    Converged,
    /// Out of iterations: the result is a descent direction all the same.
    Truncated,
    /// A direction along which the matrix is not positive was met.
    Indefinite,
}

/// Work space of the iteration.
#[derive(Debug)]
pub(crate) struct ConjugateGradient {
    residual: Vec<f64>,
    preconditioned: Vec<f64>,
    direction: Vec<f64>,
    product: Vec<f64>,
}

impl ConjugateGradient {
    pub(crate) fn new(length: usize) -> Self {
        let zeros = || vec![0.0; length];
        Self {
            residual: zeros(),
            preconditioned: zeros(),
            direction: zeros(),
            product: zeros(),
        }
    }

    /// Solves `A x = b` from `x = 0` until `‖b − A x‖₂ ≤ target`. `x` holds `b` on entry. Returns the
    /// iterations made and how they ended.
    pub(crate) fn solve(
        &mut self,
        (matrix, preconditioner): (&BlockMatrix, &Incomplete),
        x: &mut [f64],
        target: f64,
        limit: usize,
    ) -> (usize, Ending) {
        let Self { residual, preconditioned, direction, product } = self;
        residual.copy_from_slice(x);
        x.fill(0.0);
        preconditioner.solve(matrix.pattern(), residual, preconditioned);
        direction.copy_from_slice(preconditioned);
        let mut weight = dot(residual, preconditioned);
        for iteration in 0..limit {
            if norm(residual) <= target {
                return (iteration, Ending::Converged);
            }
            matrix.multiply(direction, product);
            let curvature = dot(direction, product);
            // Written so that a NaN takes this way too.
            if !(curvature > 0.0 && weight > 0.0) {
                return (iteration, Ending::Indefinite);
            }
            let step = weight / curvature;
            add_scaled(x, step, direction);
            add_scaled(residual, -step, product);
            preconditioner.solve(matrix.pattern(), residual, preconditioned);
            let next = dot(residual, preconditioned);
            let turn = next / weight;
            weight = next;
            for (d, z) in direction.iter_mut().zip(preconditioned.iter()) {
                *d = z + turn * *d;
            }
        }
        let ending = if norm(residual) <= target { Ending::Converged } else { Ending::Truncated };
        (limit, ending)
    }
}
