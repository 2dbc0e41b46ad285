//! Attempt at one sub-step: prediction, solution, velocities and energy balance.

use super::error_estimate::Extrapolation;
use super::formula::Formula;
use super::path_work::{Path, PathWork, Work, is_sampled};
use super::state::{IntegratorState, Span};
use crate::check::check_length;
use crate::error::Quantity;
use crate::linear::block::triples;
use crate::linear::vector::dot;
use crate::nonlinear::equations::StepEquations;
use crate::nonlinear::halt::Halt;
use crate::nonlinear::solver::NonlinearSolver;
use crate::report::{Report, StepEnergy, Stop};
use crate::settings::Settings;
use crate::step_filter::SystemRef;

/// Solver and work space of a sub-step.
#[derive(Debug)]
pub(crate) struct SubStepper {
    pub settings: Settings,
    pub solver: NonlinearSolver,
    pub masses: Vec<f64>,
    held: Vec<bool>,
    /// Inertia `m/(β dt)²` of each particle, in N/m.
    inertia: Vec<f64>,
    /// Terms of the formula from the present and previous positions, in m.
    past_positions: Vec<f64>,
    /// Terms of the formula from the present and previous velocities, in m/s.
    past_velocities: Vec<f64>,
    /// Positions at a deviation of zero, in m: free flight, or the prescribed positions.
    base: Vec<f64>,
    /// Velocities at the end of the sub-step, in m/s.
    velocities: Vec<f64>,
    /// Extrapolated positions, in m. Empty unless the error of the sub-step bounds the solver's
    /// error.
    predicted: Vec<f64>,
    path_work: PathWork,
}

/// Energies at the start of a sub-step, for the energy balance.
#[derive(Clone, Copy)]
struct Opening {
    formula: Formula,
    /// Whether the numerical dissipation is computed independently.
    is_sampled: bool,
    /// Kinetic energy, in J.
    kinetic: f64,
    /// Potential, in J.
    potential: f64,
}

impl SubStepper {
    /// Allocates work space for a number of `particles`.
    pub(crate) fn new(particles: usize, solver: NonlinearSolver, settings: Settings) -> Self {
        let zeros = vec![0.0; 3 * particles];
        let estimated = if settings.error_fraction > 0.0 { 3 * particles } else { 0 };
        let balanced = if settings.energy_balance { 3 * particles } else { 0 };
        Self {
            settings,
            solver,
            masses: vec![0.0; particles],
            held: vec![false; particles],
            inertia: vec![0.0; particles],
            past_positions: zeros.clone(),
            past_velocities: zeros.clone(),
            base: zeros.clone(),
            velocities: zeros,
            predicted: vec![0.0; estimated],
            path_work: PathWork::new(balanced),
        }
    }

    /// Attempts the sub-step `span`. On success `state` and the system's memory are at the end of
    /// the sub-step. Otherwise both are unchanged.
    pub(crate) fn attempt(
        &mut self,
        system: &mut SystemRef<'_>,
        state: &mut IntegratorState,
        span: Span,
        report: &mut Report,
    ) -> Result<(), Halt> {
        let formula = Formula::new(self.settings.integrator, state, span.dt);
        self.combine_past(state, formula);

        // The system prescribes the end positions of held particles.
        self.base.copy_from_slice(&state.positions);
        system.system().begin(span.end, span.dt, &state.positions, &mut self.base);
        let held = system.system().held();
        check_length("held", self.held.len(), held.len()).map_err(Halt::Fatal)?;
        self.held.copy_from_slice(held);
        self.predict(state, formula, span.dt, system.is_filtered())?;

        let unit = self.residual_unit();
        let opening = self.settings.energy_balance.then(|| {
            report.potential_evaluations += 1;
            // `begin` moved the obstacles to the end of the sub-step, the particles are at its
            // start.
            system.set_obstacle_time(0.0);
            Opening {
                formula,
                is_sampled: is_sampled(span.start, self.settings.energy_sampling),
                kinetic: self.kinetic(&state.velocities),
                potential: system.system().potential(&state.positions),
            }
        });

        let extrapolation = Extrapolation::new(formula, state, span.dt);
        extrapolation.write(state, &mut self.predicted);
        let mut equations = StepEquations {
            system: &mut *system,
            inertia: &self.inertia,
            held: &self.held,
            base: &self.base,
            start: &state.positions,
            limit: unit * self.settings.tolerance,
            unit,
            predicted: &self.predicted,
            error_fraction: self.settings.error_fraction * extrapolation.fraction,
            report: &mut *report,
        };
        self.solver.solve(&mut equations, &self.settings)?;
        if !system.is_intersection_free(&self.solver.search.current.positions) {
            return Err(Halt::Stop(Stop::Intersection));
        }

        self.set_velocities(formula);
        if let Some(opening) = opening {
            let energy = self.balance(system, state, opening, report);
            *report.energy.get_or_insert_default() += energy;
        }
        let end = &mut self.solver.search.current;
        report.residual = report.residual.max(relative(end.norm, unit));
        system.system().accept(&end.positions, &self.velocities, span.dt);
        state.advance(span, &mut end.positions, &mut self.velocities);
        Ok(())
    }

