//! Checked bodies, which answer the distance queries of particles.

use super::pose::BodyFrame;
use super::shape::Shape;
use super::signed_distance::SignedDistance;
use crate::vector::Vector;

/// Body that has been checked.
#[derive(Debug, Clone)]
pub(crate) struct Solid {
    pub(crate) shape: Shape,
    pub(crate) frame: BodyFrame,
    pub(crate) friction: f64,
}

/// Distance of a point from a body, as exact as contact needs it.
pub(crate) enum DistanceBound {
    /// Exact distance, below the activation distance.
    Active(SignedDistance),
    /// Lower bound of a distance that is not below the activation distance, in m.
    AtLeast(f64),
}

impl Solid {
    /// Returns whether the shape is a [`Shape::Mesh`].
    pub(crate) fn is_mesh(&self) -> bool {
        matches!(self.shape, Shape::Mesh(_))
    }

    /// Returns the [`SignedDistance`] of `point`, which is NaN if `point` is not finite.
    pub(crate) fn signed_distance(&self, point: Vector) -> SignedDistance {
        // Comparisons and `max` would lose a NaN.
        if !point.iter().all(|value| value.is_finite()) {
            return SignedDistance::UNKNOWN;
        }
        self.shape.signed_distance(self.frame.to_local(point)).to_world(&self.frame)
    }

    /// Returns the distance of `point` if it is below `activation_distance`, in m, or else a lower
    /// bound.
    pub(crate) fn distance_within(&self, point: Vector, activation_distance: f64) -> DistanceBound {
        let finite = point.iter().all(|value| value.is_finite());
        // The box around a mesh settles most queries.
        if let (Shape::Mesh(mesh), true) = (&self.shape, finite) {
            let bound = mesh.distance_to_box(self.frame.to_local(point));
            if bound >= activation_distance {
                return DistanceBound::AtLeast(bound);
            }
        }
        let signed = self.signed_distance(point);
        // A distance of NaN counts as active.
        if signed.distance >= activation_distance {
            DistanceBound::AtLeast(signed.distance)
        } else {
            DistanceBound::Active(signed)
        }
    }
}
