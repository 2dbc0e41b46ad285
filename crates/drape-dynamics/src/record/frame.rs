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
    /// Positions of the vertices of all bodies, likewise.
    pub bodies: Vec<f64>,
    /// Fraction of their distances that surfaces keep at that time, 0 to 1.
    pub growth_fraction: f64,
    /// Pressure of contact at each particle, in Pa, where surfaces are kept apart and a run hands the
    /// frame to its watcher.
    pub pressures: Option<Vec<f64>>,
    /// Balance of the energy since the start, or since the garment was sewn, where the scene keeps it.
    pub energy: Option<Energy>,
}
