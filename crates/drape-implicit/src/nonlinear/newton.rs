//! Newton's method with a line search, and Broyden steps on Newton's matrices.

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

/// Contraction, the ratio of new to old residual, of a whole Newton step at or below which the
/// matrix is kept for Broyden steps: the matrix then describes the neighbourhood well. Larger
/// values keep matrices that waste iterations, smaller values discard useful matrices. On a sheet
/// of 2500 particles the cost was flat within a tenth from 0.1 to 0.9.
const TRUSTED_CONTRACTION: f64 = 1.0 / 3.0;

/// A matrix is kept only if a further step with the last step's contraction would bring the
/// residual below this multiple of the limit. Farther from the solution the quadratic convergence
/// of Newton's method is worth new matrices: on a swinging sheet of 2500 particles at 5 ms, 4 to 6
/// matrices per step became 3 to 4 with half the evaluations of the forces. From 3 to 10 the cost
/// was flat.
const TRUST_MULTIPLE: f64 = 5.0;

/// Smallest ratio of new to old residual that is expected of a step on a kept matrix, however small
/// the ratio of the last step was.
const EXPECTED_CONTRACTION: f64 = 0.1;

/// A Broyden step after which more than this fraction of the residual remains is the last step on
/// its matrix. From 0.3 to 0.9 the cost was flat within a tenth.
const SLOW_CONTRACTION: f64 = 0.5;

/// Floor of the curvature along a step, as a fraction of the kept matrix's curvature. At or below
/// the floor a Broyden update is refused: the update would stretch later directions, and the errors
/// of their linear solves, by the inverse of the fraction.
const CURVATURE_FLOOR: f64 = 0.1;

/// If the line search along a truncated direction of the exact stiffness ends at or below this
/// length, definite matrices follow: the next exact matrix would hardly give a longer step.
const SHORT_STEP: f64 = 0.25;

/// Exponent `e` of the largest number `2^e` of iterations that skip the exact stiffness in a row,
/// in steps with an energy tolerance. Without an energy tolerance only one iteration skips it.
///
/// With doubling numbers, instead of always one, two garments in layers were sewn with a fifth
/// fewer matrices, and a T-shirt with an eighth fewer. But a swing took a tenth more iterations,
/// and the last steps of a flounce that came to rest left a saddle too slowly with definite
/// matrices.
const MAX_SKIP_EXPONENT: u32 = 6;

/// A linear solve ends at this fraction of the convergence limit at the latest. Otherwise the last
/// linear system of a step would be solved a hundred times more accurately than needed. The rest of
/// the limit allows for the nonlinearity.
const LINEAR_FRACTION: f64 = 0.3;

/// Largest residual, as a multiple of the limit, of a step that the energy tolerance ends. Without
/// a bound, or with a bound of a thousand, some steps of a cloth on a cube ended with contacts that
/// were too tight for the next steps.
const MAX_UNBALANCE: f64 = 100.0;

/// Largest residual, in units of relative residuals, of a step that ends because the error of its
/// formula exceeds the solver's error. With a tenth of this value a swing took 378 matrices instead
/// of 347.
const ROUGH_RESIDUAL: f64 = 1.0;

/// [`ROUGH_RESIDUAL`] for steps with a step filter. From 1 to this value the time of six scenes in
/// contact was flat within a twentieth.
const ROUGH_RESIDUAL_FILTERED: f64 = 0.01;

/// If the error of the step's formula decides on the accuracy, a matrix is kept when its Newton
/// step predicted a decrease of the energy of at most this multiple of the negligible energy. The
/// error is then about thirty times the admissible error. A Broyden step costs half as much as a
/// step on a new matrix, and is the last iteration of most steps. With a tenth of this value, and
/// after a contraction to at most a third, a swing took 347 matrices instead of 298.
const REFINED_DECREASE: f64 = 1e3;

/// Newton or Broyden step that was taken.
struct StepTaken {
    /// Whether the step had the length 1 and no filter shortened it.
    whole: bool,
    /// Predicted decrease of the energy, in J. Infinite if the linear solve missed its target.
    predicted_decrease: f64,
}

/// Result of the linear solve for a Newton direction. The direction itself is in [`Search`].
struct NewtonDirection {
    /// Slope of the energy along the direction, in J.
    slope: f64,
    /// Whether the linear system was solved to its target.
    solved: bool,
}

/// Newton's and Broyden's methods: the system matrix, its updates, and the record of failures.
#[derive(Debug)]
pub(crate) struct Newton {
    matrix: SystemMatrix,
    updates: BroydenUpdates,
    /// Least norm of the residual since obstacles moved, in N.
    least_residual: f64,
    /// Number of further iterations that skip the exact stiffness.
    remaining_skips: u32,
    /// Number of consecutive failures of the exact stiffness.
    exact_failures: u32,
}

impl Newton {
    /// Returns the solver with `matrix` as the system matrix.
    pub(crate) fn new(matrix: SystemMatrix, settings: &Settings) -> Self {
        let length = 3 * matrix.matrix.sparsity().particle_count();
        Self {
            matrix,
            updates: BroydenUpdates::with_capacity(iterations_per_matrix(settings) - 1, length),
            least_residual: f64::INFINITY,
            remaining_skips: 0,
            exact_failures: 0,
        }
    }

    /// Removes all records of the last sub-step, including the record of `matrix`.
    pub(crate) fn reset(&mut self) {
        self.remaining_skips = 0;
        self.exact_failures = 0;
        self.matrix.forget();
    }

    /// Solves `equations` from the current iterate of `search`. A safeguarded Newton step
    /// alternates with Broyden steps on its matrix, if `settings` allow several iterations per
    /// matrix.
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

