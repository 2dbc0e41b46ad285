//! Verifier: tests the frames of a recording.

use std::path::Path;

use drape_frames::{Error, Recording};

use crate::mesh::Mesh;
use crate::verdict::{Verdict, verify};

/// Verifier of the frames of a recording.
///
/// Intersections are tested in every frame. Distances are held against
/// [`half_min_separation`](drape_frames::SurfacePart::half_min_separation) of the parts: parts with
/// 0, the default, promise no distance.
#[derive(Debug, Clone)]
pub struct Verifier {
    recording: Recording,
    mesh: Mesh,
}

impl Verifier {
    /// Opens the frames in `folder`.
    ///
    /// # Errors
    /// [`Error`] if a file is missing, or has content that no run writes.
    pub fn open(folder: impl AsRef<Path>) -> Result<Verifier, Error> {
        Ok(Verifier::new(Recording::open(folder)?))
    }

    /// Returns the verifier of the frames of `recording`, which may be in memory.
    #[must_use]
    pub fn new(recording: Recording) -> Verifier {
        let mesh = Mesh::new(recording.manifest(), recording.topology());
        Verifier { recording, mesh }
    }

    /// Returns the [`Recording`] whose frames are tested.
    #[must_use]
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// Reads frame `number` and tests all its pairs of triangles.
    ///
    /// # Errors
    /// [`Error`] if a file is missing, or has content that no run writes.
    pub fn verify(&self, number: usize) -> Result<Verdict, Error> {
        Ok(verify(&self.mesh, self.recording.frame(number)?))
    }
}
