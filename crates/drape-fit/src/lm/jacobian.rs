//! Derivatives of the residuals by differences.

use nalgebra::DMatrix;

use super::{Parameter, Problem};

/// Step of forward differences over the size of the parameter: the root of the rounding unit, where the
/// error of the formula (step) meets that of rounding (unit over step).
const FORWARD_STEP: f64 = 1.5e-8;
/// Step of central differences over the size of the parameter: the cube root of the rounding unit, where the
/// error of the formula (step squared) meets that of rounding (unit over step).
const CENTRAL_STEP: f64 = 6e-6;

/// Size taken for a parameter near zero, over its scale.
///
/// One would take too long steps where the fit has left a start that was far too large, the rounding unit too
/// short ones where the fit ends at zero.
const LEAST_SIZE: f64 = 0.01;

/// Which differences are taken for derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Difference {
    /// One evaluation for each parameter, eight digits.
    Forward,
    /// Two evaluations for each parameter, ten digits.
    Central,
}

/// Fills the Jacobian by differences, one-sided at a bound or where one side has no value.
///
/// Returns how often the residuals were evaluated.
pub(super) fn differences(
    problem: &impl Problem,
    parameters: &[Parameter],
    (at, residuals): (&[f64], &[f64]),
    difference: Difference,
    out: &mut DMatrix<f64>,
) -> usize {
    let mut trial = at.to_vec();
    let mut ahead = vec![0.0; residuals.len()];
    let mut behind = residuals.to_vec();
    let mut evaluations = 0;
    for (j, parameter) in parameters.iter().enumerate() {
        if parameter.is_fixed() {
            out.column_mut(j).fill(0.0);
            continue;
        }
        let size = at[j].abs().max(LEAST_SIZE * parameter.scale);
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
        let (high, low) = match difference {
            Difference::Forward => {
                let high = side(at[j] + FORWARD_STEP * size, &mut ahead);
                if high > at[j] {
                    (high, at[j])
                } else {
                    (at[j], side(at[j] - FORWARD_STEP * size, &mut behind))
                }
            }
            Difference::Central => (
                side(at[j] + CENTRAL_STEP * size, &mut ahead),
                side(at[j] - CENTRAL_STEP * size, &mut behind),
            ),
        };
        // Both sides closed: the parameter cannot move, and a zero column says so.
        let inverse = if high > low { 1.0 / (high - low) } else { 0.0 };
        for (i, (a, b)) in ahead.iter().zip(&behind).enumerate() {
            out[(i, j)] = (a - b) * inverse;
        }
        behind.copy_from_slice(residuals);
    }
    evaluations
}
