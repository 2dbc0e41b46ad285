//! Checked bodies, of which particles ask for distances.

use super::pose::Frame;
use super::shape::Shape;
use super::signed_distance::SignedDistance;
use crate::vector::Vector;

/// Body that has been checked.
#[derive(Debug, Clone)]
pub(crate) struct Solid {
    pub(crate) shape: Shape,
    pub(crate) frame: Frame,
    pub(crate) friction: f64,
}

/// Distance of a point from a body, as far as it matters.
pub(crate) enum DistanceBound {
    /// Below the activation distance: the exact one.
    Active(SignedDistance),
    /// At or above the activation distance: a lower bound, in m.
    AtLeast(f64),
}

impl Solid {
    /// Returns whether the shape is a mesh.
    pub(crate) fn is_mesh(&self) -> bool {
        matches!(self.shape, Shape::Mesh(_))
    }

    /// Returns the signed distance of a point, in m.
    pub(crate) fn signed_distance(&self, point: Vector) -> SignedDistance {
        // Comparisons and `max` would lose a NaN.
        if !point.iter().all(|value| value.is_finite()) {
            return SignedDistance::UNKNOWN;
        }
        self.shape.signed_distance(self.frame.to_local(point)).to_world(&self.frame)
    }

    /// Returns the distance of a point if it is below an activation distance, else a lower bound.
    pub(crate) fn distance_within(&self, point: Vector, activation_distance: f64) -> DistanceBound {
        let finite = point.iter().all(|value| value.is_finite());
        if let (Shape::Mesh(mesh), true) = (&self.shape, finite) {
            let bound = mesh.distance_to_box(self.frame.to_local(point));
            if bound >= activation_distance {
                return DistanceBound::AtLeast(bound);
            }
        }
        let signed = self.signed_distance(point);
        // NaN counts as active.
        if signed.distance >= activation_distance {
            DistanceBound::AtLeast(signed.distance)
        } else {
            DistanceBound::Active(signed)
        }
    }
}
