//! A sewn garment that is steered: seams hold their particles together.

use drape_dynamics::{PhaseName, PinTarget, Simulation};
use drape_fabric::samples;
use drape_input::Document;
use drape_scene::Scene;

use crate::distance;

/// Tube of two halves, 180 mm wide and 40 mm high, that is sewn and then hangs by the edge of its
/// front.
const PATTERN: &str = r#"length = "mm"
[panel.front]
grain = 0
start = [-90, 0]
outline = [
    { name = "bottom", to = [90, 0] },
    { name = "left", to = [90, 40] },
    { name = "top", to = [-90, 40] },
    { name = "right", to = [-90, 0] },
]
origin = [0, 0, 80]
wrap = 80
[panel.back]
grain = 0
start = [-90, 0]
outline = [
    { name = "bottom", to = [90, 0] },
    { name = "right", to = [90, 40] },
    { name = "top", to = [-90, 40] },
    { name = "left", to = [-90, 0] },
]
origin = [0, 0, -80]
turn = [0, 180, 0]
wrap = 80
[seam.left]
sides = [["front.left"], ["back.left"]]
[seam.right]
sides = [["back.right"], ["front.right"]]
"#;

fn tube() -> Simulation {
    let text = "spacing = 0.015\nair.density = 0\nfabric.plain.file = \"plain.toml\"\n\
                time = { step = 0.005, end = 20 }\n[[garment]]\npattern = \"tube.toml\"\n\
                fabric = \"plain\"\n[[pin]]\npanel = \"front\"\nedge = \"top\"\naxes = [\"y\"]\n";
    let documents = [
        Document::new("plain.toml", samples::PLAIN_WEAVE_WITH_FRICTION),
        Document::new("tube.toml", PATTERN),
    ];
    Simulation::new(Scene::from_documents(&Document::new("scene.toml", text), &documents).unwrap())
        .unwrap()
}

/// Returns the particles at the place of `particle`.
fn merged(simulation: &Simulation, particle: usize) -> Vec<usize> {
    let positions = simulation.positions().as_chunks::<3>().0;
    let here = positions[particle];
    (0..positions.len()).filter(|&other| positions[other] == here).collect()
}

#[test]
fn both_sides_of_a_seam_are_held_led_and_released_together() {
    let mut simulation = tube();
    let message = simulation.hold(&[0]).unwrap_err().to_string();
    assert!(message.contains("is being sewn"), "{message}");
    while simulation.step().unwrap().phase == PhaseName::Sew {}
    for _ in 0..4 {
        simulation.step().unwrap();
    }

    // A particle of the seam at the lower edge, with its other side.
    let lowest = (0..simulation.positions().len() / 3)
        .filter(|&particle| merged(&simulation, particle).len() == 2)
        .min_by(|&a, &b| {
            let height = |p: usize| simulation.positions()[3 * p + 1];
            height(a).total_cmp(&height(b))
        });
    let [first, second] = merged(&simulation, lowest.unwrap())[..] else { panic!("two sides") };
    let before = simulation.energy().unwrap();
    let pin = simulation.hold(&[second]).unwrap();
    let stopped = simulation.energy().unwrap();
    let taken = [before.kinetic - stopped.kinetic, before.work_in - stopped.work_in];
    assert!(taken[0] > 0.0 && (taken[0] - taken[1]).abs() < 1e-15, "{taken:?}");

    let place = |simulation: &Simulation, particle: usize| -> [f64; 3] {
        simulation.positions().as_chunks::<3>().0[particle]
    };
    let held = place(&simulation, first);
    for _ in 0..10 {
        simulation.step().unwrap();
        assert_eq!([first, second].map(|p| place(&simulation, p)), [held, held]);
    }
    let goal = [held[0], held[1] + 0.01, held[2]];
    simulation.lead_pin(pin, &PinTarget::Place(goal), 0.05).unwrap();
    for _ in 0..10 {
        simulation.step().unwrap();
    }
    assert!(distance(place(&simulation, first), goal) < 1e-15);

    // The other side of the seam is released, and its twin with it.
    let saved = simulation.saved();
    let released = |simulation: &mut Simulation| {
        simulation.release(&[first]).unwrap();
        for _ in 0..20 {
            simulation.step().unwrap();
        }
        simulation.state_hash()
    };
    let hash = released(&mut simulation);
    let [a, b] = [first, second].map(|p| place(&simulation, p));
    assert!(a == b && a[1] < goal[1] - 0.002, "{a:?} of {goal:?}");
    simulation.resume(saved.clone()).unwrap();
    assert_eq!(released(&mut simulation), hash);
    let mut anew = tube();
    anew.resume(saved).unwrap();
    assert_eq!(released(&mut anew), hash);
    assert_eq!(simulation.summary().contact.intersections, 0);
}
