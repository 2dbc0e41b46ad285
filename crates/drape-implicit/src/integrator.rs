//! Time integration: advances positions and velocities by backward Euler or BDF2.
//!
//! Both formulas are of the form
//!
//! ```math
//! x_1 = \alpha_0 x_0 + \alpha_{-1} x_{-1} + \beta\,\mathrm{dt}\,v_1, \qquad
//! v_1 = \alpha_0 v_0 + \alpha_{-1} v_{-1} + \beta\,\mathrm{dt}\,M^{-1} f(x_1)
//! ```
//!
//! with coefficients by \[NB04\] eq. 6 (backward Euler) and \[HNW93\] III.5 (BDF2 with variable
//! step). The [`Stepper`](stepper::Stepper) is what a caller holds. It divides a step into
//! sub-steps ([`step_control`]), halving those that fail, and attempts each ([`sub_step`]):
//! predict, solve by the [nonlinear](crate::nonlinear) chapter, set velocities, accept. An
//! [`ErrorEstimate`](error_estimate::ErrorEstimate) tells the error of a step, and
//! [`Explicit`](explicit::Explicit) steps are a cross-check. Only this chapter writes an
//! [`IntegratorState`](state::IntegratorState).

pub(crate) mod error_estimate;
pub(crate) mod explicit;
pub(crate) mod formula;
pub(crate) mod path_work;
pub(crate) mod state;
pub(crate) mod step_control;
pub(crate) mod stepper;
pub(crate) mod sub_step;
