//! The formulas of backward differentiation.

use crate::{Integrator, IntegratorState, PreviousState};

/// Largest ratio of a second-order step to the one before it: below 1 + √2, where the formula ceases to be stable.
const MAX_GROWTH: f64 = 2.0;

/// Room for rounding in the ratio of two steps that should be equal.
const GROWTH_ROUNDING: f64 = 1e-9;

/// Weights of a formula `x₁ = current x₀ + previous x₋₁ + reach v₁`, and likewise for momentum and force.
#[derive(Clone, Copy)]
pub(crate) struct Formula {
    pub current: f64,
    pub previous: f64,
    /// `β dt`, s.
    pub reach: f64,
}

impl Formula {
    pub(crate) fn new(integrator: Integrator, state: &IntegratorState, dt: f64) -> Self {
        match (integrator, &state.previous) {
            (Integrator::Bdf2, Some(previous)) if grows_gently(dt, previous) => {
                let ratio = dt / previous.dt;
                let whole = 1.0 + 2.0 * ratio;
                Self {
                    current: (1.0 + ratio) * (1.0 + ratio) / whole,
                    previous: -ratio * ratio / whole,
                    reach: (1.0 + ratio) / whole * dt,
                }
            }
            _ => Self { current: 1.0, previous: 0.0, reach: dt },
        }
    }
}

/// Whether a second-order step may follow the previous one.
pub(crate) fn grows_gently(dt: f64, previous: &PreviousState) -> bool {
    dt <= MAX_GROWTH * (1.0 + GROWTH_ROUNDING) * previous.dt
}
