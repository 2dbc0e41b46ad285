//! Checked scenes, fields of which a program then changes.

use drape::dynamics::Simulation;
use drape::input::Document;
use drape::scene::Scene;

use crate::readers::FABRIC;
use crate::shapes::Source;

/// Scene of two sewn panels that are pinned over a box.
const SCENE: &str = r#"
spacing = 0.02
fabric.plain.file = "plain.toml"
panel = [
    { name = "a", fabric = "plain", rectangle = [0.06, 0.06], center = [0.0, 0.1, 0.0] },
    { name = "b", fabric = "plain", rectangle = [0.04, 0.04], center = [0.0, 0.14, 0.05] },
]
pin = [{ panel = "a", edge = "top" }]
time = { step = 0.005, end = 1 }
[[collider.box]]
size = [0.03, 0.03, 0.03]
"#;

pub fn simulate(source: &mut Source<'_>) {
    let fabric = Document::new("plain.toml", FABRIC);
    let scene = Scene::from_documents(&Document::new("scene.toml", SCENE), &[fabric]);
    let mut scene = scene.expect("a right scene");
    let particles = scene.cloth.particle_count();
    for _ in 0..=source.below(2) {
        change(source, &mut scene, particles);
    }
    let Ok(mut simulation) = Simulation::new(scene) else { return };
    for _ in 0..2 {
        let _ = simulation.set_gravity([source.odd(), -9.81, 0.0]);
        let _ = simulation.set_air_velocity([source.odd(), 0.0, 0.0]);
        let _ = simulation.apply_forces(&source.odd_list(3 * particles));
        if simulation.step().is_err() {
            return;
        }
    }
    let frame = simulation.frame();
    assert!(frame.cloth.iter().flatten().all(|x| x.is_finite()), "a position is not finite");
    serde_json::to_string(&simulation.summary()).expect("a summary is JSON");
}

/// Changes a field of `scene`, whose cloth has a number of `particles`.
fn change(source: &mut Source<'_>, scene: &mut Scene, particles: usize) {
    let whole = source.below(3) as usize;
    match source.below(20) {
        0 => scene.schedule.clock.step = source.odd(),
        1 => scene.schedule.clock.ticks_per_step = whole,
        2 => scene.schedule.clock.ticks_per_frame = whole,
        3 => scene.schedule.clock.ticks_max = whole,
        4 => scene.schedule.clock.end = source.odd(),
        5 => scene.schedule.clock.error = Some(source.odd()),
        6 => scene.start.positions = source.odd_list(3 * particles),
        7 => scene.start.velocities = source.odd_list(3 * particles),
        8 => scene.panels.truncate(whole),
        9 => scene.panels[0].first = whole,
        10 => scene.panels[1].material = whole,
        11 => scene.pins[0].particles.push(source.number(particles) as usize),
        12 => scene.pins[0].start.truncate(whole),
        13 => scene.environment.air = source.odd(),
        14 => scene.environment.gravity[1] = source.odd(),
        15 => scene.contact.stiffness = Some(source.odd()),
        16 => scene.contact.particles.activation_distance = source.odd(),
        17 => scene.bodies[0].body.friction = source.odd(),
        18 => scene.solver.tolerance = source.odd(),
        _ => scene.materials[0].fabric.thickness = source.odd(),
    }
}