    /// Returns the unit of relative residuals, `acceleration · √Σm²` over the free particles, in N.
    pub(crate) fn residual_unit(&self) -> f64 {
        let mut squares = 0.0;
        for (mass, &held) in self.masses.iter().zip(&self.held) {
            if !held {
                squares += mass * mass;
            }
        }
        self.settings.acceleration * squares.sqrt()
    }

    /// Returns the residual of the last attempt, in the relative unit of [`Settings::tolerance`].
    pub(crate) fn relative_residual(&self) -> f64 {
        relative(self.solver.search.current.norm, self.residual_unit())
    }

    /// Combines present and previous values of `state` with the coefficients of `formula`.
    fn combine_past(&mut self, state: &IntegratorState, formula: Formula) {
        let previous = state.previous.as_ref();
        let positions = previous.map(|previous| &previous.positions[..]);
        let velocities = previous.map(|previous| &previous.velocities[..]);
        combine(formula, &mut self.past_positions, &state.positions, positions);
        combine(formula, &mut self.past_velocities, &state.velocities, velocities);
    }

    /// Sets the inertia, the base of deviations, the predicted end of a sub-step of length `dt`, in
    /// s (the current iterate), and the start of the sub-step (the trial iterate). `filtered` says
    /// whether a step filter limits the motion of held particles.
    fn predict(
        &mut self,
        state: &IntegratorState,
        formula: Formula,
        dt: f64,
        filtered: bool,
    ) -> Result<(), Halt> {
        let Self { solver, base, past_positions, past_velocities, held, inertia, masses, .. } =
            self;
        let beta_dt = formula.beta_dt;

        for (particle, &held) in held.iter().enumerate() {
            inertia[particle] = masses[particle] / (beta_dt * beta_dt);
            for k in 3 * particle..3 * particle + 3 {
                let (mut prediction, mut start) = (0.0, 0.0);
                if held {
                    if !base[k].is_finite() {
                        return Err(Halt::NotFinite { quantity: Quantity::Target, particle });
                    }
                    if filtered {
                        start = state.positions[k] - base[k];
                    }
                } else {
                    base[k] = past_positions[k] + beta_dt * past_velocities[k];
                    start = state.positions[k] - base[k];
                    prediction = start + dt * state.velocities[k];
                }
                solver.search.current.deviation[k] = prediction;
                solver.search.trial.deviation[k] = start;
            }
        }
        Ok(())
    }

    /// Computes the velocities of all particles at the end by `formula`.
    fn set_velocities(&mut self, formula: Formula) {
        let end = &self.solver.search.current;
        for (particle, &held) in self.held.iter().enumerate() {
            for k in 3 * particle..3 * particle + 3 {
                self.velocities[k] = if held {
                    (end.positions[k] - self.past_positions[k]) / formula.beta_dt
                } else {
                    self.past_velocities[k] + end.deviation[k] / formula.beta_dt
                };
            }
        }
    }

    /// Returns the kinetic energy of `velocities`, in J.
    fn kinetic(&self, velocities: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (mass, v) in self.masses.iter().zip(triples(velocities)) {
            sum += 0.5 * mass * dot(v, v);
        }
        sum
    }

    /// Returns whether a held particle has moved in the sub-step from `state`.
    fn held_particles_moved(&self, state: &IntegratorState) -> bool {
        let end = &self.solver.search.current.positions;
        (0..state.positions.len()).any(|k| self.held[k / 3] && end[k] != state.positions[k])
    }

