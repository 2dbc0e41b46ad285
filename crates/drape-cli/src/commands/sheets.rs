//! Sheets that paths of the command line stand for: where they are, what they are called, and their
//! mistakes; and tables, of which sheets are drafted ([`drafted`]).

pub(crate) mod drafted;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use drape::input::{Diagnostic, Diagnostics};
use drape::kes::{Sheet, SheetDraft};
use drape::run::file::FileKind;

use crate::failure::Failure;
use crate::input;
pub(crate) use crate::input::SHEET_FILE;

/// Deepest folder that is searched, counted from the one that was named: a link back up would never
/// end.
const DEEPEST: usize = 8;

/// Returns the sheets that paths stand for: files, folders with a sheet, and sheets in the folders
/// below.
pub(crate) fn sheets(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut sheets = Vec::new();
    for path in paths {
        refuse_others(path)?;
        if !path.is_dir() || path.join(SHEET_FILE).exists() {
            sheets.push(path.clone());
            continue;
        }
        let mut found = BTreeSet::new();
        search(path, DEEPEST, &mut found)?;
        if found.is_empty() {
            let message = format!("{} holds no {SHEET_FILE}", path.display());
            return Err(Failure::Usage(message));
        }
        sheets.extend(found);
    }
    Ok(sheets)
}

/// Refuses what is no sheet, and no export of an instrument either.
fn refuse_others(path: &Path) -> Result<(), Diagnostics> {
    match FileKind::of(path) {
        Some(FileKind::Table | FileKind::Workbook | FileKind::Archive) => Ok(()),
        _ => input::expect(path, &[FileKind::Sheet]),
    }
}

fn search(folder: &Path, depth: usize, found: &mut BTreeSet<PathBuf>) -> Result<(), Failure> {
    let unreadable = |error| Failure::Output(format!("cannot read {}: {error}", folder.display()));
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.is_dir() && path.join(SHEET_FILE).exists() {
            found.insert(path);
        } else if path.is_dir() && depth > 0 {
            search(&path, depth - 1, found)?;
        }
    }
    Ok(())
}

/// Returns whether a path stands for tables: a workbook, a table, an archive, or a folder without a sheet in it or
/// below.
pub(crate) fn is_of_tables(path: &Path) -> bool {
    let kinds = [FileKind::Table, FileKind::Workbook, FileKind::Archive];
    if FileKind::of(path).is_some_and(|kind| !kinds.contains(&kind)) {
        return false;
    }
    if path.is_dir() {
        let mut found = BTreeSet::new();
        let is_sheet = path.join(SHEET_FILE).exists();
        return !is_sheet && search(path, DEEPEST, &mut found).is_ok() && found.is_empty();
    }
    !input::is_standard(path) && SheetDraft::reads(path)
}

/// Returns the name that the files of a sheet get: its folder's, or the file's.
pub(crate) fn stem(sheet: &Path) -> String {
    let sheet = input::result_path(sheet);
    let named = if sheet.file_name().is_some_and(|name| name == SHEET_FILE) {
        sheet.parent().filter(|folder| folder.file_name().is_some()).unwrap_or(sheet)
    } else {
        sheet
    };
    let name = if named.is_dir() { named.file_name() } else { named.file_stem() };
    let name = name.map_or("fabric".into(), |name| name.to_string_lossy().into_owned());
    // That of a drafted sheet is NAME.sheet.toml.
    name.strip_suffix(".sheet").filter(|name| !name.is_empty()).map_or(name.clone(), str::to_owned)
}

/// Returns the default path of the fabric of a sheet: `fabric.toml` in the sheet's folder, and `NAME.toml` for a sheet
/// `NAME.sheet.toml`.
pub(crate) fn fabric_beside(sheet: &Path) -> PathBuf {
    let folder = if sheet.is_dir() { sheet } else { sheet.parent().unwrap_or(Path::new("")) };
    let name = sheet.file_name().map(|name| name.to_string_lossy().into_owned());
    let stem = name.as_deref().and_then(|name| name.strip_suffix(".sheet.toml"));
    folder.join(stem.map_or("fabric.toml".to_owned(), |stem| format!("{stem}.toml")))
}

/// Returns the sheet that a path stands for, if it is one: a file called so, or a folder with it; a
/// fabric or anything else is none.
pub(crate) fn of(path: &Path) -> Option<&Path> {
    if path.is_dir() {
        return path.join(SHEET_FILE).exists().then_some(path);
    }
    let table: toml::Table = input::document(path).ok()?.text().parse().ok()?;
    // A fabric has its laws in these tables.
    let is_fabric = table.contains_key("density") || table.contains_key("shear");
    (!is_fabric).then_some(path)
}

/// Reads a sheet.
pub(crate) fn read(path: &Path) -> Result<Sheet, Diagnostics> {
    let document = input::document(&input::sheet_file(path))?;
    FileKind::expect_document(&document, &[FileKind::Sheet])?;
    Sheet::from_document(&document).map_err(|error| in_input(error, path))
}

/// Returns the mistakes of an error about a file.
pub(crate) fn in_input(error: drape::kes::Error, path: &Path) -> Diagnostics {
    match error {
        drape::kes::Error::Input(diagnostics) => diagnostics,
        other => Diagnostic::new(input::message_path(path), other.to_string()).into(),
    }
}
