//! Frame: the cloth and the bodies at one time.

/// Cloth and bodies at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Number of the frame, from 0.
    pub number: usize,
    /// Time, in s.
    pub time: f64,
    /// Positions of the particles, three numbers each, in m.
    pub positions: Vec<f64>,
    /// Positions of the vertices of all bodies, likewise.
    pub bodies: Vec<f64>,
    /// Fraction of their distances that surfaces keep at that time, 0 to 1.
    pub growth_fraction: f64,
}
