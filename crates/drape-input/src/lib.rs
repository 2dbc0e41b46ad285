#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! * `document`: [`Document`], the text of a TOML file with its path; it decodes the text into a
//!   structure and locates a key for a message. [`SizeLimit`], how large files may be.
//! * `decode`: what decodes it, with all mistakes at once, and [`Faults`], which say what was left out.
//! * `grammar`: mistakes of the text itself.
//! * `given`: [`Given`], a number of a structure that may stand with a unit; `unit`: the units.
//! * `diagnostic`: [`Diagnostic`], one mistake with its place and remedy, and [`Diagnostics`], the
//!   error type of this crate: all mistakes of an input.
//!   [`Subject`] is the part of an input that a mistake speaks of, [`Edit`] a change of a file that
//!   remedies one, made by [`apply_edits`].
//! * `spelling`: [`closest`], the known word nearest to a misspelt one.
//! * `setting`: [`Setting`], a value given beside a text, such as on a command line.
//! * `places`: [`AllowedFolders`], the folders below which the files lie that a document may name.
//! * `quoting`: [`toml_key`] and [`toml_string`], names and texts as TOML.
//! * `schema`: JSON Schema of such numbers, with the feature of that name.
//! * `figure`: [`figure`](fn@figure), [`excerpt`] and others, numbers and texts in messages.

mod allowed_folders;
mod decode;
mod diagnostic;
mod document;
mod figure;
mod given;
mod grammar;
mod node;
mod quoting;
#[cfg(feature = "schema")]
mod schema;
mod setting;
mod spelling;
mod unit;

pub use allowed_folders::{AllowedFolders, ForbiddenPath};
pub use decode::Faults;
pub use diagnostic::edit::{Edit, EditError, apply_edits};
pub use diagnostic::subject::Subject;
pub use diagnostic::{Diagnostic, Diagnostics};
pub use document::size_limit::{SizeLimit, TooLarge, raise_size_limits, size_limit_factor};
pub use document::{Document, missing_file_help, similar_file};
pub use figure::{excerpt, figure, figure_above, figure_below, figures, tidy};
pub use given::{
    Acceleration, Angle, AngularSpeed, BendingRigidity, Curvature, Density, Dimension,
    ForcePerWidth, Given, Length, MassPerArea, MomentPerWidth, PressurePerDistance, Ratio,
    ShearStiffness, Speed, TextOr, Time,
};
pub use quoting::{toml_key, toml_string};
#[cfg(feature = "schema")]
pub use schema::{at_least, laboratory_schema, one_of, positive, schema_of, unit_schema, within};
pub use setting::{Setting, SettingError};
pub use spelling::closest;
pub use unit::{NumberWithUnit, Quantity, Unit, UnitError, is_unit, parse_quantity, parse_unit};
