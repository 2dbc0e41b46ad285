//! Page of tested specimens: the loops of simulated specimens and of their laws overlaid, and their
//! KES values.

use drape_fabric::Fabric;
use drape_kes::{Curve, Direction, Test};
use drape_report::plot::{OverlayPlot, Trace};
use drape_report::{ComparePage, FabricName};
use drape_validate::instrument::Comparison;

use super::VERSION;
use super::loop_plot::trace;
use super::{kes_value, quantity};

/// Tests of a specimen, in the order of the page.
pub const TESTS: [Test; 3] = [Test::Tensile, Test::Bending, Test::Shear];

/// Loop of a specimen, with the loop of its law.
pub struct TestedLoop {
    /// Test.
    pub test: Test,
    /// Direction of the specimen.
    pub direction: Direction,
    /// Loops of the specimen and of the law.
    pub comparison: Comparison,
}

/// Returns the page of the `loops` of a `fabric`.
#[must_use]
pub fn instruments_page(fabric: &Fabric, loops: &[TestedLoop]) -> ComparePage {
    let names = ["Simulated specimens", "Laws"].map(str::to_owned);

    let overlay = |test: Test| {
        let [deformation, load] = quantity::axes(test);
        let traces = |curve: fn(&Comparison) -> &Curve| -> Vec<Trace> {
            let of_test = loops.iter().filter(|tested| tested.test == test);
            of_test
                .map(|tested| trace(tested.direction.name(), curve(&tested.comparison)))
                .collect()
        };
        OverlayPlot {
            title: test.name().into(),
            deformation,
            load,
            fabrics: names.clone().into(),
            traces: vec![traces(|c| &c.measured), traces(|c| &c.ideal)],
        }
    };
    let values = loops.iter().flat_map(|tested| {
        let values = tested.comparison.values().into_iter();
        values.map(|(symbol, values)| kes_value::simulated(tested.direction, symbol, values))
    });

    let source = format!("{}. {}", fabric.name, fabric.source);
    ComparePage {
        fabrics: names.clone().map(|name| FabricName { name, source: source.clone() }).into(),
        version: VERSION.into(),
        overlays: TESTS.into_iter().map(overlay).collect(),
        values: values.collect(),
        ..ComparePage::default()
    }
}
