//! Jacobian of the residuals by finite differences, for problems that do not know theirs.
//!
//! `iterate` calls it at each new point.

use nalgebra::DMatrix;

use crate::problem::{Parameter, Problem};

/// Step of forward differences over the size of the parameter.
///
/// It is the root of the rounding unit, where the truncation error (step) meets the rounding error
/// (unit over step).
const FORWARD_STEP: f64 = 1.5e-8;
/// Step of central differences over the size of the parameter.
///
/// It is the cube root of the rounding unit, where the truncation error (step squared) meets the
/// rounding error (unit over step).
const CENTRAL_STEP: f64 = 6e-6;

/// Smallest size taken for a parameter, over its scale.
///
/// One gives steps that are too long where the start was far too large; the rounding unit gives
/// steps that are too short where the fit ends at zero.
const LEAST_SIZE: f64 = 0.01;

/// Difference formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Difference {
    /// One evaluation for each parameter, eight digits.
    Forward,
    /// Two evaluations for each parameter, ten digits.
    Central,
}

/// Parameters with the residuals there, without weights.
#[derive(Clone, Copy)]
pub(crate) struct Evaluated<'a> {
    pub(crate) parameters: &'a [f64],
    pub(crate) residuals: &'a [f64],
}

impl Difference {
    /// Fills the Jacobian by differences, one-sided at a bound or where one side has no value.
    ///
    /// Returns the number of evaluations of the residuals.
    pub(crate) fn jacobian(
        self,
        problem: &impl Problem,
        parameters: &[Parameter],
        point: Evaluated<'_>,
        out: &mut DMatrix<f64>,
    ) -> usize {
        let Evaluated { parameters: at, residuals } = point;
        let mut trial = at.to_vec();
        let mut upper = vec![0.0; residuals.len()];
        let mut lower = residuals.to_vec();
        let mut evaluations = 0;
        for (j, parameter) in parameters.iter().enumerate() {
            if parameter.is_fixed() {
                out.column_mut(j).fill(0.0);
                continue;
            }
            let size = at[j].abs().max(LEAST_SIZE * parameter.scale);
            let mut side = |end: f64, values: &mut [f64]| {
                // The model need not exist beyond a bound: that side is the point itself.
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
            let (high, low) = match self {
                Self::Forward => {
                    let high = side(at[j] + FORWARD_STEP * size, &mut upper);
                    if high > at[j] {
                        (high, at[j])
                    } else {
                        (at[j], side(at[j] - FORWARD_STEP * size, &mut lower))
                    }
                }
                Self::Central => (
                    side(at[j] + CENTRAL_STEP * size, &mut upper),
                    side(at[j] - CENTRAL_STEP * size, &mut lower),
                ),
            };
            // Neither side has a value: a zero column says that the parameter cannot move.
            let inverse = if high > low { 1.0 / (high - low) } else { 0.0 };
            for (i, (a, b)) in upper.iter().zip(&lower).enumerate() {
                out[(i, j)] = (a - b) * inverse;
            }
            lower.copy_from_slice(residuals);
        }
        evaluations
    }
}
