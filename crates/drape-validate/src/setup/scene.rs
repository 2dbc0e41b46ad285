//! Scenes in memory, and how they are run.
//!
//! `scene` reads a scene and its fabric from text; [`finish`] steps a simulation until it ends.

use drape_dynamics::{Simulation, Step};
use drape_input::Document;
use drape_scene::Scene;

use crate::error::ValidationError;

/// A line before the tables of a scene in which one piece of cloth touches nothing: what it is held
/// against has no thickness, and to prove that it keeps clear of itself would take three times as
/// long.
pub(crate) const ALONE: &str = "contact.surfaces = false\n";

/// Returns a scene from text, whose fabric is `fabric.toml`.
///
/// # Errors
/// A scene or a fabric that cannot be read.
pub(crate) fn scene(scene: String, fabric: String) -> Result<Scene, ValidationError> {
    let fabric = Document::new("fabric.toml", fabric);
    Ok(Scene::from_documents(&Document::new("scene.toml", scene), &[fabric])?)
}

/// Returns a simulation of a scene from text, whose fabric is `fabric.toml`.
///
/// # Errors
/// A scene or a fabric that cannot be read, or a scene that cannot be prepared.
pub(crate) fn simulation(text: String, fabric: String) -> Result<Simulation, ValidationError> {
    Ok(Simulation::new(scene(text, fabric)?)?)
}

/// Steps a simulation until its end.
///
/// # Errors
/// A step that cannot be solved, or a strip that does not come to rest where the scene asks for it.
pub fn finish(simulation: &mut Simulation) -> Result<(), ValidationError> {
    finish_with(simulation, |_, _| ())
}

/// Steps a simulation until its end, and calls a function after every step.
pub(crate) fn finish_with(
    simulation: &mut Simulation,
    mut told: impl FnMut(&Simulation, &Step),
) -> Result<(), ValidationError> {
    loop {
        let step = simulation.step()?;
        told(simulation, &step);
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