            // The step may end because little energy remains, or because the solver's error is
            // small compared with the formula's.
            if settings.energy_tolerance > 0.0
                && may_end(&search.current, MAX_UNBALANCE * equations.limit)
            {
                let remaining = predicted_decrease / equations.kinetic(&search.current);
                if remaining <= settings.energy_tolerance {
                    equations.report.energy_left = equations.report.energy_left.max(remaining);
                    break;
                }
            }
            let decrease = relative_decrease(&search.current, equations, predicted_decrease);
            if decrease <= 1.0 {
                break;
            }

            // Broyden steps follow only if the Newton step shows that the matrix is worth keeping.
            self.updates.forget();
            let contraction = search.current.norm / before;
            let expected = search.current.norm * contraction.max(EXPECTED_CONTRACTION);
            let refined = contraction <= 1.0 && decrease <= REFINED_DECREASE;
            let converges =
                contraction <= TRUSTED_CONTRACTION && expected <= TRUST_MULTIPLE * equations.limit;
            let mut trusted =
                whole && search.current.obstacle_time == 1.0 && (refined || converges);
            let mut remaining = iterations_per_matrix(settings) - 1;
            while trusted && remaining > 0 && !search.current.solves(equations.limit) {
                search.count_iteration(equations, settings.max_iterations)?;
                let before = search.current.norm;
                let Some(step) = self.broyden_step(search, equations, settings) else { break };
                let predicted = step.predicted_decrease;
                if relative_decrease(&search.current, equations, predicted) <= 1.0 {
                    return Ok(());
                }
                trusted = step.whole && search.current.norm <= SLOW_CONTRACTION * before;
                remaining -= 1;
            }
        }
        Ok(())
    }

    /// Takes a step along the direction of the exact stiffness, or of the definite stiffness if the
    /// exact stiffness fails.
    ///
    /// After negative curvature that allowed no step or a short one, the next iterations skip the
    /// exact stiffness: without skipping, most of its assemblies were useless.
    fn newton_step(
        &mut self,
        search: &mut Search,
        equations: &mut StepEquations<'_, '_>,
        settings: &Settings,
    ) -> Result<StepTaken, Halt> {
        let mut stop = Stop::Indefinite;
        let kinds: &[Stiffness] = if self.remaining_skips == 0 {
            &[Stiffness::Exact, Stiffness::Definite]
        } else {
            &[Stiffness::Definite]
        };
        self.remaining_skips = self.remaining_skips.saturating_sub(1);

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

    /// Skips the exact stiffness in the next iteration. If `settings` have an energy tolerance, the
    /// number of skipped iterations doubles with each further failure.
    fn skip_exact(&mut self, settings: &Settings) {
        let max_exponent = if settings.energy_tolerance > 0.0 { MAX_SKIP_EXPONENT } else { 0 };
        self.remaining_skips = 1 << self.exact_failures.saturating_sub(1).min(max_exponent);
        self.exact_failures += 1;
    }

    /// Solves for the Newton direction at the current iterate of `search`. Returns `None` if the
    /// matrix is indefinite or the energy does not decrease along the direction.
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

    /// Takes one step of `search` with the updated inverse of the kept matrix if the residual
    /// decreases. Returns `None` if there is no direction.
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
        let decreases = search.trial.norm < search.current.norm;
        if decreases {
            search.accept_trial();
        }
        Some(StepTaken { whole: whole && decreases, predicted_decrease })
    }

    /// Returns the particle of the first row of `matrix` with an entry that is not finite.
    fn first_not_finite(&self) -> Option<usize> {
        let matrix = &self.matrix.matrix;
        let entry = matrix.values().iter().position(|x| !x.is_finite())?;
        let offsets = matrix.sparsity().offsets();
        Some(offsets.partition_point(|&offset| offset <= entry / 9) - 1)
    }
}

/// Returns the number of iterations on one matrix under `settings`, including the Newton step.
fn iterations_per_matrix(settings: &Settings) -> usize {
    if settings.method == Method::Broyden { settings.iterations_per_matrix } else { 1 }
}

/// Returns whether a step may end at `iterate` before the residual meets its tolerance: all
/// prescribed motions are complete, and the residual is at most `max_residual`, in N.
fn may_end(iterate: &Iterate, max_residual: f64) -> bool {
    iterate.obstacle_time == 1.0 && iterate.solves(max_residual)
}

/// Returns the `predicted` decrease of the energy, in J, as a multiple of the negligible energy at
/// `iterate`. Infinite if the error of the formula does not decide on the accuracy, or the residual
/// is too large for the end of a step.
fn relative_decrease(iterate: &Iterate, equations: &StepEquations<'_, '_>, predicted: f64) -> f64 {
    let is_filtered = equations.system.is_filtered();
    let max_residual = if is_filtered { ROUGH_RESIDUAL_FILTERED } else { ROUGH_RESIDUAL };
    if equations.error_fraction > 0.0 && may_end(iterate, max_residual * equations.unit) {
        predicted / equations.negligible_energy(iterate)
    } else {
        f64::INFINITY
    }
}

/// Returns the target of a linear solve at `iterate`: `forcing` times the nonlinear residual, or an
/// energy if `settings` have a forcing term of the energy. A residual far below the convergence
/// limit ends the solve in both cases.
fn linear_target(
    iterate: &Iterate,
    settings: &Settings,
    forcing: f64,
    equations: &StepEquations<'_, '_>,
) -> Target {
    let sufficient = LINEAR_FRACTION * equations.limit;
    let energy = settings.energy_forcing;
    let residual = if energy > 0.0 { sufficient } else { sufficient.max(forcing * iterate.norm) };
    Target { residual, energy }
}
