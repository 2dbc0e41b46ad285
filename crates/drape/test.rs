//! `drape test`: specimens of a fabric in simulated KES instruments.

use drape::fabric::Fabric;
use drape::kes::{Curve, Direction, Test};
use drape::report::plot::{OverlayPlot, Trace};
use drape::report::{ComparePage, FabricName};
use drape::validate::tester::Comparison;
use serde_json::json;

use crate::command::TestArguments;
use crate::failure::Failure;
use crate::say::say;
use crate::{batch, drapemeter, fabric, fabric_page, file, kes_value, quantity};

/// Spacing of the particles, in mm.
const SPACING: f64 = 5.0;
/// Points of a branch of a loop.
const POINTS: usize = 50;
const TESTS: [Test; 3] = [Test::Tensile, Test::Bending, Test::Shear];

pub(crate) fn test(arguments: &TestArguments) -> Result<(), Failure> {
    let fabric = fabric::read(&arguments.fabric)?;
    if let Some(spacing) = arguments.spacing.filter(|mm| !(*mm >= 0.5 && *mm <= 50.0)) {
        let message = format!("--spacing {spacing} is not between 0.5 and 50 (mm)");
        return Err(Failure::Usage(message));
    }
    if arguments.drape {
        return drapemeter::drape(&fabric, arguments);
    }
    let spacing = 1e-3 * arguments.spacing.unwrap_or(SPACING);
    let mut found = Vec::new();
    for test in TESTS {
        for direction in fabric_page::DIRECTIONS {
            let comparison = Comparison::of(&fabric, (test, direction), (spacing, POINTS))
                .map_err(|error| Failure::Solver(error.to_string()))?;
            if !arguments.json {
                say(line(test, direction, &comparison))?;
            }
            found.push((test, direction, comparison));
        }
    }
    if arguments.json {
        let rows: Vec<serde_json::Value> = found.iter().map(row).collect();
        let json = serde_json::to_string_pretty(&rows);
        say(json.expect("numbers and strings have a JSON form"))?;
    }
    if let Some(folder) = &arguments.report {
        let path = folder.join(format!("{}-tested.html", batch::stem(&arguments.fabric)));
        file::write(&path, &page(&fabric, &found).to_html()?)?;
        if !arguments.json {
            say(format_args!("page written to {}", path.display()))?;
        }
    }
    Ok(())
}

type Found = (Test, Direction, Comparison);

/// How far a loop is off, and its values, simulated and of the laws.
fn line(test: Test, direction: Direction, comparison: &Comparison) -> String {
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

/// A test as scripts read it.
fn row((test, direction, comparison): &Found) -> serde_json::Value {
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

/// The loops overlaid and the values beside each other.
fn page(fabric: &Fabric, found: &[Found]) -> ComparePage {
    let names = ["Simulated specimens", "Laws"].map(str::to_owned);
    let overlay = |test: Test| {
        let [deformation, load] = quantity::axes(test);
        let traces = |curve: fn(&Comparison) -> &Curve| -> Vec<Trace> {
            let of_test = found.iter().filter(|(of, ..)| *of == test);
            of_test
                .map(|(_, direction, both)| fabric_page::trace_of(direction.name(), curve(both)))
                .collect()
        };
        OverlayPlot {
            title: test.name().into(),
            deformation,
            load,
            fabrics: names.clone(),
            traces: [traces(|c| &c.measured), traces(|c| &c.ideal)],
        }
    };
    let values = found.iter().flat_map(|(_, direction, comparison)| {
        let values = comparison.values().into_iter();
        values.map(|(symbol, values)| kes_value::compared(*direction, symbol, values))
    });
    let source = format!("{}. {}", fabric.name, fabric.source);
    ComparePage {
        fabrics: names.clone().map(|name| FabricName { name, source: source.clone() }),
        version: fabric_page::VERSION.into(),
        overlays: TESTS.into_iter().map(overlay).collect(),
        values: values.collect(),
        ..ComparePage::default()
    }
}
