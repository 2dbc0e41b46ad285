//! Frame: the positions of cloth and bodies at one time.

use std::path::PathBuf;

/// Positions of cloth and bodies at one time.
///
/// A program that makes a frame gives the time and the positions. `number`, `bodies_frame` and
/// `file` may keep their defaults: a [`Recording`](crate::Recording) of frames in memory sets the
/// first two, and a [`FrameWriter`](crate::FrameWriter) does not read them.
///
/// ```
/// use drape_frames::Frame;
///
/// let cloth = vec![[0.0, 1.0, 0.0], [0.1, 1.0, 0.0], [0.0, 1.1, 0.0]];
/// let frame = Frame { time: 0.5, cloth, ..Frame::default() };
/// assert_eq!((frame.growth_fraction, frame.file), (1.0, None));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Number of the frame, from 0.
    pub number: usize,
    /// Time, in s.
    pub time: f64,
    /// Growth fraction of the minimum separation, above 0 and at most 1.
    pub growth_fraction: f64,
    /// Positions of the vertices of the cloth, panel after panel, in m.
    pub cloth: Vec<[f64; 3]>,
    /// Positions of the vertices of the bodies, body after body, in m.
    pub bodies: Vec<[f64; 3]>,
    /// Number of the first frame with these positions of the bodies, or `None` in a run without
    /// bodies. No body moves between frames that have the same number.
    pub bodies_frame: Option<usize>,
    /// Pressure of contact at each vertex of the cloth, in Pa, one number for each, if it was
    /// stored.
    pub pressures: Option<Vec<f64>>,
    /// File of the cloth, or `None` for a frame in memory.
    pub file: Option<PathBuf>,
}

impl Default for Frame {
    /// Returns the frame of the number 0 at the time 0 without vertices. The full minimum
    /// separation holds.
    fn default() -> Self {
        Self {
            number: 0,
            time: 0.0,
            growth_fraction: 1.0,
            cloth: Vec::new(),
            bodies: Vec::new(),
            bodies_frame: None,
            pressures: None,
            file: None,
        }
    }
}
