//! System matrix of a step, factorised or preconditioned, and linear systems with it.

use pulp::Arch;

use crate::error::Error;
use crate::linear::block_matrix::{BlockMatrix, NotDefinite};
use crate::linear::cholesky::Cholesky;
use crate::linear::conjugate_gradient::{
    ConjugateGradient, Ending, Outcome, Preconditioned, Target,
};
use crate::linear::incomplete_cholesky::IncompleteCholesky;
use crate::linear::level_schedule::LevelSchedule;
use crate::linear::packed_matrix::PackedMatrix;
use crate::linear::sparsity::Sparsity;
use crate::linear::vector::{add_scaled, norm};
use crate::report::Report;
use crate::settings::{LinearSolver, Settings};

/// Relative residual above which a factorised solve is not trusted: far above rounding for any
/// matrix that can be factorised at all, far below what the nonlinear iteration would notice.
const CHOLESKY_ACCURACY: f64 = 1e-6;

/// Matrix `M/(β dt)² + K`, and two solvers for it.
#[derive(Debug)]
pub(crate) struct SystemMatrix {
    pub matrix: BlockMatrix,
    cholesky: Option<Cholesky>,
    iterative: Option<Iterative>,
    /// Whether the present matrix is factorised by Cholesky.
    direct: bool,
    residual: Vec<f64>,
    max_iterations: usize,
}

impl SystemMatrix {
    pub(crate) fn new(sparsity: Sparsity, settings: &Settings) -> Result<Self, Error> {
        let length = 3 * sparsity.particles();
        let direct = settings.linear_solver == LinearSolver::Cholesky && length > 0;
        Ok(Self {
            cholesky: if direct { Some(Cholesky::new(&sparsity)?) } else { None },
            iterative: None,
            direct,
            residual: vec![0.0; length],
            max_iterations: settings.max_linear_iterations,
            matrix: BlockMatrix::zeros(sparsity),
        })
    }

    /// Forgets which shift the last preconditioner needed, for a matrix that is not like the last.
    pub(crate) fn forget(&mut self) {
        if let Some(iterative) = &mut self.iterative {
            iterative.factor.forget();
        }
    }

    /// Factorises the matrix for [`solve`](Self::solve), or its preconditioner.
    pub(crate) fn factorise(&mut self, report: &mut Report) -> Result<(), NotDefinite> {
        // The direct factor has no place for blocks outside the sparsity.
        self.direct = self.cholesky.is_some() && self.matrix.couplings().is_empty();
        match &mut self.cholesky {
            Some(cholesky) if self.direct => cholesky.factorise(&self.matrix),
            _ => self.precondition(report),
        }
    }

    fn precondition(&mut self, report: &mut Report) -> Result<(), NotDefinite> {
        let matrix = &self.matrix;
        let iterative = self.iterative.get_or_insert_with(|| Iterative::new(matrix.sparsity()));
        report.pivot_shifts += iterative.factorise(matrix)?;
        Ok(())
    }

    /// Solves `A x = b` to a target (conjugate gradients) or to rounding (Cholesky). Returns whether
    /// the target was met.
    pub(crate) fn solve(
        &mut self,
        b: &[f64],
        x: &mut [f64],
        target: Target,
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
        let limit = self.max_iterations;
        let Outcome { iterations, ending } = iterative.solve(x, target, limit);
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

    /// Solves by the Cholesky factor. Returns whether the residual is as small as it should be.
    fn solve_directly(&mut self, b: &[f64], x: &mut [f64]) -> bool {
        let Some(cholesky) = &mut self.cholesky else {
            return false;
        };
        cholesky.solve(x);
        self.matrix.multiply(x, &mut self.residual);
        add_scaled(&mut self.residual, -1.0, b);
        norm(&self.residual) <= CHOLESKY_ACCURACY * norm(b)
    }
}

/// Preconditioned conjugate gradients with all that they work on.
#[derive(Debug)]
struct Iterative {
    schedule: LevelSchedule,
    packed: PackedMatrix,
    factor: IncompleteCholesky,
    gradient: ConjugateGradient,
    arch: Arch,
}

impl Iterative {
    fn new(sparsity: &Sparsity) -> Self {
        let schedule = LevelSchedule::new(sparsity);
        Self {
            packed: PackedMatrix::new(&schedule.layout),
            factor: IncompleteCholesky::new(&schedule.layout),
            gradient: ConjugateGradient::new(&schedule.layout),
            schedule,
            arch: Arch::new(),
        }
    }

    /// Factorises a matrix; returns the number of attempts that failed.
    fn factorise(&mut self, matrix: &BlockMatrix) -> Result<usize, NotDefinite> {
        let Self { schedule, packed, factor, arch, .. } = self;
        factor.factorise(*arch, schedule, matrix, packed)
    }

    /// Solves for `x`, which holds the right side on entry.
    fn solve(&mut self, x: &mut [f64], target: Target, limit: usize) -> Outcome {
        let Self { schedule, packed, factor, gradient, arch } = self;
        let system =
            Preconditioned { arch: *arch, layout: &schedule.layout, matrix: packed, factor };
        gradient.solve(system, x, target, limit)
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
            iterative.factorise(&matrix).unwrap();
            let mut x: Vec<f64> = (0..1200).map(|k| (k as f64).sin()).collect();
            let target = Target { residual: 1e-9, energy: 0.0 };
            let Outcome { iterations, ending } = iterative.solve(&mut x, target, 100);
            assert_eq!(ending, Ending::Converged);
            (iterations, x)
        };
        let (wide, narrow) = (run(Arch::new()), run(Arch::Scalar));
        assert!(wide == narrow, "on a machine with {:?}", Arch::new());
    }
}
