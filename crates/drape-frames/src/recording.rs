//! Recording: the folder of a run, whose frames are read one by one.

use std::path::{Path, PathBuf};

use crate::energy_table::EnergyTable;
use crate::error::Error;
use crate::frame::Frame;
use crate::index::{self, Entry};
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
    frames: Frames,
    /// Whether the summary says that the run ended.
    ended: bool,
}

/// Frames of a folder.
#[derive(Debug, Clone)]
enum Frames {
    /// So many OBJ files.
    Obj(usize),
    /// Arrays.
    Arrays(Vec<Entry>),
}

impl Recording {
    /// Returns whether a folder holds the manifest of a run.
    #[must_use]
    pub fn exists(folder: &Path) -> bool {
        folder.join("surfaces.json").exists()
    }

    /// Opens a folder: reads its manifest, its topology, and which frames there are.
    ///
    /// # Errors
    /// A file is missing or is not as a run writes it.
    pub fn open(folder: impl AsRef<Path>) -> Result<Recording, Error> {
        let folder = folder.as_ref();
        if !Recording::exists(folder) {
            return Err(Error::NotARun { folder: folder.to_owned() });
        }
        let path = folder.join("surfaces.json");
        let manifest = Manifest::parse(&path, &read_text(&path)?)?;
        let summary = folder.join("summary.json");
        let announced = if summary.exists() { frames_announced(&summary)? } else { None };
        let (frames, topology) = match manifest.format {
            1 => (
                Frames::Obj(count_obj(folder, announced)?),
                obj_frames::topology(folder, &manifest)?,
            ),
            _ => (
                Frames::Arrays(list_arrays(folder, announced)?),
                array_frames::topology(folder, &manifest)?,
            ),
        };
        let (folder, ended) = (folder.to_owned(), announced.is_some());
        Ok(Recording { folder, manifest, topology, frames, ended })
    }

    /// Returns the folder.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Returns the number of frames, which is at least 1.
    #[must_use]
    pub fn frame_count(&self) -> usize {
        match &self.frames {
            Frames::Obj(count) => *count,
            Frames::Arrays(entries) => entries.len(),
        }
    }

    /// Returns whether the summary says that the run ended.
    #[must_use]
    pub fn ended(&self) -> bool {
        self.ended
    }

    /// Returns the parts of the run and the distances that it promises.
    #[must_use]
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// Returns the triangles and the material coordinates that all frames share.
    #[must_use]
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// Returns the time of a frame in s, where it is known without reading the frame.
    #[must_use]
    pub fn time(&self, number: usize) -> Option<f64> {
        match &self.frames {
            Frames::Obj(_) => None,
            Frames::Arrays(entries) => entries.get(number).map(|entry| entry.time),
        }
    }

    /// Returns the time of a frame in s, where it is known; the frame is read if need be.
    ///
    /// # Errors
    /// As for [`Recording::frame`].
    pub fn read_time(&self, number: usize) -> Result<Option<f64>, Error> {
        match self.time(number) {
            Some(time) => Ok(Some(time)),
            None => Ok(self.frame(number)?.time),
        }
    }

    /// Reads a frame.
    ///
    /// # Errors
    /// There is none of that number, or a file is missing or is not as a run writes it.
    pub fn frame(&self, number: usize) -> Result<Frame, Error> {
        if number >= self.frame_count() {
            let (folder, last) = (self.folder.clone(), self.frame_count() - 1);
            return Err(Error::NoFrame { folder, number, last });
        }
        let mut frame = match &self.frames {
            Frames::Obj(_) => {
                obj_frames::read(&self.folder, &self.manifest, &self.topology, number)?
            }
            Frames::Arrays(entries) => {
                array_frames::read(&self.folder, &self.manifest, entries[number])?
            }
        };
        let last = self.last_pressures();
        if number + 1 == self.frame_count() && frame.pressures.is_none() && last.exists() {
            let count = self.manifest.cloth_counts().vertices;
            frame.pressures = Some(array::exact_pressures(&last, count)?);
        }
        Ok(frame)
    }

    /// Returns whether the pressure of contact was stored for some frame.
    #[must_use]
    pub fn has_pressures(&self) -> bool {
        let of_frames = match &self.frames {
            Frames::Obj(_) => false,
            Frames::Arrays(entries) => entries.iter().any(|entry| entry.touched.is_some()),
        };
        of_frames || self.last_pressures().exists()
    }

    /// Reads the energy at each frame, where the run kept its balance.
    ///
    /// # Errors
    /// The file is not as a run writes it.
    pub fn energy(&self) -> Result<Option<EnergyTable>, Error> {
        let path = self.folder.join("energy.csv");
        path.exists().then(|| EnergyTable::read(&path, self.frame_count())).transpose()
    }

    /// Returns the file in which older runs have the pressures of the last frame.
    fn last_pressures(&self) -> PathBuf {
        self.folder.join("pressure.npy")
    }
}

/// Returns the number of frames of a folder of format 1, of which none may be missing.
fn count_obj(folder: &Path, announced: Option<usize>) -> Result<usize, Error> {
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

/// Returns the frames of a folder of format 2, of which none may be missing.
fn list_arrays(folder: &Path, announced: Option<usize>) -> Result<Vec<Entry>, Error> {
    let entries = index::read(&folder.join("frames.csv"))?;
    let needed = announced.unwrap_or(1).max(entries.len());
    let exists = |number: &usize| folder.join(array_frames::name(*number)).exists();
    let found = (0..entries.len()).take_while(exists).count();
    match found == needed {
        true => Ok(entries),
        false => {
            let (folder, missing) = (folder.to_owned(), array_frames::name(found));
            Err(Error::MissingFrame { folder, missing, found, needed })
        }
    }
}

/// Reads the number of frames from a summary.
fn frames_announced(path: &Path) -> Result<Option<usize>, Error> {
    let malformed = |line, reason| Error::Malformed { path: path.to_owned(), line, reason };
    let summary: serde_json::Value = serde_json::from_str(&read_text(path)?)
        .map_err(|error| malformed(error.line(), error.to_string()))?;
    Ok(summary["frames"].as_u64().and_then(|frames| usize::try_from(frames).ok()))
}
