//! Writer: stores the frames of a run in a folder.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use npyz::half::f16;
use serde::{Deserialize, Serialize};

use super::file::{write_file, write_json};
use super::files::{self, ARRAYS, ENERGY, FRAMES, SUMMARY, SURFACES};
use super::npy;
use crate::energy_table::EnergyTable;
use crate::error::Error;
use crate::frame::Frame;
use crate::frame_hash::{self, FileHashes};
use crate::manifest::Manifest;
use crate::source::{array_frames, check_frame, index};
use crate::text::read_text;
use crate::topology::Topology;

/// Writer of the frames of a run to a folder, which [`Recording`](crate::Recording) reads.
///
/// ```
/// use drape_frames::{Frame, FrameWriter, Manifest, Recording, SurfacePart, Topology};
///
/// let corners = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
/// let topology = Topology { material: corners, cloth: vec![[0, 1, 2]], bodies: Vec::new() };
/// let flag = SurfacePart { name: "flag".into(), vertices: 3, triangles: 1, ..Default::default() };
/// let manifest = Manifest { panels: vec![flag], ..Manifest::default() };
///
/// let folder = tempfile::tempdir()?;
/// let mut writer = FrameWriter::create(folder.path(), &manifest, &topology)?;
/// for time in [0.0, 0.1] {
///     writer.write(&Frame { time, cloth: vec![[time, 0.0, 0.0]; 3], ..Frame::default() })?;
/// }
/// let recording = Recording::open(folder.path())?;
/// assert_eq!((recording.frame_count(), recording.manifest()), (2, &manifest));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct FrameWriter {
    folder: PathBuf,
    manifest: Manifest,
    /// List of the frames, open for appending.
    list: fs::File,
    /// Table of the energy balance, once a frame has one.
    energy: Option<fs::File>,
    /// Bodies that were stored last.
    bodies: Option<StoredBodies>,
    /// Number of stored frames.
    frame_count: usize,
    /// Time of the last stored frame, in s.
    last_time: Option<f64>,
}

/// State of a [`FrameWriter`], from which it resumes: the number of its frames and the last bodies.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct SavedWriter {
    frame_count: usize,
    last_time: Option<f64>,
    bodies: Option<StoredBodies>,
}

/// Bodies that were stored in a file.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct StoredBodies {
    /// Positions of the vertices of all bodies, in m.
    positions: Vec<[f64; 3]>,
    /// Number of the frame with which the bodies were stored.
    frame: usize,
    /// Hash of their file.
    hash: [u8; 32],
}

/// Creates `folder` for a run. If `replace`, the files of an earlier run are removed from it; files
/// that no run has written stay.
///
/// # Errors
/// [`Error::Occupied`] if `folder` holds results and `replace` is false. [`Error::Write`] if the
/// folder cannot be created, or if a file cannot be removed.
pub fn prepare_folder(folder: &Path, replace: bool) -> Result<(), Error> {
    if folder.exists() {
        let files = files::files(folder).map_err(|error| Error::unwritable(folder, &error))?;
        if !(files.is_empty() || replace) {
            return Err(Error::Occupied { folder: folder.to_owned() });
        }
        files::remove(&files)?;
    }
    fs::create_dir_all(folder).map_err(|error| Error::unwritable(folder, &error))
}

/// Stores `summary` as `summary.json` in `folder`. The file says that the run has ended. Its key
/// `frames` is the number of frames.
///
/// # Errors
/// [`Error::Write`] if the file cannot be written.
pub fn write_summary(folder: &Path, summary: &impl Serialize) -> Result<(), Error> {
    write_json(&folder.join(SUMMARY), summary)
}

impl FrameWriter {
    /// Stores `manifest` and `topology` in `folder`, which exists and holds no run, and returns the
    /// writer of frames.
    ///
    /// # Errors
    /// [`Error::BadTopology`] or [`Error::BadTriangle`] if `topology` does not fit `manifest`, or
    /// [`Error::Write`] if a file cannot be written.
    pub fn create(
        folder: &Path,
        manifest: &Manifest,
        topology: &Topology,
    ) -> Result<FrameWriter, Error> {
        topology.check(manifest)?;
        let [material, triangles, body_triangles] = ARRAYS.map(|name| folder.join(name));
        write_file(&material, |to| npy::write(to, &topology.material))?;
        write_file(&triangles, |to| npy::write(to, &topology.cloth))?;
        if !manifest.bodies.is_empty() {
            write_file(&body_triangles, |to| npy::write(to, &topology.bodies))?;
        }

        let path = folder.join(FRAMES);
        let created = fs::File::create_new(&path).and_then(|mut list| {
            list.write_all(b"number,time,growth,bodies,touched,hash\n")?;
            Ok(list)
        });
        let list = created.map_err(|error| Error::unwritable(&path, &error))?;
        write_json(&folder.join(SURFACES), manifest)?;

        let (folder, manifest) = (folder.to_owned(), manifest.clone());
        Ok(FrameWriter {
            folder,
            manifest,
            list,
            energy: None,
            bodies: None,
            frame_count: 0,
            last_time: None,
        })
    }

