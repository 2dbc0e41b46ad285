#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! The crate is in the lowest layer of the workspace. The laws of a fabric add an elastic load to
//! the friction, and the fit of KES curves drives the laws along measured paths.
//!
//! * The models: `dahl` (one element), `bliman_sorine` (one or two elements in parallel).
//! * Argument and result of the models: `slip` (a monotone piece of a path), `response` (load and
//!   tangent), `error`.
//! * Dahl elements for SIMD loops: `prepared` (an element that is evaluated without branches),
//!   `exponential` (the exponential function without branches).
#![cfg_attr(docsrs, feature(doc_cfg))]

// Argument, result and errors of the models.
mod error;
mod response;
mod slip;

// The models.
mod bliman_sorine;
mod dahl;

// Dahl elements for SIMD loops.
mod exponential;
mod prepared;

pub use bliman_sorine::{BlimanSorine, Loads};
pub use dahl::Dahl;
pub use error::Error;
pub use exponential::exp_m1;
pub use prepared::{PassedKnot, PreparedDahl, Stroke};
pub use response::Response;
pub use slip::Slip;
