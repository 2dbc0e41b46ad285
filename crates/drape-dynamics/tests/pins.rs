//! Pins that move: specimens between the clamps of an instrument.

#![allow(clippy::unwrap_used)]

use drape_dynamics::Simulation;
use drape_fabric::{Law, drive, samples};
use drape_input::Document;
use drape_scene::Scene;

/// A strip of 4 × 5 cm whose upper edge moves, without weight and air.
fn scene(motion: &str) -> Simulation {
    let text = format!(
        r#"name = "strip"
spacing = 0.005
gravity = [0, 0, 0]
air.density = 0.0
[fabric.plain]
file = "plain.toml"
[[panel]]
name = "strip"
fabric = "plain"
rectangle = [0.04, 0.05]
[[pin]]
panel = "strip"
edge = "bottom"
[[pin]]
panel = "strip"
edge = "top"
{motion}
[time]
step = 0.01
end = 1.0
[solver]
tolerance = 1e-7
integrator = "backward-euler"
"#
    );
    let fabric = Document::new("plain.toml", samples::PLAIN_WEAVE_WITH_FRICTION);
    let scene = Scene::from_documents(&Document::new("strip.toml", &text), &[fabric]).unwrap();
    Simulation::new(scene).unwrap()
}

#[test]
fn a_strip_between_clamps_returns_the_law_of_its_yarns() {
    let mut simulation = scene(
        "[pin.motion]\ntimes = [0, 0.5, 1.0]\nshift = [[0, 0, 0], [0, 0.0015, 0], [0, 0, 0]]",
    );
    let fabric = samples::plain_weave_with_friction();
    let law = fabric.warp.traction;
    let (mut strains, mut tensions) = (Vec::new(), Vec::new());
    loop {
        let step = simulation.step().unwrap();
        let turn = if step.time < 0.5 { step.time } else { 1.0 - step.time };
        strains.push(0.0015 * turn / 0.5 / 0.05);
        tensions.push(-simulation.pin_loads()[1].force[1] / 0.04);
        if step.finished {
            break;
        }
    }
    let exact = drive(&law, law.virgin(), &strains);
    let top = exact.iter().fold(0.0, |top: f64, load| top.max(*load));
    for (i, (found, exact)) in tensions.iter().zip(&exact).enumerate() {
        // What is left is inertia: the strip is pulled in half a second.
        let error = (found - exact).abs() / top;
        assert!(error < 1e-3, "{found} N/m at strain {}, exactly {exact}", strains[i]);
    }
    assert!(top > 80.0, "{top}");
    let energy = simulation.energy().unwrap();
    let lost = energy.friction_dissipated + energy.numerical_dissipated + energy.kinetic;
    let balance = energy.work_in - energy.elastic - lost;
    assert!(balance.abs() < 1e-6 * energy.friction_dissipated, "{balance:e} of {energy:?}");
}

#[test]
fn a_pin_lets_go() {
    let motion =
        "release = 0.5\n[pin.motion]\ntimes = [0, 0.4]\nshift = [[0, 0, 0], [0, 0.0015, 0]]";
    let mut simulation = scene(motion);
    let (mut pulled, mut freed) = (0.0, f64::NAN);
    loop {
        let step = simulation.step().unwrap();
        let load = simulation.pin_loads()[1].force[1];
        if step.time < 0.5 + 1e-9 {
            pulled = load;
        } else {
            assert_eq!(load, 0.0, "it bears nothing at {} s", step.time);
            freed = simulation.positions().chunks(3).map(|x| x[1]).fold(f64::MIN, f64::max);
        }
        if step.finished {
            break;
        }
    }
    assert!(pulled < -1.0, "{pulled} N before");
    // The edge was 1.5 mm beyond its place; the friction of the yarns keeps a little of it.
    assert!(freed < 0.0254 && freed > 0.0249, "{freed} m");
}

#[test]
fn a_twisted_strip_resists() {
    let mut simulation =
        scene("[pin.motion]\ntimes = [0, 0.5]\nturn = [[0, 0, 0], [0, 40, 0]]\ncenter = [0, 0, 0]");
    loop {
        let step = simulation.step().unwrap();
        if step.finished {
            break;
        }
    }
    // Twisted by 40° over 5 cm, the strip pulls its clamps together a little and resists the twist.
    let load = simulation.pin_loads()[1];
    assert!(load.moment[1] < 0.0, "{load:?}");
    assert!(load.force[0].abs() + load.force[2].abs() < 1e-3 * load.force[1].abs(), "{load:?}");
}

#[test]
fn a_motion_that_is_none_is_refused_with_its_place() {
    for (motion, expected) in [
        ("times = [0, 1]\nshift = [[0, 0, 0]]", "1 places for 2 times"),
        ("times = [1, 0]\nshift = [[0, 0, 0], [0, 0, 1]]", "not one"),
        ("times = []", "not one"),
    ] {
        let text = format!(
            "name = \"s\"\nspacing = 0.01\n[fabric.plain]\nfile = \"plain.toml\"\n[[panel]]\nname = \"p\"\n\
             fabric = \"plain\"\nrectangle = [0.1, 0.1]\n[[pin]]\npanel = \"p\"\nedge = \"top\"\n\
             [pin.motion]\n{motion}\n[time]\nstep = 0.01\nend = 1.0\n"
        );
        let fabric = Document::new("plain.toml", samples::PLAIN_WEAVE_WITH_FRICTION);
        let mistakes =
            Scene::from_documents(&Document::new("s.toml", &text), &[fabric]).unwrap_err();
        let message = mistakes.to_string();
        assert!(message.contains(expected) && message.contains("s.toml:1"), "{message}");
    }
}
