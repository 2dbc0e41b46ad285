//! Reads B and 2HB off a measured bending loop, in the laboratory's units.

use drape_kes::{BendingPoints, Curve, Direction, Error, EvaluationPoints, ShearPoints, Test};

/// Bending rigidity of the fabric, in N·m.
const RIGIDITY: f64 = 1.2e-5;
/// Friction moment per width, in N.
const PLATEAU: f64 = 6e-4;

#[allow(clippy::print_stdout, reason = "an example prints its result")]
fn main() -> Result<(), Error> {
    // A KES-FB2 cycle between ±2.5 cm⁻¹, as an instrument writes it: curvature in 1/m, moment per
    // width in N. The friction opposes the motion, so the loop is 2·PLATEAU wide.
    let branch = |sign: f64| {
        (-25..=25).map(move |i| {
            let curvature = sign * 10.0 * f64::from(i);
            (curvature, RIGIDITY * curvature + sign * PLATEAU)
        })
    };
    let (curvature, moment) = branch(1.0).chain(branch(-1.0)).unzip();
    let curve = Curve::new(Test::Bending, Direction::Warp, curvature, moment)?;
    assert_eq!(curve.branches().len(), 2);

    let points = EvaluationPoints {
        maximum_tension: 490.0,
        bending: BendingPoints::default(),
        shear: ShearPoints::default(),
    };
    let mut values = Vec::new();
    for read in curve.values(&points) {
        let value = read.value?;
        println!("{} = {value:.4} {}", read.symbol.name(), read.symbol.unit());
        values.push(value);
    }
    // 1 gf·cm²/cm is 9.80665e-5 N·m, and 1 gf·cm/cm is 9.80665e-3 N.
    assert!((values[0] * 9.806_65e-5 / RIGIDITY - 1.0).abs() < 1e-12);
    assert!((values[1] * 9.806_65e-3 / (2.0 * PLATEAU) - 1.0).abs() < 1e-12);
    Ok(())
}
