//! Writer of the checkpoints and the status of a run, which watches the limits of the run.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use drape_checkpoint::{Checkpoint, Identity, Store};
use drape_dynamics::{Error, SavedSimulation};
use drape_frames::SavedWriter;
use drape_scene::Scene;

use super::limits::{Limits, ReachedLimit};
use super::options::RunOptions;
use super::status::{Advance, StatusFile};

/// Name of the section of the writer of frames in a checkpoint.
const FRAMES: &str = "frames";

/// Writer of the checkpoints and the status of a run.
pub(super) struct CheckpointWriter {
    folder: PathBuf,
    identity: Identity,
    every: Duration,
    /// Time of the last checkpoint, or of the start.
    last: Instant,
    limits: Limits,
    reached: Option<ReachedLimit>,
    status: StatusFile,
}

/// Content of a checkpoint: the states of the simulation and of the writer of its frames.
pub(super) struct SavedRun {
    pub(super) simulation: SavedSimulation,
    pub(super) frames: SavedWriter,
}

impl CheckpointWriter {
    /// Returns the writer of the run of a `scene` in a `folder`, with a checkpoint after `every`
    /// seconds.
    pub(super) fn new(folder: &Path, scene: &Scene, every: f64, options: &RunOptions) -> Self {
        Self {
            folder: folder.to_owned(),
            identity: identity(scene, &options.program),
            every: Duration::from_secs_f64(every),
            last: Instant::now(),
            limits: options.limits.clone(),
            reached: None,
            status: StatusFile::new(folder),
        }
    }

    /// Writes to the status that the run goes on.
    pub(super) fn start(&mut self) {
        self.status.start();
    }

    /// Takes the progress of a step, `advance`, into account, and checks the limits from time to
    /// time.
    pub(super) fn step(&mut self, advance: Advance) {
        if self.status.step(advance) && self.reached.is_none() {
            self.reached = self.limits.reached(self.status.begin(), &self.folder);
        }
    }

    /// Returns the limit that the run has reached.
    pub(super) fn reached(&self) -> Option<ReachedLimit> {
        self.reached
    }

    /// Returns whether a checkpoint is due, which is every `every` seconds.
    pub(super) fn is_due(&self) -> bool {
        self.last.elapsed() >= self.every
    }

    /// Writes a checkpoint of a `simulation` and of the writer of its `frames`.
    pub(super) fn keep(
        &mut self,
        simulation: &SavedSimulation,
        frames: &SavedWriter,
    ) -> Result<(), Error> {
        let mut checkpoint = Checkpoint::new(self.identity.clone());
        simulation.write(&mut checkpoint)?;
        checkpoint.put(FRAMES, frames)?;
        Store::new(&self.folder).write(&checkpoint)?;
        self.last = Instant::now();
        Ok(())
    }

    /// Returns the changes of the input since a `checkpoint` was written, in words.
    pub(super) fn changes(&self, checkpoint: &Checkpoint) -> Vec<String> {
        self.identity.changes(checkpoint.identity())
    }

    /// Writes the `outcome` of the run to its status, with a `message`.
    pub(super) fn end(&mut self, outcome: &str, message: Option<String>) {
        self.status.end(outcome, message);
    }
}

impl SavedRun {
    /// Returns the states that a `checkpoint` holds.
    pub(super) fn read(checkpoint: &Checkpoint) -> Result<Self, Error> {
        let simulation = SavedSimulation::read(checkpoint)?;
        Ok(Self { simulation, frames: checkpoint.get(FRAMES)? })
    }
}

/// Returns the identity of a run: all bytes of the `program`, and all files from which the `scene`
/// was read.
fn identity(scene: &Scene, program: &Path) -> Identity {
    let identity = Identity::new(concat!("drape ", env!("CARGO_PKG_VERSION")));
    let parts = scene.source.parts.iter();
    parts.fold(identity.with_file("the program's file", program), |identity, part| {
        identity.with_digest(&part.name, part.digest)
    })
}
