//! Largest deformations that a sheet's tests measured, for the provenance.

use std::collections::BTreeMap;

use drape_kes::{Curve, Direction, Sheet, Test};

/// Returns the largest measured deformation of each law by its key path: a strain, a curvature in
/// 1/m, the sine of a shear angle.
///
/// Values stand for the test that they are read from; a law that was not measured has no entry.
pub(crate) fn measured_range(sheet: &Sheet) -> BTreeMap<String, f64> {
    let largest = |curve: &Curve| {
        let range = curve.deformation_range();
        range.low.abs().max(range.high)
    };
    let of = |test: Test, direction: Direction| {
        let curves = sheet.curves.iter();
        let own = curves.filter(move |curve| (curve.test, curve.direction) == (test, direction));
        own.map(largest).reduce(f64::max)
    };
    let mut deformations = BTreeMap::new();
    for direction in [Direction::Warp, Direction::Weft] {
        let values = sheet.values(direction);
        let name = direction.name();
        let tensile = of(Test::Tensile, direction).or(values.tensile_extension());
        deformations.extend(tensile.map(|strain| (format!("{name}.traction"), strain)));
        let from_values = values.bending_rigidity().map(|_| Test::LARGEST_CURVATURE);
        let bending = of(Test::Bending, direction).or(from_values);
        deformations.extend(bending.map(|curvature| (format!("{name}.bending"), curvature)));
        let from_values = values.shear_stiffness().map(|_| Test::LARGEST_ANGLE);
        if let Some(angle) = of(Test::Shear, direction).or(from_values) {
            let most = deformations.entry("shear".into()).or_insert(0.0_f64);
            *most = most.max(angle.sin());
        }
    }
    deformations
}
