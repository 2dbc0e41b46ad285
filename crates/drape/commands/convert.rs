//! `drape convert`: files of others to the project's own, and patterns to drawings.
//!
//! [`pattern`] converts patterns: GarmentCode, FreeSewing, SVG and DXF to TOML, and any of them to SVG for a
//! plotter or for pages of paper. A further kind of file is a further module, chosen by what it is made from.

mod arguments;
mod pattern;

pub(crate) use arguments::ConvertArguments;

use crate::failure::Failure;

/// Executes `drape convert`.
pub(crate) fn convert(arguments: &ConvertArguments) -> Result<(), Failure> {
    match &arguments.from[..] {
        [one] if one.is_dir() => {
            let message = format!("{} is a folder, and no pattern", one.display());
            Err(Failure::Usage(format!("{message}; name a *.json, *.svg, *.dxf or *.toml in it")))
        }
        [one] => pattern::convert(one, arguments),
        _ => Err(Failure::Usage("one pattern at a time; each has its own -o".into())),
    }
}
