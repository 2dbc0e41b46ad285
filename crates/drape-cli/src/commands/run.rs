//! `drape run`: simulates a scene and stores its frames, a picture and `summary.json`.
//!
//! The scene is read and checked; [`job`] records frames and checkpoints as it goes, and [`report`]
//! puts the summary into words. A scene that starts with intersecting surfaces is refused, with a file of
//! the triangles.

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
    /// Proposes no other place for a garment that is not about its body. Without it a place is looked for,
    /// and tried by a sewing at 30 mm of at most 10 s before it is printed.
    #[arg(long)]
    pub(crate) quick: bool,
    #[command(flatten)]
    pub(crate) options: JobArguments,
}

/// Run that has ended.
struct Ran {
    summary: Summary,
    folder: PathBuf,
}

/// Reads a time that is not negative.
fn seconds(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "no number".to_owned())?;
    let is_right = (0.0..=1e9).contains(&number);
    if is_right { Ok(number) } else { Err("not a time from 0 to 1e9 s".into()) }
}

/// Executes `drape run`.
pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    signal::watch();
    input::set_values(&arguments.set);
    if let [scene] = &arguments.scenes[..] {
        let Ran { summary, folder } = run_scene(scene, arguments)?;
        if arguments.options.json {
            say_json(&summary)?;
        }
        return outcome(summary, &folder);
    }
    let mut summaries = Vec::new();
    let mut code = None;
    for scene in &arguments.scenes {
        if !arguments.options.json {
            say(format_args!("{}:", input::message_path(scene).display()))?;
        }
        let ended = run_scene(scene, arguments).and_then(|Ran { summary, folder }| {
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

/// Runs one scene, stores its results and says what came out; a run that fails has a summary too.
fn run_scene(path: &Path, arguments: &RunArguments) -> Result<Ran, Failure> {
    let read = drape::run::scene_of(&input::document_of_kind(path, &[FileKind::Scene])?);
    let mut scene = read.map_err(|error| refuse(error, path, arguments))?;
    if let Some(end) = arguments.until {
        end_at(&mut scene, end)?;
    }
    let folder = folder(path, arguments, scene.output.folder.as_ref());
    check_place(&folder, path, arguments)?;
    let request = RunRequest {
        state_hash: arguments.state_hash,
        set: arguments.set.iter().map(Setting::to_string).collect(),
        ..RunRequest::new(path, arguments.until, arguments.checkpoint_every)
    };
    let options = &arguments.options;
    let run = FolderRun::begin(scene, &folder, &request, &options.run_options(arguments.force))?;
    Ok(Ran { summary: Job { run, folder: &folder, options }.run()?, folder })
}

/// Returns the folder for the results of a scene.
fn folder(scene: &Path, arguments: &RunArguments, of_scene: Option<&PathBuf>) -> PathBuf {
    let name = input::result_path(scene).file_stem().unwrap_or_default();
    match (&arguments.output, &arguments.scenes[..]) {
        (Some(folder), [_]) => folder.clone(),
        (Some(folder), _) => folder.join(name),
        (None, _) => of_scene.cloned().unwrap_or_else(|| PathBuf::from("out").join(name)),
    }
}

/// Refuses a place that the user did not name and that a link takes elsewhere.
fn check_place(place: &Path, scene: &Path, arguments: &RunArguments) -> Result<(), Failure> {
    if arguments.output.is_some() {
        return Ok(());
    }
    let places = AllowedFolders::new(scene.parent().unwrap_or(Path::new("")), input::allowed());
    places.check(place).map_err(|misplaced| {
        let (place, help) = (place.display(), misplaced.help());
        Failure::Usage(format!("{place}: {misplaced}; {help}, or name a folder with -o"))
    })
}

/// Returns the failure for a scene that is refused. Triangles that intersect at the start are
/// written to a file beside the folder that the results would have.
fn refuse(error: Error, scene: &Path, arguments: &RunArguments) -> Failure {
    let mut tangle = match error {
        Error::Tangled(tangle) => tangle,
        Error::Input(mistakes) => {
            return Failure::Input(proposal::tried(scene, mistakes, arguments.quick));
        }
        other => return other.into(),
    };
    let folder = folder(scene, arguments, tangle.folder.as_ref());
    let mut name = folder.file_name().unwrap_or_default().to_owned();
    name.push("-start.ply");
    let path = folder.with_file_name(name);
    let mut content = Vec::new();
    let written = tangle.write_ply(&mut content).map_err(|error| error.to_string());
    let written = written.and_then(|()| {
        let checked = check_place(&path, scene, arguments);
        let written = checked.and_then(|()| Ok(file::write(&path, content)?));
        written.map_err(|failure| failure.to_string())
    });
    let told = match (written, tangle.overlaps.len()) {
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
    tangle.add_help(&told);
    Failure::Input(tangle.mistakes)
}
