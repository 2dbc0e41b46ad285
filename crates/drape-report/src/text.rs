//! Symbols, tables and bytes as text.
//!
//! `symbol` splits the index off a symbol, `table` aligns columns,
//! and `base64` encodes pictures for pages. `plot` and `page` use these modules.

pub(crate) mod base64;
pub(crate) mod symbol;
pub(crate) mod table;
