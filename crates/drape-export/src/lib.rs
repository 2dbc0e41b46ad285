#![doc = include_str!("../README.md")]

mod field;
mod obj;

pub use field::{Field, Fields};
pub use obj::write_obj;
