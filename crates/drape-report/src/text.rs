//! Numbers, symbols, tables and bytes as text.
//!
//! `number` rounds and typesets, `symbol` splits the index off a symbol, `table` aligns columns,
//! `base64` encodes pictures for pages. `plot` and `page` use them.

pub(crate) mod base64;
pub(crate) mod number;
pub(crate) mod symbol;
pub(crate) mod table;