    /// Returns the energy balance of the sub-step from `state`. In a sampled sub-step every entry
    /// is computed independently.
    ///
    /// With the acceleration `$a$` of the formula, the residual `$\phi = M a - f(x_1)$` of the
    /// solver, `$\Delta x = x_1 - x_0$` and the work `$W$` of the forces along the path, the
    /// numerical dissipation is
    ///
    /// ```math
    /// \bigl(a^T M \Delta x - \Delta K\bigr) + \bigl(W - f(x_1)^T \Delta x\bigr) - \phi^T \Delta x
    /// ```
    ///
    /// The first term follows from positions and velocities alone. For backward Euler it equals
    /// `$\tfrac12 |\Delta v|_M^2$`. For BDF2 with even steps, the mean velocity `$\bar v$` of the
    /// ends and `$\bar u = \Delta x/\mathrm{dt}$`, it equals
    /// `$\tfrac12\, \delta^2 v^T M \bar u + \Delta v^T M (\bar u - \bar v)$`. The second term is
    /// the work along the path less the work of the forces at the end.
    fn balance(
        &mut self,
        system: &mut SystemRef<'_>,
        state: &IntegratorState,
        opening: Opening,
        report: &mut Report,
    ) -> StepEnergy {
        let kinetic = self.kinetic(&self.velocities) - opening.kinetic;
        let ends = self.end_work(system, state, opening.formula, report);
        report.potential_evaluations += 1;
        let end = &self.solver.search.current.positions;
        let potential = system.system().potential(end);
        let decrease = opening.potential - potential;
        let formula_loss = ends.inertia - kinetic;

        let exchanged = kinetic.abs() + decrease.abs() + formula_loss.abs() + ends.held.abs();
        let path = Path {
            start: &state.positions,
            end,
            potentials: [opening.potential, potential],
            end_work: ends.forces,
            exchanged,
        };
        let work = if opening.is_sampled {
            self.path_work.measure(system, &path, report)
        } else {
            // The work of the forces with which the balance closes.
            let obstacles = system.obstacle_work(end);
            let forces =
                ends.forces + ends.residual + ends.held + obstacles - ends.inertia + decrease;
            Work { forces, obstacles, unproved: 0.0 }
        };

        let is_proved = opening.is_sampled && work.unproved == 0.0;
        let proved = if is_proved { path.resolved_energy() } else { 0.0 };
        StepEnergy {
            kinetic,
            potential: -decrease,
            work: ends.held + work.obstacles,
            numerical_dissipation: formula_loss + work.forces - ends.forces - ends.residual,
            unproved: work.unproved,
            exchanged,
            proved,
        }
    }

    /// Returns the work of inertia, forces and residual, all taken at the end, over the
    /// displacements of the sub-step from `state`.
    fn end_work(
        &mut self,
        system: &mut SystemRef<'_>,
        state: &IntegratorState,
        formula: Formula,
        report: &mut Report,
    ) -> EndWork {
        let held_particles_moved = self.held_particles_moved(state);
        let search = &mut self.solver.search;
        if held_particles_moved {
            // The solver no longer needs the image: it holds the forces on the held particles.
            report.force_evaluations += 1;
            system.system().forces(&search.current.positions, &mut search.image);
        }

        let mut work = EndWork::default();
        for (k, start) in state.positions.iter().enumerate() {
            let particle = k / 3;
            let displacement = search.current.positions[k] - start;
            let acceleration = (self.velocities[k] - self.past_velocities[k]) / formula.beta_dt;
            let inertia = self.masses[particle] * acceleration * displacement;
            work.inertia += inertia;
            if !self.held[particle] {
                let [residual, deviation] =
                    [search.current.residual[k], search.current.deviation[k]];
                work.residual += residual * displacement;
                work.forces += (self.inertia[particle] * deviation - residual) * displacement;
            } else if displacement != 0.0 {
                let force_work = search.image[k] * displacement;
                work.forces += force_work;
                work.held += inertia - force_work;
            }
        }
        work
    }
}

/// Work over the displacements of a sub-step, with all forces taken at the end, in J.
#[derive(Debug, Clone, Copy, Default)]
struct EndWork {
    /// Work of mass times the acceleration of the formula.
    inertia: f64,
    /// Work of the forces.
    forces: f64,
    /// Work of the solver's residual.
    residual: f64,
    /// Work of the forces that move the held particles.
    held: f64,
}

/// Writes the sum of `present` and `previous` values with the coefficients of `formula` into `sum`.
/// A first-order formula copies the present values.
fn combine(formula: Formula, sum: &mut [f64], present: &[f64], previous: Option<&[f64]>) {
    sum.copy_from_slice(present);
    if let Some(previous) = previous
        && formula.previous != 0.0
    {
        for (sum, previous) in sum.iter_mut().zip(previous) {
            *sum = formula.current * *sum + formula.previous * previous;
        }
    }
}

/// Returns the residual `norm` over its `unit`. Without a free particle both are 0, and so is the
/// result.
fn relative(norm: f64, unit: f64) -> f64 {
    if unit > 0.0 { norm / unit } else { 0.0 }
}
