#![doc = include_str!("../README.md")]

mod bias;
mod bias_rim;
mod breen;
mod check;
mod crease;
mod cube;
mod decrement;
pub mod drapemeter;
mod drapes;
pub mod dynamics;
mod error;
mod findings;
mod fold;
mod graph;
pub mod instrument;
mod loops;
pub mod prior;
pub mod reference;
mod section;
pub mod sensitivity;
mod shadow;
mod shipped;
mod stage;
pub mod statics;
mod strip;
mod suite;
pub mod tester;
mod vacuum;

pub use check::{Check, Kind};
pub use error::ValidationError;
pub use findings::{Findings, Still};
pub use graph::{Axis, Graph, Layout, Series, Source};
pub use strip::{GRAVITY, Hold, Strip, finish};
pub use suite::{CASES, Case, Outcome, Told};
