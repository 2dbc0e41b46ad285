#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! * `document`: [`Document`], the text of a TOML file with its path. A document decodes the text
//!   into a structure and locates a key for a message. An [`Alias`] is another spelling of a key.
//! * `decode`: the decoder, which reports all mistakes at once, and [`Faults`], the mistakes with
//!   the keys whose values were left out. A type with [`FromLiteral`] may be written in several
//!   forms.
//! * `grammar`: mistakes of TOML grammar.
//! * `given`: [`Given`], a number with or without a unit. `unit`: the units.
//! * `diagnostic`: [`Diagnostic`], one mistake with its place and remedy, and [`Diagnostics`], the
//!   error type of this crate: all mistakes of an input. [`Subject`] is the part of an input that a
//!   mistake concerns. A [`Remedy`] is an action that corrects a mistake, which a program puts in
//!   its own words, and [`Advice`] is a text with a remedy. An [`Edit`] is a change of a file that
//!   corrects a mistake. [`apply_edits`] makes such changes.
//! * `spelling`: [`closest`], the known word nearest to a misspelt word.
//! * `setting`: [`Setting`], a value that replaces a value of a text, such as on a command line.
//! * `file_access`: [`FileAccess`], what a reader of a document allows its files,
//!   [`AllowedFolders`], the folders with the files that a document may name, and [`SizeLimit`],
//!   which reads files up to a size.
//! * `quoting`: [`toml_key`] and [`toml_string`], names and texts as TOML, and [`xml_text`], texts
//!   as XML.
//! * `schema`: JSON Schema of numbers with units, with the feature `schema`.
//! * `figure`: [`figure`](fn@figure), [`Notation`], [`excerpt`] and others, numbers and texts in
//!   messages, on pages and in tables.
#![cfg_attr(docsrs, feature(doc_cfg))]

mod decode;
mod diagnostic;
mod document;
mod figure;
mod file_access;
mod given;
mod grammar;
mod node;
mod quoting;
#[cfg(feature = "schema")]
mod schema;
mod setting;
mod spelling;
mod unit;

pub use decode::Faults;
pub use decode::form::{FromLiteral, Literal, Refusal, deserialize_literal};
pub use diagnostic::advice::Advice;
pub use diagnostic::edit::{Edit, EditError, apply_edits};
pub use diagnostic::remedy::{FilePurpose, Remedy};
pub use diagnostic::subject::Subject;
pub use diagnostic::value_error::ValueError;
pub use diagnostic::{Diagnostic, Diagnostics};
pub use document::Document;
pub use document::alias::Alias;
pub use figure::{
    Notation, brief, counted, duration_in_words, excerpt, figure, figure_above, figure_below,
    figure_in_decimals, figure_in_digits, figure_in_range, figures, percent, round_decimals,
    round_digits, signed_percent, significant, size_in_words, tidy, typeset, with_error,
};
pub use file_access::FileAccess;
pub use file_access::allowed_folders::{AllowedFolders, ForbiddenPath};
pub use file_access::similar_file::{missing_file_help, similar_file};
pub use file_access::size_limit::{SizeLimit, TooLarge};
pub use given::{
    Acceleration, Angle, AngularSpeed, BendingRigidity, Curvature, Density, Dimension,
    ForcePerWidth, Given, Length, MassPerArea, Metres, MomentPerWidth, PressurePerDistance, Ratio,
    Roughness, ShearStiffness, Speed, TextOr, Time, Velocity, WorkPerArea,
};
pub use node::key_path::{KeyPath, KeyStep};
pub use quoting::{toml_key, toml_string, xml_text};
#[cfg(feature = "schema")]
pub use schema::{
    at_least, between, laboratory_schema, one_of, positive, schema_of, unit_schema, within,
};
pub use setting::{Setting, SettingError};
pub use spelling::{closest, unknown_word};
pub use unit::{NumberWithUnit, Quantity, Unit, is_unit, parse_quantity, parse_unit};
