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

/// Folder of a run with its frames and its summary.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    folder: PathBuf,
}

/// Writer of the frames of a run.
#[derive(Debug)]
pub struct Recorder<'a> {
    output: &'a Output,
    /// List of the frames, open for appending.
    list: fs::File,
    /// Table of the energy balance, once a frame has one.
    energy: Option<fs::File>,
    /// Bodies that were stored last.
    bodies: Option<StoredBodies>,
    /// Number of stored frames.
    frames: usize,
}

/// State of a recorder: the number of its frames and the last bodies, from which it resumes.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct SavedRecorder {
    frames: usize,
    bodies: Option<StoredBodies>,
}

/// Bodies that were stored in a file.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct StoredBodies {
    /// Positions of the vertices of all bodies, in m.
    positions: Vec<f64>,
    /// Number of the frame with which the bodies were stored.
    frame: usize,
}

/// Creates `folder` for a run. If `replace`, the files of an earlier run are removed from it; files
/// that no run has written stay.
///
/// # Errors
///
/// Returns an error if `folder` holds results and `replace` is false, or if it cannot be created.
///
/// # Errors
/// When it holds results and `replace` is false, or cannot be made.
pub fn prepare_folder(folder: &Path, replace: bool) -> Result<Output, Error> {
    let output = Output { folder: folder.to_owned() };
    if folder.exists() {
        let files = manifest::files(folder).map_err(|reason| write_error(folder, reason))?;
        let store = Store::new(folder);
        if !(files.is_empty() && store.is_empty() || replace) {
            return Err(Error::Occupied { folder: folder.to_owned() });
        }
        store.clear()?;
        manifest::remove(&files).map_err(|(path, reason)| Error::Write { path, reason })?;
    }
    fs::create_dir_all(folder).map_err(|reason| write_error(folder, reason))?;
    Ok(output)
}

/// Returns an [`Error::Write`] for the file or folder `path`.
fn write_error(path: &Path, reason: io::Error) -> Error {
    Error::Write { path: path.to_owned(), reason }
}

/// Removes an incomplete temporary file at `path`, if there is one. If `path` is a symbolic link,
/// only the link is removed.
fn remove_temporary(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

impl Output {
    /// Returns the existing `folder` of a run that resumes.
    #[must_use]
    pub fn resumed(folder: &Path) -> Self {
        Self { folder: folder.to_owned() }
    }

    /// Returns the path of the file `name` in the folder.
    #[must_use]
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Stores `topology` as `surfaces.json` and arrays, begins `frames.csv`, and returns the writer
    /// of frames.
    ///
    /// # Errors
    ///
    /// Returns an error if a file cannot be written.
    ///
    /// # Errors
    /// When they cannot be written.
    pub fn record(&self, topology: &Topology) -> Result<Recorder<'_>, Error> {
        let [material, triangles, body_triangles] = ARRAYS.map(|name| self.path(name));
        self.write(&material, |to| array::write(to, &topology.coordinates))?;
        self.write(&triangles, |to| array::write(to, &topology.triangles))?;
        if !topology.bodies.is_empty() {
            self.write(&body_triangles, |to| array::write(to, &topology.body_triangles))?;
        }

        let path = self.path(FRAMES);
        let created = fs::File::create_new(&path).and_then(|mut list| {
            list.write_all(b"number,time,growth,bodies,touched\n")?;
            Ok(list)
        });
        let list = created.map_err(|reason| Error::Write { path, reason })?;
        self.write_json(SURFACES, topology)?;
        Ok(Recorder { output: self, list, energy: None, bodies: None, frames: 0 })
    }

    /// Returns a writer that continues after the frames of the checkpoint state `saved`. Later
    /// frames and the summary are removed.
    ///
    /// # Errors
    ///
    /// Returns an error if frames that the checkpoint counts are missing, or if files cannot be
    /// written.
    ///
    /// # Errors
    /// When frames that the checkpoint counts are missing, or files cannot be written.
    pub fn resume(&self, saved: SavedRecorder) -> Result<Recorder<'_>, Error> {
        let SavedRecorder { frames, bodies } = saved;
        let later = manifest::frames_from(&self.folder, frames as u64);
        let later = later.map_err(|reason| Error::Write { path: self.folder.clone(), reason })?;
        let final_files = [SUMMARY, "last.obj"].map(|name| self.path(name));
        let final_files = final_files.into_iter().filter(|path| path.exists());

        let list = self.reopen(FRAMES, frames)?;
        if list.lines != frames {
            let path = self.path(FRAMES);
            return Err(Error::LostFrames { path, found: list.lines, frames });
        }
        let mut energy = None;
        if self.path(ENERGY).exists() {
            let table = self.reopen(ENERGY, frames)?;
            energy = (table.lines > 0).then_some(table.file);
        }

        // Files are removed only after the tables have been checked.
        let obsolete: Vec<PathBuf> = later.into_iter().chain(final_files).collect();
        manifest::remove(&obsolete).map_err(|(path, reason)| Error::Write { path, reason })?;
        Ok(Recorder { output: self, list: list.file, energy, bodies, frames })
    }

    /// Opens the table `name` for appending, with its heading and the complete lines of the first
    /// `frames` frames.
    fn reopen(&self, name: &str, frames: usize) -> Result<Reopened, Error> {
        let path = self.path(name);
        let text = fs::read_to_string(&path).map_err(|reason| write_error(&path, reason))?;
        let mut lines = text.split_inclusive('\n');
        let heading = lines.next().unwrap_or_default();
        let earlier = lines.filter(|line| {
            let number = line.split(',').next().and_then(|number| number.parse().ok());
            line.ends_with('\n') && number.is_some_and(|number: usize| number < frames)
        });
        let kept: Vec<&str> = earlier.collect();

        // The table is replaced as a whole, so that a reader never sees a part of it.
        let content = format!("{heading}{}", kept.concat());
        self.write(&path, |to| to.write_all(content.as_bytes()))?;
        let opened = fs::OpenOptions::new().append(true).open(&path);
        let file = opened.map_err(|reason| write_error(&path, reason))?;
        Ok(Reopened { file, lines: kept.len() })
    }

    /// Stores `summary` as `summary.json`.
    ///
    /// # Errors
    ///
    /// Returns an error if the file cannot be written.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn summary(&self, summary: &Summary) -> Result<(), Error> {
        self.write_json(SUMMARY, summary)
    }

    /// Writes `content` as JSON to the file `name`.
    fn write_json(&self, name: &str, content: &impl Serialize) -> Result<(), Error> {
        self.write(&self.path(name), |mut to| {
            serde_json::to_writer_pretty(&mut to, content)?;
            writeln!(to)
        })
    }

    /// Writes `content` to a temporary file and renames it to `path`, so that a reader never sees
    /// an incomplete file.
    fn write(
        &self,
        path: &Path,
        content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Error> {
        let temporary = path.with_extension("part");
        replace(path, &temporary, content).map_err(|reason| {
            // The error of the removal is ignored: the first error is reported.
            let _ = fs::remove_file(&temporary);
            write_error(path, reason)
        })
    }
}

