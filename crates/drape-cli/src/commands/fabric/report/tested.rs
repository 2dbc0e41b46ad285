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

/// Kinds of files that hold a fabric.
const KINDS: [FileKind; 2] = [FileKind::Fabric, FileKind::Sheet];

/// Fabric of a report.
pub(super) struct TestedFabric {
    /// Name for the files of the fabric.
    pub(super) name: String,
    /// Origin of the laws.
    origin: Origin,
    /// Notes on the origin.
    pub(super) notes: Vec<String>,
}

/// Origin of the laws of a fabric.
enum Origin {
    /// A sheet, with its fit.
    Sheet(Box<(Sheet, Fit)>),
    /// A file of laws.
    Laws(Box<Fabric>),
}

impl TestedFabric {
    /// Returns the laws of the fabric.
    pub(super) fn fabric(&self) -> &Fabric {
        match &self.origin {
            Origin::Sheet(fitted) => &fitted.1.fabric,
            Origin::Laws(fabric) => fabric,
        }
    }

    /// Returns the sheet with its [`Fit`], or `None` for a file of laws.
    pub(super) fn measured(&self) -> Option<(&Sheet, &Fit)> {
        match &self.origin {
            Origin::Sheet(fitted) => Some((&fitted.0, &fitted.1)),
            Origin::Laws(_) => None,
        }
    }

    /// Returns the [`TestRecord`] of the sheet, which is empty for a file of laws.
    pub(super) fn record(&self) -> TestRecord {
        self.measured().map(|(sheet, _)| sheet.record.clone()).unwrap_or_default()
    }

    /// Fits `sheet`, which was read from `path`.
    fn from_sheet(name: String, sheet: Sheet, path: &Path) -> Result<Self, Failure> {
        let fit = identify_with(&sheet, &FitSettings::default());
        let fit = fit.map_err(|error| Failure::from(error).in_sheet(path))?;
        Ok(Self { name, origin: Origin::Sheet(Box::new((sheet, fit))), notes: Vec::new() })
    }

    /// Reads the file of laws at `path`. If a sheet is beside it, a note says so.
    fn from_laws(path: &Path) -> Result<Self, Failure> {
        let fabric = drape::run::fabric_of(
            &input::document_of_kind(path, &KINDS)?,
            drape::scene::Model::Kes,
        )?;
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
        Ok(Self { name, origin: Origin::Laws(Box::new(fabric)), notes })
    }
}

/// Returns the name for the files of the fabric at `path`: for `fabric.toml` the name of the
/// folder, otherwise the stem.
fn file_name(path: &Path) -> String {
    let folder = path.parent().and_then(Path::file_name);
    match folder.filter(|_| path.file_name().is_some_and(|name| name == "fabric.toml")) {
        Some(folder) => folder.to_string_lossy().into_owned(),
        None => sheets::stem(path),
    }
}

/// Reads and fits the fabrics at `paths`. Of tables, all fabrics are read, or the one called
/// `fabric`.
pub(super) fn read(paths: &[PathBuf], fabric: Option<&str>) -> Result<Vec<TestedFabric>, Failure> {
    let mut tested = Vec::new();
    let mut has_tables = false;
    for path in paths {
        if sheets::holds_tables(path) {
            has_tables = true;
            tested.extend(fit_tables(path, fabric)?);
        } else if is_laws_file(path)? {
            tested.push(TestedFabric::from_laws(path)?);
        } else {
            for path in sheets::find_sheets(std::slice::from_ref(path))? {
                tested.push(TestedFabric::from_sheet(
                    sheets::stem(&path),
                    sheets::read(&path)?,
                    &path,
                )?);
            }
        }
    }

    if let (Some(fabric), false) = (fabric, has_tables) {
        let message =
            format!("--fabric {fabric} takes one of several in tables, and there are none");
        return Err(Failure::Usage(message));
    }
    number_names(&mut tested);
    Ok(tested)
}

/// Returns whether `path` is a file of laws.
fn is_laws_file(path: &Path) -> Result<bool, Failure> {
    if path.is_dir() {
        return Ok(false);
    }
    if input::is_standard(path) {
        return Ok(FileKind::of_document(&input::document(path)?) == Some(FileKind::Fabric));
    }
    Ok(input::kind(path) == Some(FileKind::Fabric))
}

/// Drafts the sheets of the tables at `path`, and fits them.
fn fit_tables(path: &Path, fabric: Option<&str>) -> Result<Vec<TestedFabric>, Failure> {
    let folder = if path.is_dir() { path } else { path.parent().unwrap_or(Path::new("")) };
    let drafts = drafted::drafts(path, folder, fabric)?;
    let several = drafts.len() > 1;
    let tested = drafts.iter().map(|draft| {
        let name = drafted::name(path, draft, several);
        let sheet_path = folder.join(format!("{name}.sheet.toml"));
        let sheet = drafted::read(draft, &sheet_path)?;
        TestedFabric::from_sheet(name, sheet, &sheet_path)
    });
    tested.collect()
}

/// Appends a number to the names of fabrics in `tested` that would repeat an earlier name.
fn number_names(tested: &mut [TestedFabric]) {
    let mut taken = BTreeSet::new();
    for fabric in tested {
        let stem = fabric.name.clone();
        let numbered = (2..).map(|number| format!("{stem}-{number}"));
        let mut candidates = std::iter::once(stem.clone()).chain(numbered);
        let name = candidates.find(|name| taken.insert(name.clone()));
        fabric.name = name.expect("there is always a next number");
    }
}
