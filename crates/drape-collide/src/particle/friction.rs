//! Lagged Coulomb friction of a particle on a body.

use crate::body::BodyFrame;
use crate::vector::{Matrix, Vector, add, combine, dot, norm, outer, projection, scale, subtract};

/// Coulomb friction of one particle on one body during one step.
///
/// Normal force and tangent plane are taken at the step's start ("lagged"). With the tangential
/// slip `$u = (I - nn^T)(x - x_0)$` of the step the force therefore has a potential:
///
/// ```math
/// E = F f_0(|u|), \qquad f_0' = f_1(y) = 2y/\epsilon - y^2/\epsilon^2
///     \quad (y < \epsilon), \qquad f_1 = 1 \quad (y \ge \epsilon)
/// ```
///
/// `$F$` is the coefficient times the normal force. Below the slip `$\epsilon$` the particle sticks
/// \[Li20, eqs. 11–12 and 17\].
#[derive(Debug, Clone)]
pub(crate) struct Friction {
    pub(crate) particle: usize,
    pub(crate) body: usize,
    /// Position `$x_0$` of the particle at the step's start, carried along by the body, in m.
    pub(crate) start: Vector,
    /// Displacement of `start` by the body, in m.
    pub(crate) carried: Vector,
    /// Normal `$n$` at the step's start, rotated by the body.
    pub(crate) normal: Vector,
    /// Largest friction force `$F$`, in N.
    pub(crate) limit: f64,
}

impl Friction {
    /// Moves start and normal with the body whose frame changes from `from` to `to`.
    pub(crate) fn carry(&mut self, from: &BodyFrame, to: &BodyFrame) {
        let start = to.to_world(from.to_local(self.start));
        self.carried = add(self.carried, subtract(start, self.start));
        self.start = start;
        self.normal = to.rotate(from.rotate_back(self.normal));
    }

    /// Returns the tangential slip at `position`, in m.
    fn slip(&self, position: Vector) -> Vector {
        let moved = subtract(position, self.start);
        subtract(moved, scale(self.normal, dot(moved, self.normal)))
    }

    /// Returns the potential of the step at `position`, in J, zero at the step's start. The
    /// particle sticks below the slip `stick`, in m.
    pub(crate) fn energy(&self, position: Vector, stick: f64) -> f64 {
        let slip = norm(self.slip(position));
        let ratio = slip / stick;
        if ratio >= 1.0 {
            self.limit * (slip - stick / 3.0)
        } else {
            self.limit * slip * ratio * (1.0 - ratio / 3.0)
        }
    }

    /// Returns the force on the particle at `position`, in N.
    pub(crate) fn force(&self, position: Vector, stick: f64) -> Vector {
        let slip = self.slip(position);
        scale(slip, -self.limit * secant(norm(slip), stick))
    }

    /// Returns the second derivative of the potential at `position`, row by row, in N/m. The matrix
    /// is positive semidefinite, as `$f_0$` is convex.
    pub(crate) fn stiffness(&self, position: Vector, stick: f64) -> Matrix {
        let slip = self.slip(position);
        let length = norm(slip);
        let secant = secant(length, stick);
        let plane = projection(self.normal);
        if length == 0.0 {
            return plane.map(|entry| entry * self.limit * secant);
        }
        let tangent = if length >= stick { 0.0 } else { 2.0 * (1.0 - length / stick) / stick };
        let along = outer(scale(slip, 1.0 / length));
        combine(&plane, self.limit * secant, &along, self.limit * (tangent - secant))
    }
}

/// Returns `$f_1(y) / y$` at the slip `$y$`, in 1/m.
fn secant(slip: f64, stick: f64) -> f64 {
    if slip >= stick { 1.0 / slip } else { (2.0 - slip / stick) / stick }
}
