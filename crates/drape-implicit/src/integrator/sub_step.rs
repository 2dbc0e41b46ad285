//! Attempt at one sub-step: prediction, solution, velocities and energy balance.

use super::error_estimate::Extrapolation;
use super::formula::Formula;
use super::path_work::{Path, PathWork, Work, is_sampled};
use super::state::{IntegratorState, Span, check_length};
use crate::error::Quantity;
use crate::linear::block::triples;
use crate::linear::vector::dot;
use crate::nonlinear::equations::StepEquations;
use crate::nonlinear::halt::Halt;
use crate::nonlinear::solver::NonlinearSolver;
use crate::report::{Energy, Report, Stop};
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
    /// Part of the formula that past positions give, in m.
    past_positions: Vec<f64>,
    /// Part of the formula that past velocities give, in m/s.
    past_velocities: Vec<f64>,
    /// Positions that deviations are counted from, in m.
    base: Vec<f64>,
    /// Velocities at the end of the sub-step, in m/s.
    velocities: Vec<f64>,
    /// Extrapolated positions, in m; empty unless the error of the sub-step bounds that of the solver.
    predicted: Vec<f64>,
    path_work: PathWork,
}

/// Start of a sub-step for its energy balance.
#[derive(Clone, Copy)]
struct Opening {
    formula: Formula,
    /// Whether the loss is found by itself.
    is_sampled: bool,
    /// Kinetic energy, in J.
    kinetic: f64,
    /// Potential, in J.
    potential: f64,
}

impl SubStepper {
    pub(crate) fn new(particles: usize, solver: NonlinearSolver, settings: Settings) -> Self {
        let zeros = || vec![0.0; 3 * particles];
        let estimated = if settings.error_fraction > 0.0 { 3 * particles } else { 0 };
        let balanced = if settings.energy_balance { 3 * particles } else { 0 };
        Self {
            settings,
            solver,
            masses: vec![0.0; particles],
            held: vec![false; particles],
            inertia: vec![0.0; particles],
            past_positions: zeros(),
            past_velocities: zeros(),
            base: zeros(),
            velocities: zeros(),
            predicted: vec![0.0; estimated],
            path_work: PathWork::new(balanced),
        }
    }

