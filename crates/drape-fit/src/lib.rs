#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! [`identify`] identifies a [`Fit`] from a sheet. Each chapter uses only the chapters above it:
//!
//! * `settings`: which laws are fitted, and how.
//! * `forward`: the loads of a law along a measured history of deformations.
//! * `regression`: initial guesses, multistart search, model selection, uncertainty of one fit.
//! * `curves`: one law from one test: [`identify_tensile`], [`identify_bending`],
//!   [`identify_loop_bending`], [`identify_shear`].
//! * `values`: laws from KES values ([`tensile_from_values`], …) and values from laws
//!   ([`fabric_values`]).
//! * `fabric`: the whole sheet, with defaults for what it lacks; batches of sheets.
#![cfg_attr(docsrs, feature(doc_cfg))]

mod error;
mod settings;
mod threads;
// Loads of a law along a history.
mod forward;
// The regression of one curve.
mod regression;
// One law from curves, from values, and values from laws.
mod curves;
mod values;
// The whole fabric.
mod fabric;

pub use curves::bending::identify_bending;
pub use curves::loop_bending::identify_loop_bending;
pub use curves::prediction::{Prediction, predict_last_cycle};
pub use curves::shear::identify_shear;
pub use curves::tensile::identify_tensile;
pub use error::Error;
pub use fabric::batch::{FittedSheet, identify_all};
pub use fabric::identify::{Fit, identify, identify_with};
pub use fabric::keys::parameter_key;
pub use regression::candidate::{Candidate, Choice};
pub use regression::curve_fit::{CurveFit, Identified};
pub use regression::estimate::{Estimate, Undetermined, ValueEstimate};
pub use settings::model::{FrictionOrder, LoopModel, Plateau, Toe, TractionModel};
pub use settings::weighting::Weighting;
pub use settings::{FitSettings, Intervals};
pub use values::bending::bending_from_values;
pub use values::comparison::{ValueComparison, compare_values};
pub use values::matched::Matched;
pub use values::shear::shear_from_values;
pub use values::simulated::fabric_values;
pub use values::traction::{TensileTarget, tensile_from_values};
