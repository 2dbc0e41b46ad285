#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! * `document`: [`Document`], the text of a TOML file with its path; it decodes the text into a
//!   structure and locates a key for a message.
//! * `diagnostic`: [`Diagnostic`], one mistake with its place and remedy, and [`Diagnostics`], the
//!   error type of this crate: all mistakes of an input.
//! * `spelling`: [`closest`], the known word nearest to a misspelt one.
//! * `quoting`: [`toml_key`] and [`toml_string`], names and texts as TOML.

mod diagnostic;
mod document;
mod quoting;
mod spelling;

pub use diagnostic::{Diagnostic, Diagnostics};
pub use document::Document;
pub use quoting::{toml_key, toml_string};
pub use spelling::closest;
