//! Numbers, symbols, tables and bytes as text.
//!
//! `number` rounds and typesets, `symbol` splits the index off a symbol, `table` aligns columns,
//! and `base64` encodes pictures for pages. `plot` and `page` use these modules.

pub(crate) mod base64;
pub(crate) mod number;
pub(crate) mod symbol;
pub(crate) mod table;
