//! Signed distance of a point from a body, with its derivatives.

use super::pose::BodyFrame;
use crate::vector::{Vector, rotated};

/// Signed distance of a point from the surface of a body, with its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SignedDistance {
    /// Signed distance `$d$` to the surface, negative inside, in m.
    pub distance: f64,
    /// Unit normal `$n = \nabla d$`, the direction in which the distance grows.
    pub normal: [f64; 3],
    /// Curvature: second derivative `$\nabla^2 d$` of the distance, row by row, in 1/m.
    ///
    /// The curvature is zero at flat faces. On the border of two regions of the surface it jumps,
    /// and this field holds the value of either side.
    pub curvature: [f64; 9],
}

impl SignedDistance {
    /// Returns the signed distance from a flat face with the unit `normal`; `distance` is in m.
    pub(crate) fn flat(distance: f64, normal: Vector) -> SignedDistance {
        SignedDistance { distance, normal, curvature: [0.0; 9] }
    }

    /// Signed distance of a point that is not finite.
    pub(crate) const UNKNOWN: SignedDistance =
        SignedDistance { distance: f64::NAN, normal: [f64::NAN; 3], curvature: [f64::NAN; 9] };

    /// Returns this signed distance, given in `frame`, in the axes of the world.
    pub(crate) fn to_world(self, frame: &BodyFrame) -> SignedDistance {
        SignedDistance {
            distance: self.distance,
            normal: frame.rotate(self.normal),
            curvature: rotated(&frame.rotation, &self.curvature),
        }
    }
}
