#![doc = include_str!("../README.md")]

mod branch;
mod curve;
mod curve_file;
mod error;
mod loop_values;
mod model;
mod plausible;
mod reading;
mod section;
mod sheet;
mod suspect;
mod table;
mod tensile;
mod unit;
mod values;

pub use branch::{Branch, reversals};
pub use curve::{Curve, Direction, Test};
pub use error::Error;
pub use loop_values::{BendingPoints, BendingValues, ShearPoints, ShearValues};
pub use model::Model;
pub use reading::{Reading, Symbol};
pub use sheet::Sheet;
pub use tensile::TensileValues;
pub use values::Values;
