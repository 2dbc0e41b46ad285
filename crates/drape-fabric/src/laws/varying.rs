//! Backbone of bending and shear whose stiffness changes along the deformation.

use drape_hysteresis::Response;

/// Load whose stiffness passes from an initial to a final value, odd about the origin.
///
/// With the initial stiffness `$k_0$`, the final stiffness `$k_\infty$` and the transition `$q_t$`,
///
/// ```math
/// F = k_\infty q + \frac{(k_0 - k_\infty)\,q}{\sqrt{1 + (q/q_t)^2}}, \qquad
/// \frac{\mathrm{d}F}{\mathrm{d}q} = k_\infty + \frac{k_0 - k_\infty}{(1 + (q/q_t)^2)^{3/2}}
/// ```
///
/// A fabric that softens in bending has `$k_0 > k_\infty$`. A fabric that stiffens in shear has
/// `$k_0 < k_\infty$`. The load rises everywhere, and tends to a line beyond the test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Varying {
    /// Stiffness `$k_0$` at rest, in load per deformation, greater than 0.
    pub initial_stiffness: f64,
    /// Stiffness `$k_\infty$` far beyond the transition, in load per deformation, greater than 0.
    pub final_stiffness: f64,
    /// Deformation `$q_t$` about which the stiffness changes, greater than 0.
    pub transition: f64,
}

impl Varying {
    /// Returns the load at `deformation` and its derivative.
    #[inline]
    #[must_use]
    pub fn respond(&self, deformation: f64) -> Response {
        let Self { initial_stiffness, final_stiffness, transition } = *self;
        let ratio = deformation / transition;
        let inverse = 1.0 / (1.0 + ratio * ratio).sqrt();
        let change = initial_stiffness - final_stiffness;
        Response {
            load: deformation * (final_stiffness + change * inverse),
            tangent: final_stiffness + change * (inverse * inverse * inverse),
        }
    }

    /// Returns the ratio of load to deformation for a deformation with the given `square`, in load
    /// per deformation. At 0 it is the limit.
    #[inline]
    #[must_use]
    pub fn secant(&self, square: f64) -> f64 {
        let ratio_squared = square / (self.transition * self.transition);
        let change = self.initial_stiffness - self.final_stiffness;
        self.final_stiffness + change / (1.0 + ratio_squared).sqrt()
    }

    /// Returns the tangent less the secant, divided by `square`, for a deformation with this
    /// square.
    #[inline]
    #[must_use]
    pub fn excess(&self, square: f64) -> f64 {
        let scale = self.transition * self.transition;
        let sum = 1.0 + square / scale;
        let change = self.initial_stiffness - self.final_stiffness;
        // (1 + u²)^{-3/2} − (1 + u²)^{-1/2} = −u² (1 + u²)^{-3/2}.
        -change / (scale * sum * sum.sqrt())
    }

    /// Returns the integral of the load from 0 to a deformation with the given `square`, in load
    /// times deformation.
    #[inline]
    #[must_use]
    pub fn energy(&self, square: f64) -> f64 {
        let ratio_squared = square / (self.transition * self.transition);
        let change = self.initial_stiffness - self.final_stiffness;
        // √(1 + u²) − 1 = u²/(√(1 + u²) + 1), which loses no digits.
        square * (0.5 * self.final_stiffness + change / (1.0 + (1.0 + ratio_squared).sqrt()))
    }

    /// Returns the backbone of a connector that takes the fraction `c` of a deformation, as a
    /// function of the whole deformation: `$F'(q) = c\,F(c\,q)$`.
    #[must_use]
    pub fn of_fraction(&self, c: f64) -> Self {
        Self {
            initial_stiffness: c * c * self.initial_stiffness,
            final_stiffness: c * c * self.final_stiffness,
            transition: self.transition / c,
        }
    }
}
