#![doc = include_str!("../README.md")]

mod block;
mod block_matrix;
mod broyden;
mod check;
mod cholesky;
mod conjugate_gradient;
mod elimination;
mod error;
mod error_estimate;
mod explicit;
mod formula;
mod incomplete;
mod incremental;
mod motion;
mod pattern;
mod report;
mod settings;
mod solver;
mod stepper;
mod sub_step;
mod system;
mod tangent;
mod textbook;
mod vector;

pub use block_matrix::BlockMatrix;
pub use check::{Check, check_system};
pub use error::{Error, Quantity};
pub use error_estimate::ErrorEstimate;
pub use explicit::Explicit;
pub use motion::{Motion, Previous};
pub use pattern::Pattern;
pub use report::{Energy, Report, Stop};
pub use settings::{Initial, Integrator, LinearSolver, Method, Settings};
pub use stepper::Stepper;
pub use system::{Stiffness, System};
