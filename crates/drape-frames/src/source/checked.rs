//! Source of frames that a program implements. Each frame is checked when it is read.

use std::sync::Arc;

use crate::energy_table::EnergyTable;
use crate::error::Error;
use crate::frame::Frame;
use crate::manifest::Manifest;
use crate::source::{FrameSource, check_frame};

/// Source of a program, whose frames must fit the parts of `manifest`.
#[derive(Debug)]
pub(crate) struct CheckedSource {
    pub(crate) manifest: Manifest,
    pub(crate) source: Arc<dyn FrameSource>,
}

impl FrameSource for CheckedSource {
    fn frame_count(&self) -> usize {
        self.source.frame_count()
    }

    fn time(&self, number: usize) -> f64 {
        self.source.time(number)
    }

    fn frame(&self, number: usize) -> Result<Frame, Error> {
        let frame = self.source.frame(number)?;
        check_frame(&self.manifest, None, &frame)?;
        Ok(frame)
    }

    fn has_pressures(&self) -> bool {
        self.source.has_pressures()
    }

    fn energy(&self) -> Result<Option<EnergyTable>, Error> {
        self.source.energy()
    }
}
