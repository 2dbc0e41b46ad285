//! Exports of instruments made into a sheet: a folder of files in, a commented `sheet.toml` out.
//!
//! ```text
//! folder ─ file (tables) ─┬─ evidence ─ curve_draft ─ verified by Sheet ─┐
//!                         ├─ compression ────────────────────────────────┼─ draft: TOML, notes
//!                         └─ value_table ────────────────────────────────┘
//! ```
//!
//! Test and direction are told by titles, headings and names; what was detected is written as keys,
//! each with its reason. A section that the reader of sheets does not take as it stands is written as
//! a comment with the reason. The chapter uses `tables`, `sheets`, `curves`; nothing uses it.
//!
//! * `evidence`: texts near a table, and the test and direction that they name.
//! * `curve_draft`: a `[[curve]]` with its keys and their reasons, and its verification.
//! * `found`: the curves of one file.
//! * `value_table`, `compression`: KES values of tables of results, and of compression curves.
//! * `draft`: the folder, and the whole sheet.

pub(crate) mod compression;
pub(crate) mod curve_draft;
pub(crate) mod draft;
pub(crate) mod evidence;
pub(crate) mod found;
pub(crate) mod value_table;
