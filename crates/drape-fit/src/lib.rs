#![doc = include_str!("../README.md")]

mod assumed;
mod bending;
mod curve_fit;
mod elastica;
mod elliptic;
mod error;
mod from_values;
mod history;
mod identify;
pub mod lm;
mod loop_bending;
mod loop_model;
mod measured;
mod shear;
mod tensile;

pub use bending::identify_bending;
pub use curve_fit::{CurveFit, Identified};
pub use error::Error;
pub use from_values::{TensileTarget, bending_from_values, shear_from_values, tensile_from_values};
pub use identify::{Fit, Settings, identify, identify_with};
pub use loop_bending::identify_loop_bending;
pub use loop_model::{FrictionOrder, LoopModel};
pub use shear::identify_shear;
pub use tensile::{TractionModel, identify_tensile};
