#![doc = include_str!("../README.md")]

mod bias;
mod check;
mod crease;
mod decrement;
pub mod drapemeter;
mod drapes;
pub mod dynamics;
mod error;
pub mod instrument;
mod loops;
pub mod reference;
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
pub use strip::{GRAVITY, Hold, Strip, finish};
pub use suite::{CASES, Case, Outcome};
