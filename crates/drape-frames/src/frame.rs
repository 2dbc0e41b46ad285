//! Frame: the positions of cloth and bodies at one time, as the files give them.

use std::path::PathBuf;

/// Positions of cloth and bodies at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Number of the frame, from 0.
    pub number: usize,
    /// File of the cloth.
    pub file: PathBuf,
    /// Time, in s. A recorded frame always has a time.
    pub time: Option<f64>,
    /// Growth fraction of the minimum separation, above 0 and at most 1.
    pub growth: f64,
    /// Positions of the vertices of the cloth, panel after panel, in m.
    pub cloth: Vec<[f64; 3]>,
    /// File of the bodies, or `None` in a run without bodies. Frames between which no body moved
    /// share a file.
    pub bodies_file: Option<PathBuf>,
    /// Positions of the vertices of the bodies, body after body, in m.
    pub bodies: Vec<[f64; 3]>,
    /// Pressure of contact at each vertex of the cloth, in Pa, if it was stored.
    pub pressures: Option<Vec<f64>>,
}
