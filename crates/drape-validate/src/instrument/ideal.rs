//! Ideal curve of a test: the laws of a fabric driven through the cycle of the instrument.
//!
//! The fabric deforms evenly, so the clamps give its strain, angle or curvature, and its law gives
//! the load per width.

use drape_fabric::{Fabric, Law, drive};
use drape_kes::{Curve, Direction, Test};

use super::cycle::cycle;
use super::yarn::laws;

/// Returns the curve of `test` along `direction` by the laws of `fabric` alone, as if the
/// instrument deformed the fabric evenly. Each branch has `points` points.
///
/// # Errors
/// There are too few points, or a load is not finite. Loads of a checked fabric are finite.
pub fn ideal(
    fabric: &Fabric,
    test: Test,
    direction: Direction,
    points: usize,
) -> Result<Curve, drape_kes::Error> {
    let path = cycle(fabric, test, direction, points);
    let laws = laws(fabric, direction);
    let load = match test {
        Test::Tensile => drive(&laws.traction, laws.traction.virgin(), &path),
        Test::Bending | Test::LoopBending => drive(&laws.bending, laws.bending.virgin(), &path),
        Test::Shear => {
            let sines: Vec<f64> = path.iter().map(|angle| angle.sin()).collect();
            drive(&fabric.shear, fabric.shear.virgin(), &sines)
        }
    };
    curve(test, direction, path, load)
}

/// Returns the curve of `test` with the deformations `path` and the loads `load`. A tensile test
/// ends where the returning fabric is slack.
pub(crate) fn curve(
    test: Test,
    direction: Direction,
    mut path: Vec<f64>,
    mut load: Vec<f64>,
) -> Result<Curve, drape_kes::Error> {
    if test == Test::Tensile {
        let points = path.len() / 2;
        let slack = load.iter().skip(points).position(|load| *load <= 0.0);
        let end = slack.map_or(path.len(), |slack| points + slack + 1);
        path.truncate(end);
        load.truncate(end);
    }
    Curve::new(test, direction, path, load)
}
