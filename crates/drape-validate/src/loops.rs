//! Loops of simulated instruments.

use drape_kes::{Direction, Test};

use crate::shipped::{COTTON, CUPRO, fabric};
use crate::tester::Comparison;
use crate::{Check, ValidationError};

/// Points of a branch of a loop.
const POINTS: usize = 50;
/// Spacings, in m, with how far the loop may be off, root mean square over its range.
const SPACINGS: [(f64, f64); 3] = [(0.01, 0.02), (0.005, 0.01), (0.0025, 0.02)];
/// How far a KES value may be off.
const VALUE_LIMIT: f64 = 0.02;

/// Every test of two fabrics, along both yarns; at 5 mm with the KES values read from the loops.
pub fn instruments() -> Result<Vec<Check>, ValidationError> {
    let mut checks = Vec::new();
    for text in [CUPRO, COTTON] {
        let fabric = fabric(text)?;
        for test in [Test::Tensile, Test::Bending, Test::Shear] {
            for direction in [Direction::Warp, Direction::Weft] {
                let what = format!("{}, {} {}", fabric.name, test.name(), direction.name());
                for (spacing, limit) in SPACINGS {
                    let found = Comparison::of(&fabric, (test, direction), (spacing, POINTS))?;
                    let millimetres = 1e3 * spacing;
                    let distance = format!("{what}, {millimetres} mm: distance of the loops");
                    checks.push(Check::at_most(distance, found.distance(), limit));
                    if spacing == 0.005 {
                        checks.extend(found.values().into_iter().map(|(symbol, [a, b])| {
                            let what = format!("{what}: {} {}", symbol.name(), symbol.unit());
                            Check::within(what, a, b, VALUE_LIMIT)
                        }));
                    }
                }
            }
        }
    }
    Ok(checks)
}
