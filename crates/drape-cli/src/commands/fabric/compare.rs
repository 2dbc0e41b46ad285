//! `drape fabric compare`: compares fabrics, their measurements and their laws.

use std::path::{Path, PathBuf};

use drape::fabric::Fabric;
use drape::kes::Sheet;
use drape::run::file::{self, FileKind};
use drape::run::reports::{ComparedFabric, compare_page};

use super::read::read;
use crate::commands::sheets;
use crate::console::note;
use crate::failure::Failure;
use crate::input;
use crate::say::{say, say_json, say_written};

/// Largest number of fabrics whose names all stand in the name of the page.
const NAMED: usize = 3;

/// Fabric with the sheet of its measurements, if there is one.
struct MeasuredFabric {
    fabric: Fabric,
    sheet: Option<Sheet>,
}

/// Compares the fabrics at `paths`, prints the table and stores the page in the folder `report`.
pub(super) fn compare(paths: &[PathBuf], report: Option<&Path>, json: bool) -> Result<(), Failure> {
    let fabrics =
        paths.iter().map(|path| MeasuredFabric::read(path)).collect::<Result<Vec<_>, _>>()?;
    let page = compare_page(&fabrics.iter().map(MeasuredFabric::borrow).collect::<Vec<_>>());
    if json {
        say_json(&page)?;
    } else {
        say(page.to_text()?.trim_end())?;
    }
    if let Some(folder) = report {
        let path = folder.join(format!("{}.html", name(paths)));
        file::write(&path, &page.to_html()?)?;
        if !json {
            say_written(format_args!("page written to {}", path.display()))?;
        }
    }
    Ok(())
}

/// Returns the name of the page, composed of the names of the fabrics.
fn name(paths: &[PathBuf]) -> String {
    let stems: Vec<String> = paths.iter().map(|path| sheets::stem(path)).collect();
    match stems.len() {
        count if count > NAMED => format!("{}-and-{}-others", stems[0], count - 1),
        _ => stems.join("-and-"),
    }
}

impl MeasuredFabric {
    /// Reads the fabric at `path`, and the sheet to which it was fitted: `path` itself, or the
    /// sheet beside it.
    fn read(path: &Path) -> Result<Self, Failure> {
        let fabric = read(path)?;
        let is_sheet = !input::is_standard(path) && input::kind(path) == Some(FileKind::Sheet);
        let sheet = if is_sheet { Some(sheets::read(path)?) } else { beside(path, &fabric) };
        Ok(Self { fabric, sheet })
    }

    fn borrow(&self) -> ComparedFabric<'_> {
        ComparedFabric { fabric: &self.fabric, sheet: self.sheet.as_ref() }
    }
}

/// Returns the sheet beside the `fabric` at `path`, if the fabric was fitted to it and the sheet
/// has not changed since.
fn beside(path: &Path, fabric: &Fabric) -> Option<Sheet> {
    let provenance = fabric.provenance.as_ref()?;
    let file = path.parent()?.join(sheets::SHEET_FILE);
    let sheet = sheets::read(&file).ok().filter(|sheet| sheet.name == provenance.sheet)?;
    if sheet.digest() == provenance.digest {
        return Some(sheet);
    }
    note(format_args!(
        "{} has changed since {} was fitted to it: its values are left out; fit it again with `drape fit {} \
         --force`",
        file.display(),
        path.display(),
        file.display()
    ));
    None
}
