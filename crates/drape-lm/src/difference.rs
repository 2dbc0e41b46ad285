//! Jacobian of the residuals by finite differences, for problems without exact derivatives.
//!
//! `iterate` computes the Jacobian at each new point.

use nalgebra::DMatrix;

use crate::problem::{Parameter, Problem};

/// Step of forward differences over the size of the parameter.
///
/// The step is the root of the rounding unit. There the truncation error (proportional to the step)
/// equals the rounding error (unit over step).
const FORWARD_STEP: f64 = 1.5e-8;
/// Step of central differences over the size of the parameter.
///
/// The step is the cube root of the rounding unit. There the truncation error (proportional to the
/// squared step) equals the rounding error (unit over step).
const CENTRAL_STEP: f64 = 6e-6;

/// Smallest size taken for a parameter, over its scale.
///
/// A value of 1 gives steps that are too long where the start was far too large. The rounding unit
/// gives steps that are too short where the fit ends at zero.
const LEAST_SIZE: f64 = 0.01;

/// Difference formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Difference {
    /// One evaluation for each parameter, eight digits.
    Forward,
    /// Two evaluations for each parameter, ten digits.
    Central,
}

/// Values of the parameters and the residuals at these values, without weights.
#[derive(Clone, Copy)]
pub(crate) struct Evaluated<'a> {
    pub(crate) values: &'a [f64],
    pub(crate) residuals: &'a [f64],
}

impl Difference {
    /// Writes the Jacobian of `problem` at `point` into `out` and returns the number of
    /// evaluations.
    ///
    /// The difference is one-sided at a bound, and where the residuals on one side are not finite.
    pub(crate) fn jacobian(
        self,
        problem: &(impl Problem + ?Sized),
        parameters: &[Parameter],
        point: Evaluated<'_>,
        out: &mut DMatrix<f64>,
    ) -> usize {
        let mut sides = Sides { problem, point, trial: point.values.to_vec(), evaluations: 0 };
        let mut upper = vec![0.0; point.residuals.len()];
        let mut lower = point.residuals.to_vec();
        for (j, parameter) in parameters.iter().enumerate() {
            if parameter.is_fixed() {
                out.column_mut(j).fill(0.0);
                continue;
            }
            let value = point.values[j];
            let size = value.abs().max(LEAST_SIZE * parameter.scale);

            // A side that cannot be evaluated is the point itself, with difference zero.
            let (high, low) = match self {
                Self::Forward => {
                    let end = parameter.clamp(value + FORWARD_STEP * size);
                    let high = sides.evaluate(j, end, &mut upper);
                    if high > value {
                        (high, value)
                    } else {
                        let end = parameter.clamp(value - FORWARD_STEP * size);
                        (value, sides.evaluate(j, end, &mut lower))
                    }
                }
                Self::Central => {
                    let [above, below] = [value + CENTRAL_STEP * size, value - CENTRAL_STEP * size];
                    (
                        sides.evaluate(j, parameter.clamp(above), &mut upper),
                        sides.evaluate(j, parameter.clamp(below), &mut lower),
                    )
                }
            };

            // If neither side has residuals, a zero column says that the parameter cannot move.
            let inverse = if high > low { 1.0 / (high - low) } else { 0.0 };
            for (i, (a, b)) in upper.iter().zip(&lower).enumerate() {
                out[(i, j)] = (a - b) * inverse;
            }
            lower.copy_from_slice(point.residuals);
        }
        sides.evaluations
    }
}

/// Evaluations of the residuals on either side of a point.
struct Sides<'a, P: ?Sized> {
    problem: &'a P,
    point: Evaluated<'a>,
    /// Values of the parameters. Between two evaluations they are the values of `point`.
    trial: Vec<f64>,
    evaluations: usize,
}

impl<P: Problem + ?Sized> Sides<'_, P> {
    /// Writes the residuals with parameter `j` at `end` into `residuals` and returns `end`.
    ///
    /// If these residuals are not finite, or if `end` is the value of the parameter at the point,
    /// the residuals of the point are written and the value at the point is returned.
    fn evaluate(&mut self, j: usize, end: f64, residuals: &mut [f64]) -> f64 {
        let value = self.point.values[j];
        if end != value {
            self.trial[j] = end;
            self.problem.residuals(&self.trial, residuals);
            self.trial[j] = value;
            self.evaluations += 1;
            if residuals.iter().all(|residual| residual.is_finite()) {
                return end;
            }
        }
        residuals.copy_from_slice(self.point.residuals);
        value
    }
}
