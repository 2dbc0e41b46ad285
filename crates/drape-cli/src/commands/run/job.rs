//! Job: one run of a scene, from its start or a checkpoint to its pictures.

use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use drape::dynamics::Summary;
use drape::frames::Recording;
use drape::render::Picture;
use drape::run::reports::{VIEWER_SIZE_MAX, ViewerPage};
use drape::run::{EndedRun, FolderRun, RunOptions};
use drape::scene::Scene;

use super::limits::LimitArguments;
use super::report::describe;
use crate::console::note;
use crate::console::progress::RunProgress;
use crate::console::signal;
use crate::failure::Failure;
use crate::pages::picture::{self, SnapshotPictures};
use crate::pages::strain_map::draw_strains;
use crate::remedy;
use crate::say::{say, say_written};
use drape::run::file;

/// After a signal, a picture of the last frame is drawn only within this time.
const PICTURE_MAX: Duration = Duration::from_millis(700);

/// Options of a run that begins or is resumed.
#[derive(Args)]
pub(crate) struct JobArguments {
    /// Draws no picture, no map of strains and no view.
    #[arg(long)]
    pub(crate) no_picture: bool,
    /// Prints the summary as JSON, the summaries of several scenes as a list.
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: LimitArguments,
}

impl JobArguments {
    /// Returns the options of the run. With `replace` the results of an earlier run are replaced.
    pub(crate) fn run_options(&self, replace: bool) -> RunOptions {
        RunOptions {
            limits: self.limits.limits(),
            program: std::env::current_exe().unwrap_or_default(),
            replace,
            give_up: signal::cancel_step_flag(),
        }
    }
}

/// Prepared run with its folder.
pub(crate) struct Job<'a> {
    pub(crate) run: FolderRun,
    pub(crate) folder: &'a Path,
    pub(crate) options: &'a JobArguments,
}

/// View of the picture of the last frame.
struct FinalView {
    /// Azimuth and elevation of the scene, in degrees, if the scene states them.
    view: [Option<f64>; 2],
    is_garment: bool,
}

impl Job<'_> {
    /// Runs the simulation, stores and prints the results, and returns the [`Summary`]. A failed
    /// run has a summary as well.
    pub(crate) fn run(self) -> Result<Summary, Failure> {
        let Self { run, folder, options } = self;
        let scene = run.scene();
        let view = [scene.output.view.azimuth, scene.output.view.elevation];
        let is_garment = scene.sewing.is_some();
        print_notes(scene);

        let mut progress = RunProgress::new(scene);
        let outcome = run.run(&mut progress);
        progress.finish();
        let ended = outcome?;

        let drawn = if options.no_picture {
            Vec::new()
        } else {
            draw(&FinalView { view, is_garment }, &ended, folder)?
        };
        let limit = ended.limit;
        let mut summary = ended.close();
        if let Some(limit) = limit {
            summary.reason = Some(remedy::limit_in_words(limit));
        }
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
struct DrawnFile {
    /// Name of the kind of file, in messages.
    kind: &'static str,
    path: PathBuf,
}

/// Returns the line that names the `folder` of the results and the files in it to open.
fn results(folder: &Path, drawn: &[DrawnFile]) -> String {
    let files: Vec<String> =
        drawn.iter().map(|file| format!("{} {}", file.kind, file.path.display())).collect();
    match files[..] {
        [] => format!("results in {}", folder.display()),
        _ => format!("results in {}: {}", folder.display(), files.join(", ")),
    }
}

/// Stores the viewer page and the pictures of the run in `folder`, and returns the files. An
/// interrupted run has one picture only, so that the program ends soon.
fn draw(
    final_view: &FinalView,
    ended: &EndedRun,
    folder: &Path,
) -> Result<Vec<DrawnFile>, Failure> {
    let EndedRun { summary, last, .. } = ended;
    let FinalView { view, is_garment } = final_view;
    let mut drawn = Vec::new();
    if let Some(since) = signal::time_since_first() {
        if since <= PICTURE_MAX {
            let picture = SnapshotPictures::new(last)?.draw(*view, picture::SIZE)?;
            save(&picture, &folder.join("picture.png"))?;
            drawn.push(DrawnFile { kind: "picture", path: folder.join("picture.png") });
        }
        return Ok(drawn);
    }

    let page = ViewerPage::new(&[Recording::open(folder)?], VIEWER_SIZE_MAX)?;
    file::write(&folder.join("view.html"), page.html)?;

    let pictures = SnapshotPictures::new(last)?;
    let picture = match (is_garment, view) {
        (true, [None, None]) => pictures.draw_garment()?,
        _ => pictures.draw(*view, picture::SIZE)?,
    };
    save(&picture, &folder.join("picture.png"))?;
    drawn.push(DrawnFile { kind: "picture", path: folder.join("picture.png") });
    drawn.push(DrawnFile { kind: "page", path: folder.join("view.html") });

    if let Some(place) = summary.place {
        let detail = picture::detail(last, place);
        let picture = SnapshotPictures::new(&detail)?.draw(*view, picture::SIZE)?;
        save(&picture, &folder.join("place.png"))?;
        drawn.push(DrawnFile { kind: "picture of the seam", path: folder.join("place.png") });
    }
    if *is_garment {
        file::write(&folder.join("strain.svg"), draw_strains(last, &pictures)?)?;
    }
    Ok(drawn)
}

fn save(picture: &Picture, path: &Path) -> Result<(), Failure> {
    Ok(file::write(path, picture.png().map_err(Failure::from_picture)?)?)
}

/// Prints the notes on `scene`, and the limits of contact in it.
fn print_notes(scene: &Scene) {
    let notes = scene.source.notes.iter().chain(&scene.source.contact_limits);
    notes.for_each(|advice| note(advice.in_words(remedy::in_words)));
}
