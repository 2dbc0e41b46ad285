//! Error estimate of a step, for callers that choose the step by its error.

use super::formula::Formula;
use super::state::IntegratorState;
use crate::check::check_step;
use crate::error::Error;
use crate::settings::Integrator;

/// Extrapolation of the last steps to the end of the next step, with the ratio of the step's error
/// to the difference between solution and extrapolation; see [`ErrorEstimate`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extrapolation {
    /// Length of the step, in s.
    dt: f64,
    /// Factor of the last change of velocity, in s.
    weight: f64,
    /// Error of the formula as a fraction of the difference between solution and extrapolation.
    pub fraction: f64,
}

impl Extrapolation {
    /// Returns the extrapolation for a first-order step of length `dt`, in s.
    fn first_order(dt: f64) -> Self {
        Self { dt, weight: 0.0, fraction: 0.5 }
    }

    /// Returns the extrapolation for a second-order step of length `dt` after a step of length
    /// `previous`, both in s.
    fn second_order(dt: f64, previous: f64) -> Self {
        let ratio = dt / previous;
        let formula_error = (1.0 + ratio) * (1.0 + ratio) / (6.0 * ratio * (1.0 + 2.0 * ratio));
        let fraction = formula_error / (formula_error + 1.0 / 6.0 + 0.25 / ratio);
        Self { dt, weight: 0.5 * dt * ratio, fraction }
    }

    /// Returns the extrapolation from `state` for a step of length `dt`, in s, by `formula`.
    pub(crate) fn new(formula: Formula, state: &IntegratorState, dt: f64) -> Self {
        match &state.previous {
            Some(previous) if formula.previous != 0.0 => Self::second_order(dt, previous.dt),
            _ => Self::first_order(dt),
        }
    }

    /// Writes the positions extrapolated from `state` into `predicted`, in m.
    pub(crate) fn write(self, state: &IntegratorState, predicted: &mut [f64]) {
        let motion = state.positions.iter().zip(&state.velocities);
        for (predicted, (x, v)) in predicted.iter_mut().zip(motion) {
            *predicted = x + self.dt * v;
        }
        let Some(previous) = state.previous.as_ref().filter(|_| self.weight != 0.0) else { return };
        let change = state.velocities.iter().zip(&previous.velocities);
        for (predicted, (v, previous_v)) in predicted.iter_mut().zip(change) {
            *predicted += self.weight * (v - previous_v);
        }
    }
}

/// Estimate of the error of a step in the positions, from a prediction before the step.
///
/// Before the step the end positions are extrapolated from positions, velocities and, for
/// second-order steps, the last change of velocity. The errors of the step's formula and of the
/// extrapolation are known multiples of one derivative (Milne's device). The difference between
/// solution and extrapolation therefore gives the error:
///
/// - First order: the extrapolation `x₀ + dt v₀` has the error `−dt² x″/2`, and the formula has the
///   error `dt² x″/2`.
/// - Second order, with `ρ = dt/dt₋₁`: the extrapolation `x₀ + dt v₀ + dt² (v₀ − v₋₁)/(2 dt₋₁)` has
///   the error `−dt³ x‴ (1/6 + 1/(4ρ))`, and the formula has the error
///   `dt³ x‴ (1 + ρ)²/(6ρ (1 + 2ρ))`.
///
/// Oscillations faster than the step are not resolved. Their error counts with their amplitude.
///
/// ```
/// use drape_implicit::{ErrorEstimate, Integrator, IntegratorState};
///
/// // A step of 0.1 s of a particle at rest that ends 2 mm from the predicted position.
/// let mut state = IntegratorState::at_rest(vec![0.0; 3]);
/// let mut estimate = ErrorEstimate::new(1);
/// estimate.predict(&state, Integrator::BackwardEuler, 0.1)?;
/// state.positions[0] = 0.002;
/// assert_eq!(estimate.estimate(&state), 0.001);
/// # Ok::<(), drape_implicit::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct ErrorEstimate {
    predicted: Vec<f64>,
    /// Error of the formula as a fraction of the difference between solution and prediction.
    fraction: f64,
}

impl ErrorEstimate {
    /// Allocates an estimate for a number of `particles`.
    #[must_use]
    pub fn new(particles: usize) -> Self {
        Self { predicted: vec![0.0; 3 * particles], fraction: f64::NAN }
    }

    /// Extrapolates `state` to the end of a step of length `dt`, in s, by `integrator`. Call this
    /// method before the step.
    ///
    /// # Errors
    /// [`Error::Dimension`] if the state has another number of particles, [`Error::StepLength`] if
    /// `dt` or the length of the previous step is not positive.
    pub fn predict(
        &mut self,
        state: &IntegratorState,
        integrator: Integrator,
        dt: f64,
    ) -> Result<(), Error> {
        check_step(dt)?;
        state.check(self.predicted.len() / 3)?;
        let extrapolation = match &state.previous {
            Some(previous) if integrator == Integrator::Bdf2 => {
                Extrapolation::second_order(dt, previous.dt)
            }
            _ => Extrapolation::first_order(dt),
        };
        extrapolation.write(state, &mut self.predicted);
        self.fraction = extrapolation.fraction;
        Ok(())
    }

    /// Returns the root-mean-square error of the positions of `state` over all particles, in m.
    /// Call this method after the step. The error is not a number (NaN) before the first call of
    /// [`predict`](Self::predict), and for a state with another number of particles.
    #[must_use]
    pub fn estimate(&self, state: &IntegratorState) -> f64 {
        if state.positions.len() != self.predicted.len() {
            return f64::NAN;
        }
        let differences = self.predicted.iter().zip(&state.positions).map(|(p, x)| p - x);
        let squares: f64 = differences.map(|d| d * d).sum();
        let particles = (self.predicted.len() / 3).max(1) as f64;
        self.fraction * (squares / particles).sqrt()
    }
}
