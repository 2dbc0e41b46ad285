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
const POINTS: usize = 25;

/// Curvature times spacing squared, in m, at which the shear of cells on the bias adds a hundredth
/// to the moment of the cupro's elastic laws. The shear adds less to the moment of the cotton.
const BIAS_RANGE: f64 = 3e-4;

/// Compares bending specimens of two fabrics, cut at 45° to their yarns, with the laws.
///
/// Cells that fold along their diagonals resist with their shear as well, see
/// [`on_the_bias_in_cells`]. At the spacings of the other specimens, the whole loop is compared
/// with the laws in such cells. Up to the curvature at which shear adds a hundredth to the moment,
/// the loop is also compared with the laws alone. This curvature is proportional to the inverse of
/// the spacing squared. At a spacing of 1.25 mm shear adds a fiftieth at 2.5 cm⁻¹, and the KES
/// values are compared with the values of the laws alone.
pub(crate) fn bias_bending() -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    for text in [CUPRO, COTTON] {
        let fabric = fabric(text)?;
        for spacing in [0.005, 0.0025] {
            let (millimetres, spacing) = (1e3 * spacing, bias_spacing(spacing));
            let what = format!("{}, {millimetres} mm: distance", fabric.name);
            let resolution = Resolution { spacing, points: POINTS };

            // The whole loop, with the shear of the cells.
            let measured = bend_on_the_bias(&fabric, LARGEST_CURVATURE, resolution)?;
            let ideal = on_the_bias_in_cells(&fabric, spacing, LARGEST_CURVATURE, POINTS)?;
            let distance = Comparison { measured, ideal }.distance();
            checks.push(Check::at_most(format!("{what} from the laws in cells"), distance, 0.01));

            // A small loop, in which the shear of the cells adds little.
            let largest = BIAS_RANGE / (spacing * spacing);
            let measured = bend_on_the_bias(&fabric, largest, resolution)?;
            let ideal = on_the_bias(&fabric, largest, POINTS)?;
            let distance = Comparison { measured, ideal }.distance();
            let what = format!("{what} of the loops up to {:.2} cm⁻¹", 0.01 * largest);
            checks.push(Check::at_most(what, distance, 0.02));
        }
    }

    // The whole loop on a fine grid, with the KES values.
    let fabric = fabric(CUPRO)?;
    let resolution = Resolution { spacing: bias_spacing(0.00125), points: POINTS };
    let comparison = Comparison {
        measured: bend_on_the_bias(&fabric, LARGEST_CURVATURE, resolution)?,
        ideal: on_the_bias(&fabric, LARGEST_CURVATURE, POINTS)?,
    };
    let what = format!("{}, 1.25 mm", fabric.name);
    let distance = comparison.distance();
    checks.push(Check::at_most(format!("{what}: distance of the loops"), distance, 0.01));
    checks.extend(comparison.values().into_iter().map(|(symbol, [measured, ideal])| {
        let what = format!("{what}: {} {}", symbol.name(), symbol.unit());
        Check::within(what, measured, ideal, VALUE_LIMIT)
    }));
    Ok(checks.into())
}
