//! One sheet fitted, with the report of its fit, and the files of both.

use std::path::{Path, PathBuf};

use drape::fit::{Fit, Settings, identify_with};
use drape::kes::Sheet;
use drape::report::FitPage;
use drape::reports::fit_page;

use crate::commands::sheets;
use crate::failure::Failure;
use drape::file;

/// A fitted sheet.
pub(crate) struct Identified {
    pub(crate) fit: Fit,
    /// The report of the fit.
    pub(crate) page: FitPage,
}

/// Reads a sheet, fits it and reports the fit.
pub(crate) fn identify(path: &Path, settings: &Settings) -> Result<Identified, Failure> {
    let sheet = sheets::read(path)?;
    let fit = identify_with(&sheet, settings).map_err(|error| Failure::from(error).of(path))?;
    let page = page(&sheet, &fit, settings)?;
    Ok(Identified { fit, page })
}

/// Returns the report of a fit, checked.
pub(crate) fn page(sheet: &Sheet, fit: &Fit, settings: &Settings) -> Result<FitPage, Failure> {
    let page = fit_page(sheet, fit, settings);
    page.check()?;
    Ok(page)
}

/// Writes the page of a fit into a folder, if one is given, and returns its path.
pub(crate) fn store(
    page: &FitPage,
    name: &str,
    folder: Option<&Path>,
) -> Result<Option<PathBuf>, Failure> {
    let Some(folder) = folder else { return Ok(None) };
    let path = folder.join(format!("{name}.html"));
    file::write(&path, &page.to_html()?)?;
    Ok(Some(path))
}

/// Returns the default path of the fabric of a sheet: `fabric.toml` in the sheet's folder.
pub(crate) fn beside(sheet: &Path) -> PathBuf {
    let folder = if sheet.is_dir() { sheet } else { sheet.parent().unwrap_or(Path::new("")) };
    folder.join("fabric.toml")
}
