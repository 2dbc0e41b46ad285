//! Elastic load of traction as an even polynomial of the strain.

use drape_hysteresis::Response;

/// Even polynomial `$F = c_2\varepsilon^2 + c_4\varepsilon^4$` \[THK03, fig. 8a\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polynomial {
    /// Coefficient `$c_2$` of the squared strain, in N/m.
    pub quadratic: f64,
    /// Coefficient `$c_4$` of the fourth power, in N/m.
    pub quartic: f64,
}

impl Polynomial {
    /// Returns load and tangent at a `strain` of at least 0.
    pub(crate) fn respond(&self, strain: f64) -> Response {
        let square = strain * strain;
        Response {
            load: square * (self.quadratic + self.quartic * square),
            tangent: strain * (2.0 * self.quadratic + 4.0 * self.quartic * square),
        }
    }

    /// Returns the integral of the load from 0 to a `strain` of at least 0, in J/m².
    #[inline(always)]
    pub(crate) fn energy(&self, strain: f64) -> f64 {
        let square = strain * strain;
        strain * square * (self.quadratic / 3.0 + self.quartic * square / 5.0)
    }
}
