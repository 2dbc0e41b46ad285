//! Error estimate of a step, for callers that choose the step by its error.

use super::formula::Formula;
use super::state::IntegratorState;
use crate::settings::Integrator;

/// Extrapolation of the last steps to the end of the next one, with the factor that makes its
/// difference from the solution the error of the step; see [`ErrorEstimate`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extrapolation {
    /// Length of the step, in s.
    dt: f64,
    /// Factor of the last change of velocity, in s.
    weight: f64,
    /// Error of the formula as a fraction of its difference from the extrapolation.
    pub fraction: f64,
}

impl Extrapolation {
    /// Extrapolation for a first-order step of length `dt`, in s.
    fn first_order(dt: f64) -> Self {
        Self { dt, weight: 0.0, fraction: 0.5 }
    }

    /// Extrapolation for a second-order step of length `dt`, in s, after one of another length.
    fn second_order(dt: f64, previous: f64) -> Self {
        let ratio = dt / previous;
        let formula = (1.0 + ratio) * (1.0 + ratio) / (6.0 * ratio * (1.0 + 2.0 * ratio));
        let fraction = formula / (formula + 1.0 / 6.0 + 0.25 / ratio);
        Self { dt, weight: 0.5 * dt * ratio, fraction }
    }

    /// Extrapolation for a step of length `dt`, in s, by a formula.
    pub(crate) fn new(formula: Formula, state: &IntegratorState, dt: f64) -> Self {
        match &state.previous {
            Some(previous) if formula.previous != 0.0 => Self::second_order(dt, previous.dt),
            _ => Self::first_order(dt),
        }
    }

    /// Writes the extrapolated positions, in m.
    pub(crate) fn write(self, state: &IntegratorState, predicted: &mut [f64]) {
        let now = state.positions.iter().zip(&state.velocities);
        for (predicted, (x, v)) in predicted.iter_mut().zip(now) {
            *predicted = x + self.dt * v;
        }
        let Some(previous) = state.previous.as_ref().filter(|_| self.weight != 0.0) else { return };
        let change = state.velocities.iter().zip(&previous.velocities);
        for (predicted, (v, before)) in predicted.iter_mut().zip(change) {
            *predicted += self.weight * (v - before);
        }
    }
}

/// Estimate of the error that a step makes in the positions, from a prediction made before it.
///
/// Before the step the positions at its end are extrapolated from positions, velocities and, for
/// second-order steps, the last change of velocity. The step's formula and the extrapolation miss
/// by known multiples of the same derivative (Milne's device), so their difference tells the error:
///
/// | formula | extrapolation | its error | the formula's |
/// |---|---|---|---|
/// | first order | `x₀ + dt v₀` | `−dt² x″/2` | `dt² x″/2` |
/// | second order, `ρ = dt/dt₋₁` | `x₀ + dt v₀ + dt² (v₀ − v₋₁)/(2 dt₋₁)` | `−dt³ x‴ (1/6 + 1/(4ρ))` | `dt³ x‴ (1 + ρ)²/(6ρ (1 + 2ρ))` |
///
/// Errors of single oscillations faster than the step are not resolved; they count with their
/// amplitude.
///
/// ```
/// use drape_implicit::{ErrorEstimate, Integrator, IntegratorState};
///
/// // A step of 0.1 s of a particle at rest that ends 2 mm from where it was predicted.
/// let mut state = IntegratorState::at_rest(vec![0.0; 3]);
/// let mut estimate = ErrorEstimate::new(1);
/// estimate.predict(&state, Integrator::BackwardEuler, 0.1);
/// state.positions[0] = 0.002;
/// assert_eq!(estimate.estimate(&state), 0.001);
/// ```
#[derive(Debug, Clone)]
pub struct ErrorEstimate {
    predicted: Vec<f64>,
    /// Error of the formula as a fraction of its difference from the extrapolation.
    fraction: f64,
}

impl ErrorEstimate {
    /// Allocates an estimate for a number of particles.
    #[must_use]
    pub fn new(particles: usize) -> Self {
        Self { predicted: vec![0.0; 3 * particles], fraction: f64::NAN }
    }

    /// Extrapolates the state to the end of a step of length `dt`, in s. Call it before the step.
    pub fn predict(&mut self, state: &IntegratorState, integrator: Integrator, dt: f64) {
        let extrapolation = match &state.previous {
            Some(previous) if integrator == Integrator::Bdf2 => {
                Extrapolation::second_order(dt, previous.dt)
            }
            _ => Extrapolation::first_order(dt),
        };
        extrapolation.write(state, &mut self.predicted);
        self.fraction = extrapolation.fraction;
    }

    /// Root-mean-square error of the positions over all particles, in m. Call it after the step.
    #[must_use]
    pub fn estimate(&self, state: &IntegratorState) -> f64 {
        let differences = self.predicted.iter().zip(&state.positions).map(|(p, x)| p - x);
        let squares: f64 = differences.map(|d| d * d).sum();
        let particles = (self.predicted.len() / 3).max(1) as f64;
        self.fraction * (squares / particles).sqrt()
    }
}
