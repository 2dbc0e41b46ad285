//! Motion that a step resolves.

/// Largest motion of a point within a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionResolution {
    /// Length of its path, in m.
    pub path: f64,
    /// Deviation from a straight path, in m.
    pub deviation: f64,
}
