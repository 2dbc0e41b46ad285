//! Nonlinear solver: the equations of one sub-step, as the minimum of an energy.
//!
//! With `$d = x - \tilde x$` the deviation from free flight, the end positions are where the
//! *incremental energy* is stationary \[BW98\] \[Li20\]:
//!
//! ```math
//! E(d) = \tfrac12\, d^T \frac{M}{(\beta\,\mathrm{dt})^2}\, d + V(\tilde x + d), \qquad
//! \varphi(d) = \nabla E = \frac{M}{(\beta\,\mathrm{dt})^2}\, d - f(\tilde x + d) = 0
//! ```
//!
//! A sub-step of the [integrator](crate::integrator) calls
//! [`NonlinearSolver`](solver::NonlinearSolver). The solver chooses a [start point](start_point).
//! It then alternates [Newton](newton) steps with a [line search](line_search) and
//! [Broyden](broyden) steps on the Newton step's matrix, until `$\|\varphi\|$` is below its limit.
//! The alternative is [textbook] Broyden. A step filter limits every step before it is taken. The
//! [linear](crate::linear) chapter solves the linear systems. No result of this chapter depends on
//! an earlier sub-step.

pub(crate) mod broyden;
pub(crate) mod equations;
pub(crate) mod halt;
pub(crate) mod line_search;
pub(crate) mod newton;
pub(crate) mod search;
pub(crate) mod solver;
pub(crate) mod start_point;
pub(crate) mod textbook;
