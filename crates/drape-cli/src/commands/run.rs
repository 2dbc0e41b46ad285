//! `drape run`: simulates a scene and stores its frames, a picture and `summary.json`.
//!
//! The scene is read and checked. [`job`] records frames and checkpoints during the run, and
//! [`report`] describes the summary. A scene that starts with intersecting surfaces is refused, and
//! the intersecting triangles are written to a file.

pub(crate) mod job;
mod limits;
pub(crate) mod report;
pub(crate) mod resume;

use std::path::{Path, PathBuf};

use clap::Args;
use drape::dynamics::Summary;
use drape::input::{AllowedFolders, Setting};
use drape::run::{FolderRun, RunRequest, end_at};
use drape::scene::Error;
use serde_json::json;

use self::job::{Job, JobArguments};
use self::report::outcome;
use crate::commands::check::proposal;
use crate::console::signal;
use crate::failure::Failure;
use crate::input;
use crate::remedy;
use crate::say::{say, say_json};
use drape::run::file::{self, FileKind};

#[derive(Args)]
pub(crate) struct RunArguments {
    /// Scenes, TOML files; they are run one after the other, and one that fails does not stop the
    /// rest. - stands for standard input, whose paths are seen from the current folder.
    #[arg(required = true, value_name = "SCENE")]
    pub(crate) scenes: Vec<PathBuf>,
    /// Folder for the results, of several scenes with a folder for each [default: the folder that
    /// the scene names, or out/NAME].
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Ends the simulation at this time, in seconds.
    #[arg(long, value_name = "SECONDS")]
    pub(crate) until: Option<f64>,
    /// Sets a key of the scene in place of its value there, such as time.end=2.0 or
    /// panel.0.rectangle=[1.0, 0.5]; may be given several times. The key is a path of names and
    /// numbers, the value one of TOML: texts stand in quotes.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<Setting>,
    /// Replaces the results of an earlier run.
    #[arg(long)]
    pub(crate) force: bool,
    /// Time between two checkpoints, in seconds; there is one at the end of each phase, too.
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, value_parser = seconds)]
    pub(crate) checkpoint_every: f64,
    /// Hashes positions and velocities after each step, for `step_hashes` in `summary.json`.
    #[arg(long)]
    pub(crate) state_hash: bool,
    /// Proposes no other place for a garment that is not about its body. Without it a place is
    /// looked for, and tried by a sewing at 30 mm of at most 10 s before it is printed.
    #[arg(long)]
    pub(crate) quick: bool,
    #[command(flatten)]
    pub(crate) options: JobArguments,
}

/// Run that has ended, with the folder of its results.
struct StoredRun {
    summary: Summary,
    folder: PathBuf,
}

/// Parses a time in seconds that is not negative.
fn seconds(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "no number".to_owned())?;
    let is_time = (0.0..=1e9).contains(&number);
    if is_time { Ok(number) } else { Err("not a time from 0 to 1e9 s".into()) }
}

/// Executes `drape run`.
pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    signal::watch();
    input::set_values(&arguments.set);
    if let [scene] = &arguments.scenes[..] {
        let StoredRun { summary, folder } = run_scene(scene, arguments)?;
        if arguments.options.json {
            say_json(&summary)?;
        }
        return outcome(summary, &folder);
    }

    // With several scenes a failure does not stop the rest, and the first failure gives the exit
    // code.
    let mut summaries = Vec::new();
    let mut code = None;
    for scene in &arguments.scenes {
        if !arguments.options.json {
            say(format_args!("{}:", input::message_path(scene).display()))?;
        }
        let ended = run_scene(scene, arguments).and_then(|StoredRun { summary, folder }| {
            summaries.push(json!({ "scene": input::message_path(scene), "summary": summary }));
            outcome(summary, &folder)
        });
        if let Err(failure) = ended {
            failure.print();
            let first = *code.get_or_insert(failure.code());
            if let Failure::Interrupted { signal, .. } = failure {
                code = Some(if first > 128 { first } else { 128 + signal });
                break;
            }
        }
    }

    if arguments.options.json {
        say_json(&summaries)?;
    }
    code.map_or(Ok(()), |code| Err(Failure::Several { code }))
}

