//! Frame: the cloth and the bodies at one time.

use crate::world::Energy;

/// Cloth and bodies at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Number of the frame, from 0.
    pub number: usize,
    /// Time, in s.
    pub time: f64,
    /// Positions of the particles, three numbers each, in m.
    pub positions: Vec<f64>,
    /// Positions of the vertices of all bodies, three numbers each, in m.
    pub bodies: Vec<f64>,
    /// Fraction of their distances that surfaces keep at `time`, 0 to 1.
    pub growth_fraction: f64,
    /// Contact pressure at each particle, in Pa, if surfaces are kept apart and a run hands the
    /// frame to its watcher.
    pub pressures: Option<Vec<f64>>,
    /// Energy balance since the start, or since the garment was sewn, if the scene keeps one.
    pub energy: Option<Energy>,
}
