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
//! step). A caller holds a [`Stepper`](stepper::Stepper). The stepper divides a step into sub-steps
//! ([`step_control`]) and halves a sub-step that fails. An attempt at a sub-step ([`sub_step`])
//! predicts the end positions, solves by the [nonlinear](crate::nonlinear) chapter, computes the
//! velocities, and accepts the result. [`ErrorEstimate`](error_estimate::ErrorEstimate) estimates
//! the error of a step. [`Explicit`](explicit::Explicit) steps are a cross-check. Only this chapter
//! writes an [`IntegratorState`](state::IntegratorState).

pub(crate) mod error_estimate;
pub(crate) mod explicit;
pub(crate) mod formula;
pub(crate) mod path_work;
pub(crate) mod state;
pub(crate) mod step_control;
pub(crate) mod stepper;
pub(crate) mod sub_step;
