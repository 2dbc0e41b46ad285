//! Version of the program, as pages show it.

pub(crate) const VERSION: &str = concat!("drape ", env!("CARGO_PKG_VERSION"));
