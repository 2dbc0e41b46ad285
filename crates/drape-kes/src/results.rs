//! Values in tables of results: of KES, of FAST and of cantilevers, in rows or in columns, of one
//! fabric or of several.
//!
//! ```text
//! grid ─ matrix ─ table (label, heads) ─ reading (number) ─ fabrics ─ average ┐
//!                                          several sheets and files ──────────┴ converted
//! ```
//!
//! A cell beside numbers is split by words of nine languages into an item, a unit, a direction, a
//! specimen and a statistic. The items of a table stand below each other, each with its numbers in
//! its row, or beside each other, each with its numbers in its column. Specimens are averaged.
//! Numbers and cells without a use are noted with the reason. The chapter uses `tables` and the
//! spellings of `sheets`. The chapter knows no file.
//!
//! * `item`, `label`: items, and the text of a cell split by words and units.
//! * `number`: the number of a cell, with its scatter.
//! * `matrix`, `heads`, `table`: cells without the cells of curves, heads of columns, and numbers
//!   with their items.
//! * `reading`: numbers in their units; `fabrics`: names of fabrics or specimens; `average`: means
//!   of specimens.
//! * `sheet_results`: the values of one sheet of a file.
//! * `sheet_value`, `cantilever`, `fast`, `converted`: values of one fabric, converted to values of
//!   a sheet.

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
