//! Scene at its start: the panels around the body, with the seams that are to close, as a drawing.
//!
//! If the scene has mistakes, the faults are drawn in red: in space if the scene could be built,
//! and otherwise on the flat panels of its pattern.

use std::path::{Path, PathBuf};

use drape::dynamics::Simulation;
use drape::input::{Diagnostic, Diagnostics, Document, Subject};
use drape::scene::{Error, Panel, Refused, Scene};

use super::describe;
use super::pattern;
use crate::console::print_message;
use crate::failure::Failure;
use crate::input;
use crate::pages::start::{StartFaults, StartPicture};
use drape::run::file;

/// Result of a scene that was checked and drawn.
pub(crate) enum Drawn {
    /// The scene has no mistakes; `text` describes it.
    Sound { text: String },
    /// The scene has mistakes.
    Refused { mistakes: Diagnostics },
}

/// Reads the scene at `path`, draws its start into the file `figure`, and describes it. If the
/// scene has mistakes, the figure shows their positions.
pub(crate) fn draw(path: &Path, figure: &Path) -> Result<Drawn, Failure> {
    let document = match input::document(path) {
        Ok(document) => document,
        Err(mistakes) => return Ok(Drawn::Refused { mistakes }),
    };
    let refused = match drape::run::scene_or_refused(&document) {
        Ok(scene) => {
            let text = describe::scene(&scene);
            draw_scene(scene, StartFaults::default(), figure)?;
            return Ok(Drawn::Sound { text });
        }
        Err(refused) => refused,
    };

    let Refused { error, scene } = *refused;
    let (mistakes, triangles) = match error {
        Error::Input(mistakes) => (mistakes, Vec::new()),
        Error::Tangled(tangle) => {
            let corners = tangle.overlaps.iter().flat_map(|overlap| overlap.corners).collect();
            (tangle.mistakes, corners)
        }
        error => {
            let mistake = Diagnostic::new(input::message_path(path), error.to_string());
            (mistake.into(), Vec::new())
        }
    };
    match scene {
        Some(scene) => {
            let faults = start_faults(&scene, &mistakes, triangles);
            // The mistakes are reported even if the figure cannot be drawn.
            draw_scene(*scene, faults, figure)
                .unwrap_or_else(|failure| print_message(format_args!("no figure: {failure}")));
        }
        None => draw_patterns(&document, &mistakes, figure)?,
    }
    Ok(Drawn::Refused { mistakes })
}

/// Draws `scene` at its start into the file `figure`, with its `faults` in red.
fn draw_scene(scene: Scene, faults: StartFaults, figure: &Path) -> Result<(), Failure> {
    let seams = scene.sewing.as_ref().map_or_else(Vec::new, |sewing| sewing.seams.clone());
    let snapshot = Simulation::new(scene)?.snapshot();
    let picture = StartPicture { snapshot: &snapshot, seams: &seams, faults: &faults };
    if is_png(figure) {
        file::write(figure, picture.draw()?.png().map_err(Failure::from_picture)?)?;
    } else {
        file::write(figure, picture.svg()?)?;
    }
    Ok(())
}

fn is_png(figure: &Path) -> bool {
    figure.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"))
}

/// Returns the faults that `mistakes` name in `scene`: seams, edges and panels. `triangles` are the
/// corners of crossing triangles, in m.
fn start_faults(
    scene: &Scene,
    mistakes: &Diagnostics,
    triangles: Vec<[[f64; 3]; 3]>,
) -> StartFaults {
    let mut faults = StartFaults { triangles, ..StartFaults::default() };
    for subject in mistakes.0.iter().filter_map(|mistake| mistake.subject.as_ref()) {
        match subject {
            Subject::Seam(name) => faults.seams.push(name.clone()),
            Subject::Panel(name) => {
                let panels = scene.panels.iter().filter(|panel| is_called(panel, name));
                faults.sides.extend(panels.flat_map(|panel| rim(scene, panel)));
            }
            Subject::Edge { panel: name, edge: edge_name } => {
                for panel in scene.panels.iter().filter(|panel| is_called(panel, name)) {
                    let first = panel.first as u32;
                    for edge in panel.edges.iter().filter(|edge| edge.name == *edge_name) {
                        let sides = edge.nodes.windows(2);
                        faults.sides.extend(sides.map(|pair| [first + pair[0], first + pair[1]]));
                    }
                }
            }
            _ => {}
        }
    }
    faults
}

/// Returns whether `panel` has this name, alone or after the name of its garment and a dot.
fn is_called(panel: &Panel, name: &str) -> bool {
    panel.name == name || panel.name.rsplit_once('.').is_some_and(|(_, short)| short == name)
}

/// Returns the boundary of `panel`: the sides that belong to one triangle only, as pairs of
/// particles.
fn rim(scene: &Scene, panel: &Panel) -> Vec<[u32; 2]> {
    let particles = panel.particles();
    let mut sides: Vec<[u32; 2]> = scene
        .cloth
        .triangles()
        .iter()
        .filter(|triangle| particles.contains(&(triangle[0] as usize)))
        .flat_map(|triangle| [0, 1, 2].map(|k| [triangle[k], triangle[(k + 1) % 3]]))
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    sides.sort_unstable();
    let single = sides.chunk_by(|a, b| a == b).filter(|equal| equal.len() == 1);
    single.map(|equal| equal[0]).collect()
}

/// Draws the flat patterns of a scene that could not be built into the file `figure`, with the
/// faults in red.
fn draw_patterns(
    document: &Document,
    mistakes: &Diagnostics,
    figure: &Path,
) -> Result<(), Failure> {
    #[derive(serde::Deserialize)]
    struct File {
        #[serde(default)]
        garment: Vec<Garment>,
    }
    #[derive(serde::Deserialize)]
    struct Garment {
        pattern: String,
    }

    let garments = document.decode_with_faults::<File>().map(|(file, _)| file.garment);
    let drawing = garments.unwrap_or_default().iter().find_map(|garment| {
        let path = document.beside(&garment.pattern).ok()?;
        pattern::RefusedPattern::new(&path, mistakes.clone()).figure
    });
    write_flat(figure, drawing)
}

/// Writes the `drawing` of flat panels, which is SVG, or prints that there is none. The ending of
/// `figure` becomes `svg`.
pub(crate) fn write_flat(figure: &Path, drawing: Option<String>) -> Result<(), Failure> {
    let Some(drawing) = drawing else {
        print_message("no figure: there is no outline that can be drawn");
        return Ok(());
    };
    let mut to = PathBuf::from(figure);
    if is_png(figure) {
        to.set_extension("svg");
        print_message(format_args!(
            "the panels of the pattern are drawn flat, as {}",
            to.display()
        ));
    }
    Ok(file::write(&to, drawing)?)
}
