//! `drape report`: the report on fabrics that a laboratory sends to its customer, one HTML page.
//!
//! The fabrics are read and fitted by [`tested`]. Their drapes are read from results of `drape test
//! --drape`, or run. The girths of garments are read from runs by [`worn`]. `drape::run::reports`
//! composes the page.

mod arguments;
mod tested;
mod worn;

use std::path::Path;

use drape::report::ReportedDrape;
use drape::run::file;
use drape::run::reports::{CustomerSubject, customer_page, laws_digest};

pub(crate) use self::arguments::ReportArguments;
use self::tested::TestedFabric;
use crate::commands::test::drapes::stored::{StoredDrape, picture, read, store};
use crate::commands::test::drapes::{DrapeRequest, check_spacing};
use crate::console::{Console, note, print_message};
use crate::failure::Failure;
use crate::input;
use crate::say::{say, say_json, say_written};

/// A page larger than this, in bytes, gets a note.
const LARGE: usize = 3_000_000;

/// Executes `drape report`.
pub(crate) fn report(arguments: &ReportArguments) -> Result<(), Failure> {
    check_spacing(arguments.spacing)?;
    let to_stdout = input::is_standard(&arguments.output);
    check_output(arguments)?;
    let request =
        arguments.drape.then(|| arguments.meter.request(arguments.spacing)).transpose()?;
    let stored = read(&arguments.drapes, arguments.drape)?;

    let fabrics = tested::read(&arguments.fabrics, arguments.fabric.as_deref())?;
    let records = arguments.record.records(&fabrics)?;
    let mut subjects = Vec::new();
    let drapes = drapes(&fabrics, &stored, request.as_ref(), arguments)?;
    for ((tested, record), drape) in fabrics.iter().zip(records).zip(drapes) {
        subjects.push(CustomerSubject {
            fabric: tested.fabric(),
            measured: tested.measured(),
            record,
            drape: drape.reported,
            notes: tested.notes.iter().cloned().chain(drape.notes).collect(),
        });
    }

    let mut page = customer_page(&subjects);
    page.garments = worn::read(&arguments.garments)?;
    let html = page.to_html()?;

    if let Some(csv) = &arguments.csv {
        file::write(csv, page.to_csv()?)?;
    }
    if to_stdout {
        return say(html.trim_end());
    }
    file::write(&arguments.output, &html)?;
    if arguments.json {
        return say_json(&page);
    }
    let size = html.len() as f64 / 1e6;
    say_written(format_args!("report written to {} ({size:.2} MB)", arguments.output.display()))?;
    if let Some(csv) = &arguments.csv {
        say_written(format_args!("numbers written to {}", csv.display()))?;
    }
    if html.len() > LARGE {
        note("the page is larger than 3 MB; report fewer fabrics on a page");
    }
    Ok(())
}

fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}

/// Refuses output files whose ending is not HTML or CSV, and two outputs on stdout.
fn check_output(arguments: &ReportArguments) -> Result<(), Failure> {
    let output = &arguments.output;
    if !input::is_standard(output) && !["html", "htm"].contains(&ending(output).as_str()) {
        let message = format!(
            "-o {}: a report is a page of HTML; write report.html, and print it to PDF in a browser",
            output.display()
        );
        return Err(Failure::Usage(message));
    }

    if input::is_standard(output) && arguments.json {
        let message = "-o - and --json both print to stdout; give one of them";
        return Err(Failure::Usage(message.into()));
    }

    match &arguments.csv {
        Some(csv) if ending(csv) != "csv" => Err(Failure::Usage(format!(
            "--csv {}: the numbers are a table of comma-separated values; write report.csv",
            csv.display()
        ))),
        _ => Ok(()),
    }
}

/// Drape of a fabric for its report, with notes on it.
#[derive(Default)]
struct FabricDrape {
    reported: Option<ReportedDrape>,
    notes: Vec<String>,
}

/// Returns the drape of each of `fabrics`: a stored one, or with a `request` a new one.
fn drapes(
    fabrics: &[TestedFabric],
    stored: &[StoredDrape],
    request: Option<&DrapeRequest>,
    arguments: &ReportArguments,
) -> Result<Vec<FabricDrape>, Failure> {
    let mut drapes: Vec<FabricDrape> = fabrics.iter().map(|tested| find(tested, stored)).collect();
    note_unused(fabrics, stored);
    let Some(request) = request else { return Ok(drapes) };

    // The expected times are printed before the first drape is run.
    let missing: Vec<usize> =
        (0..drapes.len()).filter(|index| drapes[*index].reported.is_none()).collect();
    if !Console::get().quiet {
        for &index in &missing {
            let specimens = request.specimens(fabrics[index].fabric(), true);
            let name = &fabrics[index].fabric().name;
            print_message(format_args!("{name}: drape of {}", specimens.expected()?));
        }
    }

    let folder = arguments.drapes.iter().find(|path| !path.is_file());
    for index in missing {
        let tested = &fabrics[index];
        let draped = request.specimens(tested.fabric(), true).drape()?;
        if let Some(folder) = folder {
            let files = store(&draped, folder, &tested.name)?;
            note(format_args!("drape written to {}", files.result.display()));
        }
        drapes[index].reported = draped.result.reported(picture(&draped)?);
        drapes[index].notes.clear();
    }
    Ok(drapes)
}

/// Returns the stored drape of a fabric. A drape of an equal name but other laws is left out with a
/// note.
fn find(tested: &TestedFabric, stored: &[StoredDrape]) -> FabricDrape {
    let laws = laws_digest(tested.fabric());
    if let Some(drape) = stored.iter().find(|drape| drape.result.laws == laws) {
        return FabricDrape { reported: drape.reported(), notes: Vec::new() };
    }

    let name = &tested.fabric().name;
    let stale = stored.iter().find(|drape| drape.result.fabric == *name);
    let notes = stale.map(|stale| {
        note(format_args!(
            "{}: a drape of \"{name}\" with other laws than those of this report; it is left out. Run \
             drape test --drape --report again",
            stale.path().display()
        ));
        "a drape was given, but of other laws than these; it is left out".to_owned()
    });
    FabricDrape { reported: None, notes: notes.into_iter().collect() }
}

/// Prints a note for each stored drape that belongs to none of `fabrics`.
fn note_unused(fabrics: &[TestedFabric], stored: &[StoredDrape]) {
    for drape in stored {
        let is_used = fabrics.iter().map(TestedFabric::fabric).any(|fabric| {
            fabric.name == drape.result.fabric || laws_digest(fabric) == drape.result.laws
        });
        if !is_used {
            let (path, name) = (drape.path().display(), &drape.result.fabric);
            note(format_args!("{path} is of \"{name}\", which is not in this report"));
        }
    }
}
