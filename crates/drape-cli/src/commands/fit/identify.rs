//! One sheet: its fit, the report of the fit, and the files of both.

use std::path::{Path, PathBuf};

use super::job::Job;
use drape::fit::{Fit, FitSettings, identify_with};
use drape::kes::Sheet;
use drape::report::FitPage;
use drape::run::reports::fit_page;

use crate::failure::Failure;
use drape::run::file;

/// A fitted sheet.
pub(crate) struct Identified {
    pub(crate) fit: Fit,
    /// Report of the fit.
    pub(crate) page: FitPage,
}

/// Reads the sheet of `job`, fits it and composes the report.
pub(crate) fn identify(job: &Job, settings: &FitSettings) -> Result<Identified, Failure> {
    let sheet = job.read()?;
    let fit = identify_with(&sheet, settings);
    let fit = fit.map_err(|error| Failure::from(error).in_sheet(&job.sheet))?;
    let page = page(&sheet, &fit, settings)?;
    Ok(Identified { fit, page })
}

/// Returns the report of `fit`, or an error if a name or number of it cannot be shown.
pub(crate) fn page(sheet: &Sheet, fit: &Fit, settings: &FitSettings) -> Result<FitPage, Failure> {
    let page = fit_page(sheet, fit, settings);
    page.check()?;
    Ok(page)
}

/// Writes `page` as `name.html` into `folder`, if there is one, and returns the path of the file.
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
