//! `drape validate`: compares simulations with exact solutions and measurements, case by case.

use std::path::{Path, PathBuf};

use clap::Args;
use drape::input::Diagnostic;
use drape::report::CaptionedPicture;
use drape::report::plot::graph_svg;
use drape::validate::{CASES, Case, Check, Kind, Outcome};
use serde_json::{Value, json};

use crate::console::progress;
use crate::failure::Failure;
use crate::pages::validation::{self, figure};
use crate::say::{say, say_json, say_written};
use drape::run::file;

#[derive(Args)]
pub(crate) struct ValidateArguments {
    /// Cases to run [default: all that take seconds].
    #[arg(value_name = "CASE")]
    pub(crate) cases: Vec<String>,
    /// Runs the cases that take minutes too.
    #[arg(long, conflicts_with = "cases")]
    pub(crate) full: bool,
    /// Outcomes that `--json` printed earlier, to be shown with the outcomes of this run, which
    /// replace earlier outcomes of a case.
    #[arg(long, value_name = "FILE")]
    pub(crate) earlier: Vec<PathBuf>,
    /// Folder for a page with plots and pictures, and each of them as a file.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) report: Option<PathBuf>,
    /// Writes the outcomes as a page in Markdown.
    #[arg(long, value_name = "FILE")]
    pub(crate) markdown: Option<PathBuf>,
    /// Prints the outcomes as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Executes `drape validate`.
pub(crate) fn validate(arguments: &ValidateArguments) -> Result<(), Failure> {
    let cases = chosen(&arguments.cases, arguments.full)?;
    let mut outcomes = Vec::new();
    for path in &arguments.earlier {
        outcomes.extend(earlier(path)?);
    }

    for case in cases {
        let bar = progress::bar(0, "{msg}: {pos}/{len} simulations, {eta} left");
        bar.set_message(case.name);
        let outcome = Outcome::run(case, &|count| {
            bar.set_length(count);
            bar.inc(1);
        });
        bar.finish_and_clear();
        if !arguments.json {
            show(&outcome)?;
        }
        outcomes.push(outcome);
    }

    // The last of several outcomes of a case is kept.
    outcomes.reverse();
    outcomes.sort_by_key(case_number);
    outcomes.dedup_by_key(|outcome| case_number(outcome));

    if arguments.json {
        let judged: Vec<Value> = outcomes.iter().map(judged).collect();
        say_json(&judged)?;
    }
    if let Some(path) = &arguments.markdown {
        file::write(path, validation::markdown(&outcomes))?;
    }
    if let Some(folder) = &arguments.report {
        let page = store(&outcomes, folder)?;
        if !arguments.json {
            say_written(format_args!("page written to {}", page.display()))?;
        }
    }

    let failed = outcomes.iter().filter(|outcome| !outcome.passes()).count();
    if failed > 0 {
        let message = format!("{failed} of {} cases are off their references", outcomes.len());
        return Err(Failure::Limit(message));
    }
    Ok(())
}

/// Returns the position of the case of `outcome` in [`CASES`].
fn case_number(outcome: &Outcome) -> Option<usize> {
    CASES.iter().position(|case| case.name == outcome.name)
}

/// Returns `outcome` as JSON, with a key `passes` for the case and for each of its figures.
fn judged(outcome: &Outcome) -> Value {
    let mut value = json!(outcome);
    value["passes"] = json!(outcome.passes());
    let checks = value["checks"].as_array_mut().into_iter().flatten();
    for (value, check) in checks.zip(&outcome.checks) {
        value["passes"] = json!(check.verdict());
    }
    value
}

/// Writes the page of `outcomes` into `folder`, with every plot and picture as a file beside it,
/// and returns the path of the page.
fn store(outcomes: &[Outcome], folder: &Path) -> Result<PathBuf, Failure> {
    let page = validation::page(outcomes)?;
    let path = folder.join("validation.html");
    file::write(&path, page.to_html()?)?;
    for case in &page.cases {
        for (number, plot) in case.plots.iter().enumerate() {
            let path = folder.join(format!("{}-{}.svg", case.name, number + 1));
            file::write(&path, graph_svg(plot)?)?;
        }
        for (number, CaptionedPicture { picture, .. }) in case.pictures.iter().enumerate() {
            let path = folder.join(format!("{}-{}.png", case.name, number + 1));
            file::write(&path, picture.png()?)?;
        }
    }
    Ok(path)
}

/// Reads the outcomes of an earlier run from the JSON file at `path`.
fn earlier(path: &Path) -> Result<Vec<Outcome>, Failure> {
    parse_earlier(path).map_err(|message| {
        let help = "give a file that `drape validate --json` printed";
        Failure::Input(Diagnostic::new(path, message).help(help).into())
    })
}

fn parse_earlier(path: &Path) -> Result<Vec<Outcome>, String> {
    if !path.is_file() {
        return Err("it is no file".to_owned());
    }
    let text = std::fs::read_to_string(path).map_err(|error| error.to_string())?;
    let outcomes: Vec<Outcome> = serde_json::from_str(&text).map_err(|error| error.to_string())?;
    match outcomes.iter().find(|outcome| case_number(outcome).is_none()) {
        Some(outcome) => Err(format!("there is no case \"{}\"", outcome.name)),
        None => Ok(outcomes),
    }
}

/// Returns the cases called `names`. Without names, all short cases are returned, and with `full`
/// the long ones as well.
fn chosen(names: &[String], full: bool) -> Result<Vec<&'static Case>, Failure> {
    if names.is_empty() {
        return Ok(CASES.iter().filter(|case| full || !case.is_long()).collect());
    }
    let cases = names.iter().map(|name| {
        CASES.iter().find(|case| case.name == name).ok_or_else(|| {
            let known: Vec<&str> = CASES.iter().map(|case| case.name).collect();
            Failure::Usage(format!("there is no case \"{name}\"; there are {}", known.join(", ")))
        })
    });
    cases.collect()
}

fn show(outcome: &Outcome) -> Result<(), Failure> {
    say(format_args!("{}  [{}, {:.1} s]", outcome.title, outcome.name, outcome.seconds))?;
    outcome.checks.iter().try_for_each(|check| say(line(check)))?;
    if let Some(failure) = &outcome.failure {
        say(format_args!("  FAIL  {failure}"))?;
    }
    Ok(())
}

/// Returns the figure of `check` and its verdict as a line.
fn line(check: &Check) -> String {
    let verdict = match check.verdict() {
        Some(true) => "pass",
        Some(false) => "FAIL",
        None => "    ",
    };
    let Check { what, measured, reference, limit, kind } = check;
    let limit = match kind {
        Kind::Equal => {
            format!("= {reference:.5}, off {:+.3} % of {} %", 100.0 * check.error(), 100.0 * limit)
        }
        Kind::AtLeast => format!("≥ {reference:.5}"),
        Kind::AtMost => format!("≤ {}", figure(*reference)),
        Kind::Reported => String::new(),
    };
    let measured = match kind {
        Kind::AtMost => figure(*measured),
        _ => format!("{measured:.5}"),
    };
    format!("  {verdict}  {what:<66} {measured:>9} {limit}")
}
