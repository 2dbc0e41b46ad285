//! Attempt at one sub-step: prediction, solution, velocities and energy balance.

use super::formula::Formula;
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
use crate::system::System;

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
}

/// Energies at the start of a sub-step, in J.
#[derive(Clone, Copy)]
struct StartEnergy {
    kinetic: f64,
    potential: f64,
}

impl SubStepper {
    pub(crate) fn new(particles: usize, solver: NonlinearSolver, settings: Settings) -> Self {
        let zeros = || vec![0.0; 3 * particles];
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
            StartEnergy {
                kinetic: self.kinetic(&state.velocities),
                potential: system.system().potential(&state.positions),
            }
        });

        let mut equations = StepEquations {
            system: &mut *system,
            inertia: &self.inertia,
            held: &self.held,
            base: &self.base,
            start: &state.positions,
            limit: unit * self.settings.tolerance,
            report: &mut *report,
        };
        self.solver.solve(&mut equations, &self.settings)?;
        if !system.is_intersection_free(&self.solver.search.current.positions) {
            return Err(Halt::Stop(Stop::Intersection));
        }

        self.set_velocities(formula);
        if let Some(start) = start {
            let mut work = 0.0;
            if self.held_move(state) {
                report.force_evaluations += 1;
                work = self.work_on_held(system.system(), state, formula);
            }
            let energy = self.balance(system.system(), start, work);
            report.potential_evaluations += 1;
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

    /// Work of the forces that move the held particles, those at the end of the sub-step, in J.
    fn work_on_held(
        &mut self,
        system: &mut dyn System,
        state: &IntegratorState,
        formula: Formula,
    ) -> f64 {
        // The image is not in use any more.
        let search = &mut self.solver.search;
        system.forces(&search.current.positions, &mut search.image);
        let mut work = 0.0;
        for k in (0..state.positions.len()).filter(|&k| self.is_moved(state, k)) {
            let search = &self.solver.search;
            let acceleration = (self.velocities[k] - self.past_velocities[k]) / formula.beta_dt;
            let pull = self.masses[k / 3] * acceleration - search.image[k];
            work += pull * (search.current.positions[k] - state.positions[k]);
        }
        work
    }

    /// Energy balance of the sub-step.
    fn balance(&self, system: &mut dyn System, start: StartEnergy, work: f64) -> Energy {
        let end = &self.solver.search.current;
        let kinetic = self.kinetic(&self.velocities) - start.kinetic;
        let potential = system.potential(&end.positions) - start.potential;
        Energy { kinetic, potential, work, numerical_dissipation: work - kinetic - potential }
    }
}

/// Residual in units of the norm that tolerances refer to. With no free particle both are 0.
fn relative(norm: f64, unit: f64) -> f64 {
    if unit > 0.0 { norm / unit } else { 0.0 }
}
