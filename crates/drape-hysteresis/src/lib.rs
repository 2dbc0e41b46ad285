#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! The crate stands at the bottom of the workspace: a fabric's laws add an elastic part to its
//! friction, and the fit of KES curves drives those laws along measured paths.
//!
//! * The models: `dahl` (one element), `bliman_sorine` (one or two elements in parallel).
//! * What goes in and comes out: `slip` (a monotone piece of a path), `response` (load and tangent).
//! * The same for SIMD loops: `prepared` (an element evaluated without branches), `exponential` (its
//!   exponential in straight arithmetic).

// What goes in and comes out.
mod response;
mod slip;

// The models.
mod bliman_sorine;
mod dahl;

// The same for SIMD loops.
mod exponential;
mod prepared;

pub use bliman_sorine::{BlimanSorine, Loads};
pub use dahl::Dahl;
pub use exponential::exp_m1;
pub use prepared::{PassedKnot, PreparedDahl, Stroke};
pub use response::Response;
pub use slip::Slip;
