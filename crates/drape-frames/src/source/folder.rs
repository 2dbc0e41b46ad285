//! Folder as a source of frames, which are read from their files on request.

use std::path::{Path, PathBuf};

use crate::array;
use crate::energy_table::EnergyTable;
use crate::error::Error;
use crate::frame::Frame;
use crate::manifest::Manifest;
use crate::source::FrameSource;
use crate::source::array_frames;
use crate::source::index::{self, IndexEntry};

/// Frames in the files of a folder.
#[derive(Debug)]
pub(crate) struct FolderSource {
    folder: PathBuf,
    manifest: Manifest,
    /// Lines of `frames.csv`.
    entries: Vec<IndexEntry>,
}

impl FolderSource {
    /// Reads the list of the frames in `folder`. `announced` is the number of frames that the
    /// summary gives, if there is one.
    ///
    /// # Errors
    /// [`Error::MissingFrame`] if a frame is missing.
    pub(crate) fn open(
        folder: &Path,
        manifest: &Manifest,
        announced: Option<usize>,
    ) -> Result<Self, Error> {
        let entries = index::read(&folder.join("frames.csv"))?;
        let needed = announced.unwrap_or(1).max(entries.len());
        let found = (0..entries.len())
            .take_while(|number| folder.join(array_frames::name(*number)).exists())
            .count();
        if found != needed {
            let (folder, missing) = (folder.to_owned(), array_frames::name(found));
            return Err(Error::MissingFrame { folder, missing, found, needed });
        }
        Ok(Self { folder: folder.to_owned(), manifest: manifest.clone(), entries })
    }

    /// Returns the file in which older runs stored the pressures of the last frame.
    fn last_pressures(&self) -> PathBuf {
        self.folder.join("pressure.npy")
    }
}

impl FrameSource for FolderSource {
    fn frame_count(&self) -> usize {
        self.entries.len()
    }

    fn time(&self, number: usize) -> f64 {
        self.entries[number].time
    }

    fn frame(&self, number: usize) -> Result<Frame, Error> {
        let mut frame = array_frames::read(&self.folder, &self.manifest, &self.entries[number])?;

        // Older runs stored only the pressures of the last frame.
        let file = self.last_pressures();
        if number + 1 == self.entries.len() && frame.pressures.is_none() && file.exists() {
            let count = self.manifest.cloth_counts().vertices;
            frame.pressures = Some(array::exact_pressures(&file, count)?);
        }
        Ok(frame)
    }

    fn has_pressures(&self) -> bool {
        let in_list = self.entries.iter().any(|entry| entry.touched.is_some());
        in_list || self.last_pressures().exists()
    }

    fn energy(&self) -> Result<Option<EnergyTable>, Error> {
        let path = self.folder.join("energy.csv");
        path.exists().then(|| EnergyTable::read(&path, self.entries.len())).transpose()
    }
}
