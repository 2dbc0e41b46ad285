//! Conversion of workbooks, tables, archives and folders of exports to sheets.

use std::path::{Path, PathBuf};

use drape::kes::SheetDraft;

use super::arguments::ConvertArguments;
use crate::commands::sheets::{SHEET_FILE, drafted};
use crate::console::print_message;
use crate::failure::Failure;
use crate::input;
use crate::say::say;
use drape::run::file;

/// Drafts the sheets of tables and says what was assumed and what needs a word.
pub(crate) fn convert(from: &Path, arguments: &ConvertArguments) -> Result<(), Failure> {
    let for_patterns = [
        ("--unit", arguments.unit.is_some()),
        ("--size", arguments.size.is_some()),
        ("--paper", arguments.paper.is_some()),
        ("--width", arguments.width.is_some()),
    ];
    if let Some((name, _)) = for_patterns.iter().find(|(_, given)| *given) {
        let message = format!("{name} is for patterns, and {} is none", from.display());
        return Err(Failure::Usage(message));
    }
    let to = target(arguments)?;
    // On stdout the sheet is one for the folder of the tables.
    let own = if from.is_dir() { from } else { from.parent().unwrap_or(Path::new("")) };
    let beside = to.as_deref().map_or(own, |to| to.parent().unwrap_or(Path::new("")));
    let drafts = drafted::drafts(from, beside, arguments.fabric.as_deref())?;
    let targets = targets(from, &drafts, arguments, to)?;
    for to in targets.iter().flatten() {
        file::refuse_existing(to, arguments.force, "replace it with --force")?;
    }
    for (draft, to) in drafts.iter().zip(targets) {
        notes(draft);
        let Some(to) = to else {
            say(draft.text.trim_end())?;
            continue;
        };
        file::write(&to, &draft.text)?;
        let SheetDraft { curves, values, open, .. } = draft;
        say(format_args!(
            "written to {}: {curves} curves, {values} values, {open} sections that need a word",
            to.display()
        ))?;
    }
    Ok(())
}

/// Returns the file of each draft, `None` for stdout; refuses one file for several.
fn targets(
    from: &Path,
    drafts: &[SheetDraft],
    arguments: &ConvertArguments,
    to: Option<PathBuf>,
) -> Result<Vec<Option<PathBuf>>, Failure> {
    if drafts.len() == 1 {
        return Ok(vec![to]);
    }
    let folder = arguments.output.as_ref().filter(|path| !input::is_standard(path));
    drafted::refuse_file(from, folder.map_or(Path::new("-.toml"), PathBuf::as_path), drafts)?;
    let folder = folder.map_or(Path::new(""), PathBuf::as_path);
    let file = |draft: &SheetDraft| {
        Some(folder.join(format!("{}.sheet.toml", drafted::name(from, draft, true))))
    };
    Ok(drafts.iter().map(file).collect())
}

/// Returns the file to write: a `*.toml`, or the sheet of a folder; `None` for stdout.
fn target(arguments: &ConvertArguments) -> Result<Option<PathBuf>, Failure> {
    let Some(path) = arguments.output.as_ref().filter(|path| !input::is_standard(path)) else {
        return Ok(None);
    };
    match path.extension().map(|ending| ending.to_ascii_lowercase()) {
        Some(ending) if ending == "toml" => Ok(Some(path.clone())),
        Some(_) if !path.is_dir() => Err(Failure::Usage(format!(
            "-o {}: the sheet of measurements is written as *.toml, or into a folder",
            path.display()
        ))),
        _ => Ok(Some(path.join(SHEET_FILE))),
    }
}

/// Prints the notes of a draft, which are in the sheet too.
fn notes(draft: &SheetDraft) {
    draft.notes.iter().for_each(|note| print_message(format_args!("note: {note}")));
}
