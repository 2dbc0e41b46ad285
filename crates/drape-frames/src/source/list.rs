//! List of frames in memory.

use crate::error::Error;
use crate::frame::Frame;
use crate::manifest::Manifest;
use crate::source::{FrameSource, check_frame};

/// Frames in memory, in the order of their times.
#[derive(Debug)]
pub(crate) struct FrameList(Vec<Frame>);

impl FrameList {
    /// Returns the list of `frames` of a run with the parts of `manifest`. The frames are numbered
    /// anew.
    ///
    /// # Errors
    /// [`Error::BadFrame`] if a frame does not fit `manifest`.
    pub(crate) fn new(manifest: &Manifest, mut frames: Vec<Frame>) -> Result<Self, Error> {
        for number in 0..frames.len() {
            let (earlier, rest) = frames.split_at_mut(number);
            let frame = &mut rest[0];
            frame.number = number;
            check_frame(manifest, earlier.last().map(|earlier| earlier.time), frame)?;

            let unmoved = earlier.last().filter(|last| last.bodies == frame.bodies);
            let first = unmoved.map_or(Some(number), |last| last.bodies_frame);
            frame.bodies_frame = if frame.bodies.is_empty() { None } else { first };
        }
        Ok(Self(frames))
    }
}

impl FrameSource for FrameList {
    fn frame_count(&self) -> usize {
        self.0.len()
    }

    fn time(&self, number: usize) -> f64 {
        self.0[number].time
    }

    fn frame(&self, number: usize) -> Result<Frame, Error> {
        Ok(self.0[number].clone())
    }

    fn has_pressures(&self) -> bool {
        self.0.iter().any(|frame| frame.pressures.is_some())
    }
}
