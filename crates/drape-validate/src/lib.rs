#![doc = include_str!("../README.md")]

mod check;
mod error;
pub mod reference;
pub mod statics;
mod strip;

pub use check::Check;
pub use error::ValidationError;
pub use strip::{GRAVITY, Strip, clamp, finish};
