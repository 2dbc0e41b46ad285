//! `drape convert`: files of others to the project's own, and patterns to drawings.
//!
//! [`sheet`] makes workbooks, tables and the exports of instruments into sheets.
//! [`pattern`] converts patterns: GarmentCode, FreeSewing, SVG and DXF to TOML, and any of them to SVG for a
//! plotter or for pages of paper. A further kind of file is a further module, chosen by what it is made from.

mod arguments;
mod pattern;
mod sheet;

pub(crate) use arguments::ConvertArguments;

use crate::commands::sheets;
use crate::failure::Failure;

/// Executes `drape convert`.
pub(crate) fn convert(arguments: &ConvertArguments) -> Result<(), Failure> {
    match &arguments.from[..] {
        [one] if one.is_dir() || sheets::is_of_tables(one) => sheet::convert(one, arguments),
        [one] => pattern::convert(one, arguments),
        _ => {
            Err(Failure::Usage("one pattern, file or folder at a time; each has its own -o".into()))
        }
    }
}
