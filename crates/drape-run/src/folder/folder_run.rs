//! Run of a scene in a folder, from its start or from a checkpoint to its summary.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::Error;
use super::checkpoint_writer::{CheckpointWriter, SavedRun};
use super::goal::Goal;
use super::limits::ReachedLimit;
use super::lock::Lock;
use super::options::{RunOptions, Watcher};
use super::request::RunRequest;
use super::space::check_space;
use super::status::Advance;
use drape_checkpoint::Store;
use drape_dynamics::{
    Energy, Progress, SavedSimulation, Simulation, Snapshot, Status, Step, Summary,
};
use drape_export::write_obj;
use drape_frames::{Frame, FrameWriter, Recording, write_summary};
use drape_scene::Scene;

/// Run of a scene in a folder that no other run uses.
pub struct FolderRun {
    pub(super) scene: Scene,
    pub(super) folder: PathBuf,
    pub(super) writer: CheckpointWriter,
    pub(super) lock: Lock,
    pub(super) give_up: Arc<AtomicBool>,
    /// Whether the state is hashed after each step.
    pub(super) state_hash: bool,
    /// Checkpoint from which the run continues.
    pub(super) resumption: Option<Resumption>,
}

/// Checkpoint from which a run continues, and the time by which the run is extended beyond its end,
/// in s.
pub(super) struct Resumption {
    pub(super) saved: SavedRun,
    pub(super) extend: Option<f64>,
}

/// Run that has ended. It locks its folder until it is dropped.
pub struct EndedRun {
    /// Summary, which is also in `summary.json`.
    pub summary: Summary,
    /// Cloth and bodies at the end.
    pub last: Snapshot,
    /// Limit that ended the run, if one did.
    pub limit: Option<ReachedLimit>,
    writer: CheckpointWriter,
    _lock: Lock,
}

/// Sets the end of a `scene` to `end`, in s.
///
/// # Errors
/// An end before the first step.
pub fn end_at(scene: &mut Scene, end: f64) -> Result<(), Error> {
    let step = scene.schedule.clock.step;
    if !(end >= step) {
        return Err(Error::End { end, step });
    }
    scene.schedule.clock.end = end;
    Ok(())
}

impl FolderRun {
    /// Begins a run of a `scene` in a `folder`, with a `request` for this scene.
    ///
    /// # Errors
    /// Another run writes to the folder, the folder holds results or an interrupted run and may not
    /// be replaced, the folder cannot be written, or the disk is full.
    pub fn begin(
        scene: Scene,
        folder: &Path,
        request: &RunRequest,
        options: &RunOptions,
    ) -> Result<Self, Error> {
        if RunRequest::is_interrupted(folder) && !options.replace {
            return Err(Error::Interrupted { folder: folder.to_owned() });
        }
        let place = |folder: &Path| folder.canonicalize().ok();
        let graded_by = scene.source.graded_by.as_deref().and_then(place);
        if graded_by.is_some() && graded_by == place(folder) {
            return Err(Error::GradedBy { folder: folder.to_owned() });
        }

        check_space(&scene, folder)?;
        let lock = Lock::take(folder)?;
        prepare_folder(folder, options.replace)?;
        let scene_hash = Some(scene.source.hash.clone());
        RunRequest { scene_hash, ..request.clone() }.write(folder)?;
        let writer = CheckpointWriter::new(folder, &scene, request.checkpoint_every, options);
        Ok(Self {
            scene,
            folder: folder.to_owned(),
            writer,
            lock,
            give_up: options.give_up.clone(),
            state_hash: request.state_hash,
            resumption: None,
        })
    }