    /// Returns a writer that continues the run in `folder` after the frames of `saved`. Later
    /// frames and the summary are removed. `manifest` has the parts of the run.
    ///
    /// # Errors
    /// [`Error::LostFrames`] if frames that `saved` counts are not listed, an error of reading if
    /// a frame or a table is damaged, or [`Error::Write`] if files cannot be written.
    pub fn resume(
        folder: &Path,
        manifest: &Manifest,
        saved: SavedWriter,
    ) -> Result<FrameWriter, Error> {
        let SavedWriter { frame_count, last_time, bodies } = saved;
        check_earlier(folder, manifest, frame_count)?;
        let later = files::frames_from(folder, frame_count as u64);
        let later = later.map_err(|error| Error::unwritable(folder, &error))?;
        let final_files = [SUMMARY, "last.obj"].map(|name| folder.join(name));
        let final_files = final_files.into_iter().filter(|path| path.exists());

        let list = reopen(&folder.join(FRAMES), frame_count)?;
        let mut energy = None;
        if folder.join(ENERGY).exists() {
            let table = reopen(&folder.join(ENERGY), frame_count)?;
            energy = (table.lines > 0).then_some(table.file);
        }

        // Files are removed only after the tables have been checked.
        let obsolete: Vec<PathBuf> = later.into_iter().chain(final_files).collect();
        files::remove(&obsolete)?;
        let (folder, manifest, list) = (folder.to_owned(), manifest.clone(), list.file);
        Ok(FrameWriter { folder, manifest, list, energy, bodies, frame_count, last_time })
    }

    /// Writes the tables to the disk, so that they survive a loss of power. Returns the
    /// [`SavedWriter`] from which a writer resumes.
    ///
    /// # Errors
    /// [`Error::Write`] if a table cannot be written.
    pub fn save(&self) -> Result<SavedWriter, Error> {
        let tables = [Some(&self.list), self.energy.as_ref()];
        let synced = tables.into_iter().flatten().try_for_each(fs::File::sync_data);
        synced.map_err(|error| Error::unwritable(&self.folder, &error))?;
        let Self { frame_count, last_time, .. } = *self;
        Ok(SavedWriter { frame_count, last_time, bodies: self.bodies.clone() })
    }

    /// Stores `frame` as the next frame: as `frame-00012.npy`, its bodies as `bodies-00012.npy` if
    /// they have moved, and its pressures as `pressure-00012.npy` if something touches. Then the
    /// frame is listed in `frames.csv`. Frames are numbered in the order in which they are stored.
    ///
    /// # Errors
    /// [`Error::BadFrame`] if `frame` does not fit the parts of the run, or [`Error::Write`] if a
    /// file cannot be written.
    pub fn write(&mut self, frame: &Frame) -> Result<(), Error> {
        self.write_with_energy(frame, None::<&()>)
    }

    /// Stores `frame` as [`write`](Self::write) does, with a line of `energy.csv`: `energy` is a
    /// struct whose fields are the entries of the energy balance, in J.
    ///
    /// # Errors
    /// The errors of [`write`](Self::write).
    pub fn write_with_energy(
        &mut self,
        frame: &Frame,
        energy: Option<&impl Serialize>,
    ) -> Result<(), Error> {
        let number = self.frame_count;
        check_frame(&self.manifest, self.last_time, frame)?;

        // Bodies that have not moved are stored once.
        let stored = self.bodies.as_ref();
        let is_stored = stored.is_some_and(|stored| stored.positions == frame.bodies);
        if !frame.bodies.is_empty() && !is_stored {
            let hash = self.write_positions("bodies", number, &frame.bodies)?;
            let positions = frame.bodies.clone();
            self.bodies = Some(StoredBodies { positions, frame: number, hash });
        }
        let cloth = Some(self.write_positions("frame", number, &frame.cloth)?);
        let (touched, pressures) = self.write_pressures(number, frame.pressures.as_deref())?;
        if let Some(energy) = energy {
            let path = self.folder.join(ENERGY);
            let written = energy_lines(number, frame.time, energy)
                .and_then(|lines| append(&mut self.energy, &path, lines));
            written.map_err(|error| Error::unwritable(&path, &error))?;
        }

        // The frame is listed last, when all its files exist.
        let touched = touched.map_or(String::new(), |count| count.to_string());
        let bodies = self.bodies.as_ref().map_or(String::new(), |stored| stored.frame.to_string());
        let Frame { time, growth_fraction, .. } = frame;
        let body_hash = self.bodies.as_ref().map(|stored| stored.hash);
        let hash = FileHashes { cloth, bodies: body_hash, pressures }.text();
        let line = format!("{number},{time:?},{growth_fraction:?},{bodies},{touched},{hash}\n");
        (self.frame_count, self.last_time) = (number + 1, Some(*time));
        let listed = self.list.write_all(line.as_bytes()).and_then(|()| self.list.sync_data());
        listed.map_err(|error| Error::unwritable(&self.folder.join(FRAMES), &error))
    }

