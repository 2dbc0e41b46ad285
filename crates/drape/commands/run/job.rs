//! Job: one run of a scene, from its start or from a checkpoint to its pictures.

use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use drape::dynamics::{Output, Simulation, Snapshot, Status, Summary};
use drape::export::write_obj;
use drape::frames::Recording;
use drape::report::Picture;
use drape::scene::Scene;

use super::report::describe;
use crate::console::note;
use crate::failure::Failure;
use crate::file;
use crate::keep::{Keeper, Kept, Limits, Lock, signal};
use crate::pages::picture::{self, Pictures};
use crate::pages::strain_map::draw_strains;
use crate::pages::viewer::{self, ViewerPage};
use crate::progress::RunProgress;
use crate::say::{say, say_written};

/// Time after a signal up to which a picture of the last frame is still drawn.
const PICTURE_MAX: Duration = Duration::from_millis(700);

/// Options of a run, whether it begins or goes on.
#[derive(Args)]
pub(crate) struct RunOptions {
    /// Draws no picture, no map of strains and no view.
    #[arg(long)]
    pub(crate) no_picture: bool,
    /// Prints the summary as JSON, those of several scenes as a list.
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: Limits,
}

/// Run of a scene that has been read, in a folder that is its own.
pub(crate) struct Job<'a> {
    pub(crate) scene: Scene,
    pub(crate) folder: PathBuf,
    pub(crate) output: Output,
    pub(crate) keeper: Keeper,
    pub(crate) lock: Lock,
    pub(crate) options: &'a RunOptions,
    /// Whether the state is hashed after each step.
    pub(crate) state_hash: bool,
}

/// What a job draws at its end.
struct Shown {
    view: [Option<f64>; 2],
    is_garment: bool,
    /// Last frame, unless no picture is asked for.
    last: Option<Snapshot>,
}

/// Checkpoint from which a job goes on, and by how much it goes on beyond its end, in s.
pub(crate) struct Resumption {
    pub(crate) kept: Kept,
    pub(crate) extend: Option<f64>,
}

impl Job<'_> {
    /// Runs it, stores its results and says what came out; a run that fails has a summary too.
    pub(crate) fn run(self, resumption: Option<Resumption>) -> Result<Summary, Failure> {
        let Self { scene, folder, output, keeper, lock: _lock, options, state_hash } = self;
        let view = [scene.output.view.azimuth, scene.output.view.elevation];
        let is_garment = scene.sewing.is_some();
        notes(&scene);
        let (name, step) = (scene.name.clone(), scene.schedule.clock.step);
        let mut simulation = Simulation::new(scene)?;
        simulation.give_up_when(signal::give_up_flag());
        if state_hash {
            simulation.hash_steps();
        }
        let recorder = match resumption {
            None => output.record(&simulation.topology())?,
            Some(Resumption { kept, extend }) => {
                simulation.resume(kept.simulation)?;
                if extend.is_some_and(|seconds| !simulation.extend(seconds)) {
                    return Err(Failure::Usage(
                        "the cloth is at rest, by which the run is over; there is nothing to extend"
                            .into(),
                    ));
                }
                output.resume(kept.recorder)?
            }
        };
        let mut progress = RunProgress::new((&name, step), &simulation, recorder, keeper);
        let summary = simulation.run(&mut progress);
        progress.finish();
        let mut summary = summary?;
        if let (Status::Interrupted, Some(limit)) = (&summary.status, progress.keeper.reached()) {
            summary.reason = Some(limit.to_owned());
        }
        output.summary(&summary)?;
        let last = progress.last.take().filter(|_| !options.no_picture);
        let last =
            last.map(|frame| Snapshot { positions: frame.positions, ..simulation.snapshot() });
        // Its memory is free for the page and the pictures.
        drop(simulation);
        let shown = Shown { view, is_garment, last };
        draw(&shown, &summary, &output, &folder)?;
        let state = serde_json::to_value(&summary.status).unwrap_or_default();
        progress.keeper.end(state.as_str().unwrap_or("ok"), summary.reason.clone());
        if !options.json {
            say(describe(&summary))?;
            for warning in &summary.warnings {
                say(format_args!("warning: {warning}"))?;
            }
            say_written(format_args!("results in {}", folder.display()))?;
        }
        Ok(summary)
    }
}

/// Stores the last frame, the view and the pictures; of an interrupted run those that take no time.
fn draw(shown: &Shown, summary: &Summary, output: &Output, folder: &Path) -> Result<(), Failure> {
    let recording = Recording::open(folder)?;
    save_last(&recording)?;
    let Shown { view, is_garment, last } = shown;
    let Some(last) = last else { return Ok(()) };
    if let Some(since) = signal::since() {
        if since <= PICTURE_MAX {
            let picture = Pictures::new(last)?.draw(*view, picture::SIZE)?;
            save(&picture, &output.path("picture.png"))?;
        }
        return Ok(());
    }
    let page = ViewerPage::new(&[recording], viewer::SIZE_MAX)?;
    file::write(&output.path("view.html"), page.html)?;
    let pictures = Pictures::new(last)?;
    let picture = match (is_garment, view) {
        (true, [None, None]) => pictures.draw_round()?,
        _ => pictures.draw(*view, picture::SIZE)?,
    };
    save(&picture, &output.path("picture.png"))?;
    if let Some(place) = summary.place {
        let near = picture::near(last, place);
        let picture = Pictures::new(&near)?.draw(*view, picture::SIZE)?;
        save(&picture, &output.path("place.png"))?;
    }
    if *is_garment {
        file::write(&output.path("strain.svg"), draw_strains(last, &pictures)?)?;
    }
    Ok(())
}

/// Saves the last frame as `last.obj`, which any program opens.
fn save_last(recording: &Recording) -> Result<(), Failure> {
    let frame = recording.frame(recording.frames() - 1)?;
    let mut obj = Vec::new();
    write_obj(recording, &frame, &mut obj).map_err(|error| Failure::Output(error.to_string()))?;
    file::write(&recording.folder().join("last.obj"), obj)
}

fn save(picture: &Picture, path: &Path) -> Result<(), Failure> {
    file::write(path, picture.png().map_err(Failure::of_picture)?)
}

/// Prints the notes on a scene, and what contact cannot promise.
fn notes(scene: &Scene) {
    scene.source.notes.iter().chain(&scene.source.contact_limits).for_each(note);
}
