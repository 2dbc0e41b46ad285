//! Sheets of a laboratory: TOML with KES values, and tables of curves beside it, checked and read.
//!
//! ```text
//! sheet.toml ─ spelling ─ file ─┬─ values (checks) ─────────────────┐
//!                               └─ [[curve]] ─ axis ─ (tables) ─ convert ─ checks ─ Curve ─ Sheet
//! ```
//!
//! Units are converted here and nowhere later. All mistakes are collected: each finding has file,
//! line, value and remedy. The chapter uses `values`, `curves` and `tables`. The chapter `exports`
//! uses this one.
//!
//! * `findings`: the list of errors and warnings.
//! * `file`: structs with the keys of the file, and their values as written.
//! * `spelling`: other spellings of the keys; `value_keys`: the values; `compression`: values that
//!   follow from other values of KES-FB3; `listed`: all values, with their use.
//! * `schema`: JSON Schema of the sheet and its curves.
//! * `checks`: values and curves that cannot be right, and the load of the tensile test.
//! * `axis`, `convert`, `curve_file`: a `[[curve]]` made into a curve; `repeats`: curves of
//!   specimens.
//! * `model`, `sheet`: the sheet.

pub(crate) mod axis;
pub(crate) mod checks;
pub(crate) mod compression;
pub(crate) mod convert;
pub(crate) mod curve_file;
pub(crate) mod file;
pub(crate) mod findings;
pub(crate) mod listed;
pub(crate) mod model;
pub(crate) mod repeats;
#[cfg(feature = "schema")]
pub(crate) mod schema;
pub(crate) mod sheet;
pub(crate) mod spelling;
pub(crate) mod value_keys;
