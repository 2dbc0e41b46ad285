//! Sheets drafted from a laboratory's files. A workbook, a folder of exports or an archive becomes
//! a commented `sheet.toml`.
//!
//! ```text
//! files ─ file (tables) ─┬─ evidence ─ file_curves ─ curve_draft ─┐
//!                        ├─ compression ──────────────────────────┼─ contents ─ fabrics ─ draft
//!                        └─ results ─ value_lines ────────────────┘
//! ```
//!
//! Titles, headings and names tell test and direction. Everything detected is written as a key with
//! its reason. A section that the reader of sheets refuses is written as a comment with the reason.
//! The chapter uses `tables`, `sheets`, `curves` and `results`. No chapter uses it.
//!
//! * `files`: the files of a folder or an archive, or a single file.
//! * `evidence`: texts near a table, and the test and direction that they name.
//! * `curve_draft`: a `[[curve]]` with its keys and their reasons, and its verification.
//! * `file_curves`: the curves of one file; `compression`: KES values of compression curves.
//! * `contents`: the contents of all files; `fabrics`: the contents of each fabric.
//! * `value_lines`, `draft`: the lines of values, and the whole sheet.

pub(crate) mod compression;
pub(crate) mod contents;
pub(crate) mod curve_draft;
pub(crate) mod draft;
pub(crate) mod evidence;
pub(crate) mod fabrics;
pub(crate) mod file_curves;
pub(crate) mod files;
pub(crate) mod value_lines;
