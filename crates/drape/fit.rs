use std::path::{Path, PathBuf};

use drape::fit::{Fit, Settings, identify_with};
use drape::input::{Diagnostic, Diagnostics};
use drape::kes::Sheet;
use drape::report::FitPage;

use crate::command::FitArguments;
use crate::failure::Failure;
use crate::fit_page::fit_page;
use crate::say::say;
use crate::{batch, file};

/// `drape fit`.
pub(crate) fn fit(arguments: &FitArguments) -> Result<(), Failure> {
    let sheets = batch::sheets(&arguments.sheets)?;
    match sheets.as_slice() {
        [sheet] => one(sheet, arguments),
        sheets => batch::fit_all(sheets, arguments),
    }
}

/// Fits one sheet and prints its report.
fn one(sheet: &Path, arguments: &FitArguments) -> Result<(), Failure> {
    let path = arguments.output.clone().unwrap_or_else(|| beside(sheet));
    if path.exists() && arguments.output.is_none() && !arguments.force {
        let message = format!("{} exists; give -o, or replace it with --force", path.display());
        return Err(Failure::Usage(message));
    }
    let (fit, page) = identified(sheet, &arguments.laws.settings())?;
    file::write(&path, fit.fabric.to_toml())?;
    let report = store(&page, &batch::stem(sheet), arguments.report.as_deref())?;
    if arguments.json {
        let json = serde_json::to_string_pretty(&page);
        say(json.expect("numbers and strings have a JSON form"))?;
    } else {
        say(page.to_text()?.trim_end())?;
        say(format_args!("fabric written to {}", path.display()))?;
        if let Some(report) = report {
            say(format_args!("report written to {}", report.display()))?;
        }
    }
    Ok(())
}

/// Reads a sheet, fits it, and judges the fit.
pub(crate) fn identified(path: &Path, settings: &Settings) -> Result<(Fit, FitPage), Failure> {
    let sheet = read(path)?;
    let fit = identify_with(&sheet, settings).map_err(|error| Failure::from(error).of(path))?;
    let page = page(&sheet, &fit, settings)?;
    Ok((fit, page))
}

/// Reads a sheet.
pub(crate) fn read(path: &Path) -> Result<Sheet, Failure> {
    Sheet::read(path).map_err(|error| input(path, error).into())
}

/// The report of a fit, checked.
pub(crate) fn page(sheet: &Sheet, fit: &Fit, settings: &Settings) -> Result<FitPage, Failure> {
    let page = fit_page(sheet, fit, settings);
    page.check()?;
    Ok(page)
}

/// Writes the page of a fit into a folder, if there is one.
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

/// A sheet's mistakes with their places.
pub(crate) fn input(file: &Path, error: drape::kes::Error) -> Diagnostics {
    match error {
        drape::kes::Error::Input(diagnostics) => diagnostics,
        other => Diagnostic::new(file, other.to_string()).into(),
    }
}

/// Where the fabric of a sheet goes when nothing is said: `fabric.toml` in the sheet's folder.
pub(crate) fn beside(sheet: &Path) -> PathBuf {
    let folder = if sheet.is_dir() { sheet } else { sheet.parent().unwrap_or(Path::new("")) };
    folder.join("fabric.toml")
}
