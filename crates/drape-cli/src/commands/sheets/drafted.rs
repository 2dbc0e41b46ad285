//! Sheets drafted from tables: workbooks, tables, archives and folders of exports, with the names
//! of their files.
//!
//! The sheet of a fabric `NAME.toml` is `NAME.sheet.toml` beside it.

use std::path::{Path, PathBuf};

use drape::input::{Diagnostic, Diagnostics};
use drape::kes::{Sheet, SheetDraft};

use crate::commands::sheets::to_diagnostics;
use crate::failure::Failure;
use crate::input;

/// Largest number of characters in the name of a file.
const NAME_MAX: usize = 80;

/// Drafts the sheets of the tables at `path`: all of them, or the one called `fabric`. Paths in the
/// sheets start at `folder`.
pub(crate) fn drafts(
    path: &Path,
    folder: &Path,
    fabric: Option<&str>,
) -> Result<Vec<SheetDraft>, Failure> {
    let drafts = SheetDraft::of_with(path, folder, input::access())
        .map_err(|error| to_diagnostics(error, path))?;
    match fabric {
        None => Ok(drafts),
        Some(fabric) => {
            let draft = SheetDraft::chosen(drafts, path, Some(fabric));
            Ok(vec![draft.map_err(|error| to_diagnostics(error, path))?])
        }
    }
}

/// Reads the sheet of `draft`, whose path is or will be `sheet`.
pub(crate) fn read(draft: &SheetDraft, sheet: &Path) -> Result<Sheet, Diagnostics> {
    if draft.curves + draft.values == 0 {
        let notes = draft.notes.join("; ");
        let message = format!("nothing in the tables can be fitted yet: {notes}");
        let help = format!("complete the sheet, and fit it: drape fit {}", sheet.display());
        return Err(Diagnostic::new(sheet, message).help(help).into());
    }
    let document = input::with_settings(sheet, &draft.text)?;
    draft.read_document(document).map_err(|error| to_diagnostics(error, sheet))
}

/// Refuses a single file `output` for several `drafts`.
pub(crate) fn refuse_file(
    path: &Path,
    output: &Path,
    drafts: &[SheetDraft],
) -> Result<(), Failure> {
    if output.extension().is_none_or(|ending| ending != "toml") {
        return Ok(());
    }
    let names: Vec<String> = drafts.iter().map(|draft| format!("\"{}\"", draft.name)).collect();
    Err(Failure::Usage(format!(
        "{} holds several fabrics, {}: take one with --fabric NAME, or all of them with -o FOLDER",
        path.display(),
        names.join(", ")
    )))
}

/// Returns the name for the files of `draft`: the name of the tables at `path`, or with `several`
/// fabrics the name of the fabric.
pub(crate) fn name(path: &Path, draft: &SheetDraft, several: bool) -> String {
    let full_path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let stem = if path.is_dir() { full_path.file_name() } else { full_path.file_stem() };
    let stem = stem.map_or("fabric".into(), |stem| stem.to_string_lossy().into_owned());
    if several { file_name(&draft.name) } else { file_name(&stem) }
}

/// Returns the path of the sheet beside the file `fabric`.
pub(crate) fn sheet_beside(fabric: &Path) -> PathBuf {
    let name =
        fabric.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let stem = name.strip_suffix(".toml").unwrap_or(&name);
    fabric.with_file_name(format!("{stem}.sheet.toml"))
}

/// Returns `name` as the name of a file. Blanks and characters that a file system refuses become
/// hyphens.
pub(crate) fn file_name(name: &str) -> String {
    let characters = name.trim().chars().map(|character| match character {
        '/' | '\\' | ':' | '*' | '?' | '"' | '<' | '>' | '|' => '-',
        _ if character.is_control() || character.is_whitespace() => '-',
        _ => character,
    });
    let hyphenated: String = characters.take(NAME_MAX).collect();
    let file_name = hyphenated.trim_matches(['.', '-']);
    if file_name.is_empty() { "fabric".to_owned() } else { file_name.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_has_the_name_of_its_fabric() {
        let of = |path: &str| sheet_beside(Path::new(path));
        assert_eq!(of("a/cloth.toml"), Path::new("a/cloth.sheet.toml"));
        assert_eq!(of("cloth"), Path::new("cloth.sheet.toml"));
        assert_eq!(file_name(" wool 2/1: \"blue\" "), "wool-2-1---blue");
        assert_eq!(file_name("../.."), "fabric");
    }
}
