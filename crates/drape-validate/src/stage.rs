use drape_input::Document;
use drape_scene::{Scene, Simulation};

use crate::ValidationError;

/// A simulation of a scene in memory, whose fabric is `fabric.toml`.
///
/// # Errors
/// A scene or a fabric that cannot be read, or a scene that cannot be prepared.
pub(crate) fn simulation(scene: String, fabric: String) -> Result<Simulation, ValidationError> {
    let fabric = Document::new("fabric.toml", fabric);
    Ok(Simulation::new(Scene::from_documents(&Document::new("scene.toml", scene), &[fabric])?)?)
}
