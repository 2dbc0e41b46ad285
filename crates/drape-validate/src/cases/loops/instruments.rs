//! Case `instruments`: specimens along the yarns in every simulated instrument.
//!
//! Loops at three spacings are compared with those of the laws; at 5 mm the KES values are read
//! from both.

use drape_kes::{Direction, Test};

use super::VALUE_LIMIT;
use super::plot::{axes, points};
use crate::error::ValidationError;
use crate::findings::{Check, Findings, Graph, Source};
use crate::instrument::{Comparison, Resolution};
use crate::setup::fabrics::{COTTON, CUPRO, fabric};

/// Points of a branch of a loop.
const POINTS: usize = 50;

/// Spacings, in m, with how far the loop may be off, root mean square over its range.
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

/// Every test of two fabrics, along both yarns; at 5 mm with the KES values read from the loops.
pub(crate) fn instruments() -> Result<Findings, ValidationError> {
    let mut findings = Findings::default();
    let Findings { checks, graphs, .. } = &mut findings;
    for text in [CUPRO, COTTON] {
        let fabric = fabric(text)?;
        for test in [Test::Tensile, Test::Bending, Test::Shear] {
            let mut graph = Graph::new(format!("{}, {}", fabric.name, test.name()), axes(test));
            for direction in [Direction::Warp, Direction::Weft] {
                let what = format!("{}, {} {}", fabric.name, test.name(), direction.name());
                for Limit { spacing, distance: limit } in SPACINGS {
                    let found = Comparison::of(
                        &fabric,
                        test,
                        direction,
                        Resolution { spacing, points: POINTS },
                    )?;
                    let millimetres = 1e3 * spacing;
                    let distance = format!("{what}, {millimetres} mm: distance of the loops");
                    checks.push(Check::at_most(distance, found.distance(), limit));
                    if spacing == 0.005 {
                        let label = format!("specimen, {}", direction.name());
                        graph.add(Source::Simulated, label, points(&found.measured));
                        graph.add(Source::Reference, "law", points(&found.ideal));
                        checks.extend(found.values().into_iter().map(|(symbol, [a, b])| {
                            let what = format!("{what}: {} {}", symbol.name(), symbol.unit());
                            Check::within(what, a, b, VALUE_LIMIT)
                        }));
                    }
                }
            }
            graphs.push(graph);
        }
    }
    Ok(findings)
}
