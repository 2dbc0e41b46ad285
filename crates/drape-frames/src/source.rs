//! Sources from which a recording takes its frames.

pub(crate) mod array_frames;
pub(crate) mod checked;
pub(crate) mod folder;
pub(crate) mod index;
pub(crate) mod list;

use std::fmt::Debug;

use crate::array::COORDINATE_MAX;
use crate::energy_table::EnergyTable;
use crate::error::Error;
use crate::frame::Frame;
use crate::manifest::Manifest;

/// Source of the frames of a [`Recording`](crate::Recording), such as a folder or a list in memory.
///
/// A program implements the trait for frames that it computes or decodes on request. For a list of
/// frames there is [`Recording::of_frames`](crate::Recording::of_frames).
pub trait FrameSource: Debug + Send + Sync {
    /// Returns the number of frames. It is at least 1 and does not change.
    fn frame_count(&self) -> usize;

    /// Returns the time of the frame `number`, in s. `number` is below the number of frames. A time
    /// is not before the time of an earlier frame.
    fn time(&self, number: usize) -> f64;

    /// Returns the frame `number`, which is below the number of frames. The frame has this `number`
    /// and, with bodies, its `bodies_frame`, by which exports know whether the bodies have moved.
    ///
    /// # Errors
    /// [`Error`] if the frame cannot be read.
    fn frame(&self, number: usize) -> Result<Frame, Error>;

    /// Returns whether at least one frame has pressures of contact.
    fn has_pressures(&self) -> bool {
        false
    }

    /// Returns the energy balance at each frame, if the source knows it.
    ///
    /// # Errors
    /// [`Error`] if the balance cannot be read.
    fn energy(&self) -> Result<Option<EnergyTable>, Error> {
        Ok(None)
    }
}

/// Checks that `frame`, which follows a frame at the time `earlier` in s, fits the parts of
/// `manifest`.
///
/// # Errors
/// [`Error::BadFrame`] with the fault.
pub(crate) fn check_frame(
    manifest: &Manifest,
    earlier: Option<f64>,
    frame: &Frame,
) -> Result<(), Error> {
    let fault = |reason: String| Err(Error::BadFrame { number: frame.number, reason });

    let (cloth, bodies) = (manifest.cloth_counts().vertices, manifest.body_counts().vertices);
    let pressures = frame.pressures.as_ref().map_or(cloth, Vec::len);
    let counts = [
        ("positions of the cloth", frame.cloth.len(), cloth),
        ("positions of bodies", frame.bodies.len(), bodies),
        ("pressures", pressures, cloth),
    ];
    for (what, found, needed) in counts {
        if found != needed {
            return fault(format!("it has {found} {what}, and the parts have {needed} vertices"));
        }
    }

    let mut positions = frame.cloth.iter().chain(&frame.bodies).flatten();
    if let Some(bad) = positions.find(|coordinate| !(coordinate.abs() <= COORDINATE_MAX)) {
        return fault(format!("{bad} m is no coordinate"));
    }
    let pressures = frame.pressures.iter().flatten();
    if let Some(bad) = pressures.into_iter().find(|pressure| !(**pressure >= 0.0)) {
        return fault(format!("{bad} Pa is no pressure of contact"));
    }
    if !(frame.growth_fraction > 0.0 && frame.growth_fraction <= 1.0) {
        return fault(format!("{} is no fraction of a distance", frame.growth_fraction));
    }
    let is_late = earlier.is_none_or(|earlier| earlier <= frame.time);
    if !frame.time.is_finite() || !is_late {
        return fault(format!("{} s is no time after the frame before", frame.time));
    }
    Ok(())
}
