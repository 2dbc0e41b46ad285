//! What is minimised, and over which parameters.

use nalgebra::DMatrix;

/// Residuals as a function of parameters.
pub trait Problem {
    /// How many residuals there are.
    fn residual_count(&self) -> usize;

    /// Writes the residuals at some parameters; not a number where the model has no value.
    ///
    /// A trial with a residual that is not finite is refused, as if it were infinitely bad.
    fn residuals(&self, parameters: &[f64], out: &mut [f64]);

    /// Writes the derivative of residual `i` by parameter `j` into `out[(i, j)]`, if the problem knows it.
    ///
    /// Returning `false` asks for differences instead, which is what happens unless this is overridden.
    fn jacobian(&self, _parameters: &[f64], _out: &mut DMatrix<f64>) -> bool {
        false
    }

    /// Weight of each squared residual; an empty list, the default, means one for all.
    fn weights(&self) -> &[f64] {
        &[]
    }
}

/// A parameter: where to start, the bounds, and the size of a change that matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Value to start from; it is moved inside the bounds.
    pub start: f64,
    /// Lowest value allowed.
    pub lower: f64,
    /// Highest value allowed.
    pub upper: f64,
    /// Size of the parameter, for difference steps where its value is near zero.
    pub scale: f64,
}

impl Parameter {
    /// An unbounded parameter that starts here, and whose size is that of its start (one at zero).
    pub fn new(start: f64) -> Self {
        let scale = if start == 0.0 { 1.0 } else { start.abs() };
        Self { start, lower: f64::NEG_INFINITY, upper: f64::INFINITY, scale }
    }

    /// The same parameter kept between two values.
    #[must_use]
    pub fn between(self, lower: f64, upper: f64) -> Self {
        Self { lower, upper, ..self }
    }

    /// The same parameter with another size.
    #[must_use]
    pub fn with_scale(self, scale: f64) -> Self {
        Self { scale, ..self }
    }

    /// The same parameter kept at its start.
    #[must_use]
    pub fn fixed(self) -> Self {
        self.between(self.start, self.start)
    }

    /// Whether the bounds leave it only one value.
    #[must_use]
    pub fn is_fixed(&self) -> bool {
        !(self.lower < self.upper)
    }

    pub(crate) fn clamp(&self, value: f64) -> f64 {
        value.max(self.lower).min(self.upper)
    }
}
