#![doc = include_str!("../README.md")]

mod obj;

pub use obj::write_obj;
