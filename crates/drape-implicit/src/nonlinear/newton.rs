//! Newton's method with a line search, and Broyden steps on its matrices.

use super::broyden::BroydenUpdates;
use super::equations::{Iterate, StepEquations};
use super::halt::Halt;
use super::line_search::energy_search;
use super::search::Search;
use super::start_point::advance_obstacles;
use crate::error::Quantity;
use crate::linear::conjugate_gradient::Target;
use crate::linear::system_matrix::SystemMatrix;
use crate::linear::vector::dot;
use crate::report::Stop;
use crate::settings::{Method, Settings};
use crate::system::Stiffness;

/// Contraction of the residual by a whole Newton step that shows that the matrix describes the
/// neighbourhood: only then is it kept for Broyden steps. Larger values keep matrices that waste
/// iterations, smaller ones discard useful ones; on a sheet of 2500 particles the cost was flat,
/// within a tenth, from 0.1 to 0.9.
const TRUSTED_CONTRACTION: f64 = 1.0 / 3.0;

/// A matrix is kept only if one more step with it, contracting as well as the last, would bring the
/// residual below this multiple of the limit. Farther away the quadratic convergence of Newton's
/// method is worth its matrices: on a swinging sheet of 2500 particles at 5 ms, 4 to 6 matrices per
/// step became 3 to 4 with half as many evaluations of the forces. From 3 to 10 the cost was flat.
const TRUST_MULTIPLE: f64 = 5.0;

/// Best contraction expected of a step on a kept matrix, however well the last one did.
const EXPECTED_CONTRACTION: f64 = 0.1;

/// A Broyden step that leaves more than this fraction of the residual is the last on its matrix.
/// The cost was as flat from 0.3 to 0.9.
const SLOW_CONTRACTION: f64 = 0.5;

/// Floor of the curvature along a step, as a fraction of that of the kept matrix, below which a
/// Broyden update is refused. It would stretch later directions, and the errors of their linear
/// solves, by the inverse of it.
const CURVATURE_FLOOR: f64 = 0.1;

/// Length of a step, after the line search along a direction of negative curvature, at or below
/// which definite matrices follow: the next exact one would hardly give a longer step.
const SHORT_STEP: f64 = 0.25;

/// Exponent of two of the most iterations in which the exact stiffness is skipped in a row. It is
/// one iteration where a step has to be balanced however little energy that gains. With doubling
/// numbers, instead of always one, two garments in layers were sewn with a fifth fewer matrices, a
/// T-shirt with an eighth fewer; but a swing took a tenth more iterations, and the last steps of a
/// flounce that came to rest left a saddle too slowly with definite matrices.
const MAX_SKIP_EXPONENT: u32 = 6;

/// Fraction of the convergence limit that a linear solve need not go below: the last one would
/// otherwise be solved a hundred times too well. The rest is left to the nonlinearity.
const LINEAR_FRACTION: f64 = 0.3;

/// Residual, as a multiple of the limit, that a step which has little energy left to gain may
/// leave. Without a bound, or with one of a thousand, some steps of a cloth on a cube ended with
/// contacts that were too tight for the next ones.
const MAX_UNBALANCE: f64 = 100.0;

/// Largest residual of a step that ends because its own error is larger than that of the solver, as a
/// fraction of the unit of residuals. With a tenth of it a swing took 378 matrices instead of 347.
const ROUGH_RESIDUAL: f64 = 1.0;

/// Same where a step filter keeps surfaces apart. From 1 to this the time of six scenes in contact
/// was flat within a twentieth.
const ROUGH_RESIDUAL_APART: f64 = 0.01;

/// Decrease of the energy that a Newton step predicted, as a multiple of the negligible energy, at or
/// below which its matrix is kept where the error of the step decides on the accuracy: an error
/// some thirty times as large as what may be left. A Broyden step then costs half as much as one on
/// another matrix, and is the last one of most steps. With a tenth of it, after a contraction by a
/// third at least, a swing took 347 matrices instead of 298.
const REFINED_DECREASE: f64 = 1e3;

/// Newton or Broyden step that was taken.
struct StepTaken {
    /// Whether its length was 1, with nothing limited.
    whole: bool,
    /// Decrease of the energy that it predicted, in J; infinite if it was not solved for.
    predicted_decrease: f64,
}

/// Newton direction, left in the search.
struct NewtonDirection {
    /// Slope of the energy along it, in J.
    slope: f64,
    /// Whether the linear system was solved to its target.
    solved: bool,
}

/// Newton's and Broyden's methods: the system matrix, its updates, and how well it has worked.
#[derive(Debug)]
pub(crate) struct Newton {
    matrix: SystemMatrix,
    updates: BroydenUpdates,
    /// Least norm of the residual since obstacles moved, in N.
    least_residual: f64,
    /// Iterations in which the exact stiffness is still skipped.
    skips_left: u32,
    /// Failures of the exact stiffness in a row.
    exact_failures: u32,
}

