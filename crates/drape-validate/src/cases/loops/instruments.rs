//! Case `instruments`: specimens along the yarns in every simulated instrument.
//!
//! Loops at three spacings are compared with the loops of the laws. At 5 mm the KES values of both
//! loops are compared too.

use drape_kes::{Direction, Test};

use super::VALUE_LIMIT;
use super::plot::{axes, points};
use crate::error::ValidationError;
use crate::findings::{Check, Findings, Graph, Source};
use crate::instrument::{Comparison, Resolution};
use crate::setup::fabrics::{COTTON, CUPRO, fabric};

/// Spacings, with the limits of the distance of a loop from the loop of the laws.
const SPACINGS: [Limit; 3] = [
    Limit { spacing: 0.01, distance: 0.02 },
    Limit { spacing: 0.005, distance: 0.01 },
    Limit { spacing: 0.0025, distance: 0.02 },
];

/// Limit of the distance of two loops at a spacing.
struct Limit {
    /// Distance of the particles, in m.
    spacing: f64,
    /// Largest root mean square of the differences, over the range of the loads.
    distance: f64,
}

/// Compares every test of two fabrics, along both yarns, with the laws. At 5 mm the KES values of
/// the loops are compared too.
pub(crate) fn instruments() -> Result<Findings, ValidationError> {
    /// Points of a branch of a loop.
    const POINTS: usize = 50;

    let mut findings = Findings::default();
    let Findings { checks, graphs, .. } = &mut findings;
    for text in [CUPRO, COTTON] {
        let fabric = fabric(text)?;
        for test in [Test::Tensile, Test::Bending, Test::Shear] {
            let mut graph = Graph::new(format!("{}, {}", fabric.name, test.name()), axes(test));
            for direction in [Direction::Warp, Direction::Weft] {
                let what = format!("{}, {} {}", fabric.name, test.name(), direction.name());

                for Limit { spacing, distance: limit } in SPACINGS {
                    let resolution = Resolution { spacing, points: POINTS };
                    let comparison = Comparison::run(&fabric, test, direction, resolution)?;
                    let millimetres = 1e3 * spacing;
                    let distance = format!("{what}, {millimetres} mm: distance of the loops");
                    checks.push(Check::at_most(distance, comparison.distance(), limit));

                    // One spacing of three is drawn and evaluated.
                    if spacing == 0.005 {
                        let label = format!("specimen, {}", direction.name());
                        graph.add(Source::Simulated, label, points(&comparison.measured));
                        graph.add(Source::Reference, "law", points(&comparison.ideal));
                        let values = comparison.values().into_iter();
                        checks.extend(values.map(|(symbol, [measured, ideal])| {
                            let what = format!("{what}: {} {}", symbol.name(), symbol.unit());
                            Check::within(what, measured, ideal, VALUE_LIMIT)
                        }));
                    }
                }
            }
            graphs.push(graph);
        }
    }
    Ok(findings)
}
