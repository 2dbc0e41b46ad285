//! Scenes in memory, and functions that run them.
//!
//! `scene` reads a scene and its fabric from text; [`finish`] steps a simulation until it ends.

use drape_dynamics::{Simulation, Step};
use drape_input::Document;
use drape_scene::Scene;

use crate::error::ValidationError;

/// Line before the tables of a scene in which one piece of cloth touches nothing. The references of
/// such scenes know no thickness of the cloth. The proof that the cloth does not touch itself would
/// take three times as long as the simulation.
pub(crate) const ALONE: &str = "contact.surfaces = false\n";

/// Returns the scene that the text `scene` states. The scene refers to the text `fabric` as
/// `fabric.toml`.
///
/// # Errors
/// The scene or the fabric cannot be read.
pub(crate) fn scene(scene: String, fabric: String) -> Result<Scene, ValidationError> {
    let fabric = Document::new("fabric.toml", fabric);
    Ok(Scene::from_documents(&Document::new("scene.toml", scene), &[fabric])?)
}

/// Returns a simulation of the scene that `text` states. The scene refers to the text `fabric` as
/// `fabric.toml`.
///
/// # Errors
/// The scene or the fabric cannot be read, or the scene cannot be prepared.
pub(crate) fn simulation(text: String, fabric: String) -> Result<Simulation, ValidationError> {
    Ok(Simulation::new(scene(text, fabric)?)?)
}

/// Steps `simulation` to its end.
///
/// # Errors
/// A step cannot be solved, or the cloth does not come to rest although the scene asks for rest.
pub fn finish(simulation: &mut Simulation) -> Result<(), ValidationError> {
    finish_with(simulation, |_, _| ())
}

/// Steps `simulation` to its end as [`finish`] does, and calls `observe` after every step.
pub(crate) fn finish_with(
    simulation: &mut Simulation,
    mut observe: impl FnMut(&Simulation, &Step),
) -> Result<(), ValidationError> {
    loop {
        let step = simulation.step()?;
        observe(simulation, &step);
        if step.finished {
            break;
        }
    }
    let summary = simulation.summary();
    if summary.imbalance.is_nan() || (simulation.settles() && !summary.settled) {
        return Err(ValidationError::NotSettled { seconds: summary.simulated_seconds });
    }
    Ok(())
}