    /// Tries one sub-step. On success the state and the system's memory are at its end, otherwise
    /// they are unchanged.
    pub(crate) fn attempt(
        &mut self,
        system: &mut SystemRef<'_>,
        state: &mut IntegratorState,
        span: Span,
        report: &mut Report,
    ) -> Result<(), Halt> {
        let formula = Formula::new(self.settings.integrator, state, span.dt);
        self.combine_past(state, formula);
        self.base.copy_from_slice(&state.positions);
        system.system().begin(span.end, span.dt, &state.positions, &mut self.base);
        let held = system.system().held();
        check_length("held", self.held.len(), held.len()).map_err(Halt::Fatal)?;
        self.held.copy_from_slice(held);
        self.predict(state, formula, span.dt, system.is_filtered())?;
        let unit = self.residual_unit();
        let start = self.settings.energy_balance.then(|| {
            report.potential_evaluations += 1;
            // Obstacles are at the end of the sub-step, the particles at its start.
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
        if let Some(start) = start {
            let energy = self.balance(system, state, start, report);
            *report.energy.get_or_insert_default() += energy;
        }
        let end = &mut self.solver.search.current;
        report.residual = report.residual.max(relative(end.norm, unit));
        system.system().accept(&end.positions, &self.velocities, span.dt);
        state.advance(span, &mut end.positions, &mut self.velocities);
        Ok(())
    }

    /// Norm that residuals are relative to, in N, by the masses of the free particles.
    pub(crate) fn residual_unit(&self) -> f64 {
        let mut squares = 0.0;
        for (mass, &held) in self.masses.iter().zip(&self.held) {
            if !held {
                squares += mass * mass;
            }
        }
        self.settings.acceleration * squares.sqrt()
    }

    /// Residual of the last attempt, relative as the tolerance is.
    pub(crate) fn relative_residual(&self) -> f64 {
        relative(self.solver.search.current.norm, self.residual_unit())
    }

    /// Combines present and previous state as the formula does.
    fn combine_past(&mut self, state: &IntegratorState, formula: Formula) {
        let combine = |out: &mut [f64], now: &[f64], before: Option<&[f64]>| {
            out.copy_from_slice(now);
            if let (Some(before), true) = (before, formula.previous != 0.0) {
                for (out, before) in out.iter_mut().zip(before) {
                    *out = formula.current * *out + formula.previous * before;
                }
            }
        };
        let previous = state.previous.as_ref();
        let positions = previous.map(|p| &p.positions[..]);
        let velocities = previous.map(|p| &p.velocities[..]);
        combine(&mut self.past_positions, &state.positions, positions);
        combine(&mut self.past_velocities, &state.velocities, velocities);
    }

    /// Sets the inertia, the base of deviations, the first guess (the current iterate) and the
    /// fallback (the trial iterate), which is the start of the sub-step.
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
                let (mut guess, mut fallback) = (0.0, 0.0);
                if held {
                    if !base[k].is_finite() {
                        return Err(Halt::NotFinite { quantity: Quantity::Target, particle });
                    }
                    if filtered {
                        fallback = state.positions[k] - base[k];
                    }
                } else {
                    base[k] = past_positions[k] + beta_dt * past_velocities[k];
                    fallback = state.positions[k] - base[k];
                    guess = fallback + dt * state.velocities[k];
                }
                solver.search.current.deviation[k] = guess;
                solver.search.trial.deviation[k] = fallback;
            }
        }
        Ok(())
    }

    /// Computes the velocities at the end, those of held particles included.
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

    fn kinetic(&self, velocities: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (mass, v) in self.masses.iter().zip(triples(velocities)) {
            sum += 0.5 * mass * dot(v, v);
        }
        sum
    }

    /// Whether a held particle has moved in the sub-step.
    fn held_move(&self, state: &IntegratorState) -> bool {
        (0..state.positions.len()).any(|k| self.is_moved(state, k))
    }

    /// Whether a coordinate is that of a held particle and has changed in the sub-step.
    fn is_moved(&self, state: &IntegratorState, k: usize) -> bool {
        self.held[k / 3] && self.solver.search.current.positions[k] != state.positions[k]
    }

    /// Energy balance of the sub-step, whose entries are found each by itself where it is sampled.
    ///
    /// With the acceleration `$a$` of the formula, the residual `$\phi = M a - f(x_1)$` that the
    /// solver leaves, `$\Delta x = x_1 - x_0$` and the work `$W$` of the forces along the way, the
    /// formula loses
    ///
    /// ```math
    /// \bigl(a^T M \Delta x - \Delta K\bigr) + \bigl(W - f(x_1)^T \Delta x\bigr) - \phi^T \Delta x
    /// ```
    ///
    /// The first part follows from positions and velocities alone. For backward Euler it is
    /// `$\tfrac12 |\Delta v|_M^2$`; for BDF2 with even steps, with the mean velocity `$\bar v$` of
    /// the ends and `$\bar u = \Delta x/\mathrm{dt}$`, it is
    /// `$\tfrac12\, \delta^2 v^T M \bar u + \Delta v^T M (\bar u - \bar v)$`. The second is what
    /// forces that are taken at the end do less than along the way.
    fn balance(
        &mut self,
        system: &mut SystemRef<'_>,
        state: &IntegratorState,
        opening: Opening,
        report: &mut Report,
    ) -> Energy {
        let kinetic = self.kinetic(&self.velocities) - opening.kinetic;
        let ends = self.end_work(system, state, opening.formula, report);
        report.potential_evaluations += 1;
        let end = &self.solver.search.current.positions;
        let potential = system.system().potential(end);
        let fall = opening.potential - potential;
        let formula_loss = ends.inertia - kinetic;
        let exchanged = kinetic.abs() + fall.abs() + formula_loss.abs() + ends.held.abs();
        let path = Path {
            start: &state.positions,
            end,
            potentials: [opening.potential, potential],
            end_work: ends.forces,
            exchanged,
        };
        let work = match opening.is_sampled {
            true => self.path_work.measure(system, &path, report),
            false => {
                let obstacles = system.obstacle_work(end);
                let forces =
                    ends.forces + ends.residual + ends.held + obstacles - ends.inertia + fall;
                Work { forces, obstacles, unproved: 0.0 }
            }
        };
        Energy {
            kinetic,
            potential: -fall,
            work: ends.held + work.obstacles,
            numerical_dissipation: formula_loss + work.forces - ends.forces - ends.residual,
            unproved: work.unproved,
        }
    }

    /// Work of inertia, forces and residual at the end over the displacements of the sub-step.
    fn end_work(
        &mut self,
        system: &mut SystemRef<'_>,
        state: &IntegratorState,
        formula: Formula,
        report: &mut Report,
    ) -> EndWork {
        let held_move = self.held_move(state);
        let search = &mut self.solver.search;
        if held_move {
            // The image is not in use any more.
            report.force_evaluations += 1;
            system.system().forces(&search.current.positions, &mut search.image);
        }
        let mut work = EndWork::default();
        for (k, start) in state.positions.iter().enumerate() {
            let particle = k / 3;
            let moved = search.current.positions[k] - start;
            let acceleration = (self.velocities[k] - self.past_velocities[k]) / formula.beta_dt;
            let inertia = self.masses[particle] * acceleration * moved;
            work.inertia += inertia;
            if !self.held[particle] {
                let [residual, deviation] =
                    [search.current.residual[k], search.current.deviation[k]];
                work.residual += residual * moved;
                work.forces += (self.inertia[particle] * deviation - residual) * moved;
            } else if moved != 0.0 {
                let force = search.image[k] * moved;
                work.forces += force;
                work.held += inertia - force;
            }
        }
        work
    }
}

/// Work at the end of a sub-step, over its displacements, in J.
#[derive(Debug, Clone, Copy, Default)]
struct EndWork {
    /// Work that the accelerations of the formula stand for.
    inertia: f64,
    /// Work of the forces.
    forces: f64,
    /// Work of the residual that the solver leaves.
    residual: f64,
    /// Work of the forces that move the held particles.
    held: f64,
}

/// Residual in units of the norm that tolerances refer to. With no free particle both are 0.
fn relative(norm: f64, unit: f64) -> f64 {
    if unit > 0.0 { norm / unit } else { 0.0 }
}
