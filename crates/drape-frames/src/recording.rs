//! Recording: the frames of a run, from a folder or from memory, which are taken one by one.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::energy_table::EnergyTable;
use crate::error::Error;
use crate::frame::Frame;
use crate::manifest::Manifest;
use crate::source::checked::CheckedSource;
use crate::source::folder::FolderSource;
use crate::source::list::FrameList;
use crate::source::{FrameSource, array_frames};
use crate::text::read_text;
use crate::topology::Topology;

/// Frames of a run, from a folder or from memory, which are taken one by one.
///
/// ```
/// use drape_frames::{Frame, Manifest, Recording, SurfacePart, Topology};
///
/// // A program that has frames of its own needs no folder.
/// let corners = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
/// let topology = Topology { material: corners, cloth: vec![[0, 1, 2]], bodies: Vec::new() };
/// let flag = SurfacePart { name: "flag".into(), vertices: 3, triangles: 1, ..Default::default() };
/// let manifest = Manifest { panels: vec![flag], ..Manifest::default() };
/// let frame = |time: f64| Frame { time, cloth: vec![[time, 0.0, 0.0]; 3], ..Frame::default() };
///
/// let recording = Recording::of_frames(manifest, topology, vec![frame(0.0), frame(0.1)])?;
/// assert_eq!(recording.frame(1)?.cloth[2], [0.1, 0.0, 0.0]);
/// # Ok::<(), drape_frames::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Recording {
    /// Folder of the run, or `None` for frames in memory.
    folder: Option<PathBuf>,
    manifest: Manifest,
    topology: Topology,
    source: Arc<dyn FrameSource>,
    /// Whether the summary says that the run has ended.
    ended: bool,
}

impl Recording {
    /// Returns whether `folder` holds the manifest of a run.
    #[must_use]
    pub fn exists(folder: &Path) -> bool {
        folder.join("surfaces.json").exists()
    }

    /// Opens `folder`: reads its manifest, its topology and the list of its frames.
    ///
    /// # Errors
    /// [`Error`] if a file is missing, or has content that no run writes.
    pub fn open(folder: impl AsRef<Path>) -> Result<Recording, Error> {
        let folder = folder.as_ref();
        if !Recording::exists(folder) {
            return Err(Error::NotARun { folder: folder.to_owned() });
        }
        let path = folder.join("surfaces.json");
        let manifest = Manifest::parse(&path, &read_text(&path)?)?;

        // A summary exists once the run has ended, and gives the number of its frames.
        let summary = folder.join("summary.json");
        let announced = if summary.exists() { announced_count(&summary)? } else { None };
        let source = Arc::new(FolderSource::open(folder, &manifest, announced)?);
        let topology = array_frames::topology(folder, &manifest)?;

        let (folder, ended) = (Some(folder.to_owned()), announced.is_some());
        Ok(Recording { folder, manifest, topology, source, ended })
    }

    /// Returns the recording of `frames` in memory, in the order of their times. The frames are
    /// numbered from 0. Each frame has the vertices of the panels of `manifest` and then of its
    /// bodies.
    ///
    /// # Errors
    /// [`Error`] if `topology` or a frame does not fit `manifest`, or if there is no frame.
    pub fn of_frames(
        manifest: Manifest,
        topology: Topology,
        frames: Vec<Frame>,
    ) -> Result<Recording, Error> {
        let list = FrameList::new(&manifest, frames)?;
        Recording::in_memory(manifest, topology, Arc::new(list))
    }

    /// Returns the recording of the frames of `source`.
    ///
    /// # Errors
    /// [`Error`] if `topology` does not fit `manifest`, or if there is no frame. The frames are not
    /// read.
    pub fn of_source(
        manifest: Manifest,
        topology: Topology,
        source: Arc<dyn FrameSource>,
    ) -> Result<Recording, Error> {
        let source = CheckedSource { manifest: manifest.clone(), source };
        Recording::in_memory(manifest, topology, Arc::new(source))
    }

    /// Returns the recording of `source`, whose frames fit `manifest`.
    fn in_memory(
        manifest: Manifest,
        topology: Topology,
        source: Arc<dyn FrameSource>,
    ) -> Result<Recording, Error> {
        topology.check(&manifest)?;
        if source.frame_count() == 0 {
            return Err(Error::BadFrame { number: 0, reason: "there is no frame".to_owned() });
        }
        Ok(Recording { folder: None, manifest, topology, source, ended: true })
    }

    /// Returns the folder that was opened, or `None` for frames in memory.
    #[must_use]
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// Returns the number of frames, which is at least 1.
    #[must_use]
    pub fn frame_count(&self) -> usize {
        self.source.frame_count()
    }

    /// Returns whether the summary says that the run has ended. Frames in memory are complete.
    #[must_use]
    pub fn ended(&self) -> bool {
        self.ended
    }

    /// Returns the [`Manifest`]: the parts of the run and the distances that it promises.
    #[must_use]
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// Returns the [`Topology`]: the triangles and the material coordinates that all frames share.
    #[must_use]
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// Returns the time of the frame `number`, in s.
    ///
    /// # Errors
    /// [`Error::NoFrame`] if there is no such frame.
    pub fn time(&self, number: usize) -> Result<f64, Error> {
        self.check_number(number)?;
        Ok(self.source.time(number))
    }

    /// Returns the frame `number`.
    ///
    /// # Errors
    /// [`Error::NoFrame`] if there is no such frame. Another [`Error`] if a file is missing, or has
    /// content that no run writes, or if the frame of a source does not fit the parts.
    pub fn frame(&self, number: usize) -> Result<Frame, Error> {
        self.check_number(number)?;
        self.source.frame(number)
    }

    /// Returns whether the pressure of contact was stored for at least one frame.
    #[must_use]
    pub fn has_pressures(&self) -> bool {
        self.source.has_pressures()
    }

    /// Returns the energy balance at each frame, or `None` if the run recorded none.
    ///
    /// # Errors
    /// [`Error`] if the file has content that no run writes.
    pub fn energy(&self) -> Result<Option<EnergyTable>, Error> {
        self.source.energy()
    }

    /// Checks that there is a frame `number`.
    fn check_number(&self, number: usize) -> Result<(), Error> {
        let count = self.frame_count();
        if number < count {
            return Ok(());
        }
        let (folder, last) = (self.folder.clone(), count - 1);
        Err(Error::NoFrame { folder, number, last })
    }
}

/// Reads the number of frames from the summary in the file `path`.
fn announced_count(path: &Path) -> Result<Option<usize>, Error> {
    let summary: serde_json::Value = serde_json::from_str(&read_text(path)?)
        .map_err(|error| Error::malformed(path, error.line(), error.to_string()))?;
    Ok(summary["frames"].as_u64().and_then(|frames| usize::try_from(frames).ok()))
}
