//! Conversion of workbooks, tables, archives and folders of exports to sheets.

use std::path::{Path, PathBuf};

use drape::input::counted;
use drape::kes::SheetDraft;

use super::arguments::ConvertArguments;
use crate::commands::sheets::{SHEET_FILE, drafted};
use crate::console::print_message;
use crate::failure::Failure;
use crate::input;
use crate::say::say;
use drape::run::file;

/// Drafts the sheets of the tables at `from`, and prints the assumptions and the sections that the
/// user has to complete.
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
    // On stdout the paths of the sheet start at the folder of the tables.
    let tables_folder = if from.is_dir() { from } else { from.parent().unwrap_or(Path::new("")) };
    let sheet_folder =
        to.as_deref().map_or(tables_folder, |to| to.parent().unwrap_or(Path::new("")));
    let drafts = drafted::drafts(from, sheet_folder, arguments.fabric.as_deref())?;
    let targets = targets(from, &drafts, arguments, to)?;
    for to in targets.iter().flatten() {
        file::refuse_existing(to, arguments.force, "replace it with --force")?;
    }

    for (draft, to) in drafts.iter().zip(targets) {
        print_notes(draft);
        let Some(to) = to else {
            say(draft.text.trim_end())?;
            continue;
        };
        file::write(&to, &draft.text)?;
        let SheetDraft { curves, values, open, .. } = draft;
        say(format_args!(
            "written to {}: {}, {}, {} that need a word",
            to.display(),
            counted(*curves, "curve", "curves"),
            counted(*values, "value", "values"),
            counted(*open, "section", "sections"),
        ))?;
    }
    Ok(())
}

/// Returns the file of each draft, or `None` for stdout. `to` is the file of a single draft.
/// Refuses a single file for several drafts.
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
    let names = drafts.iter().map(|draft| drafted::name(from, draft, true));
    Ok(names.map(|name| Some(folder.join(format!("{name}.sheet.toml")))).collect())
}

/// Returns the file to write, a `*.toml` or the sheet of a folder, or `None` for stdout.
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

/// Prints the notes of `draft`, which the sheet contains as well.
fn print_notes(draft: &SheetDraft) {
    draft.notes.iter().for_each(|note| print_message(format_args!("note: {note}")));
}
