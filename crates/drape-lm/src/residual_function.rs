//! Problem whose residuals are a function.
//!
//! [`ResidualFunction`] implements [`Problem`], so that a closure is enough where a type with a
//! name would say no more.

use crate::problem::Problem;

/// Problem whose residuals are computed by a function, such as a closure.
///
/// ```
/// use drape_lm::{MinimiserSettings, Parameter, ResidualFunction, minimise};
///
/// // A straight line through the origin.
/// let points = [(1.0, 2.1), (2.0, 3.9), (3.0, 6.0)];
/// let line = ResidualFunction::new(points.len(), |p, residuals| {
///     for (residual, (x, y)) in residuals.iter_mut().zip(points) {
///         *residual = p[0] * x - y;
///     }
/// });
/// let report = minimise(&line, &[Parameter::new(1.0)], &MinimiserSettings::default());
/// assert!((report.parameters[0] - 27.9 / 14.0).abs() < 1e-12);
/// ```
#[derive(Clone, Debug)]
pub struct ResidualFunction<F> {
    residual_count: usize,
    function: F,
    weights: Vec<f64>,
}

impl<F: Fn(&[f64], &mut [f64])> ResidualFunction<F> {
    /// Creates a problem of `residual_count` residuals. `function` takes the parameters and writes
    /// the residuals, as [`Problem::residuals`] does.
    #[must_use]
    pub fn new(residual_count: usize, function: F) -> Self {
        Self { residual_count, function, weights: Vec::new() }
    }

    /// Returns the problem with the weight of each squared residual in `weights`.
    #[must_use]
    pub fn with_weights(self, weights: Vec<f64>) -> Self {
        Self { weights, ..self }
    }
}

impl<F: Fn(&[f64], &mut [f64])> Problem for ResidualFunction<F> {
    fn residual_count(&self) -> usize {
        self.residual_count
    }

    fn residuals(&self, parameters: &[f64], out: &mut [f64]) {
        (self.function)(parameters, out);
    }

    fn weights(&self) -> &[f64] {
        &self.weights
    }
}
