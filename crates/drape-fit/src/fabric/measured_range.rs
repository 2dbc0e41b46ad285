//! Largest deformations that a sheet's tests measured, for the provenance.

use std::collections::BTreeMap;

use drape_kes::{Direction, Sheet, Test};

/// Returns the largest deformation that the tests of `sheet` measured, by the key path of the law:
/// a strain, a curvature in 1/m, or the sine of a shear angle.
///
/// Values stand for the test that they are read from; a law that was not measured has no entry.
pub(crate) fn measured_range(sheet: &Sheet) -> BTreeMap<String, f64> {
    let mut deformations = BTreeMap::new();
    for direction in [Direction::Warp, Direction::Weft] {
        let values = sheet.values(direction);
        let name = direction.name();
        let tensile =
            largest_deformation(sheet, Test::Tensile, direction).or(values.tensile_extension());
        deformations.extend(tensile.map(|strain| (format!("{name}.traction"), strain)));
        let from_values = values.bending_rigidity().map(|_| Test::LARGEST_CURVATURE);
        let bending = largest_deformation(sheet, Test::Bending, direction).or(from_values);
        deformations.extend(bending.map(|curvature| (format!("{name}.bending"), curvature)));
        let from_values = values.shear_stiffness().map(|_| Test::LARGEST_ANGLE);
        if let Some(angle) = largest_deformation(sheet, Test::Shear, direction).or(from_values) {
            let most = deformations.entry("shear".into()).or_insert(0.0_f64);
            *most = most.max(angle.sin());
        }
    }
    deformations
}

/// Returns the largest deformation of the curves of `test` and `direction`.
fn largest_deformation(sheet: &Sheet, test: Test, direction: Direction) -> Option<f64> {
    sheet
        .curves_of(test, direction)
        .map(|curve| {
            let range = curve.deformation_range();
            range.low.abs().max(range.high)
        })
        .reduce(f64::max)
}
