#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! A caller implements [`System`], with [`StepFilter`] on top where steps must not lead to
//! intersections, and holds an [`IntegratorState`] and a [`Stepper`] with its [`Settings`]. Each
//! call of [`Stepper::advance`] passes through three chapters: `integrator` divides the step into
//! sub-steps and predicts, `nonlinear` solves the equations of each by Newton's and Broyden's
//! methods, `linear` solves the linear systems in it, on the [`BlockMatrix`] that the system fills.
//! A [`Report`] tells the work done, an [`Error`] why a step could not be made. [`check_system`] is
//! for the tests of a new system, [`ErrorEstimate`] for steps of a length by their error,
//! [`Explicit`] for cross-checks.

// Interface of a system.
mod step_filter;
mod system;
mod system_check;

// Chapters, each using those below it.
mod integrator;
mod linear;
mod nonlinear;

// Settings and answers.
mod error;
mod report;
mod settings;

pub use error::{Error, Quantity};
pub use integrator::error_estimate::ErrorEstimate;
pub use integrator::explicit::Explicit;
pub use integrator::state::{IntegratorState, PreviousState};
pub use integrator::stepper::Stepper;
pub use linear::block_matrix::{BlockMatrix, Coupling};
pub use linear::sparsity::Sparsity;
pub use report::{Energy, Report, Stop};
pub use settings::{InitialMatrix, Integrator, LinearSolver, Method, Settings};
pub use step_filter::{StepFilter, StepLimit, TrialStep};
pub use system::{MaterialPoint, Stiffness, System};
pub use system_check::{Check, check_system};
