#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! [`Sheet::read`] reads a laboratory's sheet with its [`Curve`]s and [`Values`];
//! [`Curve::values`] computes KES values from a curve.
//!
//! * `test`, `symbol`, `values`, `scatter`: the KES values of one direction, in laboratory units
//!   and in SI, and the standard deviations of the values.
//! * `test_record`: [`TestRecord`], the customer, date and laboratory of a test.
//! * `curves`: [`Curve`], its branches, and the KES values that are read from a curve at
//!   [`EvaluationPoints`].
//! * `tables`: reads files of instruments and spreadsheets into columns of numbers.
//! * `results`: reads tables of KES values, as laboratories and publications print them.
//! * `sheets`: [`Sheet`], its TOML and table files, and the checks of values and curves.
//! * `exports`: [`SheetDraft`], a sheet drafted from a folder of exported files.
#![cfg_attr(docsrs, feature(doc_cfg))]

mod error;
// Tests, and the values that they give.
mod scatter;
mod symbol;
mod test;
mod test_record;
mod values;
// Curves, and the values read off them.
mod curves;
// Sheets and their files.
mod sheets;
// Tables of results.
mod results;
// Tables of any instrument.
mod tables;
// Folders of exports, drafted as sheets.
mod exports;

pub use curves::branch::{Branch, reversals};
pub use curves::curve::Curve;
pub use curves::evaluation::{CurveValue, EvaluationPoints};
pub use curves::extent::Extent;
pub use curves::loop_values::{BendingPoints, BendingValues, ShearPoints, ShearValues};
pub use curves::preparation::{Preparation, Rupture};
pub use curves::steady::SteadyPath;
pub use curves::tensile_values::TensileValues;
pub use error::Error;
pub use exports::draft::SheetDraft;
pub use scatter::{OtherScatter, Scatter};
pub use sheets::listed::SheetValue;
pub use sheets::model::Model;
#[cfg(feature = "schema")]
pub use sheets::schema::sheet_schema;
pub use sheets::sheet::Sheet;
pub use symbol::Symbol;
pub use test::{Direction, Test};
pub use test_record::TestRecord;
pub use values::Values;
