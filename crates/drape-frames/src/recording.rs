//! Recording: the folder of a run, whose frames are read one by one.

use std::path::{Path, PathBuf};

use crate::energy_table::EnergyTable;
use crate::error::Error;
use crate::frame::Frame;
use crate::index::{self, IndexEntry};
use crate::manifest::Manifest;
use crate::text::read_text;
use crate::topology::Topology;
use crate::{array, array_frames, obj_frames};

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
    frames: FrameList,
    /// Whether the summary says that the run has ended.
    ended: bool,
}

/// Frames of a folder, by the format of the folder.
#[derive(Debug, Clone)]
enum FrameList {
    /// Number of OBJ files, in format 1.
    Obj(usize),
    /// Lines of `frames.csv`, in format 2.
    Arrays(Vec<IndexEntry>),
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
        let (frames, topology) = match manifest.format {
            1 => (
                FrameList::Obj(count_obj_frames(folder, announced)?),
                obj_frames::topology(folder, &manifest)?,
            ),
            _ => (
                FrameList::Arrays(list_array_frames(folder, announced)?),
                array_frames::topology(folder, &manifest)?,
            ),
        };

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
        match &self.frames {
            FrameList::Obj(count) => *count,
            FrameList::Arrays(entries) => entries.len(),
        }
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

    /// Returns the time of frame `number` in s, or `None` if the time is only known after reading
    /// the frame.
    #[must_use]
    pub fn time(&self, number: usize) -> Option<f64> {
        match &self.frames {
            FrameList::Obj(_) => None,
            FrameList::Arrays(entries) => entries.get(number).map(|entry| entry.time),
        }
    }

    /// Returns the time of frame `number` in s, or `None` if the files do not give it. The frame is
    /// read if necessary.
    ///
    /// # Errors
    /// The errors of [`Recording::frame`].
    pub fn read_time(&self, number: usize) -> Result<Option<f64>, Error> {
        match self.time(number) {
            Some(time) => Ok(Some(time)),
            None => Ok(self.frame(number)?.time),
        }
    }

    /// Reads frame `number`.
    ///
    /// # Errors
    /// [`Error::NoFrame`] if there is no such frame. Another [`Error`] if a file is missing, or has
    /// content that no run writes.
    pub fn frame(&self, number: usize) -> Result<Frame, Error> {
        if number >= self.frame_count() {
            let (folder, last) = (self.folder.clone(), self.frame_count() - 1);
            return Err(Error::NoFrame { folder, number, last });
        }
        let mut frame = match &self.frames {
            FrameList::Obj(_) => {
                obj_frames::read(&self.folder, &self.manifest, &self.topology, number)?
            }
            FrameList::Arrays(entries) => {
                array_frames::read(&self.folder, &self.manifest, entries[number])?
            }
        };

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
        let in_list = match &self.frames {
            FrameList::Obj(_) => false,
            FrameList::Arrays(entries) => entries.iter().any(|entry| entry.touched.is_some()),
        };
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

    /// Returns the file in which older runs stored the pressures of the last frame.
    fn last_pressures(&self) -> PathBuf {
        self.folder.join("pressure.npy")
    }
}

/// Returns the number of frames in `folder`, which has format 1. `announced` is the number of
/// frames that the summary gives, if there is one.
///
/// # Errors
/// [`Error::MissingFrame`] if a frame is missing.
fn count_obj_frames(folder: &Path, announced: Option<usize>) -> Result<usize, Error> {
    let numbers = obj_frames::numbers(folder)?;
    let needed = announced.unwrap_or(0).max(numbers.last().map_or(1, |last| last + 1));
    let missing = (0..needed).find(|number| numbers.binary_search(number).is_err());
    match missing.map(obj_frames::name) {
        None => Ok(needed),
        Some(missing) => {
            let (folder, found) = (folder.to_owned(), numbers.len());
            Err(Error::MissingFrame { folder, missing, found, needed })
        }
    }
}

/// Returns the list of the frames in `folder`, which has format 2. `announced` is the number of
/// frames that the summary gives, if there is one.
///
/// # Errors
/// [`Error::MissingFrame`] if a frame is missing.
fn list_array_frames(folder: &Path, announced: Option<usize>) -> Result<Vec<IndexEntry>, Error> {
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
