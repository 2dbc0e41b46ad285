//! Recording: the folder of a run, whose frames are read one by one.

use std::path::{Path, PathBuf};

use crate::energy_table::EnergyTable;
use crate::error::Error;
use crate::frame::Frame;
use crate::index::{self, IndexEntry};
use crate::manifest::Manifest;
use crate::text::read_text;
use crate::topology::Topology;
use crate::{array, array_frames};

/// Folder of a run, whose frames are read one by one.
///
/// ```
/// use drape_frames::{Error, Recording};
///
/// let folder = tempfile::tempdir()?;
/// assert!(matches!(Recording::open(folder.path()), Err(Error::NotARun { .. })));
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Recording {
    folder: PathBuf,
    manifest: Manifest,
    topology: Topology,
    /// Lines of `frames.csv`.
    frames: Vec<IndexEntry>,
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
        let frames = list_frames(folder, announced)?;
        let topology = array_frames::topology(folder, &manifest)?;

        let (folder, ended) = (folder.to_owned(), announced.is_some());
        Ok(Recording { folder, manifest, topology, frames, ended })
    }

    /// Returns the folder that was opened.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Returns the number of frames, which is at least 1.
    #[must_use]
    pub fn frame_count(&self) -> usize {
        self.frames.len()
    }

    /// Returns whether the summary says that the run has ended.
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

    /// Returns the time of frame `number` in s.
    ///
    /// # Errors
    /// [`Error::NoFrame`] if there is no such frame.
    pub fn time(&self, number: usize) -> Result<f64, Error> {
        Ok(self.entry(number)?.time)
    }

    /// Reads frame `number`.
    ///
    /// # Errors
    /// [`Error::NoFrame`] if there is no such frame. Another [`Error`] if a file is missing, or has
    /// content that no run writes.
    pub fn frame(&self, number: usize) -> Result<Frame, Error> {
        let entry = *self.entry(number)?;
        let mut frame = array_frames::read(&self.folder, &self.manifest, entry)?;

        // Older runs stored only the pressures of the last frame.
        let file = self.last_pressures();
        if number + 1 == self.frame_count() && frame.pressures.is_none() && file.exists() {
            let count = self.manifest.cloth_counts().vertices;
            frame.pressures = Some(array::exact_pressures(&file, count)?);
        }
        Ok(frame)
    }

    /// Returns whether the pressure of contact was stored for at least one frame.
    #[must_use]
    pub fn has_pressures(&self) -> bool {
        let in_list = self.frames.iter().any(|entry| entry.touched.is_some());
        in_list || self.last_pressures().exists()
    }

    /// Reads the energy balance at each frame, or returns `None` if the run recorded none.
    ///
    /// # Errors
    /// [`Error`] if the file has content that no run writes.
    pub fn energy(&self) -> Result<Option<EnergyTable>, Error> {
        let path = self.folder.join("energy.csv");
        path.exists().then(|| EnergyTable::read(&path, self.frame_count())).transpose()
    }

    /// Returns the line of frame `number`.
    fn entry(&self, number: usize) -> Result<&IndexEntry, Error> {
        self.frames.get(number).ok_or_else(|| {
            let (folder, last) = (self.folder.clone(), self.frame_count() - 1);
            Error::NoFrame { folder, number, last }
        })
    }

    /// Returns the file in which older runs stored the pressures of the last frame.
    fn last_pressures(&self) -> PathBuf {
        self.folder.join("pressure.npy")
    }
}

/// Returns the list of the frames in `folder`. `announced` is the number of frames that the summary
/// gives, if there is one.
///
/// # Errors
/// [`Error::MissingFrame`] if a frame is missing.
fn list_frames(folder: &Path, announced: Option<usize>) -> Result<Vec<IndexEntry>, Error> {
    let entries = index::read(&folder.join("frames.csv"))?;
    let needed = announced.unwrap_or(1).max(entries.len());
    let found = (0..entries.len())
        .take_while(|number| folder.join(array_frames::name(*number)).exists())
        .count();
    if found != needed {
        let (folder, missing) = (folder.to_owned(), array_frames::name(found));
        return Err(Error::MissingFrame { folder, missing, found, needed });
    }
    Ok(entries)
}

/// Reads the number of frames from the summary in the file `path`.
fn announced_count(path: &Path) -> Result<Option<usize>, Error> {
    let summary: serde_json::Value = serde_json::from_str(&read_text(path)?)
        .map_err(|error| Error::malformed(path, error.line(), error.to_string()))?;
    Ok(summary["frames"].as_u64().and_then(|frames| usize::try_from(frames).ok()))
}
