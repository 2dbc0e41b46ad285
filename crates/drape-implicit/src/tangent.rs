//! The tangent of a step, factorised or preconditioned, and linear systems with it.

use crate::cholesky::Cholesky;
use crate::conjugate_gradient::{ConjugateGradient, Ending};
use crate::incomplete::{Incomplete, NotDefinite};
use crate::vector::{add_scaled, norm};
use crate::{BlockMatrix, Error, LinearSolver, Pattern, Report, Settings};

/// Relative residual above which a factorised solve is not trusted: far above rounding for any matrix that can
/// be factorised at all, far below what the nonlinear iteration would notice.
const CHOLESKY_ACCURACY: f64 = 1e-6;

/// A matrix and the two ways to solve with it.
#[derive(Debug)]
pub(crate) struct Tangent {
    pub matrix: BlockMatrix,
    cholesky: Option<Cholesky>,
    incomplete: Option<Incomplete>,
    gradient: ConjugateGradient,
    direct: bool,
    check: Vec<f64>,
    limit: usize,
}

impl Tangent {
    pub(crate) fn new(pattern: Pattern, settings: &Settings) -> Result<Self, Error> {
        let length = 3 * pattern.particles();
        let direct = settings.linear_solver == LinearSolver::Cholesky && length > 0;
        Ok(Self {
            cholesky: if direct { Some(Cholesky::new(&pattern)?) } else { None },
            incomplete: None,
            gradient: ConjugateGradient::new(length),
            direct,
            check: vec![0.0; length],
            limit: settings.max_linear_iterations,
            matrix: BlockMatrix::zeros(pattern),
        })
    }

    /// Makes the matrix ready for [`solve`](Self::solve).
    pub(crate) fn prepare(&mut self, report: &mut Report) -> Result<(), NotDefinite> {
        self.direct = self.cholesky.is_some();
        match &mut self.cholesky {
            Some(cholesky) => cholesky.factorise(&self.matrix),
            None => self.precondition(report),
        }
    }

    fn precondition(&mut self, report: &mut Report) -> Result<(), NotDefinite> {
        let matrix = &self.matrix;
        let incomplete = self.incomplete.get_or_insert_with(|| Incomplete::new(matrix.pattern()));
        report.pivot_shifts += incomplete.factorise(matrix)?;
        Ok(())
    }

    /// `x = A⁻¹ b` to a residual of at most `target` (conjugate gradients) or to rounding (Cholesky).
    pub(crate) fn solve(
        &mut self,
        b: &[f64],
        x: &mut [f64],
        target: f64,
        report: &mut Report,
    ) -> Result<(), NotDefinite> {
        report.linear_solves += 1;
        x.copy_from_slice(b);
        if self.direct {
            if self.solve_directly(b, x) {
                return Ok(());
            }
            self.precondition(report)?;
            self.direct = false;
            x.copy_from_slice(b);
        }
        let incomplete = self.incomplete.as_mut().ok_or(NotDefinite)?;
        let (iterations, ending) =
            self.gradient.solve((&self.matrix, incomplete), x, target, self.limit);
        report.linear_iterations += iterations;
        match ending {
            Ending::Converged => Ok(()),
            Ending::Truncated => {
                report.linear_truncations += 1;
                Ok(())
            }
            Ending::Indefinite => Err(NotDefinite),
        }
    }

    /// Whether the factorisation gave a solution of the system it was made for.
    fn solve_directly(&mut self, b: &[f64], x: &mut [f64]) -> bool {
        let Some(cholesky) = &mut self.cholesky else {
            return false;
        };
        cholesky.solve(x);
        self.matrix.multiply(x, &mut self.check);
        add_scaled(&mut self.check, -1.0, b);
        norm(&self.check) <= CHOLESKY_ACCURACY * norm(b)
    }
}
