//! Sheets drafted from tables: workbooks, tables, archives, folders of exports; and what their files are called.
//!
//! The sheet of a fabric `NAME.toml` is `NAME.sheet.toml` beside it.

use std::path::{Path, PathBuf};

use drape::input::{Diagnostic, Diagnostics};
use drape::kes::{Sheet, SheetDraft};

use crate::commands::sheets::in_input;
use crate::failure::Failure;
use crate::input;

/// Letters of the name of a file at most.
const NAME_MAX: usize = 80;

/// Drafts the sheets of tables, for a folder in which they will lie: of all fabrics, or of one.
pub(crate) fn drafts(
    path: &Path,
    folder: &Path,
    fabric: Option<&str>,
) -> Result<Vec<SheetDraft>, Failure> {
    let drafts = SheetDraft::of(path, folder).map_err(|error| in_input(error, path))?;
    match fabric {
        None => Ok(drafts),
        Some(fabric) => {
            let chosen = SheetDraft::chosen(drafts, path, Some(fabric));
            Ok(vec![chosen.map_err(|error| in_input(error, path))?])
        }
    }
}

/// Reads the sheet of a draft, which lies or will lie at a path.
pub(crate) fn read(draft: &SheetDraft, sheet: &Path) -> Result<Sheet, Diagnostics> {
    if draft.curves + draft.values == 0 {
        let notes = draft.notes.join("; ");
        let message = format!("nothing in the tables can be fitted yet: {notes}");
        let help = format!("complete the sheet, and fit it: drape fit {}", sheet.display());
        return Err(Diagnostic::new(sheet, message).help(help).into());
    }
    let document = input::with_settings(sheet, &draft.text)?;
    draft.read_document(document).map_err(|error| in_input(error, sheet))
}

/// Refuses a single file for several fabrics.
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

/// Returns the name of the files of a draft: that of the tables, with that of the fabric where there are several.
pub(crate) fn name(path: &Path, draft: &SheetDraft, several: bool) -> String {
    let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let stem = if path.is_dir() { whole.file_name() } else { whole.file_stem() };
    let stem = stem.map_or("fabric".into(), |stem| stem.to_string_lossy().into_owned());
    if several { file_name(&draft.name) } else { file_name(&stem) }
}

/// Returns the path of the sheet of a fabric.
pub(crate) fn sheet_beside(fabric: &Path) -> PathBuf {
    let name =
        fabric.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let stem = name.strip_suffix(".toml").unwrap_or(&name);
    fabric.with_file_name(format!("{stem}.sheet.toml"))
}

/// Returns a name as that of a file: signs that a file system does not take, and blanks, are hyphens.
pub(crate) fn file_name(name: &str) -> String {
    let letter = |letter: char| match letter {
        '/' | '\\' | ':' | '*' | '?' | '"' | '<' | '>' | '|' => '-',
        letter if letter.is_control() || letter.is_whitespace() => '-',
        letter => letter,
    };
    let name: String = name.trim().chars().map(letter).take(NAME_MAX).collect();
    let name = name.trim_matches(['.', '-']);
    if name.is_empty() { "fabric".to_owned() } else { name.to_owned() }
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
