#![doc = include_str!("../README.md")]

mod check;
pub mod dynamics;
mod error;
pub mod reference;
pub mod statics;
mod strip;

pub use check::Check;
pub use error::ValidationError;
pub use strip::{GRAVITY, Hold, Strip, finish};
