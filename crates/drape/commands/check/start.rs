//! Scene at its start: its panels about the body, with the seams that are to close, as a drawing.

use std::path::Path;

use drape::dynamics::Simulation;
use drape::input::Diagnostics;

use super::describe;
use crate::failure::Failure;
use crate::pages::start::{draw_start, start_svg};
use drape::file;

/// Reads a scene, draws it as it starts, and describes it; or returns its mistakes.
pub(crate) fn draw(path: &Path, figure: &Path) -> Result<Result<String, Diagnostics>, Failure> {
    let scene = match describe::read_scene(path) {
        Ok(scene) => scene,
        Err(mistakes) => return Ok(Err(mistakes)),
    };
    let text = describe::scene(&scene);
    let seams = scene.sewing.as_ref().map_or_else(Vec::new, |sewing| sewing.seams.clone());
    let snapshot = Simulation::new(scene)?.snapshot();
    match figure.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png")) {
        true => {
            let picture = draw_start(&snapshot, &seams)?;
            file::write(figure, picture.png().map_err(Failure::of_picture)?)?;
        }
        false => file::write(figure, start_svg(&snapshot, &seams)?)?,
    }
    Ok(Ok(text))
}
