//! Builds a scene without a file: a napkin over a tetrahedron, both of them in memory.

use std::sync::Arc;

use drape_collide::Triangulation;
use drape_fabric::Fabric;
use drape_fabric::samples::PLAIN_WEAVE;
use drape_input::Document;
use drape_scene::{FabricSpec, MeshSpec, PanelSpec, SceneSpec};

#[expect(clippy::print_stdout, reason = "an example shows its result")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let fabric = Fabric::from_document(&Document::new("plain.toml", PLAIN_WEAVE))?;
    let body = Triangulation {
        vertices: vec![[0.1, 0.0, 0.1], [0.1, 0.0, -0.1], [-0.1, 0.0, 0.0], [0.0, 0.15, 0.0]],
        triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    };

    let mut spec = SceneSpec { spacing: 0.02, ..SceneSpec::default() };
    let file = Arc::new(fabric).into();
    spec.fabric.insert("plain".into(), FabricSpec { file, ..FabricSpec::default() });
    spec.panel.push(PanelSpec {
        name: "napkin".into(),
        fabric: "plain".into(),
        rectangle: Some([0.4, 0.4]),
        center: [0.0, 0.16, 0.0],
        turn: [-90.0, 0.0, 0.0],
        ..PanelSpec::default()
    });
    let file = Arc::new(body).into();
    spec.collider.mesh.push(MeshSpec { file, friction: Some(0.4), ..MeshSpec::default() });

    let scene = spec.build()?;
    println!("{} particles over \"{}\"", scene.cloth.particle_count(), scene.bodies[0].body.name);
    assert_eq!(scene.cloth.particle_count(), 21 * 21);
    Ok(())
}
