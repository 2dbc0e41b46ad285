//! `drape resume`: goes on with a run that was interrupted, from its last checkpoint, or with one
//! that has ended, beyond its end.

use std::path::{Path, PathBuf};

use clap::Args;
use drape::checkpoint::{Checkpoint, Store};
use drape::dynamics::{Output, prepare_folder};
use drape::input::Diagnostic;
use drape::scene::Scene;

use crate::commands::run::job::{Job, Resumption, RunOptions};
use crate::commands::run::report::outcome;
use crate::console::tell;
use crate::failure::Failure;
use crate::input;
use crate::keep::{Keeper, Kept, Lock, RunRequest, positive, signal, status_of};
use crate::say::say_json;

#[derive(Args)]
pub(crate) struct ResumeArguments {
    /// Folder of the run.
    #[arg(value_name = "RUN")]
    run: PathBuf,
    /// Scene of the run, if it has another place now; - stands for standard input.
    #[arg(long, value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// Goes on for so many seconds beyond the end of the run.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    extend: Option<f64>,
    #[command(flatten)]
    options: RunOptions,
}

/// Executes `drape resume`.
pub(crate) fn resume(arguments: &ResumeArguments) -> Result<(), Failure> {
    signal::watch();
    let ResumeArguments { run: folder, extend, options, .. } = arguments;
    let mut request = RunRequest::read(folder)?;
    let lock = Lock::take(folder)?;
    refuse_ended(folder, *extend)?;
    let path = arguments.scene.clone().unwrap_or_else(|| request.scene.clone());
    if input::is_standard(&path) && arguments.scene.is_none() {
        return Err(Failure::Usage(
            "the scene was read from standard input: pipe it again, with --scene -".into(),
        ));
    }
    input::set(&request.settings()?);
    let mut scene = drape::scene_of(&input::document(&path)?)?;
    if let Some(end) = request.until {
        scene.schedule.clock.end = end;
    }
    let keeper = Keeper::new(folder, &scene, request.checkpoint_every, options.limits.clone());
    let found = Store::new(folder).read().map_err(drape::dynamics::Error::from)?;
    for damaged in &found.damaged {
        let (path, fault) = (damaged.path.display(), &damaged.fault);
        tell(format_args!("warning: {path} is damaged: {fault}; an earlier state is used"));
    }
    let resumption = match &found.newest {
        Some(checkpoint) => {
            check_identity(&keeper, checkpoint, &scene)?;
            found.remove_damaged().map_err(drape::dynamics::Error::from)?;
            Some(Resumption { kept: Kept::read(checkpoint)?, extend: *extend })
        }
        None if extend.is_some() => {
            let message = format!("{}: no checkpoint is left to extend", folder.display());
            return Err(Failure::Usage(message));
        }
        None => {
            tell("note: there is no checkpoint yet; the run begins anew");
            None
        }
    };
    let output = match &resumption {
        Some(_) => Output::of_run(folder),
        None => prepare_folder(folder, true)?,
    };
    if arguments.scene.is_some() {
        request.move_scene(&path);
    }
    request.write(folder)?;
    let state_hash = request.state_hash;
    let job = Job { scene, folder: folder.clone(), output, keeper, lock, options, state_hash };
    let summary = job.run(resumption)?;
    if options.json {
        say_json(&summary)?;
    }
    outcome(summary, folder)
}

/// Refuses a run that has ended, unless it is to go on beyond an end that time gave it.
fn refuse_ended(folder: &Path, extend: Option<f64>) -> Result<(), Failure> {
    let Some(status) = status_of(folder) else { return Ok(()) };
    let place = folder.display();
    let message = match (&status[..], extend) {
        ("interrupted", _) | ("ok" | "did not settle", Some(_)) => return Ok(()),
        ("ok" | "did not settle", None) => format!(
            "{place}: the run has ended ({status}); go on beyond its end with --extend SECONDS"
        ),
        _ => format!(
            "{place}: the run has ended ({status}); it would end so again: change its scene, and \
             run it anew with drape run --force"
        ),
    };
    Err(Failure::Usage(message))
}

/// Refuses a checkpoint that was written by another program, or from other input.
fn check_identity(keeper: &Keeper, checkpoint: &Checkpoint, scene: &Scene) -> Result<(), Failure> {
    let changes = keeper.changes(checkpoint);
    if changes.is_empty() {
        return Ok(());
    }
    let message = format!("since the run was begun this has changed: {}", changes.join(", "));
    let help = "undo the change to go on, or run the scene anew with drape run --force";
    Err(Failure::Input(Diagnostic::new(&scene.source.file, message).help(help).into()))
}
