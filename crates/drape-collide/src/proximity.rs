use crate::pose::Frame;
use crate::vector::{Vector, turned};

/// How a point lies to the surface of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SignedDistance {
    /// Signed distance `$d$` to the surface, negative inside, in m.
    pub distance: f64,
    /// Unit direction `$n = \nabla d$` in which the distance grows.
    pub normal: [f64; 3],
    /// Second derivative `$\nabla^2 d$` of the distance, row by row, in 1/m.
    ///
    /// Curved faces, edges and corners have one; flat faces have none. On the border of two
    /// regions of the surface it jumps, and either side's value is given.
    pub curvature: [f64; 9],
}

impl SignedDistance {
    pub(crate) fn flat(distance: f64, normal: Vector) -> SignedDistance {
        SignedDistance { distance, normal, curvature: [0.0; 9] }
    }

    /// The answer to a question about a point that is no point.
    pub(crate) const UNKNOWN: SignedDistance =
        SignedDistance { distance: f64::NAN, normal: [f64::NAN; 3], curvature: [f64::NAN; 9] };

    pub(crate) fn to_world(self, frame: &Frame) -> SignedDistance {
        SignedDistance {
            distance: self.distance,
            normal: frame.turn(self.normal),
            curvature: turned(&frame.rotation, &self.curvature),
        }
    }
}
