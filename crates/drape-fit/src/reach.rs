//! How far a sheet's tests deformed the fabric.

use std::collections::BTreeMap;

use drape_kes::{Curve, Direction, Sheet, Test};

use crate::fabric_values::{BENDING_REACH, SHEAR_REACH};

/// The largest deformation that was measured for each law, by its key path: a strain, a curvature in 1/m, the sine of a
/// shear angle. Values stand for the test that they are read from; a law that was not measured has none.
pub(crate) fn reach(sheet: &Sheet) -> BTreeMap<String, f64> {
    let farthest = |curve: &Curve| {
        let (low, high) = curve.deformation_range();
        low.abs().max(high)
    };
    let of = |test: Test, direction: Direction| {
        let curves = sheet.curves.iter();
        let own = curves.filter(move |curve| (curve.test, curve.direction) == (test, direction));
        own.map(farthest).reduce(f64::max)
    };
    let mut reach = BTreeMap::new();
    for direction in [Direction::Warp, Direction::Weft] {
        let values = sheet.values(direction);
        let name = direction.name();
        let tensile = of(Test::Tensile, direction).or(values.tensile_extension());
        reach.extend(tensile.map(|strain| (format!("{name}.traction"), strain)));
        let bent = values.bending_rigidity().map(|_| BENDING_REACH);
        let bending = of(Test::Bending, direction).or(bent);
        reach.extend(bending.map(|curvature| (format!("{name}.bending"), curvature)));
        let sheared = values.shear_stiffness().map(|_| SHEAR_REACH);
        if let Some(angle) = of(Test::Shear, direction).or(sheared) {
            let most = reach.entry("shear".into()).or_insert(0.0_f64);
            *most = most.max(angle.sin());
        }
    }
    reach
}
