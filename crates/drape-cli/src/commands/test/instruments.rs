//! Specimens of a fabric in simulated KES instruments: their loops, compared with the laws.

use drape::fabric::Fabric;
use drape::run::reports::{DIRECTIONS, TESTS, TestedLoop, instruments_page};
use drape::validate::instrument::{Comparison, Resolution};
use serde_json::json;

use super::arguments::TestArguments;
use crate::commands::sheets;
use crate::failure::Failure;
use crate::say::{say, say_json, say_written};
use drape::run::file;

/// Default spacing of the particles, in mm.
const SPACING: f64 = 5.0;

/// Number of points of a branch of a loop.
const POINTS: usize = 50;

/// Tests specimens of `fabric` in every instrument and direction. Prints and stores the loops.
pub(crate) fn compare(fabric: &Fabric, arguments: &TestArguments) -> Result<(), Failure> {
    let spacing = 1e-3 * arguments.spacing.unwrap_or(SPACING);
    let mut loops = Vec::new();
    for test in TESTS {
        for direction in DIRECTIONS {
            let comparison =
                Comparison::run(fabric, test, direction, Resolution { spacing, points: POINTS })
                    .map_err(|error| Failure::Solver(error.to_string()))?;
            let tested = TestedLoop { test, direction, comparison };
            if !arguments.json {
                say(line(&tested))?;
            }
            loops.push(tested);
        }
    }

    if arguments.json {
        let rows: Vec<serde_json::Value> = loops.iter().map(row).collect();
        say_json(&rows)?;
    }
    if let Some(folder) = &arguments.report {
        let path = folder.join(format!("{}-tested.html", sheets::stem(&arguments.fabric)));
        file::write(&path, &instruments_page(fabric, &loops).to_html()?)?;
        if !arguments.json {
            say_written(format_args!("page written to {}", path.display()))?;
        }
    }
    Ok(())
}

/// Describes the loop `tested` in a line: its distance from the law's loop, and its values,
/// simulated and of the law.
fn line(tested: &TestedLoop) -> String {
    let TestedLoop { test, direction, comparison } = tested;
    let values = comparison.values().into_iter().map(|(symbol, [measured, ideal])| {
        format!("{} {measured:.4} ({ideal:.4}) {}", symbol.name(), symbol.unit())
    });
    format!(
        "{:<8} {:<5} off {:6.3} % of the loop's range; {}",
        test.name(),
        direction.name(),
        100.0 * comparison.distance(),
        values.collect::<Vec<_>>().join(", ")
    )
}

/// Returns the loop `tested` as JSON.
fn row(tested: &TestedLoop) -> serde_json::Value {
    let TestedLoop { test, direction, comparison } = tested;
    let values = comparison.values().into_iter().map(|(symbol, [simulated, law])| {
        json!({
            "symbol": symbol.name(), "unit": symbol.unit(), "simulated": simulated, "law": law,
        })
    });
    json!({
        "test": test.name(),
        "direction": direction.name(),
        "distance": comparison.distance(),
        "values": values.collect::<Vec<_>>(),
        "deformation": comparison.measured.deformation(),
        "load": comparison.measured.load(),
    })
}
