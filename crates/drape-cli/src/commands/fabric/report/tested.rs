//! Fabrics of a report: sheets and tables with their fits, and files of laws.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use drape::fabric::Fabric;
use drape::fit::{Fit, FitSettings, identify_with};
use drape::kes::{Sheet, TestRecord};
use drape::run::file::FileKind;

use crate::commands::sheets::{self, SHEET_FILE, drafted};
use crate::failure::Failure;
use crate::input;

/// Kinds of files that give a fabric.
const KINDS: [FileKind; 2] = [FileKind::Fabric, FileKind::Sheet];

/// Fabric of a report.
pub(super) struct Tested {
    /// Name of its files.
    pub(super) name: String,
    of: Origin,
    /// Notes on where it comes from.
    pub(super) notes: Vec<String>,
}

/// Where the laws of a fabric come from.
enum Origin {
    /// A sheet, with its fit.
    Sheet(Box<(Sheet, Fit)>),
    /// A file of laws.
    Laws(Box<Fabric>),
}

impl Tested {
    /// Returns the laws.
    pub(super) fn fabric(&self) -> &Fabric {
        match &self.of {
            Origin::Sheet(own) => &own.1.fabric,
            Origin::Laws(fabric) => fabric,
        }
    }

    /// Returns what was measured, with its fit.
    pub(super) fn measured(&self) -> Option<(&Sheet, &Fit)> {
        match &self.of {
            Origin::Sheet(own) => Some((&own.0, &own.1)),
            Origin::Laws(_) => None,
        }
    }

    /// Returns the record of the sheet.
    pub(super) fn record(&self) -> TestRecord {
        self.measured().map(|(sheet, _)| sheet.record.clone()).unwrap_or_default()
    }

    /// Fits a sheet that was read.
    fn of_sheet(name: String, sheet: Sheet, path: &Path) -> Result<Self, Failure> {
        let fit = identify_with(&sheet, &FitSettings::default());
        let fit = fit.map_err(|error| Failure::from(error).in_sheet(path))?;
        Ok(Self { name, of: Origin::Sheet(Box::new((sheet, fit))), notes: Vec::new() })
    }

    /// Reads a file of laws; a sheet beside it that it was fitted to is noted.
    fn of_laws(path: &Path) -> Result<Self, Failure> {
        let fabric =
            drape::run::fabric_of(&input::document_of_kind(path, &KINDS)?, drape::scene::Model::Kes)?;
        let beside = path.with_file_name(SHEET_FILE);
        let notes = if !input::is_standard(path) && beside.exists() {
            vec![format!(
                "the laws alone are reported; {} beside them has what was measured, report it instead",
                beside.display()
            )]
        } else {
            Vec::new()
        };
        let name = file_name(path);
        Ok(Self { name, of: Origin::Laws(Box::new(fabric)), notes })
    }
}

/// Returns the name of the files of a fabric: that of its folder for `fabric.toml`.
fn file_name(path: &Path) -> String {
    let folder = path.parent().and_then(Path::file_name);
    match folder.filter(|_| path.file_name().is_some_and(|name| name == "fabric.toml")) {
        Some(folder) => folder.to_string_lossy().into_owned(),
        None => sheets::stem(path),
    }
}

/// Reads the fabrics of paths, fitted; of tables all of their fabrics, or that of a name.
pub(super) fn read(paths: &[PathBuf], fabric: Option<&str>) -> Result<Vec<Tested>, Failure> {
    let mut tested = Vec::new();
    let mut has_tables = false;
    for path in paths {
        if sheets::is_of_tables(path) {
            has_tables = true;
            tested.extend(of_tables(path, fabric)?);
        } else if is_laws(path)? {
            tested.push(Tested::of_laws(path)?);
        } else {
            for path in sheets::sheets(std::slice::from_ref(path))? {
                tested.push(Tested::of_sheet(sheets::stem(&path), sheets::read(&path)?, &path)?);
            }
        }
    }
    if let (Some(fabric), false) = (fabric, has_tables) {
        let message =
            format!("--fabric {fabric} takes one of several in tables, and there are none");
        return Err(Failure::Usage(message));
    }
    number(&mut tested);
    Ok(tested)
}

/// Returns whether a path is a file of laws.
fn is_laws(path: &Path) -> Result<bool, Failure> {
    if path.is_dir() {
        return Ok(false);
    }
    if input::is_standard(path) {
        return Ok(FileKind::of_document(&input::document(path)?) == Some(FileKind::Fabric));
    }
    Ok(FileKind::of(path) == Some(FileKind::Fabric))
}

/// Drafts the sheets of tables, and fits them.
fn of_tables(path: &Path, fabric: Option<&str>) -> Result<Vec<Tested>, Failure> {
    let folder = if path.is_dir() { path } else { path.parent().unwrap_or(Path::new("")) };
    let drafts = drafted::drafts(path, folder, fabric)?;
    let several = drafts.len() > 1;
    let tested = |draft: &drape::kes::SheetDraft| {
        let name = drafted::name(path, draft, several);
        let sheet = folder.join(format!("{name}.sheet.toml"));
        let read = drafted::read(draft, &sheet)?;
        Tested::of_sheet(name, read, &sheet)
    };
    drafts.iter().map(tested).collect()
}

/// Gives fabrics whose files would have the same name a number behind it.
fn number(tested: &mut [Tested]) {
    let mut taken = BTreeSet::new();
    for own in tested {
        let stem = own.name.clone();
        let numbered = (2..).map(|number| format!("{stem}-{number}"));
        let mut candidates = std::iter::once(stem.clone()).chain(numbered);
        let name = candidates.find(|name| taken.insert(name.clone()));
        own.name = name.expect("there is always a next number");
    }
}
