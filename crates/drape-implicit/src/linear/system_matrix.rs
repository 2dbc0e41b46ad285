//! System matrix of a step, with a factorisation or a preconditioner, and the solution of linear
//! systems.

use pulp::Arch;

use crate::error::Error;
use crate::linear::block_matrix::{BlockMatrix, NotDefinite};
use crate::linear::cholesky::{Cholesky, Kernel};
use crate::linear::coarse_level::CoarseLevel;
use crate::linear::conjugate_gradient::{
    ConjugateGradient, Ending, Outcome, Preconditioned, Target,
};
use crate::linear::level_schedule::LevelSchedule;
use crate::linear::level_schedule::partition::Partition;
use crate::linear::packed_matrix::PackedMatrix;
use crate::linear::preconditioner::Preconditioner;
use crate::linear::sparsity::Sparsity;
use crate::linear::vector::{add_scaled, norm};
use crate::report::Report;
use crate::settings::{LinearSolver, Settings};
use crate::system::MaterialPoint;

/// Relative residual above which the solution of the Cholesky factor is discarded. The value is far
/// above rounding for any matrix with a factor, and too small to affect the nonlinear iteration.
const CHOLESKY_ACCURACY: f64 = 1e-6;

/// Matrix `M/(β dt)² + K` with two linear solvers.
#[derive(Debug)]
pub(crate) struct SystemMatrix {
    pub matrix: BlockMatrix,
    cholesky: Option<Cholesky>,
    iterative: Option<IterativeSolver>,
    /// Material points of the particles if the matrix has parts and a coarse level, otherwise
    /// empty.
    material_points: Vec<MaterialPoint>,
    /// Whether the present matrix has a Cholesky factor.
    direct: bool,
    residual: Vec<f64>,
    max_iterations: usize,
}

impl SystemMatrix {
    /// Returns the matrix of zeros on `sparsity`. `material_points` are the points of all
    /// particles, or empty.
    ///
    /// Steps with an energy tolerance have a preconditioner without a coarse level and with one
    /// part. With a coarse level, cloth of 10 201 particles that comes to rest on a cube took half
    /// as many matrices again, 51 s instead of 33 s, and a T-shirt of 21 137 particles only a
    /// twentieth less time. Several parts suit only the stabilised factor, which belongs to the
    /// coarse level.
    pub(crate) fn new(
        sparsity: Sparsity,
        material_points: Vec<MaterialPoint>,
        settings: &Settings,
    ) -> Result<Self, Error> {
        let length = 3 * sparsity.particle_count();
        let is_worthwhile =
            settings.energy_tolerance == 0.0 && CoarseLevel::is_worthwhile(&material_points);
        let direct = settings.linear_solver == LinearSolver::Cholesky && length > 0;
        Ok(Self {
            cholesky: if direct { Some(Cholesky::new(&sparsity, Kernel::Vector)?) } else { None },
            iterative: None,
            material_points: if is_worthwhile { material_points } else { Vec::new() },
            direct,
            residual: vec![0.0; length],
            max_iterations: settings.max_linear_iterations,
            matrix: BlockMatrix::zeros(sparsity),
        })
    }

    /// Discards the preconditioner's record of earlier matrices, because the next matrix differs
    /// from them.
    pub(crate) fn forget(&mut self) {
        if let Some(iterative) = &mut self.iterative {
            iterative.preconditioner.forget();
        }
    }

    /// Factorises the matrix for [`solve`](Self::solve), or its preconditioner.
    pub(crate) fn factorise(&mut self, report: &mut Report) -> Result<(), NotDefinite> {
        // The Cholesky factor cannot represent blocks outside the sparsity.
        self.direct = self.cholesky.is_some() && self.matrix.couplings().is_empty();
        match &mut self.cholesky {
            Some(cholesky) if self.direct => cholesky.factorise(&self.matrix),
            _ => self.precondition(report),
        }
    }

    fn precondition(&mut self, report: &mut Report) -> Result<(), NotDefinite> {
        let Self { matrix, material_points, iterative, .. } = self;
        let iterative = iterative
            .get_or_insert_with(|| IterativeSolver::new(matrix.sparsity(), material_points));
        report.pivot_shifts += iterative.factorise(matrix)?;
        Ok(())
    }

