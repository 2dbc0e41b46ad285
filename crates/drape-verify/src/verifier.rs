//! Verifier: tests the frames of a folder one by one.

use std::path::Path;

use drape_frames::{Error, Recording};

use crate::mesh::Mesh;
use crate::verdict::{Verdict, verify};

/// Verifier of the frames of a folder.
#[derive(Debug, Clone)]
pub struct Verifier {
    recording: Recording,
    mesh: Mesh,
}

impl Verifier {
    /// Opens a folder.
    ///
    /// # Errors
    /// A file is missing or is not as a run writes it.
    pub fn open(folder: impl AsRef<Path>) -> Result<Verifier, Error> {
        let recording = Recording::open(folder)?;
        let mesh = Mesh::new(recording.manifest(), recording.topology());
        Ok(Verifier { recording, mesh })
    }

    /// Returns the folder with its frames.
    #[must_use]
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// Reads a frame and tests all its pairs of triangles.
    ///
    /// # Errors
    /// A file is missing or is not as a run writes it.
    pub fn verify(&self, number: usize) -> Result<Verdict, Error> {
        Ok(verify(&self.mesh, self.recording.frame(number)?))
    }
}
