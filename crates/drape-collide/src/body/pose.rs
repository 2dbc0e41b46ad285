//! Positions and rotations of bodies.

use serde::{Deserialize, Serialize};

use crate::error::{Error, check_position};
use crate::vector::{Matrix, Vector, add, subtract, times, transposed_times};

/// Largest deviation of a quaternion's length from 1.
///
/// Six digits typed by hand give 1e-6. A missing normalisation gives far more.
const UNIT_TOLERANCE: f64 = 1e-5;

/// Position and rotation of a body.
///
/// A point `$x$` of the body's frame lies at `$p + R x$` in the world.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Position `$p$` of the origin of the body's frame, in m.
    pub position: [f64; 3],
    /// Rotation as a unit quaternion (x, y, z, w), scalar last.
    pub rotation: [f64; 4],
}

impl Default for Pose {
    /// Returns the pose at the origin, not rotated.
    fn default() -> Pose {
        Pose::new([0.0; 3])
    }
}

impl Pose {
    /// Returns the pose at `position`, in m, not rotated.
    #[must_use]
    pub fn new(position: [f64; 3]) -> Pose {
        Pose { position, rotation: [0.0, 0.0, 0.0, 1.0] }
    }

    /// Returns this pose rotated further about the world's `axis` by `angle`, in rad.
    ///
    /// `axis` needs no unit length. An `axis` of length 0 gives an invalid rotation, which is an
    /// error where the pose is used.
    #[must_use]
    pub fn rotated(self, axis: [f64; 3], angle: f64) -> Pose {
        let length = (axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]).sqrt();
        let (sine, cosine) = (0.5 * angle).sin_cos();
        let [bx, by, bz] = axis.map(|a| a / length * sine);
        let [x, y, z, w] = self.rotation;
        Pose {
            position: self.position,
            rotation: [
                cosine * x + bx * w + by * z - bz * y,
                cosine * y + by * w + bz * x - bx * z,
                cosine * z + bz * w + bx * y - by * x,
                cosine * w - bx * x - by * y - bz * z,
            ],
        }
    }
}

/// Frame of a body: the checked pose, with the rotation as a matrix.
#[derive(Debug, Clone)]
pub(crate) struct BodyFrame {
    origin: Vector,
    pub(crate) rotation: Matrix,
}

impl BodyFrame {
    /// Checks `pose` and returns its frame. Errors name `body`.
    pub(crate) fn new(pose: &Pose, body: &str) -> Result<BodyFrame, Error> {
        check_position(|| format!("position of the body `{body}`"), pose.position)?;
        let length = pose.rotation.iter().map(|q| q * q).sum::<f64>().sqrt();
        // A range contains no NaN.
        if !(1.0 - UNIT_TOLERANCE..=1.0 + UNIT_TOLERANCE).contains(&length) {
            return Err(Error::InvalidRotation {
                body: body.to_string(),
                rotation: pose.rotation,
                length,
            });
        }

        let [x, y, z, w] = pose.rotation.map(|q| q / length);
        let rotation = [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - z * w),
            2.0 * (x * z + y * w),
            2.0 * (x * y + z * w),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - x * w),
            2.0 * (x * z - y * w),
            2.0 * (y * z + x * w),
            1.0 - 2.0 * (x * x + y * y),
        ];
        Ok(BodyFrame { origin: pose.position, rotation })
    }

    /// Returns the coordinates of the world's `point` in the body's frame, in m.
    pub(crate) fn to_local(&self, point: Vector) -> Vector {
        transposed_times(&self.rotation, subtract(point, self.origin))
    }

    /// Returns the world's coordinates of a `point` of the body's frame, in m.
    pub(crate) fn to_world(&self, point: Vector) -> Vector {
        add(self.origin, times(&self.rotation, point))
    }

    /// Returns the components of the world's `direction` in the body's frame.
    pub(crate) fn rotate_back(&self, direction: Vector) -> Vector {
        transposed_times(&self.rotation, direction)
    }

    /// Returns the world's components of a `direction` of the body's frame.
    pub(crate) fn rotate(&self, direction: Vector) -> Vector {
        times(&self.rotation, direction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::norm;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn a_quarter_turn_about_z_takes_x_to_y() {
        let pose = Pose::new([1.0, 2.0, 3.0]).rotated([0.0, 0.0, 5.0], FRAC_PI_2);
        let frame = BodyFrame::new(&pose, "test").unwrap();
        let point = frame.to_world([1.0, 0.0, 0.0]);
        let miss = norm(subtract(point, [1.0, 3.0, 3.0]));
        assert!(miss < 1e-15, "{point:?}");
        let back = norm(subtract(frame.to_local(point), [1.0, 0.0, 0.0]));
        assert!(back < 1e-15, "{back:e}");
    }

    #[test]
    fn rotations_follow_each_other_in_world_axes() {
        let pose =
            Pose::default().rotated([0.0, 0.0, 1.0], FRAC_PI_2).rotated([1.0, 0.0, 0.0], FRAC_PI_2);
        let frame = BodyFrame::new(&pose, "test").unwrap();
        // x goes to y by the first rotation, and y to z by the second.
        let point = frame.rotate([1.0, 0.0, 0.0]);
        assert!(norm(subtract(point, [0.0, 0.0, 1.0])) < 1e-15, "{point:?}");
    }

    #[test]
    fn invalid_rotations_are_refused() {
        let axisless = Pose::default().rotated([0.0; 3], 1.0);
        let long = Pose { rotation: [0.0, 0.0, 1.0, 1.0], ..Pose::default() };
        for pose in [axisless, long] {
            let answer = BodyFrame::new(&pose, "cube");
            assert!(matches!(answer, Err(Error::InvalidRotation { .. })), "{answer:?}");
        }
        let lost = BodyFrame::new(&Pose::new([0.0, f64::NAN, 0.0]), "cube");
        assert!(matches!(lost, Err(Error::InvalidPosition { .. })), "{lost:?}");
    }
}
