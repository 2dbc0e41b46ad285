#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! `setup` turns strips and shipped fabrics into scenes in memory. [`instrument`] and
//! [`drapemeter`] simulate the tests of a laboratory; `outline` reads closed curves from draped
//! cloth. [`mod@reference`] has the exact solutions. Each of `cases` runs one experiment, compares
//! it and returns [`Findings`]; [`CASES`] lists them for the command line.
//!
//! Modules use each other in this order only: `error`, `progress`, `bisection`, `findings`,
//! `setup`, `instrument`, `outline`, `drapemeter`, `reference`, `cases`, `suite`.

// What a case returns.
mod error;
mod findings;
mod progress;

// What is simulated, and how it is read.
mod bisection;
pub mod drapemeter;
pub mod instrument;
mod outline;
mod setup;

// What it is held against, and the comparisons.
mod cases;
pub mod reference;
mod suite;

pub use error::ValidationError;
pub use findings::{Axis, Check, Findings, Graph, Kind, Layout, Series, Source, Still};
pub use progress::Progress;
pub use setup::{Friction, GRAVITY, Hold, LinePoint, Strip, finish};
pub use suite::{CASES, Case, Outcome};
