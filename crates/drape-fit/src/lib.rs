#![doc = include_str!("../README.md")]

mod assumed;
mod basis;
mod bending;
mod choice;
mod curve_fit;
mod elastica;
mod elliptic;
mod error;
mod estimate;
mod from_values;
mod history;
mod identify;
mod line;
pub mod lm;
mod loop_bending;
mod loop_model;
mod measured;
mod search;
mod shear;
mod statistics;
mod strokes;
mod tensile;
mod tensile_start;
mod weighting;

pub use bending::identify_bending;
pub use choice::Candidate;
pub use curve_fit::{CurveFit, Identified};
pub use error::Error;
pub use estimate::{Estimate, Unknown};
pub use from_values::{TensileTarget, bending_from_values, shear_from_values, tensile_from_values};
pub use identify::{Fit, Intervals, Settings, identify, identify_with};
pub use loop_bending::identify_loop_bending;
pub use loop_model::{FrictionOrder, LoopModel, Plateau};
pub use shear::identify_shear;
pub use tensile::{Toe, TractionModel, identify_tensile};
pub use weighting::Weighting;
