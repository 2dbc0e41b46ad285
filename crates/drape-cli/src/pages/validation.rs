//! Pages of `drape validate`: HTML with plots and pictures, and the Markdown of `VALIDATION.md`.

mod limits;

use drape::render::Picture;
use drape::report::plot::{Axis, GraphPlot, GraphSeries, Look};
use drape::report::{CaptionedPicture, ValidationCase, ValidationPage, ValidationRow};
use drape::run::reports::VERSION;
use drape::validate::{Check, Graph, Kind, Layout, Outcome, Source, Still};

use self::limits::LIMITS;
use super::picture::SnapshotPictures;
use crate::failure::Failure;

/// Width and height of each picture of a still, in pixels.
const STILL_SIZE: [u32; 2] = [640, 480];

/// Returns the path of the shipped picture of `case`, relative to the Markdown page.
fn shipped_picture(case: &str) -> Option<&'static str> {
    (case == "breen").then_some("../../scenes/cubes.png")
}

/// Returns the HTML page of `outcomes`, with the plots and pictures of every case.
pub(crate) fn page(outcomes: &[Outcome]) -> Result<ValidationPage, Failure> {
    let cases: Result<Vec<ValidationCase>, Failure> = outcomes.iter().map(case).collect();
    Ok(ValidationPage {
        version: VERSION.into(),
        cases: cases?,
        notes: LIMITS.iter().map(|text| text.replace('`', "")).collect(),
    })
}

fn case(outcome: &Outcome) -> Result<ValidationCase, Failure> {
    let stills = outcome.stills.iter();
    let pictures: Result<Vec<CaptionedPicture>, Failure> = stills
        .map(|still| Ok(CaptionedPicture { caption: still.title.clone(), picture: draw(still)? }))
        .collect();
    Ok(ValidationCase {
        name: outcome.name.clone(),
        title: outcome.title.clone(),
        seconds: outcome.seconds,
        failure: outcome.failure.clone(),
        rows: outcome.checks.iter().map(row).collect(),
        plots: outcome.graphs.iter().map(plot).collect(),
        pictures: pictures?,
    })
}

fn plot(graph: &Graph) -> GraphPlot {
    let series = graph.series.iter().map(|series| GraphSeries {
        label: series.label.clone(),
        look: match series.source {
            Source::Simulated => Look::Dots,
            Source::Traced => Look::Line,
            Source::Reference => Look::Exact,
        },
        points: series.points.clone(),
    });
    GraphPlot {
        title: graph.title.clone(),
        axes: graph.axes.map(|axis| Axis::new(axis.label, axis.unit, axis.in_si)),
        categories: Vec::new(),
        logarithmic: [graph.layout == Layout::Logarithmic; 2],
        to_scale: graph.layout == Layout::ToScale,
        series: series.collect(),
    }
}

/// Draws the cloths of `still` side by side.
fn draw(still: &Still) -> Result<Picture, Failure> {
    let view = still.view.map(Some);
    let snapshots = still.snapshots.iter();
    let pictures: Result<Vec<Picture>, Failure> =
        snapshots.map(|snapshot| SnapshotPictures::new(snapshot)?.draw(view, STILL_SIZE)).collect();
    Ok(Picture::sheet(&pictures?, still.columns))
}

/// Returns the row of `check` in the table of its case.
fn row(check: &Check) -> ValidationRow {
    let Check { what, measured, reference, limit, kind } = check;
    let [measured, reference, error, limit] = match kind {
        Kind::Equal => [
            format!("{measured:.5}"),
            format!("{reference:.5}"),
            format!("{:+.3} %", 100.0 * check.error()),
            format!("{} %", 100.0 * limit),
        ],
        Kind::AtLeast => {
            [format!("{measured:.3}"), String::new(), String::new(), format!("≥ {reference}")]
        }
        Kind::AtMost => {
            [figure(*measured), String::new(), String::new(), format!("≤ {}", figure(*reference))]
        }
        Kind::Reported => {
            [format!("{measured:.3}"), String::new(), String::new(), "none".to_owned()]
        }
    };

    let (what, passes) = (what.clone(), check.verdict());
    ValidationRow { what, measured, reference, error, limit, passes }
}

/// Returns `value` with three decimals, or with an exponent if it is very small or large.
pub(crate) fn figure(value: f64) -> String {
    if (0.01..1e5).contains(&value.abs()) { format!("{value:.3}") } else { format!("{value:.1e}") }
}

/// Returns the Markdown page of `outcomes`. `crates/drape/VALIDATION.md` is such a page.
pub(crate) fn markdown(outcomes: &[Outcome]) -> String {
    let mut page = String::from(
        "# Validation\n\nSimulations against exact solutions and measurements. `drape validate --markdown FILE` \
         writes this page, with `--full` the cases that take minutes too; \
         the references are computed in `crates/drape-validate/src/reference` or cited there. \
         `drape validate --report FOLDER` writes the same with plots and pictures.\n",
    );
    for outcome in outcomes {
        page += &format!("\n## {}\n\n`drape validate {}`\n\n", outcome.title, outcome.name);
        if let Some(failure) = &outcome.failure {
            page += &format!("It could not be run: {failure}\n");
            continue;
        }

        let still = outcome.stills.first().map_or(&outcome.title, |still| &still.title);
        if let Some(path) = shipped_picture(&outcome.name) {
            page += &format!("![{still}]({path})\n\n{still}.\n\n");
        }

        // simulated
        page += "| figure | simulated | reference | error | limit | |\n|---|---|---|---|---|---|\n";
        for row in outcome.checks.iter().map(row) {
            let verdict = match row.passes {
                Some(true) => "pass",
                Some(false) => "**fail**",
                None => "",
            };
            let cells = row
                .cells()
                .map(|cell: &str| if cell.is_empty() { String::new() } else { format!("{cell} ") });
            page += &format!("| {} | {}| {verdict} |\n", row.what, cells.join("| "));
        }
    }

    page += "\n## What this does not show\n\n";
    LIMITS.iter().for_each(|text| page += &format!("* {}\n", text.replace('\n', "\n  ")));
    page
}
