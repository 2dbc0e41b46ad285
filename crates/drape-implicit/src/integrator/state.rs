//! State that the integrator advances: positions, velocities, time, and the previous state.

use serde::{Deserialize, Serialize};

use crate::check::{check_length, check_step};
use crate::error::Error;
use crate::system::System;

/// Positions, velocities and time, with the previous state that a second-order formula needs.
///
/// A state that was written to disk and read back continues to the bits of an uninterrupted run:
/// the [`Stepper`](crate::Stepper) has no memory.
///
/// ```
/// use drape_implicit::IntegratorState;
///
/// let mut state = IntegratorState::at_rest(vec![0.0, 1.0, 0.0]);
/// assert_eq!(state.velocities, [0.0; 3]);
/// // After a change by hand the previous state no longer fits.
/// state.velocities[1] = -2.0;
/// state.restart();
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct IntegratorState {
    /// Time, in s.
    ///
    /// Each call of [`Stepper::advance`](crate::Stepper::advance) adds the step's length. A caller
    /// that takes many equal steps sets `time` to the number of steps times their length, so that
    /// rounding errors do not add up.
    pub time: f64,
    /// Positions, three per particle, in m.
    pub positions: Vec<f64>,
    /// Velocities, three per particle, in m/s.
    pub velocities: Vec<f64>,
    /// State before the last accepted sub-step, for second-order steps.
    pub previous: Option<PreviousState>,
}

/// State one sub-step earlier.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PreviousState {
    /// Length of the sub-step from this state to the present one, in s.
    pub dt: f64,
    /// Positions before the sub-step, in m.
    pub positions: Vec<f64>,
    /// Velocities before the sub-step, in m/s.
    pub velocities: Vec<f64>,
}

impl IntegratorState {
    /// Returns the state at time 0 with `positions`, in m, and `velocities`, in m/s.
    #[must_use]
    pub fn new(positions: Vec<f64>, velocities: Vec<f64>) -> Self {
        Self { time: 0.0, positions, velocities, previous: None }
    }

    /// Returns the state at time 0, at rest at `positions`, in m.
    #[must_use]
    pub fn at_rest(positions: Vec<f64>) -> Self {
        let velocities = vec![0.0; positions.len()];
        Self::new(positions, velocities)
    }

    /// Removes the `previous` state, so that the next step is of first order. Call this method
    /// after a change of positions or velocities by hand, or when the forces have jumped.
    pub fn restart(&mut self) {
        self.previous = None;
    }

    /// Checks that all lists have three numbers for each of the `particles`, and that the previous
    /// step has a positive length.
    ///
    /// # Errors
    /// [`Error::Dimension`] and [`Error::StepLength`].
    pub fn check(&self, particles: usize) -> Result<(), Error> {
        check_length("positions", 3 * particles, self.positions.len())?;
        check_length("velocities", 3 * particles, self.velocities.len())?;
        if let Some(previous) = &self.previous {
            check_step(previous.dt)?;
            check_length("previous positions", 3 * particles, previous.positions.len())?;
            check_length("previous velocities", 3 * particles, previous.velocities.len())?;
        }
        Ok(())
    }

    /// Replaces positions and velocities by the ones at the end of the sub-step `span`. The ones at
    /// the start become the previous state. Buffers are exchanged: afterwards the contents of
    /// `positions` and `velocities` are meaningless.
    pub(crate) fn advance(
        &mut self,
        span: Span,
        positions: &mut Vec<f64>,
        velocities: &mut Vec<f64>,
    ) {
        let previous = self.previous.get_or_insert_with(|| PreviousState {
            dt: span.dt,
            positions: vec![0.0; positions.len()],
            velocities: vec![0.0; velocities.len()],
        });
        previous.dt = span.dt;
        core::mem::swap(&mut previous.positions, &mut self.positions);
        core::mem::swap(&mut previous.velocities, &mut self.velocities);
        core::mem::swap(&mut self.positions, positions);
        core::mem::swap(&mut self.velocities, velocities);
        self.time = span.end;
    }
}

/// Checks that `system` has the number of `particles`, with a positive, finite mass each.
pub(crate) fn check_particles(system: &dyn System, particles: usize) -> Result<(), Error> {
    check_length("particles", particles, system.particle_count())?;
    check_length("masses", particles, system.masses().len())?;
    check_length("held", particles, system.held().len())?;
    let mut masses = system.masses().iter().enumerate();
    match masses.find(|(_, mass)| !(**mass > 0.0 && mass.is_finite())) {
        Some((particle, &mass)) => Err(Error::Mass { particle, mass }),
        None => Ok(()),
    }
}

/// Start, end and length of a sub-step, in s.
///
/// `dt` is exact in binary. The difference `end - start` is rounded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    pub start: f64,
    pub end: f64,
    pub dt: f64,
}
