//! Motions of bodies and pins: rigid ones along keys, and shapes from frame to frame.

mod resolution;
mod rigid;
mod shape;

pub use self::resolution::MotionResolution;
pub use self::rigid::{MotionKey, RigidMotion};
pub(crate) use self::rigid::{rotate, rotate_pose};
pub use self::shape::ShapeMotion;
pub(crate) use self::shape::check_frame;

use serde::{Deserialize, Serialize};

/// Motion of a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum BodyMotion {
    /// Rigid motion along keys.
    Rigid(RigidMotion),
    /// Motion of each vertex by itself, from frame to frame.
    Shapes(ShapeMotion),
}

impl BodyMotion {
    /// Writes the positions at a time, in s, of vertices that start at some positions; three
    /// coordinates each, in m.
    pub fn write_positions(&self, time: f64, start: &[f64], positions: &mut [f64]) {
        match self {
            Self::Rigid(motion) => {
                let transform = motion.transform(time);
                let start = start.as_chunks::<3>().0.iter();
                for (start, now) in start.zip(positions.as_chunks_mut::<3>().0) {
                    *now = transform(*start);
                }
            }
            Self::Shapes(motion) => motion.write_positions(time, positions),
        }
    }

    /// Returns whether a step between two times, in s, resolves the motion of vertices that start
    /// at some positions, in m. From frame to frame vertices move straight.
    #[must_use]
    pub fn is_resolved(
        &self,
        times: [f64; 2],
        start: &[[f64; 3]],
        resolution: MotionResolution,
    ) -> bool {
        match self {
            Self::Rigid(motion) => motion.is_resolved(times, start, resolution),
            Self::Shapes(motion) => motion.path(times) <= resolution.path,
        }
    }

    /// Returns whether the motion has keys or frames at rising times, with finite numbers, for a
    /// body with `vertex_count` vertices. A motion from a file may be damaged.
    #[must_use]
    pub fn is_sound(&self, vertex_count: usize) -> bool {
        match self {
            Self::Rigid(motion) => motion.is_sound(),
            Self::Shapes(motion) => motion.is_sound(vertex_count),
        }
    }

    /// Returns the largest speed of a vertex that starts at one of some positions, in m/s.
    #[must_use]
    pub fn max_speed(&self, start: &[[f64; 3]]) -> f64 {
        match self {
            Self::Rigid(motion) => motion.max_speed(start),
            Self::Shapes(motion) => motion.max_speed(),
        }
    }
}
