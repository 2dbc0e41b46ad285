//! Job: one run of a scene, from its start or from a checkpoint to its pictures.

use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use drape::dynamics::Summary;
use drape::frames::Recording;
use drape::report::Picture;
use drape::run::reports::{VIEWER_SIZE_MAX, ViewerPage};
use drape::run::{EndedRun, FolderRun, RunOptions};
use drape::scene::Scene;

use super::limits::LimitArguments;
use super::report::describe;
use crate::console::note;
use crate::console::progress::RunProgress;
use crate::console::signal;
use crate::failure::Failure;
use crate::pages::picture::{self, Pictures};
use crate::pages::strain_map::draw_strains;
use crate::say::{say, say_written};
use drape::run::file;

/// Time after a signal up to which a picture of the last frame is still drawn.
const PICTURE_MAX: Duration = Duration::from_millis(700);

/// Options of a run, whether it begins or goes on.
#[derive(Args)]
pub(crate) struct JobArguments {
    /// Draws no picture, no map of strains and no view.
    #[arg(long)]
    pub(crate) no_picture: bool,
    /// Prints the summary as JSON, those of several scenes as a list.
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: LimitArguments,
}

impl JobArguments {
    /// Returns the options of the run; `replace` allows the results of an earlier run to be replaced.
    pub(crate) fn run_options(&self, replace: bool) -> RunOptions {
        RunOptions {
            limits: self.limits.limits(),
            program: std::env::current_exe().unwrap_or_default(),
            replace,
            give_up: signal::cancel_step_flag(),
        }
    }
}

/// Run that is ready, in a folder that is its own.
pub(crate) struct Job<'a> {
    pub(crate) run: FolderRun,
    pub(crate) folder: &'a Path,
    pub(crate) options: &'a JobArguments,
}

/// How a job draws its end.
struct Shown {
    view: [Option<f64>; 2],
    is_garment: bool,
}

impl Job<'_> {
    /// Runs it, stores its results and says what came out; a run that fails has a summary too.
    pub(crate) fn run(self) -> Result<Summary, Failure> {
        let Self { run, folder, options } = self;
        let scene = run.scene();
        let view = [scene.output.view.azimuth, scene.output.view.elevation];
        let is_garment = scene.sewing.is_some();
        notes(scene);
        let mut progress = RunProgress::new(scene);
        let ended = run.run(&mut progress);
        progress.finish();
        let ended = ended?;
        let drawn = match options.no_picture {
            true => Vec::new(),
            false => draw(&Shown { view, is_garment }, &ended, folder)?,
        };
        let summary = ended.close();
        if !options.json {
            say(describe(&summary))?;
            for warning in &summary.warnings {
                say(format_args!("warning: {warning}"))?;
            }
            say_written(results(folder, &drawn))?;
        }
        Ok(summary)
    }
}

/// File of a run that a person opens.
struct Drawn {
    /// What the file is, in a word or two.
    kind: &'static str,
    path: PathBuf,
}

/// Returns the line that says where the results of a run are, and which files of them to open.
fn results(folder: &Path, drawn: &[Drawn]) -> String {
    let file = |Drawn { kind, path }: &Drawn| format!("{kind} {}", path.display());
    let files: Vec<String> = drawn.iter().map(file).collect();
    match files[..] {
        [] => format!("results in {}", folder.display()),
        _ => format!("results in {}: {}", folder.display(), files.join(", ")),
    }
}

/// Stores the view and the pictures, of an interrupted run those that take no time, and returns their
/// files.
fn draw(shown: &Shown, ended: &EndedRun, folder: &Path) -> Result<Vec<Drawn>, Failure> {
    let EndedRun { summary, output, last, .. } = ended;
    let Shown { view, is_garment } = shown;
    let mut drawn = Vec::new();
    let mut keep = |kind, name: &str| drawn.push(Drawn { kind, path: folder.join(name) });
    if let Some(since) = signal::time_since_first() {
        if since <= PICTURE_MAX {
            let picture = Pictures::new(last)?.draw(*view, picture::SIZE)?;
            save(&picture, &output.path("picture.png"))?;
            keep("picture", "picture.png");
        }
        return Ok(drawn);
    }
    let page = ViewerPage::new(&[Recording::open(folder)?], VIEWER_SIZE_MAX)?;
    file::write(&output.path("view.html"), page.html)?;
    let pictures = Pictures::new(last)?;
    let picture = match (is_garment, view) {
        (true, [None, None]) => pictures.draw_round()?,
        _ => pictures.draw(*view, picture::SIZE)?,
    };
    save(&picture, &output.path("picture.png"))?;
    keep("picture", "picture.png");
    keep("page", "view.html");
    if let Some(place) = summary.place {
        let near = picture::near(last, place);
        let picture = Pictures::new(&near)?.draw(*view, picture::SIZE)?;
        save(&picture, &output.path("place.png"))?;
        keep("picture of the seam", "place.png");
    }
    if *is_garment {
        file::write(&output.path("strain.svg"), draw_strains(last, &pictures)?)?;
    }
    Ok(drawn)
}

fn save(picture: &Picture, path: &Path) -> Result<(), Failure> {
    Ok(file::write(path, picture.png().map_err(Failure::from_picture)?)?)
}

/// Prints the notes on a scene, and what contact cannot promise.
fn notes(scene: &Scene) {
    scene.source.notes.iter().chain(&scene.source.contact_limits).for_each(note);
}
