//! Conversion of a folder of exports to a sheet.

use std::path::{Path, PathBuf};

use drape::input::{Diagnostic, Diagnostics};
use drape::kes::{Error, SheetDraft};

use super::arguments::ConvertArguments;
use crate::commands::sheets::SHEET_FILE;
use crate::console::tell;
use crate::failure::Failure;
use crate::input;
use crate::say::say;
use drape::file;

/// Drafts the sheet of a folder and says what was assumed and what needs a word.
pub(crate) fn convert(folder: &Path, arguments: &ConvertArguments) -> Result<(), Failure> {
    let for_patterns = [
        ("--unit", arguments.unit.is_some()),
        ("--size", arguments.size.is_some()),
        ("--paper", arguments.paper.is_some()),
        ("--width", arguments.width.is_some()),
    ];
    if let Some((name, _)) = for_patterns.iter().find(|(_, given)| *given) {
        let message = format!("{name} is for patterns, and {} is a folder", folder.display());
        return Err(Failure::Usage(message));
    }
    let to = target(arguments)?;
    // On stdout the sheet is one for the folder of the exports.
    let beside = to.as_deref().map_or(folder, |to| to.parent().unwrap_or(Path::new("")));
    if let Some(to) = &to {
        file::refuse_existing(to, arguments.force, "replace it with --force")?;
    }
    let draft = SheetDraft::of_folder(folder, beside).map_err(|error| match error {
        Error::Input(mistakes) => Failure::Input(mistakes),
        other => Failure::Input(Diagnostics::from(Diagnostic::new(folder, other.to_string()))),
    })?;
    notes(&draft);
    let Some(to) = to else { return say(draft.text.trim_end()) };
    file::write(&to, &draft.text)?;
    let SheetDraft { curves, values, open, .. } = draft;
    say(format_args!(
        "written to {}: {curves} curves, {values} values, {open} sections that need a word",
        to.display()
    ))
}

/// Returns the file to write: a `*.toml`, or the sheet of a folder; `None` for stdout.
fn target(arguments: &ConvertArguments) -> Result<Option<PathBuf>, Failure> {
    let Some(path) = arguments.output.as_ref().filter(|path| !input::is_standard(path)) else {
        return Ok(None);
    };
    match path.extension().map(|ending| ending.to_ascii_lowercase()) {
        Some(ending) if ending == "toml" => Ok(Some(path.clone())),
        Some(_) if !path.is_dir() => Err(Failure::Usage(format!(
            "-o {}: the sheet of a folder of exports is written as *.toml, or into a folder",
            path.display()
        ))),
        _ => Ok(Some(path.join(SHEET_FILE))),
    }
}

/// Prints the notes of a draft, which are in the sheet too.
fn notes(draft: &SheetDraft) {
    draft.notes.iter().for_each(|note| tell(format_args!("note: {note}")));
}
