//! Backbone of bending and shear after Breen: a quadratic, then a line.

/// Quadratic through the origin that continues as a straight line, odd about the origin.
///
/// The curve approximates the first branch of a KES bending or shear curve \[BHW94, §5.1\]. The
/// line is fitted to the outer, stable part. The quadratic continues the line to the origin, with
/// equal value and slope at the knot:
///
/// ```math
/// L(d) = \begin{cases} p\,d + q\,d^2, & 0 \le d \le d_k\\ c + s\,d, & d > d_k \end{cases}
/// \qquad q = -c/d_k^2,\quad p = s + 2c/d_k
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piecewise {
    /// Slope `$s$` of the line, in load per deformation, greater than 0.
    pub slope: f64,
    /// Intercept `$c$` of the line, in the unit of the load.
    pub intercept: f64,
    /// Deformation `$d_k$` at which quadratic and line meet, greater than 0.
    pub knot: f64,
}

impl Piecewise {
    /// Returns the load at `deformation`, in the unit of the load.
    #[must_use]
    pub fn load(&self, deformation: f64) -> f64 {
        let d = deformation.abs();
        let load = if d <= self.knot {
            let t = d / self.knot;
            self.slope * d + self.intercept * t * (2.0 - t)
        } else {
            self.intercept + self.slope * d
        };
        load.copysign(load * deformation)
    }

    /// Returns the ratio of load to `deformation`, which is at least 0, in load per deformation. At
    /// 0 it is the limit.
    #[must_use]
    #[inline]
    pub fn secant(&self, deformation: f64) -> f64 {
        let t = deformation / self.knot;
        let within = self.slope + self.intercept / self.knot * (2.0 - t);
        let beyond = self.slope + self.intercept / deformation;
        if deformation <= self.knot { within } else { beyond }
    }

    /// Returns the derivative of the load at `deformation`, in load per deformation.
    #[must_use]
    pub fn tangent(&self, deformation: f64) -> f64 {
        let t = (deformation.abs() / self.knot).min(1.0);
        self.slope + 2.0 * self.intercept / self.knot * (1.0 - t)
    }

    /// Returns the integral of the load from 0 to `deformation`, in load times deformation.
    #[must_use]
    pub fn energy(&self, deformation: f64) -> f64 {
        let d = deformation.abs();
        let t = (d / self.knot).min(1.0);
        let beyond = (d - self.knot).max(0.0);
        0.5 * self.slope * d * d + self.intercept * (self.knot * t * t * (1.0 - t / 3.0) + beyond)
    }
}
