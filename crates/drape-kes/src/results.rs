//! Values in tables of results: of KES, of FAST and of cantilevers, in rows or in columns, of one
//! fabric or of several.
//!
//! ```text
//! grid ─ matrix ─ table (label, heads) ─ reading (number) ─ fabrics ─ average ┐
//!                                          several sheets and files ──────────┴ converted (cantilever, fast)
//! ```
//!
//! A cell beside numbers is taken apart by words of nine languages: an item, its unit, a direction,
//! a specimen, a statistic. The items of a table stand below each other, each with its numbers in
//! its row, or beside each other, each with its numbers in its column. Specimens are averaged. What
//! has no use is noted with its reason. The chapter uses `tables` and the spellings of `sheets`,
//! and knows no file.
//!
//! * `item`, `label`: items, and the text of a cell taken apart by words and units.
//! * `number`: the number of a cell, with its scatter.
//! * `matrix`, `heads`, `table`: cells without those of curves, heads of columns, numbers with
//!   their items.
//! * `reading`: numbers in their units; `fabrics`: names of fabrics or specimens; `average`: their
//!   means.
//! * `sheet_results`: the values of one sheet of a file.
//! * `sheet_value`, `cantilever`, `fast`, `converted`: values of a sheet of a fabric.

pub(crate) mod average;
pub(crate) mod cantilever;
pub(crate) mod converted;
pub(crate) mod fabrics;
pub(crate) mod fast;
pub(crate) mod heads;
pub(crate) mod item;
pub(crate) mod label;
pub(crate) mod matrix;
pub(crate) mod number;
pub(crate) mod reading;
pub(crate) mod sheet_results;
pub(crate) mod sheet_value;
pub(crate) mod table;
