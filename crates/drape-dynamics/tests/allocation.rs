//! Heap of a run: a step of the simulation, with all forces and contact, in steady state.

use drape_dynamics::Simulation;
use drape_fabric::samples;
use drape_input::Document;
use drape_scene::Scene;

const FABRIC: &str = samples::PLAIN_WEAVE_WITH_FRICTION;

/// Returns the simulation of a square that falls onto a ball, with more tables of the scene.
fn falling(tables: &str) -> Simulation {
    let scene = format!(
        r#"
spacing = 0.02
fabric.plain.file = "plain.toml"
time = {{ step = 0.002, end = 2 }}
{tables}
[[panel]]
name = "square"
fabric = "plain"
rectangle = [0.2, 0.2]
turn = [-90, 0, 0]
center = [0, 0.003, 0]
[[collider.sphere]]
radius = 0.05
center = [0, -0.05, 0]
friction = 0.3
"#
    );
    let fabric = Document::new("plain.toml", FABRIC);
    let scene = Scene::from_documents(&Document::new("square.toml", scene), &[fabric]);
    Simulation::new(scene.expect("the scene is sound")).expect("the solver can be set up")
}

/// Number of steps after which the square rests on the ball and its lists have grown.
const BEFORE: usize = 300;

/// Number of steps that are measured.
const STEPS: usize = 100;

#[test]
fn a_step_with_contact_allocates_nothing_in_steady_state() {
    for tables in [
        "contact.surfaces = false",
        "contact.surfaces = false\nsolver.method = \"newton\"",
        "contact.surfaces = true",
    ] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        pool.expect("a thread starts").install(|| {
            let mut simulation = falling(tables);
            let mut advance = |steps: usize| {
                for _ in 0..steps {
                    simulation.step().expect("the step can be solved");
                }
            };
            advance(BEFORE);
            let used = allocation_counter::measure(|| advance(STEPS));
            assert_eq!(used.count_total, 0, "{tables}: {used:?}");
            assert!(simulation.summary().contact.pairs_max > 0, "{tables}: nothing touches");
        });
    }
}
