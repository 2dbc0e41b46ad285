//! Scenes in Breen's model.
#![allow(clippy::unwrap_used)]

use drape_dynamics::Simulation;
use drape_input::Document;
use drape_scene::Scene;

const FABRIC: &str = r#"name = "plain"
density = 0.12
thickness = 0.0003
surface_friction = 0.3
shear = { stiffness = 35.0, friction = [{ plateau = 0.4, length = 0.004 }] }
[warp]
traction.primed = { stiffness = 5000, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.015 }
bending = { rigidity = 2e-6, friction = [{ plateau = 1e-4, length = 4.0 }] }
[weft]
traction.primed = { stiffness = 4000, toe_ratio = 0.7, toe_strain = 0.02, toe_strain_after = 0.03 }
bending = { rigidity = 2e-6, friction = [{ plateau = 1e-4, length = 4.0 }] }
"#;

/// A strip that stands a little askew on a floor, and has to fold onto itself.
fn strip(model: &str) -> Simulation {
    let text = format!(
        r#"model = "{model}"
spacing = 0.01
fabric.plain.file = "plain.toml"
[[panel]]
name = "strip"
fabric = "plain"
rectangle = [0.04, 0.3]
center = [0, 0.16, 0]
turn = [2, 0, 0]
noise = {{ amplitude = 1e-3, seed = 5 }}
[[collider.plane]]
[time]
step = 0.004
end = 1.0
"#
    );
    let fabric = Document::new("plain.toml", FABRIC);
    let scene = Scene::from_documents(&Document::new("strip.toml", text), &[fabric]).unwrap();
    Simulation::new(scene).unwrap()
}

/// Distance of the two nearest particles that are more than two spacings apart along the strip, in
/// spacings.
fn nearest(simulation: &Simulation) -> f64 {
    let positions = simulation.positions().to_vec();
    let points: Vec<&[f64]> = positions.chunks_exact(3).collect();
    let coordinates = simulation.coordinates();
    let mut nearest = f64::INFINITY;
    for (a, p) in points.iter().enumerate() {
        for (b, q) in points.iter().enumerate().skip(a + 1) {
            if (coordinates[a][1] - coordinates[b][1]).abs() > 0.025 {
                let square: f64 = p.iter().zip(*q).map(|(p, q)| (p - q) * (p - q)).sum();
                nearest = nearest.min(square.sqrt() / 0.01);
            }
        }
    }
    nearest
}

#[test]
fn a_strip_that_folds_onto_itself_stays_apart() {
    let run = |model: &str| {
        let mut simulation = strip(model);
        let mut least = f64::INFINITY;
        while !simulation.step().unwrap().finished {
            least = least.min(nearest(&simulation));
        }
        (least, simulation)
    };
    let (apart, simulation) = run("breen-1994");
    let (through, _) = run("kes");
    assert!(apart > 0.6 && apart < 1.0, "it met itself at {apart} spacings");
    assert!(through < 0.5, "without repulsion it passes at {through} spacings");
    // What is stored is had back, and what is lost the integrator or the floor has taken.
    let energy = simulation.energy().unwrap();
    assert_eq!(energy.friction_dissipated, 0.0);
    assert!(energy.residual.abs() < 1e-6 * -energy.gravity, "{energy:?}");
}

#[test]
fn another_model_is_not_known() {
    let text = "model = \"breen-1995\"\nfabric.plain.file = \"plain.toml\"\n[[panel]]\nname = \"a\"\nfabric = \"plain\"\n\
                rectangle = [0.1, 0.1]\n[time]\nstep = 0.01\nend = 0.1\n";
    let fabric = Document::new("plain.toml", FABRIC);
    let error = Scene::from_documents(&Document::new("a.toml", text), &[fabric]).unwrap_err();
    assert!(error.to_string().ends_with("help: did you mean \"breen-1994\"?"), "{error}");
}
