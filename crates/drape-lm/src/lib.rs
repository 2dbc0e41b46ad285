#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! A [`Problem`] and its [`Parameter`]s are the input. [`minimise`] returns a [`Report`].
//! [`Covariance`], [`profile`] and [`akaike`] judge a report.
//!
//! * The problem: `problem`, `residual_function` (a closure as a problem), `linked` (parameters as
//!   functions of others), `loss`, `check` (refusal of invalid input).
//! * The minimiser: `minimise` moves `iterate`, the current point with its linear model. `iterate`
//!   uses `difference` (Jacobian by differences) and `trust_region` (a step within a radius).
//! * The uncertainty: `covariance`, `profile`, `student` (quantiles), `akaike`.
#![cfg_attr(docsrs, feature(doc_cfg))]

// The problem.
mod check;
mod linked;
mod loss;
mod problem;
mod residual_function;
// The minimiser.
mod difference;
mod iterate;
mod minimise;
mod trust_region;
// The uncertainty of the result.
mod akaike;
mod covariance;
mod profile;
mod student;

pub use akaike::akaike;
pub use check::InvalidInput;
pub use covariance::{Covariance, Undetermined};
pub use linked::Linked;
pub use loss::Loss;
pub use minimise::{Iteration, MinimiserSettings, Report, Stop, minimise, minimise_watched};
pub use nalgebra;
pub use problem::{Parameter, Problem};
pub use profile::{End, Interval, ProfileSettings, profile};
pub use residual_function::ResidualFunction;
pub use student::student_quantile;
