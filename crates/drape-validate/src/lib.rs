#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! `setup` turns strips and shipped fabrics into scenes in memory. [`instrument`] and
//! [`drapemeter`] simulate the tests of a laboratory; `outline` reads closed curves from draped
//! cloth. [`mod@reference`] has the exact solutions. Each function of `cases` runs one experiment,
//! compares the result with a reference and returns [`Findings`]. [`CASES`] lists the cases for the
//! command line.
//!
//! A module uses only modules before it in this order: `error`, `progress`, `bisection`,
//! `findings`, `setup`, `instrument`, `outline`, `drapemeter`, `reference`, `cases`, `suite`.

// Results of a case.
mod error;
mod findings;
mod progress;

// Simulations, and measurements of their results.
mod bisection;
pub mod drapemeter;
pub mod instrument;
mod outline;
mod setup;

// References, and comparisons with them.
mod cases;
pub mod reference;
mod suite;

pub use error::ValidationError;
pub use findings::{Axis, Check, Findings, Graph, Kind, Layout, Series, Source, Still};
pub use progress::Progress;
pub use setup::{Friction, GRAVITY, Hold, LinePoint, Strip, finish};
pub use suite::{CASES, Case, Outcome};
