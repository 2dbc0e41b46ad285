//! Batch: many sheets fitted on all threads. Each sheet gets a fabric and a page, and all are
//! printed as one table.

use std::path::Path;

use drape::fit::{FittedSheet, identify_all};
use drape::kes::Sheet;
use drape::report::{FitPage, Trust};

use super::arguments::FitArguments;
use super::identify::{page, store};
use super::job::Job;
use crate::console::progress;
use crate::console::{Console, print_message};
use crate::failure::Failure;
use crate::say::{say, say_json};
use drape::run::file;

/// Reads the sheet of `job`, and writes a drafted one. Existing files are refused unless `force` is
/// set.
fn read(job: &Job, force: bool) -> Result<Sheet, Failure> {
    job.refuse_existing(force, "replace it with --force")?;
    job.write_sheet()?;
    Ok(job.read()?)
}

/// Heads of the columns of the table.
const HEAD: [&str; 5] = ["fabric", "fit", "misfit", "warnings", "assumed"];

/// Row of the table. Nothing else is kept of a fitted sheet, because there may be thousands of
/// sheets.
struct Row {
    /// Name of the fabric.
    name: String,
    trust: Trust,
    misfit: Option<f64>,
    warnings: usize,
    assumed: usize,
}

/// Fits the sheets of all `jobs` on all threads. A failed sheet does not stop the others.
pub(crate) fn fit_all(jobs: &[Job], arguments: &FitArguments) -> Result<(), Failure> {
    let bar = progress::bar(jobs.len() as u64, "{pos}/{len} sheets, {per_sec}, {eta} left");
    let settings = arguments.laws.settings();
    let force = arguments.force;
    let rows = identify_all(
        jobs,
        &settings,
        |job: &Job| read(job, force),
        |job, outcome| {
            let row = outcome.and_then(|FittedSheet { sheet, fit }| {
                let page = page(sheet, fit, &settings)?;
                file::write(&job.fabric, fit.fabric.to_toml())?;
                store(&page, &job.name, arguments.report.as_deref())?;
                Ok(Row::new(&page))
            });
            bar.inc(1);
            row.map_err(|failure| failure.in_sheet(&job.sheet))
        },
    );
    bar.finish_and_clear();

    let failed = rows.iter().filter(|row| row.is_err()).count();
    if arguments.json {
        let rows: Vec<_> = jobs.iter().zip(&rows).map(|(job, row)| json(&job.sheet, row)).collect();
        say_json(&rows)?;
    } else {
        let [name, fit, misfit, warnings, assumed] = HEAD;
        say(format_args!("{name:<36} {fit:<10} {misfit:>8} {warnings:>8} {assumed:>8}  sheet"))?;
        for (job, row) in jobs.iter().zip(&rows) {
            say(line(&job.sheet, row))?;
        }
    }

    rows.iter().filter_map(|row| row.as_ref().err()).for_each(Failure::print);
    if !Console::get().quiet {
        print_message(format_args!("{} of {} sheets fitted", jobs.len() - failed, jobs.len()));
    }
    if failed > 0 { Err(Failure::Batch) } else { Ok(()) }
}

impl Row {
    /// Summarises `page` by its least trusted law and its largest misfit.
    fn new(page: &FitPage) -> Self {
        let verdicts = page.laws.iter().map(|law| law.verdict(&page.limits).trust);
        let misfits = page.laws.iter().filter_map(|law| law.statistics.as_ref());
        Self {
            name: page.name.clone(),
            trust: verdicts.max().unwrap_or(Trust::Unjudged),
            misfit: misfits.map(|statistics| statistics.misfit).reduce(f64::max),
            warnings: page.warnings.len(),
            assumed: page.assumed.len(),
        }
    }
}

/// Returns the line of the table for `sheet`.
fn line(sheet: &Path, row: &Result<Row, Failure>) -> String {
    let path = sheet.display();
    let Ok(Row { name, trust, misfit, warnings, assumed }) = row else {
        return format!("{:<36} {:<10} {:>26}  {path}", "", "failed", "");
    };
    let misfit = misfit.map_or(String::new(), |misfit| format!("{:.2} %", 100.0 * misfit));
    let trust = trust.name();
    format!("{name:<36} {trust:<10} {misfit:>8} {warnings:>8} {assumed:>8}  {path}")
}

/// Returns the row of `sheet` as JSON.
fn json(sheet: &Path, row: &Result<Row, Failure>) -> serde_json::Value {
    match row {
        Ok(row) => serde_json::json!({
            "sheet": sheet,
            "fabric": row.name,
            "trust": row.trust,
            "misfit": row.misfit,
            "warnings": row.warnings,
            "assumed": row.assumed,
        }),
        Err(failure) => serde_json::json!({ "sheet": sheet, "error": failure.to_string() }),
    }
}
