//! Regression of one curve: nonlinear least squares with several initial guesses and several laws.
//!
//! The residuals of a law along a curve, over the range `$\Delta F$` of the measured load, are
//!
//! ```math
//! r_i(p) = \frac{F(q_1 \dots q_i;\,p) - F_i}{\Delta F}, \qquad p^* = \arg\min_p \sum_i w_i r_i^2
//! ```
//!
//! `curves` passes candidate laws, each with initial guesses and a forward model, and receives a
//! [`CurveFit`](crate::CurveFit). The minimiser is drape-lm. The chapter knows no law of a fabric.
//!
//! * `linear`: linear least squares for the initial guesses, with the nonlinear parameters on a
//!   grid.
//! * `residuals`: forward model and residuals, as a problem of drape-lm.
//! * `functional`: areas and means that a fit meets beside its points; `noise`: the noise of a
//!   load.
//! * `search`: the minimiser from several starts.
//! * `candidate`, `selection`: which of several laws the data support, by Akaike's criterion, their
//!   misfits and their predictions.
//! * `estimate`, `uncertainty`: parameters with errors, intervals and correlations.
//! * `curve_fit`: the result.

pub(crate) mod candidate;
pub(crate) mod curve_fit;
pub(crate) mod estimate;
pub(crate) mod functional;
pub(crate) mod linear;
pub(crate) mod noise;
pub(crate) mod repeats;
pub(crate) mod residuals;
pub(crate) mod search;
pub(crate) mod selection;
pub(crate) mod uncertainty;