    /// Returns the `scene`.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Runs the scene to its end and writes its results, while `watcher` sees the progress. A run
    /// that fails has a summary too.
    ///
    /// # Errors
    /// The simulation cannot be set up, or results cannot be written.
    pub fn run(self, watcher: &mut dyn Watcher) -> Result<EndedRun, Error> {
        let Self { scene, folder, mut writer, lock, give_up, state_hash, resumption } = self;
        if resumption.is_none() {
            writer.start();
        }
        let mut simulation = Simulation::new(scene)?;
        simulation.give_up_when(give_up);
        if state_hash {
            simulation.hash_steps();
        }
        let manifest = simulation.manifest();
        let frames = match resumption {
            None => FrameWriter::create(&folder, &manifest, &simulation.topology())?,
            Some(Resumption { saved, extend }) => {
                simulation.resume(saved.simulation)?;
                if let Some(seconds) = extend
                    && !simulation.extend(seconds).map_err(Error::Extension)?
                {
                    return Err(Error::AtRest);
                }
                let frames = FrameWriter::resume(&folder, &manifest, saved.frames)?;
                writer.start();
                frames
            }
        };

        let goal = Goal::new(&simulation);
        let mut progress = FolderProgress { frames, writer, goal, last: None, watcher };
        let mut summary = simulation.run(&mut progress)?;
        let FolderProgress { mut writer, last, frames, .. } = progress;
        let saved_frames = frames.save()?;

        let limit = writer.reached().filter(|_| summary.status == Status::Interrupted);
        if let Some(limit) = limit {
            summary.reason = Some(limit.to_string());
        }
        // The summary says that the run has ended, so the summary is written after the last frame.
        // A run that is interrupted before repeats its last steps and reaches the same summary.
        save_last(&folder)?;
        write_summary(&folder, &summary)?;
        if matches!(summary.status, Status::Ok | Status::DidNotSettle) {
            writer.keep(&simulation.saved(), &saved_frames)?;
        }
        let mut at_end = simulation.snapshot();
        if let Some(frame) = last {
            at_end.positions = frame.cloth.into_flattened();
        }
        Ok(EndedRun { summary, last: at_end, limit, writer, _lock: lock })
    }
}

impl EndedRun {
    /// Writes the outcome of the run for other programs, releases the folder and returns the
    /// [`Summary`].
    #[must_use]
    pub fn close(mut self) -> Summary {
        let state = serde_json::to_value(&self.summary.status).unwrap_or_default();
        self.writer.end(state.as_str().unwrap_or("ok"), self.summary.reason.clone());
        self.summary
    }
}

/// Creates `folder` for a run. If `replace`, the files and checkpoints of an earlier run are
/// removed from it. Files that no run has written stay.
///
/// # Errors
/// The folder holds results and `replace` is false, or it cannot be written.
pub(super) fn prepare_folder(folder: &Path, replace: bool) -> Result<(), Error> {
    let store = Store::new(folder);
    if !replace && folder.exists() && !store.is_empty() {
        return Err(drape_frames::Error::Occupied { folder: folder.to_owned() }.into());
    }
    drape_frames::prepare_folder(folder, replace)?;
    store.clear().map_err(drape_dynamics::Error::from)?;
    Ok(())
}

/// Saves the last frame in `folder` as `last.obj`, which any program opens.
fn save_last(folder: &Path) -> Result<(), Error> {
    let recording = Recording::open(folder)?;
    let frame = recording.frame(recording.frame_count() - 1)?;
    let path = folder.join("last.obj");
    let mut obj = Vec::new();
    write_obj(&recording, &frame, &mut obj)
        .map_err(|error| Error::LastFrame { path: path.clone(), reason: error.to_string() })?;
    Ok(crate::file::write(&path, obj)?)
}

/// Progress of a run, which writes its frames and checkpoints.
struct FolderProgress<'a> {
    frames: FrameWriter,
    writer: CheckpointWriter,
    goal: Goal,
    /// Latest frame.
    last: Option<Frame>,
    watcher: &'a mut dyn Watcher,
}

impl Progress for FolderProgress<'_> {
    fn step(&mut self, step: &Step, _ticks: usize) {
        let done = self.goal.done(step);
        self.writer.step(Advance { phase: step.phase, done, time: step.time });
        self.watcher.step(step, done);
    }

    fn frame(
        &mut self,
        frame: &Frame,
        energy: Option<&Energy>,
    ) -> Result<(), drape_dynamics::Error> {
        self.frames.write_with_energy(frame, energy)?;
        self.watcher.frame(frame);
        self.last = Some(frame.clone());
        Ok(())
    }

    fn is_checkpoint_due(&self) -> bool {
        self.writer.is_due()
    }

    fn checkpoint(&mut self, saved: &SavedSimulation) -> Result<(), drape_dynamics::Error> {
        self.writer.keep(saved, &self.frames.save()?)
    }

    fn is_interrupted(&self) -> bool {
        self.writer.reached().is_some() || self.watcher.is_interrupted()
    }
}
