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
use crate::input;
use crate::say::{say, say_json, say_written};
use drape::file;

/// Executes `drape fit`.
pub(crate) fn fit(arguments: &FitArguments) -> Result<(), Failure> {
    input::set(&arguments.set);
    let sheets = sheets::sheets(&arguments.sheets)?;
    match sheets.as_slice() {
        [sheet] => one(sheet, arguments),
        sheets => batch::fit_all(sheets, arguments),
    }
}

/// Fits one sheet and prints its report.
fn one(sheet: &Path, arguments: &FitArguments) -> Result<(), Failure> {
    let path = arguments.output.clone().unwrap_or_else(|| identify::beside(sheet));
    let to_stdout = input::is_standard(&path);
    if to_stdout && arguments.json {
        let message = "-o - and --json both print to stdout; give one of them";
        return Err(Failure::Usage(message.into()));
    }
    let force = arguments.force || to_stdout;
    file::refuse_existing(&path, force, "give -o, or replace it with --force")?;
    let identified = identify(sheet, &arguments.laws.settings())?;
    if to_stdout {
        say(identified.fit.fabric.to_toml().trim_end())?;
    } else {
        file::write(&path, identified.fit.fabric.to_toml())?;
    }
    let page = &identified.page;
    let report = store(page, &sheets::stem(sheet), arguments.report.as_deref())?;
    if arguments.json {
        say_json(page)?;
    } else if !to_stdout {
        say(page.to_text()?.trim_end())?;
        say_written(format_args!("fabric written to {}", path.display()))?;
        if let Some(report) = report {
            say_written(format_args!("report written to {}", report.display()))?;
        }
    }
    Ok(())
}
