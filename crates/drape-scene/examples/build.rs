//! Builds a scene without a file: a napkin over a tetrahedron, both of them in memory.

use std::sync::Arc;

use drape_collide::Triangulation;
use drape_fabric::Fabric;
use drape_input::Document;
use drape_scene::{FabricSpec, MeshSpec, PanelSpec, SceneSpec};

const FABRIC: &str = r#"
name = "plain weave"
density = 0.12
thickness = 0.0003
surface_friction = 0.25
shear.stiffness = 35
[warp]
traction.primed = { stiffness = 5000, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.015 }
bending.rigidity = 1.2e-5
[weft]
traction.primed = { stiffness = 4000, toe_ratio = 0.7, toe_strain = 0.02, toe_strain_after = 0.03 }
bending.rigidity = 0.8e-5
"#;

#[expect(clippy::print_stdout, reason = "an example shows its result")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let fabric = Fabric::from_document(&Document::new("plain.toml", FABRIC))?;
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
    println!("{} particles over \"{}\"", scene.cloth.particles(), scene.bodies[0].body.name);
    assert_eq!(scene.cloth.particles(), 21 * 21);
    Ok(())
}
