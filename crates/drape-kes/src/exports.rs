//! Files of a laboratory made into sheets: a workbook, a folder of exports, an archive in, a
//! commented `sheet.toml` out.
//!
//! ```text
//! files ─ file (tables) ─┬─ evidence ─ found ─ curve_draft, verified by Sheet ─┐
//!                        ├─ compression ───────────────────────────────────────┼─ parts ─ fabrics ─ draft: TOML, notes
//!                        └─ results ─ value_lines ─────────────────────────────┘
//! ```
//!
//! Test and direction are told by titles, headings and names; what was detected is written as keys,
//! each with its reason. A section that the reader of sheets does not take as it stands is written
//! as a comment with the reason. The chapter uses `tables`, `sheets`, `curves`, `results`; nothing
//! uses it.
//!
//! * `files`: the files of a folder, of an archive, or one.
//! * `evidence`: texts near a table, and the test and direction that they name.
//! * `curve_draft`: a `[[curve]]` with its keys and their reasons, and its verification.
//! * `found`: the curves of one file; `compression`: KES values of compression curves.
//! * `parts`: what all files hold; `fabrics`: the same by fabric.
//! * `value_lines`, `draft`: the lines of values, and the whole sheet.

pub(crate) mod compression;
pub(crate) mod curve_draft;
pub(crate) mod draft;
pub(crate) mod evidence;
pub(crate) mod fabrics;
pub(crate) mod files;
pub(crate) mod found;
pub(crate) mod parts;
pub(crate) mod value_lines;
