//! Tables as instruments and spreadsheets write them, read into series of numbers.
//!
//! ```text
//! bytes ─ encoding ─ text ─ separator ─┐
//!                     spreadsheet ─────┴ grid ─ block (header, units) ─ columns ─ series
//! ```
//!
//! A file needs no declaration: encoding, separator, decimal sign, header, units, columns and
//! repeats are detected, and a sheet may declare each of them ([`layout`]). An ambiguous file is
//! refused: the error names file, line and the key that decides. The chapter knows words, units and
//! numbers. The chapter converts nothing, and knows no curve.
//!
//! * `encoding`, `spreadsheet`, `file`: bytes to grids.
//! * `number`, `grid`, `channel_rows`: cells, decimal signs, separators, and channels in rows.
//! * `heading`, `block`: names and units of columns, and the rows of numbers below them.
//! * `layout`: the layout that a sheet declares.
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
