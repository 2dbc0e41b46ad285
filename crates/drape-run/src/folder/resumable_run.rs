//! Run to resume: an interrupted run continues from its last checkpoint, and a run that has ended
//! continues beyond its end.

use std::path::{Path, PathBuf};

use super::Error;
use super::checkpoint_writer::{CheckpointWriter, SavedRun};
use super::folder_run::{FolderRun, Resumption, prepare_folder};
use super::lock::Lock;
use super::options::RunOptions;
use super::request::RunRequest;
use super::verdict::RunVerdict;
use drape_checkpoint::{Checkpoint, Store};
use drape_input::{Advice, Diagnostic, Remedy};
use drape_scene::Scene;

/// Run in a folder that is to continue.
pub struct ResumableRun {
    /// Request with which the run began.
    pub request: RunRequest,
    folder: PathBuf,
    /// Time to continue beyond the end of the run, in s.
    extend: Option<f64>,
    lock: Lock,
}

impl ResumableRun {
    /// Opens the run in `folder`, to continue to its end, or for `extend` seconds beyond its end.
    ///
    /// # Errors
    /// No run was begun in the folder, another run writes to the folder, or the run cannot
    /// continue.
    pub fn open(folder: &Path, extend: Option<f64>) -> Result<Self, Error> {
        let request = RunRequest::read(folder)?;
        let lock = Lock::take(folder)?;
        refuse_ended(folder, extend)?;
        Ok(Self { request, folder: folder.to_owned(), extend, lock })
    }

    /// Returns the run of `scene`, which was read again, from the last checkpoint, with notes on
    /// checkpoints that are damaged or missing.
    ///
    /// # Errors
    /// The scene or the program has changed since the run was begun, or there is no checkpoint to
    /// extend.
    pub fn go_on(
        self,
        scene: Scene,
        options: &RunOptions,
    ) -> Result<(FolderRun, Vec<String>), Error> {
        let Self { request, folder, extend, lock } = self;
        let writer = CheckpointWriter::new(&folder, &scene, request.checkpoint_every, options);
        let stored = Store::new(&folder).read().map_err(drape_dynamics::Error::from)?;
        let damaged = stored.damaged.iter().map(|damaged| {
            let (path, fault) = (damaged.path.display(), &damaged.fault);
            format!("warning: {path} is damaged: {fault}; an earlier state is used")
        });
        let mut notes: Vec<String> = damaged.collect();

        let resumption = match &stored.newest {
            Some(checkpoint) => {
                check_identity(&writer, checkpoint, &scene)?;
                stored.remove_damaged().map_err(drape_dynamics::Error::from)?;
                Some(Resumption { saved: SavedRun::read(checkpoint)?, extend })
            }
            None if extend.is_some() => return Err(Error::NoCheckpoint { folder }),
            None => {
                check_scene(&request, &scene)?;
                notes.push("note: there is no checkpoint yet; the run begins anew".into());
                None
            }
        };

        if resumption.is_none() {
            prepare_folder(&folder, true)?;
        }
        request.write(&folder)?;
        let (give_up, state_hash) = (options.give_up.clone(), request.state_hash);
        let run = FolderRun { scene, folder, writer, lock, give_up, state_hash, resumption };
        Ok((run, notes))
    }
}

/// Refuses a run that has ended, unless it is to `extend` an end that was set by time.
fn refuse_ended(folder: &Path, extend: Option<f64>) -> Result<(), Error> {
    let Some(RunVerdict { status, .. }) = RunVerdict::read(folder) else { return Ok(()) };
    let folder = folder.to_owned();
    match (&status[..], extend) {
        ("interrupted", _) | ("ok" | "did not settle", Some(_)) => Ok(()),
        ("ok" | "did not settle", None) => Err(Error::Ended { folder, status }),
        _ => Err(Error::Failed { folder, status }),
    }
}

/// Refuses a `scene` that has changed since the run of `request` was begun.
fn check_scene(request: &RunRequest, scene: &Scene) -> Result<(), Error> {
    match &request.scene_hash {
        Some(hash) if *hash != scene.source.hash => {
            Err(changed(scene, "the scene, or a file that it names"))
        }
        _ => Ok(()),
    }
}

/// Returns the error that `what` has changed since the run of `scene` was begun.
fn changed(scene: &Scene, what: &str) -> Error {
    let message = format!("since the run was begun this has changed: {what}");
    let help = Advice::from("undo the change to go on").with(Remedy::RunAnew);
    Error::Input(Diagnostic::new(&scene.source.file, message).help(help).into())
}

/// Refuses a `checkpoint` that was written by another program, or from another input.
fn check_identity(
    writer: &CheckpointWriter,
    checkpoint: &Checkpoint,
    scene: &Scene,
) -> Result<(), Error> {
    let changes = writer.changes(checkpoint);
    if changes.is_empty() { Ok(()) } else { Err(changed(scene, &changes.join(", "))) }
}
