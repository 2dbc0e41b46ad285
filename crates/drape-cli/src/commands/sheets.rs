//! Sheets that the command line names: their paths, their names and their mistakes. [`drafted`]
//! drafts sheets from tables.

pub(crate) mod drafted;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use drape::input::{Diagnostic, Diagnostics};
use drape::kes::{Sheet, SheetDraft};
use drape::run::file::FileKind;

use crate::failure::Failure;
use crate::input;
pub(crate) use crate::input::SHEET_FILE;

/// Deepest level of subfolders that is searched, so that a link to a folder above does not make the
/// search endless.
const DEEPEST: usize = 8;

/// Returns the sheets that `paths` name: sheet files, folders with a sheet, and sheets in
/// subfolders.
pub(crate) fn find_sheets(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut sheets = Vec::new();
    for path in paths {
        expect_sheet_or_export(path)?;
        if !path.is_dir() || path.join(SHEET_FILE).exists() {
            sheets.push(path.clone());
            continue;
        }
        let mut sheets_below = BTreeSet::new();
        search(path, DEEPEST, &mut sheets_below)?;
        if sheets_below.is_empty() {
            let message = format!("{} holds no {SHEET_FILE}", path.display());
            return Err(Failure::Usage(message));
        }
        sheets.extend(sheets_below);
    }
    Ok(sheets)
}

/// Refuses a `path` that is neither a sheet nor an export of an instrument.
fn expect_sheet_or_export(path: &Path) -> Result<(), Diagnostics> {
    match input::kind(path) {
        Some(FileKind::Table | FileKind::Workbook | FileKind::Archive) => Ok(()),
        _ => input::expect(path, &[FileKind::Sheet]),
    }
}

/// Adds the folders with a sheet inside `folder` to `sheets_below`, at most `depth` levels of
/// subfolders down.
fn search(
    folder: &Path,
    depth: usize,
    sheets_below: &mut BTreeSet<PathBuf>,
) -> Result<(), Failure> {
    for path in entries(folder)? {
        if path.is_dir() && path.join(SHEET_FILE).exists() {
            sheets_below.insert(path);
        } else if path.is_dir() && depth > 0 {
            search(&path, depth - 1, sheets_below)?;
        }
    }
    Ok(())
}

/// Returns the paths of the entries of `folder`.
pub(crate) fn entries(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let read = std::fs::read_dir(folder);
    let paths = read.and_then(|entries| entries.map(|entry| Ok(entry?.path())).collect());
    paths.map_err(|error| Failure::Output(format!("cannot read {}: {error}", folder.display())))
}

/// Returns whether `path` names tables: a workbook, a table, an archive, or a folder without a
/// sheet in it or below.
pub(crate) fn holds_tables(path: &Path) -> bool {
    let kinds = [FileKind::Table, FileKind::Workbook, FileKind::Archive];
    if input::kind(path).is_some_and(|kind| !kinds.contains(&kind)) {
        return false;
    }
    if path.is_dir() {
        let mut sheets_below = BTreeSet::new();
        let is_sheet = path.join(SHEET_FILE).exists();
        return !is_sheet
            && search(path, DEEPEST, &mut sheets_below).is_ok()
            && sheets_below.is_empty();
    }
    !input::is_standard(path) && SheetDraft::reads(path)
}

/// Returns the name for the files of `sheet`: the name of its folder, or of the file if that is not
/// `sheet.toml`.
pub(crate) fn stem(sheet: &Path) -> String {
    let sheet = input::path_for_results(sheet);
    let source = if sheet.file_name().is_some_and(|name| name == SHEET_FILE) {
        sheet.parent().filter(|folder| folder.file_name().is_some()).unwrap_or(sheet)
    } else {
        sheet
    };
    let name = if source.is_dir() { source.file_name() } else { source.file_stem() };
    let name = name.map_or("fabric".into(), |name| name.to_string_lossy().into_owned());
    // A drafted sheet is called NAME.sheet.toml.
    name.strip_suffix(".sheet").filter(|name| !name.is_empty()).map_or(name.clone(), str::to_owned)
}

/// Returns the default path of the fabric of `sheet`: `fabric.toml` in the sheet's folder, and
/// `NAME.toml` for a sheet `NAME.sheet.toml`.
pub(crate) fn fabric_beside(sheet: &Path) -> PathBuf {
    let folder = if sheet.is_dir() { sheet } else { sheet.parent().unwrap_or(Path::new("")) };
    let name = sheet.file_name().map(|name| name.to_string_lossy().into_owned());
    let stem = name.as_deref().and_then(|name| name.strip_suffix(".sheet.toml"));
    folder.join(stem.map_or("fabric.toml".to_owned(), |stem| format!("{stem}.toml")))
}

/// Returns `path` if it is a sheet or a folder with a sheet. A fabric or another file gives `None`.
pub(crate) fn sheet_path(path: &Path) -> Option<&Path> {
    if path.is_dir() {
        return path.join(SHEET_FILE).exists().then_some(path);
    }
    let table: toml::Table = input::document(path).ok()?.text().parse().ok()?;
    // Only fabrics have these keys at the top level.
    let is_fabric = table.contains_key("density") || table.contains_key("shear");
    (!is_fabric).then_some(path)
}

/// Reads the sheet at `path`.
pub(crate) fn read(path: &Path) -> Result<Sheet, Diagnostics> {
    let document = input::document(&input::sheet_file(path))?;
    FileKind::expect_document(&document, &[FileKind::Sheet])?;
    Sheet::from_document(&document).map_err(|error| to_diagnostics(error, path))
}

/// Returns `error`, of the file at `path`, as mistakes of the input.
pub(crate) fn to_diagnostics(error: drape::kes::Error, path: &Path) -> Diagnostics {
    match error {
        drape::kes::Error::Input(diagnostics) => diagnostics,
        error => Diagnostic::new(input::message_path(path), error.to_string()).into(),
    }
}
