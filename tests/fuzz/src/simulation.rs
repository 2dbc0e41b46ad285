//! Simulations of a few particles from bytes: finite, and without a crossing in exact arithmetic.

use drape::dynamics::Simulation;
use drape::input::Document;
use drape::scene::Scene;
use drape::verify::triangles_intersect;

use crate::readers::FABRIC;
use crate::shapes::Source;

/// Number of steps.
const STEPS: usize = 3;

/// Returns a scene: one or two sheets of 9 or 8 particles, thrown at a ball or a box.
fn scene(source: &mut Source<'_>) -> String {
    let mut near = |reach: f64| [0; 3].map(|_| source.between(-reach, reach));
    let (speeds, turns, others) = ([near(3.0), near(3.0)], [near(180.0), near(180.0)], near(0.05));
    let step = source.between(0.0005, 0.01);
    let count = 1 + source.below(2);
    let mut text = format!(
        "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\ntime = {{ step = {step}, end = 1 }}\n"
    );
    let height = if count == 1 { 0.04 } else { 0.02 };
    for index in 0..count as usize {
        let rows = if count == 1 { [0.04, height] } else { [0.02 * 2.0, 0.02 * 2.0] };
        let center = [others[0], 0.03 * (index as f64 + 1.0) + 0.03, others[2]];
        text += &format!(
            "[[panel]]\nname = \"p{index}\"\nfabric = \"plain\"\nrectangle = {rows:?}\n\
             center = {center:?}\nturn = {:?}\nvelocity = {:?}\n",
            turns[index], speeds[index]
        );
    }
    let size = source.between(0.005, 0.05);
    text + &match source.below(3) {
        0 => format!("[[collider.sphere]]\nradius = {size}\n"),
        1 => format!("[[collider.box]]\nsize = [{size}, {size}, {size}]\n"),
        _ => String::new(),
    }
}

/// Simulates some steps of a scene, if it is accepted.
pub fn simulate(bytes: &[u8]) {
    let text = scene(&mut Source::new(bytes));
    let fabric = Document::new("plain.toml", FABRIC);
    let Ok(scene) = Scene::from_documents(&Document::new("scene.toml", text.as_str()), &[fabric])
    else {
        return;
    };
    let Ok(mut simulation) = Simulation::new(scene) else { return };
    let topology = simulation.topology();
    for step in 0..STEPS {
        // A step that cannot be solved leaves the last good state, which holds too.
        let ended = simulation.step().is_err();
        let frame = simulation.frame();
        let all = || frame.cloth.iter().chain(&frame.bodies).flatten();
        assert!(all().all(|x| x.is_finite()), "step {step} of\n{text}");
        if let Some(energy) = simulation.energy() {
            let numbers = serde_json::to_value(energy).expect("JSON");
            let finite = |number: &serde_json::Value| number.is_number();
            assert!(numbers.as_object().is_some_and(|own| own.values().all(finite)), "{numbers}");
        }
        let cloth = frame.cloth.len() as u32;
        let of_cloth = topology.cloth.iter().map(|t| (*t, t.map(|k| frame.cloth[k as usize])));
        let bodies = topology.bodies.iter();
        let of_bodies = bodies.map(|t| (t.map(|k| k + cloth), t.map(|k| frame.bodies[k as usize])));
        let triangles: Vec<_> = of_cloth.chain(of_bodies).collect();
        for (number, (own, place)) in triangles.iter().take(topology.cloth.len()).enumerate() {
            for (other, there) in &triangles[number + 1..] {
                let joined = own.iter().any(|k| other.contains(k));
                assert!(
                    joined || !triangles_intersect(*place, *there),
                    "{own:?} and {other:?} cross in step {step} of\n{text}"
                );
            }
        }
        if ended {
            return;
        }
    }
}
