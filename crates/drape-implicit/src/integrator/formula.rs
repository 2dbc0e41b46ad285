//! Formulas of backward differentiation.

use super::state::{IntegratorState, PreviousState};
use crate::settings::Integrator;

/// Largest ratio of a second-order step to the one before it: below 1 + √2, from where on the
/// formula is unstable \[HNW93\].
const MAX_GROWTH: f64 = 2.0;

/// Tolerance for rounding in the ratio of two steps that should be equal.
const GROWTH_ROUNDING: f64 = 1e-9;

/// Coefficients of `x₁ = current x₀ + previous x₋₁ + beta_dt v₁`, and likewise for momentum and
/// force.
#[derive(Clone, Copy)]
pub(crate) struct Formula {
    pub current: f64,
    pub previous: f64,
    /// Product `β dt`, in s.
    pub beta_dt: f64,
}

impl Formula {
    /// Formula of a step of length `dt`: BDF2 where it is asked for and the past allows it, with
    /// `$\rho = \mathrm{dt}/\mathrm{dt}_{-1}$`
    ///
    /// ```math
    /// \alpha_0 = \frac{(1+\rho)^2}{1+2\rho}, \qquad
    /// \alpha_{-1} = -\frac{\rho^2}{1+2\rho}, \qquad \beta = \frac{1+\rho}{1+2\rho}
    /// ```
    ///
    /// and otherwise backward Euler.
    pub(crate) fn new(integrator: Integrator, state: &IntegratorState, dt: f64) -> Self {
        match (integrator, &state.previous) {
            (Integrator::Bdf2, Some(previous)) if grows_gently(dt, previous) => {
                let ratio = dt / previous.dt;
                let whole = 1.0 + 2.0 * ratio;
                Self {
                    current: (1.0 + ratio) * (1.0 + ratio) / whole,
                    previous: -ratio * ratio / whole,
                    beta_dt: (1.0 + ratio) / whole * dt,
                }
            }
            _ => Self { current: 1.0, previous: 0.0, beta_dt: dt },
        }
    }
}

/// Whether a second-order step of length `dt` may follow the previous one.
pub(crate) fn grows_gently(dt: f64, previous: &PreviousState) -> bool {
    dt <= MAX_GROWTH * (1.0 + GROWTH_ROUNDING) * previous.dt
}
