//! Scene at its start: its panels about the body, with the seams that are to close, as a drawing.
//!
//! Of a scene with mistakes, what is wrong is drawn in red: in space where the scene could be made, else
//! on the flat panels of its pattern.

use std::path::{Path, PathBuf};

use drape::dynamics::Simulation;
use drape::input::{Diagnostic, Diagnostics, Document, Subject};
use drape::scene::{Error, Panel, Refused, Scene};

use super::describe;
use super::pattern;
use crate::console::print_message;
use crate::failure::Failure;
use crate::input;
use crate::pages::start::{StartPicture, Wrong};
use drape::run::file;

/// Reads a scene, draws it as it starts, and describes it; or returns its mistakes, which are drawn.
pub(crate) fn draw(path: &Path, figure: &Path) -> Result<Result<String, Diagnostics>, Failure> {
    let document = match input::document(path) {
        Ok(document) => document,
        Err(mistakes) => return Ok(Err(mistakes)),
    };
    match drape::run::scene_or_refused(&document) {
        Ok(scene) => {
            let text = describe::scene(&scene);
            draw_scene(scene, Wrong::default(), figure)?;
            Ok(Ok(text))
        }
        Err(refused) => {
            let Refused { error, scene } = *refused;
            let (mistakes, triangles) = match error {
                Error::Input(mistakes) => (mistakes, Vec::new()),
                Error::Tangled(tangle) => {
                    let corners = tangle.overlaps.iter().flat_map(|overlap| overlap.corners);
                    let corners = corners.collect();
                    (tangle.mistakes, corners)
                }
                other => {
                    (Diagnostic::new(input::message_path(path), other.to_string()).into(), Vec::new())
                }
            };
            match scene {
                Some(scene) => {
                    let wrong = wrong(&scene, &mistakes, triangles);
                    // What cannot be drawn takes nothing from the mistakes.
                    let drawn = draw_scene(*scene, wrong, figure);
                    drawn.unwrap_or_else(|failure| print_message(format_args!("no figure: {failure}")));
                }
                None => draw_patterns(&document, &mistakes, figure)?,
            }
            Ok(Err(mistakes))
        }
    }
}

/// Draws a scene at its start, with what is wrong in red.
fn draw_scene(scene: Scene, wrong: Wrong, figure: &Path) -> Result<(), Failure> {
    let seams = scene.sewing.as_ref().map_or_else(Vec::new, |sewing| sewing.seams.clone());
    let snapshot = Simulation::new(scene)?.snapshot();
    let picture = StartPicture { snapshot: &snapshot, seams: &seams, wrong: &wrong };
    match is_png(figure) {
        true => file::write(figure, picture.draw()?.png().map_err(Failure::from_picture)?)?,
        false => file::write(figure, picture.svg()?)?,
    }
    Ok(())
}

fn is_png(figure: &Path) -> bool {
    figure.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"))
}

/// Returns what mistakes find wrong in a scene: seams, edges and panels by their names, and triangles
/// that cross, by their corners in m.
fn wrong(scene: &Scene, mistakes: &Diagnostics, triangles: Vec<[[f64; 3]; 3]>) -> Wrong {
    let mut wrong = Wrong { triangles, ..Wrong::default() };
    let is_of = |panel: &Panel, name: &str| {
        panel.name == name || panel.name.rsplit_once('.').is_some_and(|(_, own)| own == name)
    };
    for subject in mistakes.0.iter().filter_map(|mistake| mistake.subject.as_ref()) {
        match subject {
            Subject::Seam(name) => wrong.seams.push(name.clone()),
            Subject::Panel(name) => {
                let panels = scene.panels.iter().filter(|panel| is_of(panel, name));
                wrong.sides.extend(panels.flat_map(|panel| rim(scene, panel)));
            }
            Subject::Edge { panel: name, edge } => {
                let panels = scene.panels.iter().filter(|panel| is_of(panel, name));
                for (panel, own) in
                    panels.flat_map(|panel| panel.edges.iter().map(move |own| (panel, own)))
                {
                    if own.name == *edge {
                        let first = panel.first as u32;
                        let sides = own.nodes.windows(2);
                        wrong.sides.extend(sides.map(|two| [first + two[0], first + two[1]]));
                    }
                }
            }
            _ => {}
        }
    }
    wrong
}

/// Returns the sides of a panel's triangles that belong to one of them only.
fn rim(scene: &Scene, panel: &Panel) -> Vec<[u32; 2]> {
    let particles = panel.particles();
    let own = scene.cloth.triangles().iter();
    let own = own.filter(|triangle| particles.contains(&(triangle[0] as usize)));
    let mut sides: Vec<[u32; 2]> = own
        .flat_map(|triangle| [0, 1, 2].map(|k| [triangle[k], triangle[(k + 1) % 3]]))
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    sides.sort_unstable();
    let alone = sides.chunk_by(|a, b| a == b).filter(|same| same.len() == 1);
    alone.map(|same| same[0]).collect()
}

/// Draws the patterns of a scene that could not be made, flat, with what is wrong in red.
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
    let drawn = garments.unwrap_or_default().iter().find_map(|garment| {
        let path = document.beside(&garment.pattern).ok()?;
        pattern::Refused::new(&path, mistakes.clone()).figure
    });
    write_flat(figure, drawn)
}

/// Writes the drawing of flat panels, which is SVG, or says that there is none.
pub(crate) fn write_flat(figure: &Path, drawn: Option<String>) -> Result<(), Failure> {
    let Some(drawn) = drawn else {
        print_message("no figure: there is no outline that can be drawn");
        return Ok(());
    };
    let mut to = PathBuf::from(figure);
    if is_png(figure) {
        to.set_extension("svg");
        print_message(format_args!("the panels of the pattern are drawn flat, as {}", to.display()));
    }
    Ok(file::write(&to, drawn)?)
}