/// Writes `content` to the new file `temporary`, and renames the file to `path`.
fn replace(
    path: &Path,
    temporary: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    remove_temporary(temporary)?;
    let mut to = BufWriter::new(fs::File::create_new(temporary)?);
    content(&mut to)?;
    to.into_inner().map_err(|error| error.into_error())?.sync_all()?;
    fs::rename(temporary, path)
}

/// Table that was opened again for appending lines.
struct Reopened {
    file: fs::File,
    /// Number of lines without the heading.
    lines: usize,
}

impl Recorder<'_> {
    /// Writes the tables to the disk, so that they survive a loss of power. Returns the
    /// [`SavedRecorder`] from which a recorder resumes.
    ///
    /// # Errors
    ///
    /// Returns an error if a table cannot be written.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn save(&self) -> Result<SavedRecorder, Error> {
        let tables = [Some(&self.list), self.energy.as_ref()];
        let synced = tables.into_iter().flatten().try_for_each(fs::File::sync_data);
        synced.map_err(|reason| write_error(&self.output.folder, reason))?;
        Ok(SavedRecorder { frames: self.frames, bodies: self.bodies.clone() })
    }

    /// Stores `frame` as `frame-00012.npy`, its bodies as `bodies-00012.npy` if they have moved,
    /// its pressures as `pressure-00012.npy` if something touches, and a line of `energy.csv`. Then
    /// the frame is listed in `frames.csv`.
    ///
    /// # Errors
    ///
    /// Returns an error if a file cannot be written.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn frame(&mut self, frame: &Frame) -> Result<(), Error> {
        let bodies = self.bodies.as_ref();
        let is_stored = bodies.is_some_and(|stored| stored.positions == frame.bodies);
        if !frame.bodies.is_empty() && !is_stored {
            self.write_positions("bodies", frame.number, &frame.bodies)?;
            self.bodies =
                Some(StoredBodies { positions: frame.bodies.clone(), frame: frame.number });
        }
        self.write_positions("frame", frame.number, &frame.positions)?;
        let touched = self.write_pressures(frame)?.map_or(String::new(), |count| count.to_string());
        if let Some(energy) = &frame.energy {
            let path = self.output.path(ENERGY);
            let written = energy_lines(frame, energy)
                .and_then(|lines| append(&mut self.energy, &path, lines));
            written.map_err(|reason| Error::Write { path, reason })?;
        }

        // The frame is listed last, when all its files exist.
        let bodies = self.bodies.as_ref().map_or(String::new(), |stored| stored.frame.to_string());
        let Frame { number, time, growth_fraction, .. } = frame;
        let line = format!("{number},{time:?},{growth_fraction:?},{bodies},{touched}\n");
        self.frames = number + 1;
        let listed = self.list.write_all(line.as_bytes()).and_then(|()| self.list.sync_data());
        listed.map_err(|reason| Error::Write { path: self.output.path(FRAMES), reason })
    }

    /// Stores `positions` as the array of `kind` of the frame `number`.
    fn write_positions(&self, kind: &str, number: usize, positions: &[f64]) -> Result<(), Error> {
        let path = self.output.path(&format!("{kind}-{number:05}.npy"));
        self.output.write(&path, |to| array::write(to, positions.as_chunks::<3>().0))
    }

    /// Stores the pressures of `frame` in half precision if any is above zero. Returns the number
    /// of pressures above zero, or `None` if `frame` has no pressures.
    fn write_pressures(&self, frame: &Frame) -> Result<Option<usize>, Error> {
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

/// Returns the heading of the table of energies, and the line of `energy` at `frame`.
fn energy_lines(frame: &Frame, energy: &Energy) -> io::Result<[String; 2]> {
    let mut table = csv::Writer::from_writer(Vec::new());
    table.serialize(energy).map_err(io::Error::from)?;
    let bytes = table.into_inner().map_err(|error| error.into_error())?;
    let text = String::from_utf8(bytes).map_err(io::Error::other)?;
    let (names, entries) = text.split_once('\n').unwrap_or_default();
    let Frame { number, time, .. } = frame;
    Ok([format!("number,time,{names}\n"), format!("{number},{time:?},{entries}")])
}

/// Appends `line` to `table`. A table that does not exist yet is created at `path` with the heading
/// `names`.
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