/// Runs the scene at `path`, stores the results and prints a summary. A failed run has a summary as
/// well.
fn run_scene(path: &Path, arguments: &RunArguments) -> Result<StoredRun, Failure> {
    let result = drape::run::scene_of(&input::document_of_kind(path, &[FileKind::Scene])?);
    let mut scene = result.map_err(|error| refuse(error, path, arguments))?;
    if let Some(end) = arguments.until {
        end_at(&mut scene, end)?;
    }

    let folder = folder(path, arguments, scene.output.folder.as_ref());
    check_location(&folder, path, arguments)?;
    let request = RunRequest {
        state_hash: arguments.state_hash,
        set: arguments.set.iter().map(Setting::to_string).collect(),
        ..RunRequest::new(path, arguments.until, arguments.checkpoint_every)
    };
    let options = &arguments.options;
    let run = FolderRun::begin(scene, &folder, &request, &options.run_options(arguments.force))?;
    Ok(StoredRun { summary: Job { run, folder: &folder, options }.run()?, folder })
}

/// Returns the folder for the results of `scene`. `scene_folder` is the folder that the scene
/// itself names.
fn folder(scene: &Path, arguments: &RunArguments, scene_folder: Option<&PathBuf>) -> PathBuf {
    let name = input::path_for_results(scene).file_stem().unwrap_or_default();
    match (&arguments.output, &arguments.scenes[..]) {
        (Some(folder), [_]) => folder.clone(),
        (Some(folder), _) => folder.join(name),
        (None, _) => scene_folder.cloned().unwrap_or_else(|| PathBuf::from("out").join(name)),
    }
}

/// Refuses a `path` for results that the user did not name on the command line and that a link
/// moves outside the allowed folders.
fn check_location(path: &Path, scene: &Path, arguments: &RunArguments) -> Result<(), Failure> {
    if arguments.output.is_some() {
        return Ok(());
    }
    let folders =
        AllowedFolders::new(scene.parent().unwrap_or(Path::new("")), &input::access().allowed);
    folders.check(path).map_err(|misplaced| {
        let (path, help) = (path.display(), misplaced.help().in_words(remedy::in_words));
        Failure::Usage(format!("{path}: {misplaced}; {help}, or name a folder with -o"))
    })
}

/// Returns the failure for the `error` of a scene that cannot be run. Triangles that intersect at
/// the start are written to a file beside the folder of the results.
fn refuse(error: Error, scene: &Path, arguments: &RunArguments) -> Failure {
    let mut tangle = match error {
        Error::Tangled(tangle) => tangle,
        Error::Input(mistakes) => {
            return Failure::Input(proposal::with_trials(scene, mistakes, arguments.quick));
        }
        error => return error.into(),
    };

    let folder = folder(scene, arguments, tangle.folder.as_ref());
    let mut name = folder.file_name().unwrap_or_default().to_owned();
    name.push("-start.ply");
    let path = folder.with_file_name(name);
    let mut content = Vec::new();
    let encoded = tangle.write_ply(&mut content).map_err(|error| error.to_string());
    let written = encoded.and_then(|()| {
        check_location(&path, scene, arguments)
            .and_then(|()| Ok(file::write(&path, content)?))
            .map_err(|failure| failure.to_string())
    });

    let help = match (written, tangle.overlaps.len()) {
        (Ok(()), count) if count < tangle.total => {
            format!(
                "the triangles of the first {count} of {} pairs are in {}",
                tangle.total,
                path.display()
            )
        }
        (Ok(()), _) => format!("the triangles are in {}", path.display()),
        (Err(reason), _) => reason,
    };
    tangle.add_help(&help);
    Failure::Input(tangle.mistakes)
}
