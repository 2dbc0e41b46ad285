//! Keeper of a run: writes its checkpoints and its status, and watches its limits.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use drape::checkpoint::{Checkpoint, Identity, Store};
use drape::dynamics::{Error, SavedRecorder, SavedSimulation};
use drape::scene::Scene;

use super::limits::Limits;
use super::status::{Advance, StatusFile};

/// Name of the section of the recorder in a checkpoint.
const RECORDER: &str = "recorder";

/// Keeper of a run.
pub(crate) struct Keeper {
    folder: PathBuf,
    identity: Identity,
    every: Duration,
    /// Time of the last checkpoint, or of the start.
    last: Instant,
    limits: Limits,
    reached: Option<String>,
    status: StatusFile,
}

/// Content of a checkpoint: the states of simulation and recorder.
pub(crate) struct Kept {
    pub(crate) simulation: SavedSimulation,
    pub(crate) recorder: SavedRecorder,
}

impl Keeper {
    /// Keeper of a run of a scene in a folder, with a checkpoint after every so many seconds.
    pub(crate) fn new(folder: &Path, scene: &Scene, every: f64, limits: Limits) -> Self {
        Self {
            folder: folder.to_owned(),
            identity: identity(scene),
            every: Duration::from_secs_f64(every),
            last: Instant::now(),
            limits,
            reached: None,
            status: StatusFile::new(folder),
        }
    }

    /// Takes a step into account, and looks after the limits from time to time.
    pub(crate) fn step(&mut self, advance: Advance) {
        if self.status.step(advance) && self.reached.is_none() {
            self.reached = self.limits.reached(self.status.begin(), &self.folder);
        }
    }

    /// Returns the limit that the run has reached, in words.
    pub(crate) fn reached(&self) -> Option<&str> {
        self.reached.as_deref()
    }

    /// Returns whether it is time for a checkpoint.
    pub(crate) fn is_due(&self) -> bool {
        self.last.elapsed() >= self.every
    }

    /// Writes a checkpoint.
    pub(crate) fn keep(
        &mut self,
        simulation: &SavedSimulation,
        recorder: &SavedRecorder,
    ) -> Result<(), Error> {
        let mut checkpoint = Checkpoint::new(self.identity.clone());
        simulation.write(&mut checkpoint)?;
        checkpoint.put(RECORDER, recorder)?;
        Store::new(&self.folder).write(&checkpoint)?;
        self.last = Instant::now();
        Ok(())
    }

    /// Returns what changed since a checkpoint was written.
    pub(crate) fn changes(&self, checkpoint: &Checkpoint) -> Vec<String> {
        self.identity.changes(checkpoint.identity())
    }

    /// Tells how the run ended.
    pub(crate) fn end(&mut self, outcome: &str, message: Option<String>) {
        self.status.end(outcome, message);
    }
}

impl Kept {
    /// Takes what a checkpoint holds.
    pub(crate) fn read(checkpoint: &Checkpoint) -> Result<Self, Error> {
        let simulation = SavedSimulation::read(checkpoint)?;
        Ok(Self { simulation, recorder: checkpoint.get(RECORDER)? })
    }
}

/// Identity of a run: the program, to the last byte, and all that the scene was read from.
fn identity(scene: &Scene) -> Identity {
    let identity = Identity::new(concat!("drape ", env!("CARGO_PKG_VERSION")));
    let program = std::env::current_exe().and_then(std::fs::read).unwrap_or_default();
    let parts = scene.source.parts.iter();
    parts.fold(identity.with("the program's file", &program), |identity, part| {
        identity.with_digest(&part.name, part.digest)
    })
}