impl Newton {
    pub(crate) fn new(matrix: SystemMatrix, settings: &Settings) -> Self {
        let length = 3 * matrix.matrix.sparsity().particles();
        Self {
            matrix,
            updates: BroydenUpdates::with_capacity(iterations_per_matrix(settings) - 1, length),
            least_residual: f64::INFINITY,
            skips_left: 0,
            exact_failures: 0,
        }
    }

    /// Forgets the last sub-step.
    pub(crate) fn reset(&mut self) {
        self.skips_left = 0;
        self.exact_failures = 0;
        self.matrix.forget();
    }

    /// Alternates one safeguarded Newton step and, if the settings allow more iterations per
    /// matrix, Broyden steps on its matrix.
    pub(crate) fn solve(
        &mut self,
        search: &mut Search,
        equations: &mut StepEquations<'_, '_>,
        settings: &Settings,
    ) -> Result<(), Halt> {
        self.least_residual = search.current.norm;
        while search.current.obstacle_time < 1.0 || !search.current.solves(equations.limit) {
            search.count_iteration(equations, settings.max_iterations)?;
            if search.current.obstacle_time < 1.0 {
                advance_obstacles(search, equations)?;
                self.least_residual = search.current.norm;
                if search.current.solves(equations.limit) {
                    // Without a residual there is no direction.
                    continue;
                }
            }
            let before = search.current.norm;
            self.least_residual = self.least_residual.min(before);
            let StepTaken { whole, predicted_decrease } =
                self.newton_step(search, equations, settings)?;
            if settings.energy_tolerance > 0.0
                && may_end(&search.current, MAX_UNBALANCE * equations.limit)
            {
                let left = predicted_decrease / equations.kinetic(&search.current);
                if left <= settings.energy_tolerance {
                    equations.report.energy_left = equations.report.energy_left.max(left);
                    break;
                }
            }
            let decrease = relative_decrease(&search.current, equations, predicted_decrease);
            if decrease <= 1.0 {
                break;
            }
            self.updates.forget();
            let contraction = search.current.norm / before;
            let expected = search.current.norm * contraction.max(EXPECTED_CONTRACTION);
            let refined = contraction <= 1.0 && decrease <= REFINED_DECREASE;
            let converges =
                contraction <= TRUSTED_CONTRACTION && expected <= TRUST_MULTIPLE * equations.limit;
            let mut trusted =
                whole && search.current.obstacle_time == 1.0 && (refined || converges);
            let mut left = iterations_per_matrix(settings) - 1;
            while trusted && left > 0 && !search.current.solves(equations.limit) {
                search.count_iteration(equations, settings.max_iterations)?;
                let before = search.current.norm;
                let Some(step) = self.broyden_step(search, equations, settings) else { break };
                let predicted = step.predicted_decrease;
                if relative_decrease(&search.current, equations, predicted) <= 1.0 {
                    return Ok(());
                }
                trusted = step.whole && search.current.norm <= SLOW_CONTRACTION * before;
                left -= 1;
            }
        }
        Ok(())
    }

    /// Takes a step along the direction of the exact stiffness, or of the definite one if that
    /// fails.
    ///
    /// After a direction of negative curvature that left a short step at most, the exact stiffness
    /// is skipped: tried at every iteration, most of its assemblies were in vain.
    fn newton_step(
        &mut self,
        search: &mut Search,
        equations: &mut StepEquations<'_, '_>,
        settings: &Settings,
    ) -> Result<StepTaken, Halt> {
        let mut stop = Stop::Indefinite;
        let kinds: &[Stiffness] = match self.skips_left {
            0 => &[Stiffness::Exact, Stiffness::Definite],
            _ => &[Stiffness::Definite],
        };
        self.skips_left = self.skips_left.saturating_sub(1);
        for &kind in kinds {
            equations.assemble(&search.current, kind, &mut self.matrix)?;
            let direction = self.newton_direction(search, equations, settings);
            let Some(NewtonDirection { mut slope, solved }) = direction else {
                if let Some(particle) = self.first_not_finite() {
                    return Err(Halt::NotFinite { quantity: Quantity::Stiffness, particle });
                }
                if kind == Stiffness::Exact {
                    equations.report.negative_curvatures += 1;
                    self.skip_exact(settings);
                    self.matrix.forget();
                }
                continue;
            };
            let predicted_decrease = if solved { -0.5 * slope } else { f64::INFINITY };
            let whole = search.limit_direction(equations);
            if !whole {
                slope = dot(&search.direction, &search.current.residual);
            }
            stop = Stop::LineSearch;
            if let Some(length) = energy_search(search, equations, slope, self.least_residual) {
                match (kind, solved) {
                    (Stiffness::Exact, true) => self.exact_failures = 0,
                    (Stiffness::Exact, false) if length <= SHORT_STEP => self.skip_exact(settings),
                    _ => {}
                }
                return Ok(StepTaken { whole: whole && length == 1.0, predicted_decrease });
            }
        }
        Err(Halt::Stop(stop))
    }

