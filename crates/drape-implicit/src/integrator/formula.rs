//! Formulas of backward differentiation.

use super::state::{IntegratorState, PreviousState};
use crate::settings::Integrator;

/// Largest ratio of a second-order step to the step before. The formula is unstable from a ratio of
/// 1 + √2 \[HNW93\].
const MAX_GROWTH: f64 = 2.0;

/// Tolerance for rounding in the ratio of two steps that should be equal.
const GROWTH_ROUNDING: f64 = 1e-9;

/// Coefficients of `x₁ = current x₀ + previous x₋₁ + beta_dt v₁`. The formula of momentum and force
/// has equal coefficients.
#[derive(Clone, Copy)]
pub(crate) struct Formula {
    pub current: f64,
    pub previous: f64,
    /// Product `β dt`, in s.
    pub beta_dt: f64,
}

impl Formula {
    /// Returns the formula of a step of length `dt`, in s, from `state`: BDF2 if `integrator` is
    /// BDF2 and `dt` is not too long after the previous step. With
    /// `$\rho = \mathrm{dt}/\mathrm{dt}_{-1}$`
    ///
    /// ```math
    /// \alpha_0 = \frac{(1+\rho)^2}{1+2\rho}, \qquad
    /// \alpha_{-1} = -\frac{\rho^2}{1+2\rho}, \qquad \beta = \frac{1+\rho}{1+2\rho}
    /// ```
    ///
    /// Otherwise the formula is backward Euler.
    pub(crate) fn new(integrator: Integrator, state: &IntegratorState, dt: f64) -> Self {
        match (integrator, &state.previous) {
            (Integrator::Bdf2, Some(previous)) if grows_gently(dt, previous) => {
                let ratio = dt / previous.dt;
                let divisor = 1.0 + 2.0 * ratio;
                Self {
                    current: (1.0 + ratio) * (1.0 + ratio) / divisor,
                    previous: -ratio * ratio / divisor,
                    beta_dt: (1.0 + ratio) / divisor * dt,
                }
            }
            _ => Self { current: 1.0, previous: 0.0, beta_dt: dt },
        }
    }
}

/// Returns whether a second-order step of length `dt`, in s, may follow the step `previous`.
pub(crate) fn grows_gently(dt: f64, previous: &PreviousState) -> bool {
    dt <= MAX_GROWTH * (1.0 + GROWTH_ROUNDING) * previous.dt
}
