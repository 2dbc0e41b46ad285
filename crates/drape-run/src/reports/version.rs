//! Version of the program, as pages show it.

/// Name and version of the program.
pub const VERSION: &str = concat!("drape ", env!("CARGO_PKG_VERSION"));
