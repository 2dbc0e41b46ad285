//! One attempted sub-step: prediction, solution, and what follows from it.

use crate::error::Quantity;
use crate::formula::Formula;
use crate::incremental::{Halt, Incremental};
use crate::step_filter::SystemRef;
use crate::{
    Energy, Error, IntegratorState, PreviousState, Report, Stepper, Stop, System, block, vector,
};

/// One attempted sub-step.
#[derive(Clone, Copy)]
pub(crate) struct Span {
    pub start: f64,
    pub end: f64,
    pub dt: f64,
}

impl Stepper {
    /// Tries one sub-step. On success the motion and the system's memory are at its end, otherwise untouched.
    pub(crate) fn attempt(
        &mut self,
        system: &mut SystemRef<'_>,
        state: &mut IntegratorState,
        span: Span,
        report: &mut Report,
    ) -> Result<(), Halt> {
        let formula = Formula::new(self.settings.integrator, state, span.dt);
        self.predict(state, formula);
        let target = &mut self.base;
        target.copy_from_slice(&state.positions);
        system.system().begin(span.end, span.dt, &state.positions, target);
        let held = system.system().held();
        if held.len() != self.held.len() {
            return Err(Halt::Fatal(Error::Dimension {
                what: "held",
                expected: self.held.len(),
                found: held.len(),
            }));
        }
        self.held.copy_from_slice(held);
        let guarded = system.is_filtered();
        let limit = self.place(state, formula, (span.dt, guarded))?;
        let start = self.settings.energy_balance.then(|| {
            report.potential_evaluations += 1;
            // Where bodies will be, the cloth may not be yet.
            system.set_obstacle_time(0.0);
            (self.kinetic(&state.velocities), system.system().potential(&state.positions))
        });

        let mut problem = Incremental {
            system: &mut *system,
            inertia: &self.inertia,
            held: &self.held,
            base: &self.base,
            start: &state.positions,
            limit: limit * self.settings.tolerance,
            report: &mut *report,
        };
        self.solver.solve(&mut problem, &self.settings)?;
        if !system.is_intersection_free(&self.solver.current.positions) {
            return Err(Halt::Stop(Stop::Intersection));
        }

        self.set_velocities(formula);
        if let Some(start) = start {
            let balance = self.balance((system.system(), report), state, formula, start);
            report.potential_evaluations += 1;
            *report.energy.get_or_insert_default() += balance;
        }
        let end = &self.solver.current;
        report.residual = report.residual.max(relative(end.norm, limit));
        system.system().accept(&end.positions, &self.velocities, span.dt);
        commit(state, span, &end.positions, &self.velocities);
        Ok(())
    }

    /// Fills in what past positions and velocities amount to.
    fn predict(&mut self, state: &IntegratorState, formula: Formula) {
        let combine = |out: &mut [f64], now: &[f64], before: Option<&[f64]>| {
            out.copy_from_slice(now);
            if let (Some(before), true) = (before, formula.previous != 0.0) {
                for (out, before) in out.iter_mut().zip(before) {
                    *out = formula.current * *out + formula.previous * before;
                }
            }
        };
        let previous = state.previous.as_ref();
        combine(&mut self.drift, &state.positions, previous.map(|p| &p.positions[..]));
        combine(&mut self.momentum, &state.velocities, previous.map(|p| &p.velocities[..]));
    }

    /// Turns targets into the base of deviations, and sets the first guess and the one to fall back on. Returns the
    /// norm that residuals are relative to, N.
    fn place(
        &mut self,
        state: &IntegratorState,
        formula: Formula,
        (dt, guarded): (f64, bool),
    ) -> Result<f64, Halt> {
        let Self { solver, base, drift, momentum, held, inertia, masses, .. } = self;
        let mut squares = 0.0;
        for (particle, &held) in held.iter().enumerate() {
            let mass = masses[particle];
            inertia[particle] = mass / (formula.reach * formula.reach);
            if !held {
                squares += mass * mass;
            }
            for k in 3 * particle..3 * particle + 3 {
                let (mut guess, mut fallback) = (0.0, 0.0);
                if held {
                    if !base[k].is_finite() {
                        return Err(Halt::NotFinite(Quantity::Target, particle));
                    }
                    if guarded {
                        fallback = state.positions[k] - base[k];
                    }
                } else {
                    base[k] = drift[k] + formula.reach * momentum[k];
                    fallback = state.positions[k] - base[k];
                    guess = fallback + dt * state.velocities[k];
                }
                solver.current.deviation[k] = guess;
                solver.trial.deviation[k] = fallback;
            }
        }
        Ok(self.settings.acceleration * squares.sqrt())
    }

    /// Velocities at the end, those of held particles included.
    fn set_velocities(&mut self, formula: Formula) {
        let end = &self.solver.current;
        for (particle, &held) in self.held.iter().enumerate() {
            for k in 3 * particle..3 * particle + 3 {
                self.velocities[k] = if held {
                    (end.positions[k] - self.drift[k]) / formula.reach
                } else {
                    self.momentum[k] + end.deviation[k] / formula.reach
                };
            }
        }
    }

    fn kinetic(&self, velocities: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (mass, v) in self.masses.iter().zip(block::triples(velocities)) {
            sum += 0.5 * mass * vector::dot(v, v);
        }
        sum
    }

    /// What the sub-step did with the energy, given the kinetic and potential energies at its start.
    fn balance(
        &mut self,
        (system, report): (&mut dyn System, &mut Report),
        state: &IntegratorState,
        formula: Formula,
        (kinetic, potential): (f64, f64),
    ) -> Energy {
        let end = &self.solver.current;
        let carried = |k: usize| self.held[k / 3] && end.positions[k] != state.positions[k];
        let mut work = 0.0;
        if (0..end.positions.len()).any(carried) {
            let forces = &mut self.solver.image;
            system.forces(&end.positions, forces);
            report.force_evaluations += 1;
            for (k, force) in forces.iter().enumerate().filter(|&(k, _)| carried(k)) {
                let acceleration = (self.velocities[k] - self.momentum[k]) / formula.reach;
                let pull = self.masses[k / 3] * acceleration - force;
                work += pull * (end.positions[k] - state.positions[k]);
            }
        }
        let kinetic = self.kinetic(&self.velocities) - kinetic;
        let potential = system.potential(&end.positions) - potential;
        Energy { kinetic, potential, work, numerical_dissipation: work - kinetic - potential }
    }
}

/// A residual in units of the norm that tolerances refer to. With nothing free both are zero.
pub(crate) fn relative(norm: f64, unit: f64) -> f64 {
    if unit > 0.0 { norm / unit } else { 0.0 }
}

/// Moves the motion on, keeping the state it comes from.
fn commit(state: &mut IntegratorState, span: Span, positions: &[f64], velocities: &[f64]) {
    let IntegratorState { previous, .. } = state;
    let previous = previous.get_or_insert_with(|| PreviousState {
        dt: span.dt,
        positions: vec![0.0; positions.len()],
        velocities: vec![0.0; velocities.len()],
    });
    previous.dt = span.dt;
    previous.positions.copy_from_slice(&state.positions);
    previous.velocities.copy_from_slice(&state.velocities);
    state.positions.copy_from_slice(positions);
    state.velocities.copy_from_slice(velocities);
    state.time = span.end;
}