    /// Skips the exact stiffness in the next iteration or, if it fails again and again in a step
    /// that may end with energy left to gain, in a number of iterations that doubles.
    fn skip_exact(&mut self, settings: &Settings) {
        let most = if settings.energy_tolerance > 0.0 { MAX_SKIP_EXPONENT } else { 0 };
        self.skips_left = 1 << self.exact_failures.saturating_sub(1).min(most);
        self.exact_failures += 1;
    }

    /// Solves for the Newton direction; `None` unless it is one of descent.
    fn newton_direction(
        &mut self,
        search: &mut Search,
        equations: &mut StepEquations<'_, '_>,
        settings: &Settings,
    ) -> Option<NewtonDirection> {
        self.matrix.factorise(equations.report).ok()?;
        let target = linear_target(&search.current, settings, settings.newton_forcing, equations);
        let Search { current, direction, .. } = search;
        let solved =
            self.matrix.solve(&current.residual, direction, target, equations.report).ok()?;
        for p in direction.iter_mut() {
            *p = -*p;
        }
        let slope = dot(direction, &current.residual);
        (slope < 0.0).then_some(NewtonDirection { slope, solved })
    }

    /// Takes one step with the updated inverse of the kept matrix if the residual falls; `None` if
    /// there is no direction.
    fn broyden_step(
        &mut self,
        search: &mut Search,
        equations: &mut StepEquations<'_, '_>,
        settings: &Settings,
    ) -> Option<StepTaken> {
        let target = linear_target(&search.current, settings, settings.broyden_forcing, equations);
        let Search { current, image, .. } = search;
        self.matrix.solve(&current.residual, image, target, equations.report).ok()?;
        if !self.updates.next_direction(search, 1.0, CURVATURE_FLOOR) {
            return None;
        }
        let predicted_decrease = -0.5 * dot(&search.direction, &search.current.residual);
        let whole = search.limit_direction(equations);
        search.try_step(equations, 1.0);
        let falls = search.trial.norm < search.current.norm;
        if falls {
            search.accept_trial();
        }
        Some(StepTaken { whole: whole && falls, predicted_decrease })
    }

    /// Particle of the first row of the matrix with an entry that is not finite.
    fn first_not_finite(&self) -> Option<usize> {
        let matrix = &self.matrix.matrix;
        let entry = matrix.values().iter().position(|x| !x.is_finite())?;
        let offsets = matrix.sparsity().offsets();
        Some(offsets.partition_point(|&offset| offset <= entry / 9) - 1)
    }
}

/// Iterations on one matrix, the first (Newton's) included.
fn iterations_per_matrix(settings: &Settings) -> usize {
    if settings.method == Method::Broyden { settings.iterations_per_matrix } else { 1 }
}

/// Whether a step may end at an iterate before it meets its tolerance: all motions are done, and the
/// residual is at most `residual_max`, in N.
fn may_end(iterate: &Iterate, residual_max: f64) -> bool {
    iterate.obstacle_time == 1.0 && iterate.solves(residual_max)
}

/// Decrease of the energy that the last iteration predicted, as a multiple of the negligible energy.
/// Infinite where the error of the time step does not decide on the accuracy, or the residual is too
/// large to end here.
fn relative_decrease(iterate: &Iterate, equations: &StepEquations<'_, '_>, predicted: f64) -> f64 {
    let apart = equations.system.is_filtered();
    let residual_max = if apart { ROUGH_RESIDUAL_APART } else { ROUGH_RESIDUAL };
    if equations.error_fraction > 0.0 && may_end(iterate, residual_max * equations.unit) {
        predicted / equations.negligible_energy(iterate)
    } else {
        f64::INFINITY
    }
}

/// Target of a linear solve: a residual relative to the nonlinear one, or the energy gained where a
/// fraction of it is set. Either ends at the residual that convergence needs.
fn linear_target(
    iterate: &Iterate,
    settings: &Settings,
    forcing: f64,
    equations: &StepEquations<'_, '_>,
) -> Target {
    let enough = LINEAR_FRACTION * equations.limit;
    let energy = settings.energy_forcing;
    let residual = if energy > 0.0 { enough } else { enough.max(forcing * iterate.norm) };
    Target { residual, energy }
}
