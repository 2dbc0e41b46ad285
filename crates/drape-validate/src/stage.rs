use drape_dynamics::Simulation;
use drape_input::Document;
use drape_scene::Scene;

use crate::ValidationError;

/// A line before the tables of a scene in which one piece of cloth touches nothing: what it is held against has no
/// thickness, and to prove that it keeps clear of itself would take three times as long.
pub(crate) const ALONE: &str = "contact.surfaces = false\n";

/// A scene in memory, whose fabric is `fabric.toml`.
///
/// # Errors
/// A scene or a fabric that cannot be read.
pub(crate) fn scene(scene: String, fabric: String) -> Result<Scene, ValidationError> {
    let fabric = Document::new("fabric.toml", fabric);
    Ok(Scene::from_documents(&Document::new("scene.toml", scene), &[fabric])?)
}

/// A simulation of a scene in memory, whose fabric is `fabric.toml`.
///
/// # Errors
/// A scene or a fabric that cannot be read, or a scene that cannot be prepared.
pub(crate) fn simulation(text: String, fabric: String) -> Result<Simulation, ValidationError> {
    Ok(Simulation::new(scene(text, fabric)?)?)
}
