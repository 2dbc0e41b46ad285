//! Run to resume: one that was interrupted, from its last checkpoint, or one that has ended, beyond
//! its end.

use std::path::{Path, PathBuf};

use super::Error;
use super::keeper::{Keeper, Kept};
use super::keeping::Keeping;
use super::lock::Lock;
use super::request::{RunRequest, status_of};
use super::run::{KeptRun, Resumption};
use crate::checkpoint::{Checkpoint, Store};
use crate::dynamics::{self, Output, prepare_folder};
use crate::input::Diagnostic;
use crate::scene::Scene;

/// Run in a folder that is to go on.
pub struct RunToResume {
    /// Request by which it began.
    pub request: RunRequest,
    folder: PathBuf,
    /// Time to go on beyond its end, in s.
    extend: Option<f64>,
    lock: Lock,
}

impl RunToResume {
    /// Opens a run, to go on to its end, or for so many seconds beyond it.
    ///
    /// # Errors
    /// A folder in which no run was begun, to which one writes, or whose run cannot go on.
    pub fn open(folder: &Path, extend: Option<f64>) -> Result<Self, Error> {
        let request = RunRequest::read(folder)?;
        let lock = Lock::take(folder)?;
        refuse_ended(folder, extend)?;
        Ok(Self { request, folder: folder.to_owned(), extend, lock })
    }

    /// Returns the run of its scene, which was read again, from the last checkpoint; with notes on
    /// checkpoints that are damaged or missing.
    ///
    /// # Errors
    /// A scene or a program that has changed since, or no checkpoint to extend.
    pub fn go_on(self, scene: Scene, keeping: &Keeping) -> Result<(KeptRun, Vec<String>), Error> {
        let Self { request, folder, extend, lock } = self;
        let keeper = Keeper::new(&folder, &scene, request.checkpoint_every, keeping);
        let found = Store::new(&folder).read().map_err(dynamics::Error::from)?;
        let damaged = found.damaged.iter().map(|damaged| {
            let (path, fault) = (damaged.path.display(), &damaged.fault);
            format!("warning: {path} is damaged: {fault}; an earlier state is used")
        });
        let mut notes: Vec<String> = damaged.collect();
        let resumption = match &found.newest {
            Some(checkpoint) => {
                check_identity(&keeper, checkpoint, &scene)?;
                found.remove_damaged().map_err(dynamics::Error::from)?;
                Some(Resumption { kept: Kept::read(checkpoint)?, extend })
            }
            None if extend.is_some() => return Err(Error::NoCheckpoint { folder }),
            None => {
                notes.push("note: there is no checkpoint yet; the run begins anew".into());
                None
            }
        };
        let output = match &resumption {
            Some(_) => Output::of_run(&folder),
            None => prepare_folder(&folder, true)?,
        };
        request.write(&folder)?;
        let (give_up, state_hash) = (keeping.give_up.clone(), request.state_hash);
        let run = KeptRun { scene, folder, output, keeper, lock, give_up, state_hash, resumption };
        Ok((run, notes))
    }
}

/// Refuses a run that has ended, unless it is to go on beyond an end that time gave it.
fn refuse_ended(folder: &Path, extend: Option<f64>) -> Result<(), Error> {
    let Some(status) = status_of(folder) else { return Ok(()) };
    let folder = folder.to_owned();
    match (&status[..], extend) {
        ("interrupted", _) | ("ok" | "did not settle", Some(_)) => Ok(()),
        ("ok" | "did not settle", None) => Err(Error::Ended { folder, status }),
        _ => Err(Error::Failed { folder, status }),
    }
}

/// Refuses a checkpoint that was written by another program, or from other input.
fn check_identity(keeper: &Keeper, checkpoint: &Checkpoint, scene: &Scene) -> Result<(), Error> {
    let changes = keeper.changes(checkpoint);
    if changes.is_empty() {
        return Ok(());
    }
    let message = format!("since the run was begun this has changed: {}", changes.join(", "));
    let help = "undo the change to go on, or run the scene anew with drape run --force, in Python with \
                replace=True";
    let mistake = Diagnostic::new(&scene.source.file, message).help(help);
    Err(Error::Input(mistake.into()))
}
