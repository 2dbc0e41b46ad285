//! `drape run`: simulates a scene and stores its frames, a picture and `summary.json`.
//!
//! The scene is read and checked, its simulation records frames as it goes, and [`report`] puts the
//! summary into words. A scene that starts with intersecting surfaces is refused, with a file of
//! the triangles.

mod report;

use std::path::PathBuf;

use clap::Args;
use drape::dynamics::{Simulation, Snapshot, prepare_folder};
use drape::scene::{Error, Scene};

use self::report::{describe, outcome};
use crate::failure::Failure;
use crate::file;
use crate::pages::picture::{self, Pictures};
use crate::pages::strain_map::draw_strains;
use crate::progress::Screen;
use crate::say::say;

#[derive(Args)]
pub(crate) struct RunArguments {
    /// The scene, a TOML file.
    pub(crate) scene: PathBuf,
    /// Folder for the results [default: the folder that the scene names, or out/NAME].
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Number of threads [default: all].
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<usize>,
    /// Ends the simulation at this time, in seconds.
    #[arg(long, value_name = "SECONDS")]
    pub(crate) until: Option<f64>,
    /// Replaces the results of an earlier run.
    #[arg(long)]
    pub(crate) force: bool,
    /// Prints the summary as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Executes `drape run`.
pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let mut scene =
        drape::read_scene(&arguments.scene).map_err(|error| refuse(error, arguments))?;
    if let Some(end) = arguments.until {
        if !(end >= scene.schedule.clock.step) {
            let step = scene.schedule.clock.step;
            return Err(Failure::Usage(format!("--until {end}: a step takes {step} s already")));
        }
        scene.schedule.clock.end = end;
    }
    let folder = folder(arguments, scene.output.folder.as_ref());
    let output = prepare_folder(&folder, arguments.force || arguments.output.is_none())?;
    let view = [scene.output.view.azimuth, scene.output.view.elevation];
    let garment = scene.sewing.is_some();
    notes(&scene);
    let mut simulation = Simulation::new(scene)?;
    let recorder = output.record(simulation.topology())?;
    let mut screen = Screen::new(simulation.ticks_to_do(), recorder);
    let summary = simulation.run(&mut screen);
    screen.finish();
    let summary = summary?;
    output.summary(&summary)?;
    if let Some(frame) = &screen.last {
        let shown = Snapshot { positions: frame.positions.clone(), ..simulation.snapshot() };
        let pictures = Pictures::new(&shown)?;
        let picture = match (garment, view) {
            (true, [None, None]) => pictures.draw_round()?,
            _ => pictures.draw(view, picture::SIZE)?,
        };
        let stored = picture.save(output.path("picture.png"));
        stored.map_err(|error| Failure::Output(error.to_string()))?;
        if garment {
            file::write(&output.path("strain.svg"), draw_strains(&shown, &pictures)?)?;
        }
    }
    if arguments.json {
        let json = serde_json::to_string_pretty(&summary);
        say(json.expect("a summary always has a JSON form"))?;
    } else {
        say(describe(&summary))?;
        for warning in &summary.warnings {
            say(format_args!("warning: {warning}"))?;
        }
        say(format_args!("results in {}", folder.display()))?;
    }
    outcome(summary)
}

/// Prints the notes on the patterns of a scene.
#[expect(clippy::print_stderr, reason = "messages of the program go to stderr")]
fn notes(scene: &Scene) {
    scene.source.notes.iter().for_each(|note| eprintln!("note: {note}"));
}

/// Returns the folder for the results.
fn folder(arguments: &RunArguments, of_scene: Option<&PathBuf>) -> PathBuf {
    let given = arguments.output.as_ref().or(of_scene);
    given.cloned().unwrap_or_else(|| {
        let name = arguments.scene.file_stem().unwrap_or_default();
        PathBuf::from("out").join(name)
    })
}

/// Returns the failure for a scene that is refused. Triangles that intersect at the start are
/// written to a file beside the folder that the results would have.
fn refuse(error: Error, arguments: &RunArguments) -> Failure {
    let Error::Tangled(mut tangle) = error else { return error.into() };
    let folder = folder(arguments, tangle.folder.as_ref());
    let mut name = folder.file_name().unwrap_or_default().to_owned();
    name.push("-start.ply");
    let path = folder.with_file_name(name);
    let mut content = Vec::new();
    let written = tangle.write_ply(&mut content).map_err(|error| error.to_string());
    let written =
        written.and_then(|()| file::write(&path, content).map_err(|failure| failure.to_string()));
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
