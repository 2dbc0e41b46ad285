//! `drape run`: simulates a scene and stores its frames, a picture and `summary.json`.
//!
//! The scene is read and checked, its simulation records frames as it goes, and [`report`] puts the
//! summary into words. A scene that starts with intersecting surfaces is refused, with a file of
//! the triangles.

mod report;
pub(crate) mod space;

use std::path::{Path, PathBuf};

use clap::Args;
use drape::dynamics::{Simulation, Snapshot, Summary, prepare_folder};
use drape::export::write_obj;
use drape::frames::Recording;
use drape::input::Places;
use drape::report::Picture;
use drape::scene::{Error, Scene};
use serde_json::json;

use self::report::{describe, outcome};
use crate::console::note;
use crate::failure::Failure;
use crate::pages::picture::{self, Pictures};
use crate::pages::strain_map::draw_strains;
use crate::pages::viewer::{self, ViewerPage};
use crate::progress::RunProgress;
use crate::say::{say, say_json, say_written};
use crate::{file, input, signal};

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
    /// Replaces the results of an earlier run.
    #[arg(long)]
    pub(crate) force: bool,
    /// Draws no picture, no map of strains and no view.
    #[arg(long)]
    pub(crate) no_picture: bool,
    /// Prints the summary as JSON, those of several scenes as a list.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Executes `drape run`.
pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    signal::watch();
    if let [scene] = &arguments.scenes[..] {
        let summary = run_scene(scene, arguments)?;
        if arguments.json {
            say_json(&summary)?;
        }
        return outcome(summary);
    }
    let mut summaries = Vec::new();
    let mut code = None;
    for scene in &arguments.scenes {
        if !arguments.json {
            say(format_args!("{}:", input::shown(scene).display()))?;
        }
        let ended = run_scene(scene, arguments).and_then(|summary| {
            summaries.push(json!({ "scene": input::shown(scene), "summary": summary }));
            outcome(summary)
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
    if arguments.json {
        say_json(&summaries)?;
    }
    code.map_or(Ok(()), |code| Err(Failure::Several { code }))
}

/// Runs one scene, stores its results and says what came out; a run that fails has a summary too.
fn run_scene(path: &Path, arguments: &RunArguments) -> Result<Summary, Failure> {
    let read = drape::scene_of(&input::document(path)?);
    let mut scene = read.map_err(|error| refuse(error, path, arguments))?;
    if let Some(end) = arguments.until {
        if !(end >= scene.schedule.clock.step) {
            let step = scene.schedule.clock.step;
            return Err(Failure::Usage(format!("--until {end}: a step takes {step} s already")));
        }
        scene.schedule.clock.end = end;
    }
    let folder = folder(path, arguments, scene.output.folder.as_ref());
    check_place(&folder, path, arguments)?;
    space::check(&scene, path, &folder)?;
    let output = prepare_folder(&folder, arguments.force)?;
    let view = [scene.output.view.azimuth, scene.output.view.elevation];
    let garment = scene.sewing.is_some();
    notes(&scene);
    let (name, step) = (scene.name.clone(), scene.schedule.clock.step);
    let mut simulation = Simulation::new(scene)?;
    let recorder = output.record(&simulation.topology())?;
    let mut progress = RunProgress::new(&name, &simulation, step, recorder);
    let summary = simulation.run(&mut progress);
    progress.finish();
    let summary = summary?;
    output.summary(&summary)?;
    let last = progress.last.take().filter(|_| !arguments.no_picture);
    let shown = last.map(|frame| Snapshot { positions: frame.positions, ..simulation.snapshot() });
    // Its memory is free for the page and the pictures.
    drop(simulation);
    let recording = Recording::open(&folder)?;
    save_last(&recording)?;
    if !arguments.no_picture {
        let page = ViewerPage::new(&[recording], viewer::SIZE_MAX)?;
        file::write(&output.path("view.html"), page.html)?;
    }
    if let Some(shown) = shown {
        let pictures = Pictures::new(&shown)?;
        let picture = match (garment, view) {
            (true, [None, None]) => pictures.draw_round()?,
            _ => pictures.draw(view, picture::SIZE)?,
        };
        save(&picture, &output.path("picture.png"))?;
        if let Some(place) = summary.place {
            let near = picture::near(&shown, place);
            let picture = Pictures::new(&near)?.draw(view, picture::SIZE)?;
            save(&picture, &output.path("place.png"))?;
        }
        if garment {
            file::write(&output.path("strain.svg"), draw_strains(&shown, &pictures)?)?;
        }
    }
    if !arguments.json {
        say(describe(&summary))?;
        for warning in &summary.warnings {
            say(format_args!("warning: {warning}"))?;
        }
        say_written(format_args!("results in {}", folder.display()))?;
    }
    Ok(summary)
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

/// Returns the folder for the results of a scene.
fn folder(scene: &Path, arguments: &RunArguments, of_scene: Option<&PathBuf>) -> PathBuf {
    let name = input::named(scene).file_stem().unwrap_or_default();
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
    let places = Places::new(scene.parent().unwrap_or(Path::new("")), input::allowed());
    places.check(place).map_err(|misplaced| {
        let (place, help) = (place.display(), misplaced.help());
        Failure::Usage(format!("{place}: {misplaced}; {help}, or name a folder with -o"))
    })
}

/// Returns the failure for a scene that is refused. Triangles that intersect at the start are
/// written to a file beside the folder that the results would have.
fn refuse(error: Error, scene: &Path, arguments: &RunArguments) -> Failure {
    let Error::Tangled(mut tangle) = error else { return error.into() };
    let folder = folder(scene, arguments, tangle.folder.as_ref());
    let mut name = folder.file_name().unwrap_or_default().to_owned();
    name.push("-start.ply");
    let path = folder.with_file_name(name);
    let mut content = Vec::new();
    let written = tangle.write_ply(&mut content).map_err(|error| error.to_string());
    let written = written.and_then(|()| {
        let checked = check_place(&path, scene, arguments);
        let written = checked.and_then(|()| file::write(&path, content));
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
