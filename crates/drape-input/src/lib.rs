#![doc = include_str!("../README.md")]

mod diagnostic;
mod document;
mod spelling;

pub use diagnostic::{Diagnostic, Diagnostics};
pub use document::Document;
pub use spelling::{closest, toml_key, toml_string};
