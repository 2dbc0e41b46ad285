#![doc = include_str!("../README.md")]

mod bending;
mod curve_fit;
mod error;
mod friction_order;
mod history;
pub mod lm;
mod shear;
mod tensile;

pub use bending::{identify_bending, identify_bending_piecewise};
pub use curve_fit::{CurveFit, Identified};
pub use error::Error;
pub use friction_order::FrictionOrder;
pub use shear::identify_shear;
pub use tensile::{TractionModel, identify_tensile};
