#![doc = include_str!("../README.md")]

mod bliman_sorine;
mod dahl;
mod slip;

pub use bliman_sorine::{BlimanSorine, Loads};
pub use dahl::Dahl;
pub use slip::Slip;
