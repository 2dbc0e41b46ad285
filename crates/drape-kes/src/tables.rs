//! Tables as instruments and spreadsheets write them, made into series of numbers.
//!
//! ```text
//! bytes ─ encoding ─ text ─ separator ─┐
//!                     spreadsheet ─────┴ grid ─ block (header, units) ─ columns ─ series
//! ```
//!
//! Nothing about a file need be declared: encoding, separator, decimal sign, header, units, columns
//! and repeats are found by what they are, and a sheet may declare each of them ([`layout`]). Where
//! two readings are possible none is taken: the answer names file, line and the key that decides.
//! The chapter knows words, units and numbers; it converts nothing, and knows no curve.
//!
//! * `encoding`, `spreadsheet`, `file`: bytes to grids.
//! * `number`, `grid`, `channel_rows`: cells, decimal signs, separators, rows that are channels.
//! * `heading`, `block`: names and units of columns, and the rows below them.
//! * `layout`: what a sheet declares.
//! * `columns`, `series`, `parts`, `find`: deformation and load, repeats and cycles.
//! * `stated`: gauge and width in the lines above the numbers.

pub(crate) mod block;
pub(crate) mod channel_rows;
pub(crate) mod columns;
pub(crate) mod encoding;
pub(crate) mod file;
pub(crate) mod find;
pub(crate) mod grid;
pub(crate) mod heading;
pub(crate) mod layout;
pub(crate) mod number;
pub(crate) mod parts;
pub(crate) mod series;
pub(crate) mod spreadsheet;
pub(crate) mod stated;
