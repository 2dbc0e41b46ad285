//! The input of a fit: residuals as a function of parameters, and where each parameter starts.
//!
//! Every other module reads a [`Problem`] through this trait.

use nalgebra::DMatrix;

/// Residuals as a function of parameters.
///
/// ```
/// use drape_lm::{Parameter, Problem, MinimiserSettings, minimise};
///
/// /// A straight line through the origin.
/// struct Line;
///
/// impl Problem for Line {
///     fn residual_count(&self) -> usize { 3 }
///     fn residuals(&self, p: &[f64], out: &mut [f64]) {
///         for (r, (x, y)) in out.iter_mut().zip([(1.0, 2.1), (2.0, 3.9), (3.0, 6.0)]) {
///             *r = p[0] * x - y;
///         }
///     }
/// }
///
/// let report = minimise(&Line, &[Parameter::new(1.0)], &MinimiserSettings::default());
/// assert!((report.parameters[0] - 27.9 / 14.0).abs() < 1e-12);
/// ```
pub trait Problem {
    /// Number of residuals.
    fn residual_count(&self) -> usize;

    /// Writes the residuals at `parameters` into `out`, or NaN where the model has no value.
    ///
    /// `parameters` are in the order in which they were given to the minimiser. `out` has one entry
    /// for each residual. The residuals are without their weights.
    ///
    /// The minimiser rejects a trial step that has a residual that is not finite.
    fn residuals(&self, parameters: &[f64], out: &mut [f64]);

    /// Writes the derivative of residual `i` by parameter `j` into `out[(i, j)]`, if it is known.
    ///
    /// `out` has a row for each residual and a column for each parameter, fixed ones included. Its
    /// type is from [`nalgebra`](crate::nalgebra), which this crate re-exports. Derivatives are
    /// without weights.
    ///
    /// Returns `false`, the default, if `out` was not written. The minimiser then differentiates
    /// the residuals by finite differences.
    fn jacobian(&self, _parameters: &[f64], _out: &mut DMatrix<f64>) -> bool {
        false
    }

    /// Returns the weight of each squared residual, not negative: `$1/\sigma^2$` for a measurement
    /// with the standard deviation `$\sigma$`. The default, an empty slice, means that every weight
    /// is one.
    fn weights(&self) -> &[f64] {
        &[]
    }
}

/// Start, bounds and scale of one parameter. A minimisation refuses a parameter that is no number,
/// and names it.
///
/// ```
/// use drape_lm::Parameter;
///
/// let length = Parameter::new(0.3).between(1e-3, 10.0);
/// assert!(!length.is_fixed() && length.fixed().is_fixed());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Starting value. A value outside the bounds is moved to the nearest bound.
    pub start: f64,
    /// Lower bound, −∞ without one.
    pub lower: f64,
    /// Upper bound, +∞ without one.
    pub upper: f64,
    /// Typical size of the value. The size sets the difference step where the value is near zero.
    pub scale: f64,
}

impl Parameter {
    /// Creates an unbounded parameter that starts at `start`. Its scale is the magnitude of
    /// `start`, or 1 if `start` is 0.
    #[must_use]
    pub fn new(start: f64) -> Self {
        let scale = if start == 0.0 { 1.0 } else { start.abs() };
        Self { start, lower: f64::NEG_INFINITY, upper: f64::INFINITY, scale }
    }

    /// Returns the parameter with the bounds `lower` and `upper`. A minimisation refuses bounds of
    /// which `lower` is above `upper`.
    #[must_use]
    pub fn between(self, lower: f64, upper: f64) -> Self {
        Self { lower, upper, ..self }
    }

    /// Returns the parameter with the given `scale`.
    #[must_use]
    pub fn with_scale(self, scale: f64) -> Self {
        Self { scale, ..self }
    }

    /// Returns the parameter with both bounds at `start`, so that its value cannot change.
    #[must_use]
    pub fn fixed(self) -> Self {
        self.between(self.start, self.start)
    }

    /// Returns whether the bounds leave only one value.
    #[must_use]
    pub fn is_fixed(&self) -> bool {
        !(self.lower < self.upper)
    }

    /// Returns the number within the bounds that is nearest to `value`.
    pub(crate) fn clamp(&self, value: f64) -> f64 {
        value.max(self.lower).min(self.upper)
    }
}
