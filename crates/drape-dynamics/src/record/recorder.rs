//! Recorder: files of a run in a folder.

use std::fs;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use npyz::half::f16;
use serde::Serialize;

use crate::error::Error;
use crate::record::array;
use crate::record::frame::Frame;
use crate::record::manifest::{self, ARRAYS, ENERGY, FRAMES, SUMMARY, SURFACES};
use crate::record::summary::Summary;
use crate::record::topology::Topology;
use crate::world::Energy;

/// Folder of a run, for its frames and its summary.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    folder: PathBuf,
}

/// Writer of the frames of a run.
#[derive(Debug)]
pub struct Recorder<'a> {
    output: &'a Output,
    /// List of the frames so far.
    list: fs::File,
    /// Balance of the energy so far, once a frame has one.
    energy: Option<fs::File>,
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

/// Makes the folder for a run, emptied of the files of an earlier one if `replace` allows it; files
/// that no run has written stay.
///
/// # Errors
/// When it holds results and `replace` is false, or cannot be made.
pub fn prepare_folder(folder: &Path, replace: bool) -> Result<Output, Error> {
    let output = Output { folder: folder.to_owned() };
    let fail = |reason| Error::Write { path: folder.to_owned(), reason };
    if folder.exists() {
        let files = manifest::files(folder).map_err(fail)?;
        if !files.is_empty() && !replace {
            return Err(Error::Occupied { folder: folder.to_owned() });
        }
        manifest::remove(&files).map_err(|(path, reason)| Error::Write { path, reason })?;
    }
    fs::create_dir_all(folder).map_err(fail)?;
    Ok(output)
}

/// Removes the rest of a file that was not written to its end; a link itself, not what it leads to.
fn remove_left(path: &Path) -> std::io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
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
            let mut list = fs::File::create_new(&path)?;
            list.write_all(b"number,time,growth,bodies,touched\n")?;
            Ok(list)
        };
        let list = begin().map_err(|reason| Error::Write { path, reason })?;
        self.json(SURFACES, topology)?;
        Ok(Recorder { output: self, list, energy: None, bodies: None })
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
            remove_left(&temporary)?;
            let mut to = BufWriter::new(fs::File::create_new(&temporary)?);
            content(&mut to)?;
            to.into_inner().map_err(|e| e.into_error())?.sync_all()?;
            fs::rename(&temporary, path)
        };
        write().map_err(|reason| {
            // Half a file is of no use; the failure is told, not that of its removal.
            let _ = fs::remove_file(&temporary);
            Error::Write { path: path.to_owned(), reason }
        })
    }
}

impl Recorder<'_> {
    /// Stores a frame as `frame-00012.npy`, the bodies where they have moved as `bodies-00012.npy`,
    /// pressures as `pressure-00012.npy` where something touches, and a line of `energy.csv`; then it
    /// is listed in `frames.csv`.
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
        let touched = self.pressures(frame)?.map_or(String::new(), |count| count.to_string());
        if let Some(energy) = &frame.energy {
            let path = || self.output.path(ENERGY);
            let written = energy_lines(frame, energy)
                .and_then(|lines| append(&mut self.energy, &path(), lines));
            written.map_err(|reason| Error::Write { path: path(), reason })?;
        }
        let bodies = self.bodies.as_ref().map_or(String::new(), |own| own.frame.to_string());
        let Frame { number, time, growth_fraction, .. } = frame;
        let line = format!("{number},{time:?},{growth_fraction:?},{bodies},{touched}\n");
        let listed = self.list.write_all(line.as_bytes()).and_then(|()| self.list.sync_data());
        listed.map_err(|reason| Error::Write { path: self.output.path(FRAMES), reason })
    }

    fn positions(&self, kind: &str, number: usize, positions: &[f64]) -> Result<(), Error> {
        let path = self.output.path(&format!("{kind}-{number:05}.npy"));
        self.output.write(&path, |to| array::write(to, positions.as_chunks::<3>().0))
    }

    /// Stores pressures in half precision where any is above zero; returns how many are, where they
    /// are known.
    fn pressures(&self, frame: &Frame) -> Result<Option<usize>, Error> {
        let Some(pressures) = &frame.pressures else { return Ok(None) };
        let largest = f64::from(f16::MAX);
        let half: Vec<f16> = pressures.iter().map(|p| f16::from_f64(p.min(largest))).collect();
        let touched = half.iter().filter(|pressure| **pressure > f16::ZERO).count();
        if touched > 0 {
            let path = self.output.path(&format!("pressure-{:05}.npy", frame.number));
            self.output.write(&path, |to| array::write_half(to, &half))?;
        }
        Ok(Some(touched))
    }
}

/// Returns the line of the balance of a frame, and before it that of the names.
fn energy_lines(frame: &Frame, energy: &Energy) -> std::io::Result<[String; 2]> {
    let mut table = csv::Writer::from_writer(Vec::new());
    table.serialize(energy).map_err(std::io::Error::from)?;
    let bytes = table.into_inner().map_err(|error| error.into_error())?;
    let text = String::from_utf8(bytes).map_err(std::io::Error::other)?;
    let (names, entries) = text.split_once('\n').unwrap_or_default();
    let Frame { number, time, .. } = frame;
    Ok([format!("number,time,{names}\n"), format!("{number},{time:?},{entries}")])
}

/// Appends a line to a table; one that is not there yet begins with the names of its columns.
fn append(
    table: &mut Option<fs::File>,
    path: &Path,
    [names, line]: [String; 2],
) -> std::io::Result<()> {
    let file = match table {
        Some(file) => file,
        None => {
            let mut file = fs::File::create_new(path)?;
            file.write_all(names.as_bytes())?;
            table.insert(file)
        }
    };
    file.write_all(line.as_bytes())
}
