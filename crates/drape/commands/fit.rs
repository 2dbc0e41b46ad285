//! `drape fit`: identifies fabrics from sheets, one or many, and writes them with a report.
//!
//! A sheet is read ([`sheets`](super::sheets)), fitted and reported ([`identify`]); many are fitted
//! on all threads ([`batch`]).

mod arguments;
mod batch;
mod identify;

use std::path::Path;

pub(crate) use arguments::FitArguments;
pub(crate) use identify::store;

use self::identify::identify;
use crate::commands::sheets;
use crate::failure::Failure;
use crate::file;
use crate::say::say;

/// Executes `drape fit`.
pub(crate) fn fit(arguments: &FitArguments) -> Result<(), Failure> {
    let sheets = sheets::sheets(&arguments.sheets)?;
    match sheets.as_slice() {
        [sheet] => one(sheet, arguments),
        sheets => batch::fit_all(sheets, arguments),
    }
}

/// Fits one sheet and prints its report.
fn one(sheet: &Path, arguments: &FitArguments) -> Result<(), Failure> {
    let path = arguments.output.clone().unwrap_or_else(|| identify::beside(sheet));
    if path.exists() && arguments.output.is_none() && !arguments.force {
        let message = format!("{} exists; give -o, or replace it with --force", path.display());
        return Err(Failure::Usage(message));
    }
    let identified = identify(sheet, &arguments.laws.settings())?;
    file::write(&path, identified.fit.fabric.to_toml())?;
    let page = &identified.page;
    let report = store(page, &sheets::stem(sheet), arguments.report.as_deref())?;
    if arguments.json {
        let json = serde_json::to_string_pretty(page);
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
