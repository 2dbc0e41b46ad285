//! Case `bias-bending`: bending specimens cut at 45° to their yarns.
//!
//! Their moment is `$\tfrac12(M_1(\kappa/2) + M_2(\kappa/2))$`, to which square cells add their
//! shear.

use super::VALUE_LIMIT;
use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::instrument::{
    Comparison, LARGEST_CURVATURE, Resolution, bend_on_the_bias, bias_spacing, on_the_bias,
    on_the_bias_in_cells,
};
use crate::setup::fabrics::{COTTON, CUPRO, fabric};

/// Points of a branch of a specimen on the bias.
const FEW: usize = 25;

/// Curvature times spacing squared, in m, where the shear of cells on the bias adds a hundredth to
/// the moment of the cupro's elastic laws; to that of the cotton's it adds less.
const BIAS_RANGE: f64 = 3e-4;

/// Bending specimens of two fabrics cut at 45° to their yarns.
///
/// The cells' shear counts as bending when they fold along their diagonals, see
/// [`on_the_bias_in_cells`]; so at the spacings of the other specimens the whole loop is held
/// against the laws in such cells, and against the laws alone where that adds less than a hundredth
/// to the moment: up to a curvature that goes with the inverse of the spacing squared. At a
/// millimetre and a quarter it is a fiftieth at 2.5 cm⁻¹, and the KES values are the laws'.
pub(crate) fn bias_bending() -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    for text in [CUPRO, COTTON] {
        let fabric = fabric(text)?;
        for spacing in [0.005, 0.0025] {
            let (millimetres, spacing) = (1e3 * spacing, bias_spacing(spacing));
            let what = format!("{}, {millimetres} mm: distance", fabric.name);
            let of = |largest, ideal| -> Result<Comparison, ValidationError> {
                let measured =
                    bend_on_the_bias(&fabric, largest, Resolution { spacing, points: FEW })?;
                Ok(Comparison { measured, ideal })
            };
            let ideal = on_the_bias_in_cells(&fabric, spacing, LARGEST_CURVATURE, FEW);
            let distance = of(LARGEST_CURVATURE, ideal)?.distance();
            checks.push(Check::at_most(format!("{what} from the laws in cells"), distance, 0.01));
            let largest = BIAS_RANGE / (spacing * spacing);
            let distance = of(largest, on_the_bias(&fabric, largest, FEW))?.distance();
            let what = format!("{what} of the loops up to {:.2} cm⁻¹", 0.01 * largest);
            checks.push(Check::at_most(what, distance, 0.02));
        }
    }
    let fabric = fabric(CUPRO)?;
    let spacing = bias_spacing(0.00125);
    let measured =
        bend_on_the_bias(&fabric, LARGEST_CURVATURE, Resolution { spacing, points: FEW })?;
    let found = Comparison { measured, ideal: on_the_bias(&fabric, LARGEST_CURVATURE, FEW) };
    let what = format!("{}, 1.25 mm", fabric.name);
    checks.push(Check::at_most(format!("{what}: distance of the loops"), found.distance(), 0.01));
    checks.extend(found.values().into_iter().map(|(symbol, [a, b])| {
        Check::within(format!("{what}: {} {}", symbol.name(), symbol.unit()), a, b, VALUE_LIMIT)
    }));
    Ok(checks.into())
}