    /// Solves `A x = b` to `target` (conjugate gradients) or to rounding (Cholesky). Returns
    /// whether the target was met.
    pub(crate) fn solve(
        &mut self,
        b: &[f64],
        x: &mut [f64],
        target: Target,
        report: &mut Report,
    ) -> Result<bool, NotDefinite> {
        report.linear_solves += 1;
        x.copy_from_slice(b);

        // Conjugate gradients replace an inaccurate factor.
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

    /// Solves for `x`, which holds the right side `b` on entry, by the Cholesky factor. Returns
    /// whether the residual is at most [`CHOLESKY_ACCURACY`].
    fn solve_directly(&mut self, b: &[f64], x: &mut [f64]) -> bool {
        let Some(cholesky) = &mut self.cholesky else {
            return false;
        };
        cholesky.solve(x);
        self.matrix.write_product(x, &mut self.residual);
        add_scaled(&mut self.residual, -1.0, b);
        norm(&self.residual) <= CHOLESKY_ACCURACY * norm(b)
    }
}

/// Preconditioned conjugate gradients with their matrix and work space.
#[derive(Debug)]
struct IterativeSolver {
    schedule: LevelSchedule,
    packed: PackedMatrix,
    preconditioner: Preconditioner,
    gradient: ConjugateGradient,
    arch: Arch,
}

impl IterativeSolver {
    /// Allocates a solver for `sparsity`. With `material_points` the matrix is divided into parts
    /// and has a coarse level.
    fn new(sparsity: &Sparsity, material_points: &[MaterialPoint]) -> Self {
        let partition = match material_points {
            [] => Partition::into_parts(sparsity, 1),
            _ => Partition::new(sparsity),
        };
        let schedule = LevelSchedule::new(sparsity, &partition);
        let row_of = &schedule.layout.order.row_of;
        let coarse = CoarseLevel::new(sparsity, row_of, material_points);
        Self {
            packed: PackedMatrix::new(&schedule.layout),
            preconditioner: Preconditioner::new(&schedule.layout, coarse),
            gradient: ConjugateGradient::new(&schedule.layout),
            schedule,
            arch: Arch::new(),
        }
    }

    /// Computes the preconditioner of `matrix`. Returns the number of failed attempts.
    fn factorise(&mut self, matrix: &BlockMatrix) -> Result<usize, NotDefinite> {
        let Self { schedule, packed, preconditioner, arch, .. } = self;
        packed.pack(*arch, &schedule.layout, matrix);
        preconditioner.factorise(*arch, schedule, matrix, packed)
    }

    /// Solves for `x`, which holds the right side on entry, to `target` or in at most `limit`
    /// iterations.
    fn solve(&mut self, x: &mut [f64], target: Target, limit: usize) -> Outcome {
        let Self { schedule, packed, preconditioner, gradient, arch } = self;
        let (arch, layout) = (*arch, &schedule.layout);
        let system = Preconditioned { arch, layout, matrix: packed, preconditioner };
        gradient.solve(system, x, target, limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::level_schedule::sample::{spring, springs, weave};

    /// A sheet of stiff cells, tied to its place a little; its lowest row is held.
    fn sheet(n: usize) -> (BlockMatrix, Vec<MaterialPoint>) {
        let mut matrix = springs(weave(n), |_, [i, j]| {
            let [x, y] = [(j % n) as f64 - (i % n) as f64, (j / n) as f64 - (i / n) as f64];
            spring([x, y, 0.1 * (i as f64).sin()])
        });
        let held: Vec<bool> = (0..n * n).map(|k| k < n).collect();
        matrix.add_inertia(&vec![1e-3; n * n], &held);
        let coordinates = |k: usize| [(k % n) as f64, (k / n) as f64];
        let point = |k| MaterialPoint { sheet: 0, coordinates: coordinates(k), spacing: 1.0 };
        (matrix, (0..n * n).map(point).collect())
    }

    /// Solves for a load that is smooth.
    fn solve(matrix: &BlockMatrix, points: &[MaterialPoint], arch: Arch) -> (usize, Vec<f64>) {
        let mut iterative =
            IterativeSolver { arch, ..IterativeSolver::new(matrix.sparsity(), points) };
        iterative.factorise(matrix).unwrap();
        let size = 3 * matrix.sparsity().particle_count();
        let held = |k: usize| matrix.is_held(k / 3);
        let mut x: Vec<f64> =
            (0..size).map(|k| if held(k) { 0.0 } else { 1.0 + (k as f64).sin() }).collect();
        let target = Target { residual: 1e-6 * norm(&x), energy: 0.0 };
        let Outcome { iterations, ending } = iterative.solve(&mut x, target, 2000);
        assert_eq!(ending, Ending::Converged);
        (iterations, x)
    }

    #[test]
    fn with_a_coarse_level_iterations_hardly_grow_with_the_sheet() {
        let iterations = |n: usize, with: bool| {
            let (matrix, points) = sheet(n);
            solve(&matrix, if with { &points } else { &[] }, Arch::new()).0
        };
        let [small, large] = [80, 160].map(|n| iterations(n, true));
        let large_without = iterations(160, false);
        assert!(2 * large < large_without, "{large} with, {large_without} without");
        assert!(large < small + small / 3, "{small} of 6 400, {large} of 25 600");
    }

    #[test]
    fn neither_threads_nor_vector_instructions_change_a_bit_of_a_large_solve() {
        let (matrix, points) = sheet(100);
        let on = |threads: usize, arch: Arch| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| solve(&matrix, &points, arch))
        };
        let one = on(1, Arch::new());
        for threads in [2, 3, 8] {
            assert!(on(threads, Arch::new()) == one, "{threads} threads");
        }
        assert!(on(2, Arch::Scalar) == one, "on a machine with {:?}", Arch::new());
    }

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
            let mut iterative =
                IterativeSolver { arch, ..IterativeSolver::new(matrix.sparsity(), &[]) };
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
