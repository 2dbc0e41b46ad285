//! `drape convert`: converts files of other programs to TOML, and patterns to drawings.
//!
//! [`sheet`] drafts sheets from workbooks, tables and the exports of instruments. [`pattern`]
//! converts patterns: GarmentCode, FreeSewing, SVG and DXF to TOML, and any of them to SVG for a
//! plotter or for pages of paper, and to DXF.

mod arguments;
mod pattern;
mod sheet;

pub(crate) use arguments::ConvertArguments;

use crate::commands::sheets;
use crate::failure::Failure;

/// Executes `drape convert`.
pub(crate) fn convert(arguments: &ConvertArguments) -> Result<(), Failure> {
    match &arguments.from[..] {
        [path] if path.is_dir() || sheets::holds_tables(path) => sheet::convert(path, arguments),
        [path] => pattern::convert(path, arguments),
        _ => {
            Err(Failure::Usage("one pattern, file or folder at a time; each has its own -o".into()))
        }
    }
}
