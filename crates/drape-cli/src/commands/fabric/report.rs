//! `drape report`: the report on fabrics that a laboratory sends to its customer, one HTML page.
//!
//! The fabrics are read and fitted ([`tested`]), their drapes are taken from results of `drape test --drape`
//! or run, girths of garments from runs ([`worn`]), and the page is made by `drape::run::reports`.

mod arguments;
mod tested;
mod worn;

use std::path::Path;

use drape::report::ReportedDrape;
use drape::run::file;
use drape::run::reports::{CustomerSubject, customer_page, laws_digest};

pub(crate) use self::arguments::ReportArguments;
use self::tested::Tested;
use crate::commands::test::drapes::stored::{Stored, picture, read, store};
use crate::commands::test::drapes::{DrapeRequest, check_spacing};
use crate::console::{Console, note, print_message};
use crate::failure::Failure;
use crate::input;
use crate::say::{say, say_json, say_written};

/// Size of a page above which it is said to be large, in bytes.
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
    for ((own, record), drape) in fabrics.iter().zip(records).zip(drapes) {
        subjects.push(CustomerSubject {
            fabric: own.fabric(),
            measured: own.measured(),
            record,
            drape: drape.reported,
            notes: own.notes.iter().cloned().chain(drape.notes).collect(),
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

/// Refuses files that are no page and no table.
fn check_output(arguments: &ReportArguments) -> Result<(), Failure> {
    let ending =
        |path: &Path| path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
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

/// Drape of a fabric for its report.
#[derive(Default)]
struct FoundDrape {
    reported: Option<ReportedDrape>,
    notes: Vec<String>,
}

/// Returns the drapes of fabrics: those that were stored, and the others if they are to be run.
fn drapes(
    fabrics: &[Tested],
    stored: &[Stored],
    request: Option<&DrapeRequest>,
    arguments: &ReportArguments,
) -> Result<Vec<FoundDrape>, Failure> {
    let mut found: Vec<FoundDrape> = fabrics.iter().map(|own| find(own, stored)).collect();
    tell_unused(fabrics, stored);
    let Some(request) = request else { return Ok(found) };

    // The time of all of them is said before the first is run.
    let missing: Vec<usize> =
        (0..found.len()).filter(|index| found[*index].reported.is_none()).collect();
    if !Console::get().quiet {
        for &index in &missing {
            let specimens = request.of(fabrics[index].fabric(), true);
            let name = &fabrics[index].fabric().name;
            print_message(format_args!("{name}: drape of {}", specimens.expected()?));
        }
    }
    let folder = arguments.drapes.iter().find(|path| !path.is_file());
    for index in missing {
        let own = &fabrics[index];
        let draped = request.of(own.fabric(), true).drape()?;
        if let Some(folder) = folder {
            let written = store(&draped, folder, &own.name)?;
            note(format_args!("drape written to {}", written.result.display()));
        }
        found[index].reported = draped.result.reported(picture(&draped)?);
        found[index].notes.clear();
    }
    Ok(found)
}

/// Returns the stored drape of a fabric; one of a fabric with its name and other laws is noted.
fn find(own: &Tested, stored: &[Stored]) -> FoundDrape {
    let laws = laws_digest(own.fabric());
    if let Some(found) = stored.iter().find(|stored| stored.result.laws == laws) {
        return FoundDrape { reported: found.reported(), notes: Vec::new() };
    }
    let name = &own.fabric().name;
    let of_name = stored.iter().find(|stored| stored.result.fabric == *name);
    let notes = of_name.map(|stale| {
        note(format_args!(
            "{}: a drape of \"{name}\" with other laws than those of this report; it is left out. Run \
             drape test --drape --report again",
            stale.path().display()
        ));
        "a drape was given, but of other laws than these; it is left out".to_owned()
    });
    FoundDrape { reported: None, notes: notes.into_iter().collect() }
}

/// Tells of stored drapes that belong to none of the fabrics.
fn tell_unused(fabrics: &[Tested], stored: &[Stored]) {
    for own in stored {
        let is_of = |fabric: &Tested| {
            let fabric = fabric.fabric();
            fabric.name == own.result.fabric || laws_digest(fabric) == own.result.laws
        };
        if !fabrics.iter().any(is_of) {
            let (path, name) = (own.path().display(), &own.result.fabric);
            note(format_args!("{path} is of \"{name}\", which is not in this report"));
        }
    }
}
