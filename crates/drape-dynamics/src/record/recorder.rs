//! Recorder: files of a run in a folder.

use std::fs;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::error::Error;
use crate::record::array;
use crate::record::frame::Frame;
use crate::record::summary::Summary;
use crate::record::topology::Topology;

/// Folder of a run, for its frames and its summary.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    folder: PathBuf,
}

/// Name of the file of the summary, which marks a folder as one of results.
const SUMMARY: &str = "summary.json";

/// Name of the file of the topology.
const SURFACES: &str = "surfaces.json";

/// Name of the list of frames.
const FRAMES: &str = "frames.csv";

/// Names of the arrays of the topology.
const ARRAYS: [&str; 3] = ["material.npy", "triangles.npy", "body-triangles.npy"];

/// Name of the pressures of the last frame.
const PRESSURE: &str = "pressure.npy";

/// Name of the last frame in a form that any program opens.
const LAST: &str = "last.obj";

/// Writer of the frames of a run.
#[derive(Debug)]
pub struct Recorder<'a> {
    output: &'a Output,
    /// List of the frames so far.
    list: fs::File,
    /// Bodies that were stored last.
    bodies: Option<StoredBodies>,
}

/// Bodies in a file.
#[derive(Debug)]
struct StoredBodies {
    /// Positions of their vertices, in m.
    positions: Vec<f64>,
    /// Number of the frame with which they were stored.
    frame: usize,
}

/// Makes the folder for a run, emptied of the frames of an earlier one if `replace` allows it.
///
/// # Errors
/// When it holds results and `replace` is false, or cannot be made.
pub fn prepare_folder(folder: &Path, replace: bool) -> Result<Output, Error> {
    let output = Output { folder: folder.to_owned() };
    let fail = |reason| Error::Write { path: folder.to_owned(), reason };
    if folder.exists() {
        let frames: Vec<PathBuf> = fs::read_dir(folder)
            .map_err(fail)?
            .flatten()
            .map(|entry| entry.path())
            .filter(|path| is_result(path))
            .collect();
        if !frames.is_empty() && !replace {
            return Err(Error::Occupied { folder: folder.to_owned() });
        }
        for path in frames {
            fs::remove_file(&path).map_err(|reason| Error::Write { path, reason })?;
        }
    }
    fs::create_dir_all(folder).map_err(fail)?;
    Ok(output)
}

/// Returns whether a file is one that a run writes and a later run would take for its own.
fn is_result(path: &Path) -> bool {
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let numbered = name.starts_with("frame-") || name.starts_with("bodies-");
    let whole = [SUMMARY, SURFACES, FRAMES, PRESSURE, LAST].into_iter().chain(ARRAYS);
    whole.into_iter().any(|own| own == name)
        || (numbered && [".npy", ".obj"].iter().any(|ending| name.ends_with(ending)))
}

impl Output {
    /// Path of a file in the folder.
    #[must_use]
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Stores the topology as `surfaces.json` and arrays, begins `frames.csv`, and returns the writer
    /// of frames.
    ///
    /// # Errors
    /// When they cannot be written.
    pub fn record(&self, topology: &Topology) -> Result<Recorder<'_>, Error> {
        let [material, triangles, of_bodies] = ARRAYS.map(|name| self.path(name));
        self.write(&material, |to| array::write(to, &topology.coordinates))?;
        self.write(&triangles, |to| array::write(to, &topology.triangles))?;
        if !topology.bodies.is_empty() {
            self.write(&of_bodies, |to| array::write(to, &topology.body_triangles))?;
        }
        let path = self.path(FRAMES);
        let begin = || -> std::io::Result<fs::File> {
            let mut list = fs::File::create(&path)?;
            list.write_all(b"number,time,growth,bodies\n")?;
            Ok(list)
        };
        let list = begin().map_err(|reason| Error::Write { path, reason })?;
        self.json(SURFACES, topology)?;
        Ok(Recorder { output: self, list, bodies: None })
    }

    /// Stores the pressures of contact at the last frame, in Pa, as `pressure.npy`.
    ///
    /// # Errors
    /// When they cannot be written.
    pub fn pressure(&self, pressures: &[f64]) -> Result<(), Error> {
        self.write(&self.path(PRESSURE), |to| array::write_column(to, pressures))
    }

    /// Stores the summary as `summary.json`.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn summary(&self, summary: &Summary) -> Result<(), Error> {
        self.json(SUMMARY, summary)
    }

    fn json(&self, name: &str, content: &impl Serialize) -> Result<(), Error> {
        self.write(&self.path(name), |mut to| {
            serde_json::to_writer_pretty(&mut to, content)?;
            writeln!(to)
        })
    }

    /// Writes to a temporary file first, so that a reader never sees half of one.
    fn write(
        &self,
        path: &Path,
        content: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
    ) -> Result<(), Error> {
        let temporary = path.with_extension("part");
        let write = || -> std::io::Result<()> {
            let mut to = BufWriter::new(fs::File::create(&temporary)?);
            content(&mut to)?;
            to.into_inner().map_err(|e| e.into_error())?.sync_all()?;
            fs::rename(&temporary, path)
        };
        write().map_err(|reason| Error::Write { path: path.to_owned(), reason })
    }
}

impl Recorder<'_> {
    /// Stores a frame as `frame-00012.npy` and, where they have moved, the bodies as
    /// `bodies-00012.npy`; then it is listed in `frames.csv`.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn frame(&mut self, frame: &Frame) -> Result<(), Error> {
        let stored = self.bodies.as_ref().is_some_and(|own| own.positions == frame.bodies);
        if !frame.bodies.is_empty() && !stored {
            self.positions("bodies", frame.number, &frame.bodies)?;
            self.bodies =
                Some(StoredBodies { positions: frame.bodies.clone(), frame: frame.number });
        }
        self.positions("frame", frame.number, &frame.positions)?;
        let bodies = self.bodies.as_ref().map_or(String::new(), |own| own.frame.to_string());
        let line =
            format!("{},{:?},{:?},{bodies}\n", frame.number, frame.time, frame.growth_fraction);
        let listed = self.list.write_all(line.as_bytes()).and_then(|()| self.list.sync_data());
        listed.map_err(|reason| Error::Write { path: self.output.path(FRAMES), reason })
    }

    fn positions(&self, kind: &str, number: usize, positions: &[f64]) -> Result<(), Error> {
        let path = self.output.path(&format!("{kind}-{number:05}.npy"));
        self.output.write(&path, |to| array::write(to, positions.as_chunks::<3>().0))
    }
}
