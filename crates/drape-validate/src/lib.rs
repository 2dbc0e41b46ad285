#![doc = include_str!("../README.md")]

mod check;
pub mod dynamics;
mod error;
pub mod reference;
pub mod statics;
mod strip;
mod suite;

pub use check::{Check, Kind};
pub use error::ValidationError;
pub use strip::{GRAVITY, Hold, Strip, finish};
pub use suite::{CASES, Case, Outcome};
