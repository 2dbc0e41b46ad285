#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! A caller implements [`System`], and also [`StepFilter`] where steps must not lead to
//! intersections. The caller holds an [`IntegratorState`] and a [`Stepper`] with [`Settings`]. Each
//! call of [`Stepper::advance`] passes through three chapters:
//!
//! - `integrator` divides the step into sub-steps and predicts the end positions of each.
//! - `nonlinear` solves the equations of a sub-step by Newton's and Broyden's methods.
//! - `linear` solves the linear systems of these methods with the [`BlockMatrix`] that the system
//!   fills.
//!
//! A [`Report`] counts the work done. An [`Error`] says why a step failed. [`check_system`] tests a
//! new system. [`ErrorEstimate`] serves callers that choose the length of a step by its error.
//! [`Explicit`] integrates by another method as a cross-check.
#![cfg_attr(docsrs, feature(doc_cfg))]

// Interface of a system.
mod step_filter;
mod system;
mod system_check;

// Chapters, each using those below it.
mod integrator;
mod linear;
mod nonlinear;

// Settings and answers.
mod check;
mod error;
mod report;
mod settings;

// Division of work among threads.
mod threads;

pub use error::{Error, Quantity};
pub use integrator::error_estimate::ErrorEstimate;
pub use integrator::explicit::Explicit;
pub use integrator::state::{IntegratorState, PreviousState};
pub use integrator::stepper::Stepper;
pub use linear::block_matrix::{BlockMatrix, Coupling};
pub use linear::sparsity::Sparsity;
pub use report::{Report, StepEnergy, Stop};
pub use settings::{InitialMatrix, Integrator, LinearSolver, Method, Settings};
pub use step_filter::{AllowedStep, StepFilter, TrialStep};
pub use system::{MaterialPoint, Stiffness, System};
pub use system_check::{SystemCheck, check_system};
