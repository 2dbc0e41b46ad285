//! Recorder: files of a run in a folder.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use drape_checkpoint::Store;
use npyz::half::f16;
use serde::{Deserialize, Serialize};

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
    /// Frames so far.
    frames: usize,
}

/// State of a recorder: the number of its frames and the last bodies, from which it resumes.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct SavedRecorder {
    frames: usize,
    bodies: Option<StoredBodies>,
}

/// Bodies in a file.
#[derive(Debug, Clone, Serialize, Deserialize)]
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
        let store = Store::new(folder);
        if !(files.is_empty() && store.is_empty() || replace) {
            return Err(Error::Occupied { folder: folder.to_owned() });
        }
        store.clear()?;
        manifest::remove(&files).map_err(|(path, reason)| Error::Write { path, reason })?;
    }
    fs::create_dir_all(folder).map_err(fail)?;
    Ok(output)
}

/// Removes an incomplete temporary file. Of a symbolic link, the link itself is removed.
fn remove_left(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

impl Output {
    /// Folder of a run that goes on.
    #[must_use]
    pub fn of_run(folder: &Path) -> Self {
        Self { folder: folder.to_owned() }
    }

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
        let begin = || -> io::Result<fs::File> {
            let mut list = fs::File::create_new(&path)?;
            list.write_all(b"number,time,growth,bodies,touched\n")?;
            Ok(list)
        };
        let list = begin().map_err(|reason| Error::Write { path, reason })?;
        self.json(SURFACES, topology)?;
        Ok(Recorder { output: self, list, energy: None, bodies: None, frames: 0 })
    }

    /// Returns a writer that goes on behind the frames of a checkpoint: later ones are removed, with
    /// the summary.
    ///
    /// # Errors
    /// When frames that the checkpoint counts are missing, or files cannot be written.
    pub fn resume(&self, saved: SavedRecorder) -> Result<Recorder<'_>, Error> {
        let SavedRecorder { frames, bodies } = saved;
        let later = manifest::frames_from(&self.folder, frames as u64);
        let later = later.map_err(|reason| Error::Write { path: self.folder.clone(), reason })?;
        let ended = [SUMMARY, "last.obj"].map(|name| self.path(name));
        let ended = ended.into_iter().filter(|path| path.exists());
        let list = self.reopen(FRAMES, frames)?;
        if list.lines != frames {
            let path = self.path(FRAMES);
            return Err(Error::LostFrames { path, found: list.lines, frames });
        }
        let energy = match self.path(ENERGY).exists() {
            true => Some(self.reopen(ENERGY, frames)?).filter(|own| own.lines > 0),
            false => None,
        };
        let all: Vec<PathBuf> = later.into_iter().chain(ended).collect();
        manifest::remove(&all).map_err(|(path, reason)| Error::Write { path, reason })?;
        let energy = energy.map(|own| own.file);
        Ok(Recorder { output: self, list: list.file, energy, bodies, frames })
    }

    /// Opens a table to go on, with its heading and the whole lines of so many frames.
    fn reopen(&self, name: &str, frames: usize) -> Result<Reopened, Error> {
        let path = self.path(name);
        let fail = |reason: io::Error| Error::Write { path: path.clone(), reason };
        let text = fs::read_to_string(&path).map_err(fail)?;
        let is_earlier = |line: &&str| {
            let number = line.split(',').next().and_then(|number| number.parse().ok());
            line.ends_with('\n') && number.is_some_and(|number: usize| number < frames)
        };
        let mut lines = text.split_inclusive('\n');
        let heading = lines.next().unwrap_or_default();
        let kept: Vec<&str> = lines.filter(is_earlier).collect();
        let content = format!("{heading}{}", kept.concat());
        self.write(&path, |to| to.write_all(content.as_bytes()))?;
        let file = fs::OpenOptions::new().append(true).open(&path).map_err(fail)?;
        Ok(Reopened { file, lines: kept.len() })
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
        content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Error> {
        let temporary = path.with_extension("part");
        let write = || -> io::Result<()> {
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

/// Table that is opened again to append lines.
struct Reopened {
    file: fs::File,
    /// Lines that it has, but the heading.
    lines: usize,
}

impl Recorder<'_> {
    /// Makes what has been stored outlast a loss of power, and returns what a recorder needs to go
    /// on behind it.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn save(&self) -> Result<SavedRecorder, Error> {
        let folder = || self.output.folder.clone();
        let tables = [Some(&self.list), self.energy.as_ref()];
        let synced = tables.into_iter().flatten().try_for_each(fs::File::sync_data);
        synced.map_err(|reason| Error::Write { path: folder(), reason })?;
        Ok(SavedRecorder { frames: self.frames, bodies: self.bodies.clone() })
    }

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
        self.frames = number + 1;
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
fn energy_lines(frame: &Frame, energy: &Energy) -> io::Result<[String; 2]> {
    let mut table = csv::Writer::from_writer(Vec::new());
    table.serialize(energy).map_err(io::Error::from)?;
    let bytes = table.into_inner().map_err(|error| error.into_error())?;
    let text = String::from_utf8(bytes).map_err(io::Error::other)?;
    let (names, entries) = text.split_once('\n').unwrap_or_default();
    let Frame { number, time, .. } = frame;
    Ok([format!("number,time,{names}\n"), format!("{number},{time:?},{entries}")])
}

/// Appends a line to a table; one that is not there yet begins with the names of its columns.
fn append(table: &mut Option<fs::File>, path: &Path, [names, line]: [String; 2]) -> io::Result<()> {
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
