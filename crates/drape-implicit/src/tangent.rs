//! The tangent of a step, factorised or preconditioned, and linear systems with it.

use pulp::{Arch, Simd, WithSimd};

use crate::cholesky::Cholesky;
use crate::conjugate_gradient::{ConjugateGradient, Ending};
use crate::incomplete::{Incomplete, NotDefinite};
use crate::packed::Packed;
use crate::vector::{add_scaled, norm};
use crate::waves::Waves;
use crate::{BlockMatrix, Error, LinearSolver, Report, Settings, Sparsity};

/// Relative residual above which a factorised solve is not trusted: far above rounding for any matrix that can
/// be factorised at all, far below what the nonlinear iteration would notice.
const CHOLESKY_ACCURACY: f64 = 1e-6;

/// A matrix and the two ways to solve with it.
#[derive(Debug)]
pub(crate) struct Tangent {
    pub matrix: BlockMatrix,
    cholesky: Option<Cholesky>,
    iterative: Option<Iterative>,
    direct: bool,
    check: Vec<f64>,
    limit: usize,
}

impl Tangent {
    pub(crate) fn new(sparsity: Sparsity, settings: &Settings) -> Result<Self, Error> {
        let length = 3 * sparsity.particles();
        let direct = settings.linear_solver == LinearSolver::Cholesky && length > 0;
        Ok(Self {
            cholesky: if direct { Some(Cholesky::new(&sparsity)?) } else { None },
            iterative: None,
            direct,
            check: vec![0.0; length],
            limit: settings.max_linear_iterations,
            matrix: BlockMatrix::zeros(sparsity),
        })
    }

    /// The next matrix need not be like the one before.
    pub(crate) fn forget(&mut self) {
        if let Some(iterative) = &mut self.iterative {
            iterative.incomplete.forget();
        }
    }

    /// Makes the matrix ready for [`solve`](Self::solve).
    pub(crate) fn prepare(&mut self, report: &mut Report) -> Result<(), NotDefinite> {
        // The factor has no room for couplings beyond the sparsity.
        self.direct = self.cholesky.is_some() && self.matrix.couplings().is_empty();
        match &mut self.cholesky {
            Some(cholesky) if self.direct => cholesky.factorise(&self.matrix),
            _ => self.precondition(report),
        }
    }

    fn precondition(&mut self, report: &mut Report) -> Result<(), NotDefinite> {
        let matrix = &self.matrix;
        let iterative = self.iterative.get_or_insert_with(|| Iterative::new(matrix.sparsity()));
        report.pivot_shifts += iterative.arch.dispatch(Prepare(iterative, matrix))?;
        Ok(())
    }

    /// `x = A⁻¹ b` to a residual of at most `target` (conjugate gradients) or to rounding (Cholesky). Returns whether the
    /// target was met.
    pub(crate) fn solve(
        &mut self,
        b: &[f64],
        x: &mut [f64],
        target: f64,
        report: &mut Report,
    ) -> Result<bool, NotDefinite> {
        report.linear_solves += 1;
        x.copy_from_slice(b);
        if self.direct {
            if self.solve_directly(b, x) {
                return Ok(true);
            }
            self.precondition(report)?;
            self.direct = false;
            x.copy_from_slice(b);
        }
        let iterative = self.iterative.as_mut().ok_or(NotDefinite)?;
        let (iterations, ending) = iterative.arch.dispatch(Solve(iterative, x, target, self.limit));
        report.linear_iterations += iterations;
        match ending {
            Ending::Converged => Ok(true),
            Ending::Truncated => {
                report.linear_truncations += 1;
                Ok(false)
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

/// What conjugate gradients need.
#[derive(Debug)]
struct Iterative {
    waves: Waves,
    packed: Packed,
    incomplete: Incomplete,
    gradient: ConjugateGradient,
    arch: Arch,
}

impl Iterative {
    fn new(sparsity: &Sparsity) -> Self {
        let waves = Waves::new(sparsity);
        Self {
            packed: Packed::new(&waves),
            incomplete: Incomplete::new(&waves),
            gradient: ConjugateGradient::new(&waves),
            waves,
            arch: Arch::new(),
        }
    }
}

// What is dispatched to the machine's vector instructions: everything below is inlined into it.

struct Prepare<'a>(&'a mut Iterative, &'a BlockMatrix);

impl WithSimd for Prepare<'_> {
    type Output = Result<usize, NotDefinite>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let Self(Iterative { waves, packed, incomplete, .. }, matrix) = self;
        incomplete.factorise(waves, matrix, packed)
    }
}

struct Solve<'a>(&'a mut Iterative, &'a mut [f64], f64, usize);

impl WithSimd for Solve<'_> {
    type Output = (usize, Ending);

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let Self(Iterative { waves, packed, incomplete, gradient, .. }, x, target, limit) = self;
        gradient.solve((waves, packed, incomplete), x, target, limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_vector_instructions_change_no_bit() {
        let pairs = (0..400).flat_map(|i| [[i, i + 1], [i, i + 20], [i, i + 21]]);
        let pairs: Vec<_> = pairs.filter(|&[_, j]| j < 400).collect();
        let mut matrix = BlockMatrix::zeros(Sparsity::from_pairs(400, pairs.clone()).unwrap());
        for i in 0..400 {
            matrix.add(i, i, &[8.0, 0.1, 0.2, 0.1, 9.0, 0.3, 0.2, 0.3, 7.0]);
        }
        for [i, j] in pairs {
            matrix.add(i, j, &[-0.8, 0.1, 0.0, 0.2, -0.7, 0.0, 0.1, 0.0, -0.9]);
        }
        let run = |arch: Arch| {
            let mut iterative = Iterative { arch, ..Iterative::new(matrix.sparsity()) };
            arch.dispatch(Prepare(&mut iterative, &matrix)).unwrap();
            let mut x: Vec<f64> = (0..1200).map(|k| (k as f64).sin()).collect();
            let (iterations, ending) = arch.dispatch(Solve(&mut iterative, &mut x, 1e-9, 100));
            assert_eq!(ending, Ending::Converged);
            (iterations, x)
        };
        let (wide, narrow) = (run(Arch::new()), run(Arch::Scalar));
        assert!(wide == narrow, "on a machine with {:?}", Arch::new());
    }
}
