#![doc = include_str!("../README.md")]

mod bliman_sorine;
mod dahl;
mod exponential;
mod slip;
mod stroke;

pub use bliman_sorine::{BlimanSorine, Loads};
pub use dahl::Dahl;
pub use exponential::exp_m1;
pub use slip::Slip;
pub use stroke::{Bend, Slider, Stroke};
