//! Derivatives of the residuals by differences.

use nalgebra::DMatrix;

use super::{Parameter, Problem};

/// Difference step over the size of the parameter: the cube root of the rounding unit, where the error of
/// the central formula (step squared) meets that of rounding (unit over step).
const STEP: f64 = 6e-6;

/// Fills the Jacobian by central differences, one-sided at a bound or where one side has no value.
///
/// Returns how often the residuals were evaluated.
pub(super) fn differences(
    problem: &impl Problem,
    parameters: &[Parameter],
    at: &[f64],
    residuals: &[f64],
    out: &mut DMatrix<f64>,
) -> usize {
    let mut trial = at.to_vec();
    let mut ahead = vec![0.0; residuals.len()];
    let mut behind = vec![0.0; residuals.len()];
    let mut evaluations = 0;
    for (j, parameter) in parameters.iter().enumerate() {
        let step = STEP * at[j].abs().max(parameter.scale);
        let mut side = |end: f64, values: &mut [f64]| {
            // Beyond a bound the model need not exist: that side is the point itself.
            let end = parameter.clamp(end);
            if end != at[j] {
                trial[j] = end;
                problem.residuals(&trial, values);
                trial[j] = at[j];
                evaluations += 1;
                if values.iter().all(|value| value.is_finite()) {
                    return end;
                }
            }
            values.copy_from_slice(residuals);
            at[j]
        };
        let high = side(at[j] + step, &mut ahead);
        let low = side(at[j] - step, &mut behind);
        // Both sides closed: the parameter cannot move, and a zero column says so.
        let inverse = if high > low { 1.0 / (high - low) } else { 0.0 };
        for (i, (a, b)) in ahead.iter().zip(&behind).enumerate() {
            out[(i, j)] = (a - b) * inverse;
        }
    }
    evaluations
}