    /// Stores `positions` as the array of `kind` of the frame `number`. Returns the hash of the
    /// file.
    fn write_positions(
        &self,
        kind: &str,
        number: usize,
        positions: &[[f64; 3]],
    ) -> Result<[u8; 32], Error> {
        let path = self.folder.join(format!("{kind}-{number:05}.npy"));
        write_hashed(&path, |to| npy::write(to, positions))
    }

    /// Stores `pressures` of the frame `number` in half precision if any is above zero. Returns the
    /// number of pressures above zero, or `None` if there are no pressures, and the hash of the
    /// file, if there is one.
    fn write_pressures(
        &self,
        number: usize,
        pressures: Option<&[f64]>,
    ) -> Result<(Option<usize>, Option<[u8; 32]>), Error> {
        let Some(pressures) = pressures else { return Ok((None, None)) };
        let largest = f64::from(f16::MAX);
        let half: Vec<f16> = pressures.iter().map(|p| f16::from_f64(p.min(largest))).collect();
        let touched = half.iter().filter(|pressure| **pressure > f16::ZERO).count();
        let mut hash = None;
        if touched > 0 {
            let path = self.folder.join(format!("pressure-{number:05}.npy"));
            hash = Some(write_hashed(&path, |to| npy::write_half(to, &half))?);
        }
        Ok((Some(touched), hash))
    }
}

/// Writes the array that `content` writes to the file `path`. Returns the hash of the file.
fn write_hashed(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<[u8; 32], Error> {
    let mut array = Vec::new();
    content(&mut array).map_err(|error| Error::unwritable(path, &error))?;
    write_file(path, |to| to.write_all(&array))?;
    Ok(frame_hash::hash(&array))
}

/// Refuses a folder in which one of the first `frame_count` frames, or the table of energies, is
/// missing or damaged, before anything in the folder changes.
fn check_earlier(folder: &Path, manifest: &Manifest, frame_count: usize) -> Result<(), Error> {
    let path = folder.join(FRAMES);
    let entries = index::read(&path)?;
    if entries.len() < frame_count {
        return Err(Error::LostFrames { path, found: entries.len(), frames: frame_count });
    }
    for entry in &entries[..frame_count] {
        array_frames::read(folder, manifest, entry)?;
    }

    let energy = folder.join(ENERGY);
    if energy.exists() {
        EnergyTable::read(&energy, entries.len())?;
    }
    Ok(())
}

/// Table that was opened again for appending lines.
struct Reopened {
    file: fs::File,
    /// Number of lines without the heading.
    lines: usize,
}

/// Opens the table `path` for appending, with its heading and the complete lines of the first
/// `frame_count` frames.
fn reopen(path: &Path, frame_count: usize) -> Result<Reopened, Error> {
    let text = read_text(path)?;
    let mut lines = text.split_inclusive('\n');
    let heading = lines.next().unwrap_or_default();
    let earlier = lines.filter(|line| {
        let number = line.split(',').next().and_then(|number| number.parse().ok());
        line.ends_with('\n') && number.is_some_and(|number: usize| number < frame_count)
    });
    let kept: Vec<&str> = earlier.collect();

    // The table is replaced as a whole, so that a reader never sees a part of it.
    let content = format!("{heading}{}", kept.concat());
    write_file(path, |to| to.write_all(content.as_bytes()))?;
    let opened = fs::OpenOptions::new().append(true).open(path);
    let file = opened.map_err(|error| Error::unwritable(path, &error))?;
    Ok(Reopened { file, lines: kept.len() })
}

/// Returns the heading of the table of energies, and the line of `energy` at the frame `number` and
/// the time `time`, in s.
fn energy_lines(number: usize, time: f64, energy: &impl Serialize) -> io::Result<[String; 2]> {
    let mut table = csv::Writer::from_writer(Vec::new());
    table.serialize(energy).map_err(io::Error::from)?;
    let bytes = table.into_inner().map_err(|error| error.into_error())?;
    let text = String::from_utf8(bytes).map_err(io::Error::other)?;
    let (names, entries) = text.split_once('\n').unwrap_or_default();
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
