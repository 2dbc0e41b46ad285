//! `drape fit`: identifies fabrics from sheets, one or many, and writes them with a report.
//!
//! A sheet is read ([`sheets`](super::sheets)) or drafted from tables ([`job`]), and then fitted
//! and reported ([`mod@identify`]). Several sheets are fitted on all threads ([`batch`]).

mod arguments;
mod batch;
mod identify;
mod job;

pub(crate) use arguments::FitArguments;
pub(crate) use identify::store;

use self::identify::identify;
use self::job::Job;
use crate::failure::Failure;
use crate::input;
use crate::say::{say, say_json, say_written};
use drape::run::file;

/// Executes `drape fit`.
pub(crate) fn fit(arguments: &FitArguments) -> Result<(), Failure> {
    input::set_values(&arguments.set);
    match job::jobs(arguments)?.as_slice() {
        [job] => fit_one(job, arguments),
        jobs => batch::fit_all(jobs, arguments),
    }
}

/// Fits the sheet of `job`, writes the fabric, and prints the report.
fn fit_one(job: &Job, arguments: &FitArguments) -> Result<(), Failure> {
    let path = &job.fabric;
    let to_stdout = input::is_standard(path);
    if to_stdout && arguments.json {
        let message = "-o - and --json both print to stdout; give one of them";
        return Err(Failure::Usage(message.into()));
    }

    let force = arguments.force || to_stdout;
    job.refuse_existing(force, "give -o, or replace it with --force")?;
    if !to_stdout {
        job.write_sheet()?;
    }

    let identified = identify(job, &arguments.laws.settings())?;
    if to_stdout {
        say(identified.fit.fabric.to_toml().trim_end())?;
    } else {
        file::write(path, identified.fit.fabric.to_toml())?;
    }

    let page = &identified.page;
    let report = store(page, &job.name, arguments.report.as_deref())?;
    if arguments.json {
        say_json(page)?;
    } else if !to_stdout {
        say(page.to_text()?.trim_end())?;
        if job.is_drafted() {
            say_written(format_args!("sheet written to {}", job.sheet.display()))?;
        }
        say_written(format_args!("fabric written to {}", path.display()))?;
        if let Some(report) = report {
            say_written(format_args!("report written to {}", report.display()))?;
        }
    }
    Ok(())
}
