#![doc = include_str!("../README.md")]

mod field;
mod obj;
mod view;

pub use field::{Field, Fields};
pub use obj::write_obj;
pub use view::{Named, View};
