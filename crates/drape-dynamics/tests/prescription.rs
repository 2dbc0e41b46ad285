//! What a program prescribes between steps: forces on the particles, and where bodies go.

#![allow(clippy::unwrap_used)]

use drape_dynamics::{BodyTarget, Displacement, Energy, Simulation};
use drape_fabric::samples;
use drape_input::Document;
use drape_scene::Scene;

const STEP: f64 = 0.002;

/// A level sheet of 7 × 7 particles without air, with more keys and tables.
fn simulation(keys: &str, tables: &str) -> Simulation {
    let text = format!(
        r#"spacing = 0.02
fabric.plain.file = "plain.toml"
time = {{ step = {STEP}, end = 10 }}
air.density = 0.0
{keys}
[[panel]]
name = "cloth"
fabric = "plain"
rectangle = [0.12, 0.12]
turn = [-90, 0, 0]
{tables}
"#
    );
    let fabric = Document::new("plain.toml", samples::PLAIN_WEAVE_WITH_FRICTION);
    let scene = Scene::from_documents(&Document::new("scene.toml", &text), &[fabric]).unwrap();
    Simulation::new(scene).unwrap()
}

fn exchanged(energy: &Energy) -> f64 {
    energy.kinetic.abs().max(energy.work_in.abs())
}

/// Forces that give each particle of a cloth an acceleration, in m/s².
fn forces(acceleration: [f64; 3], masses: &[f64]) -> Vec<f64> {
    masses.iter().flat_map(|mass| acceleration.map(|a| mass * a)).collect()
}

/// Masses of the particles of a free sheet with 7 × 7 particles, in kg: half and quarter at the
/// edges.
fn masses() -> Vec<f64> {
    let weight = |k: usize| if k == 0 || k == 6 { 0.5 } else { 1.0 };
    let cell = 0.15 * 0.02 * 0.02;
    (0..49).map(|k| cell * weight(k % 7) * weight(k / 7)).collect()
}

#[test]
fn a_constant_force_is_a_fall_in_its_direction() {
    let mut simulation = simulation("gravity = [0, 0, 0]\nsolver.tolerance = 1e-8", "");
    let acceleration = [3.0, 2.0, -1.0];
    let start = simulation.positions().to_vec();
    simulation.apply_forces(&forces(acceleration, &masses())).unwrap();
    let steps = 50;
    for _ in 0..steps {
        assert_eq!(simulation.next_step(), STEP);
        simulation.step().unwrap();
    }
    let t = f64::from(steps) * STEP;
    for (now, start) in simulation.positions().chunks(3).zip(start.chunks(3)) {
        for axis in 0..3 {
            // BDF2 begins with a step of backward Euler: it adds a STEP² / 2 once, and 1/3 of it
            // later.
            let moved = now[axis] - start[axis];
            let exact = 0.5 * acceleration[axis] * t * t;
            let first = acceleration[axis] * STEP * STEP;
            assert!((moved - exact).abs() < first.abs(), "{moved} m, {exact} m");
        }
    }
    for velocity in simulation.velocities().chunks(3) {
        for axis in 0..3 {
            assert!((velocity[axis] / (acceleration[axis] * t) - 1.0).abs() < 1e-6);
        }
    }
    let energy = simulation.energy().unwrap();
    let weight: f64 = masses().iter().sum();
    let squares: f64 = acceleration.iter().map(|a| a * a).sum();
    let kinetic = 0.5 * weight * squares * t * t;
    assert!((energy.kinetic / kinetic - 1.0).abs() < 1e-5, "{energy:?}");
    assert!((energy.work_in / kinetic - 1.0).abs() < 0.05, "{energy:?}");
    assert!(energy.residual.abs() < 1e-5 * exchanged(&energy), "{energy:?}");
}

#[test]
fn forces_like_gravity_do_what_gravity_does() {
    let pinned = "[[pin]]\npanel = \"cloth\"\nedge = \"top\"";
    let mut heavy = simulation("", pinned);
    let mut pushed = simulation("gravity = [0, 0, 0]", pinned);
    pushed.apply_forces(&forces([0.0, -9.81, 0.0], &masses())).unwrap();
    for _ in 0..100 {
        heavy.step().unwrap();
        pushed.step().unwrap();
    }
    let pairs = heavy.positions().iter().zip(pushed.positions());
    let most = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(most < 1e-6, "{most} m apart");
    let energy = pushed.energy().unwrap();
    assert!((energy.work_in + heavy.energy().unwrap().gravity).abs() < 1e-3 * energy.work_in);
    assert!(energy.residual.abs() < 1e-4 * exchanged(&energy), "{energy:?}");
    // Without numbers there are no forces any more.
    pushed.apply_forces(&[]).unwrap();
    let before = pushed.energy().unwrap().work_in;
    pushed.step().unwrap();
    assert!((pushed.energy().unwrap().work_in - before).abs() < 1e-3 * before);
}

#[test]
fn forces_that_do_not_fit_are_refused() {
    let mut simulation = simulation("", "");
    let refused = |simulation: &mut Simulation, forces: &[f64]| {
        simulation.apply_forces(forces).unwrap_err().to_string()
    };
    assert!(refused(&mut simulation, &[1.0; 6]).contains("6 numbers are no forces on 49"));
    let mut wrong = vec![0.0; 3 * 49];
    wrong[7] = f64::NAN;
    assert!(refused(&mut simulation, &wrong).contains("particle 2 is NaN"));
    simulation.apply_forces(&[0.0; 3 * 49]).unwrap();
}

const SPHERE: &str =
    "[[collider.sphere]]\nname = \"ball\"\nradius = 0.03\ncenter = [0, -0.032, 0]\n";

const PINS: &str = "[[pin]]\npanel = \"cloth\"\nedge = \"top\"\n\
                    [[pin]]\npanel = \"cloth\"\nedge = \"bottom\"";

/// Ball below a cloth with two held edges, with more tables of the ball.
fn ball(tables: &str) -> String {
    format!("{SPHERE}{tables}{PINS}")
}

/// Lifts the ball by 2 cm within 0.1 s.
fn lift(simulation: &mut Simulation, target: &BodyTarget) {
    simulation.lead_body("ball", target, 0.1).unwrap();
    for _ in 0..60 {
        simulation.step().unwrap();
    }
}

fn middle(simulation: &Simulation) -> f64 {
    simulation.positions()[3 * 24 + 1]
}

#[test]
fn a_body_is_led_as_by_a_motion_of_the_scene() {
    for (keys, motion) in [("", "surfaces"), ("contact.surfaces = false", "particles")] {
        let told =
            "[collider.sphere.motion]\ntimes = [0, 0.1]\nshift = [[0, 0, 0], [0, 0.02, 0]]\n";
        let mut scene = simulation(keys, &ball(told));
        let mut led = simulation(keys, &ball(""));
        let target =
            BodyTarget::Rigid(Displacement { shift: [0.0, 0.02, 0.0], ..Displacement::default() });
        lift(&mut led, &target);
        for _ in 0..60 {
            scene.step().unwrap();
        }
        let [a, b] = [&scene, &led].map(middle);
        assert!(a > 0.012 && (a - b).abs() < 1e-4, "{motion}: {a} and {b} m");
        let energy = led.energy().unwrap();
        assert!(energy.work_in > 0.0, "{motion}: {energy:?}");
        let most = 1e-3 * exchanged(&energy).max(energy.elastic);
        assert!(energy.residual.abs() < most, "{motion}: {energy:?}");
    }
}

#[test]
fn vertices_go_where_they_are_led_and_stay_apart_from_cloth() {
    let mut simulation = simulation("", &ball(""));
    let (name, outline) = simulation.bodies().remove(0);
    assert_eq!(name, "ball");
    // The ball rises and becomes taller.
    let taller = |[x, y, z]: [f64; 3]| [x, 1.2 * (y + 0.032) - 0.032 + 0.012, z];
    let goal: Vec<[f64; 3]> = outline.vertices.iter().map(|&v| taller(v)).collect();
    lift(&mut simulation, &BodyTarget::Vertices(goal.clone()));
    let (_, now) = simulation.bodies().remove(0);
    let miss = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).map(|k| (a[k] - b[k]).abs()).sum::<f64>();
    assert!(now.vertices.iter().zip(&goal).map(miss).fold(0.0, f64::max) < 1e-12);
    assert!(middle(&simulation) > 0.012);
    assert_eq!(simulation.summary().contact.intersections_found, 0);
    // From there it goes on.
    let target =
        BodyTarget::Rigid(Displacement { shift: [0.0, -0.01, 0.0], ..Displacement::default() });
    lift(&mut simulation, &target);
    let (_, last) = simulation.bodies().remove(0);
    let lower: Vec<[f64; 3]> = goal.iter().map(|&[x, y, z]| [x, y - 0.01, z]).collect();
    assert!(last.vertices.iter().zip(&lower).map(miss).fold(0.0, f64::max) < 1e-12);
}

#[test]
fn motions_that_do_not_fit_are_refused_with_what_would() {
    let mut one = simulation("", &ball(""));
    let up = |y: f64| {
        BodyTarget::Rigid(Displacement { shift: [0.0, y, 0.0], ..Displacement::default() })
    };
    let mut refused = |name: &str, target: &BodyTarget, seconds: f64| {
        one.lead_body(name, target, seconds).unwrap_err().to_string()
    };
    assert!(refused("bowl", &up(0.01), 1.0).contains("the bodies are: ball"));
    assert!(refused("ball", &up(0.01), 0.0).contains("a time above 0"));
    assert!(refused("ball", &BodyTarget::Vertices(vec![[0.0; 3]; 4]), 1.0).contains("4 are given"));
    assert!(refused("ball", &up(f64::NAN), 1.0).contains("NaN"));
    let fast = refused("ball", &up(10.0), 0.002);
    let needed = fast.split("give it ").nth(1).unwrap().split(' ').next().unwrap();
    let line = one.bodies()[0].1.vertices.iter().map(|&[x, ..]| [x, 0.0, 0.0]).collect();
    let error = one.lead_body("ball", &BodyTarget::Vertices(line), 1.0).unwrap_err().to_string();
    assert!(error.contains("the body \"ball\": triangle 0 has no area"), "{error}");
    let point = vec![[0.0; 3]; one.bodies()[0].1.vertices.len()];
    let error = one.lead_body("ball", &BodyTarget::Vertices(point), 1.0).unwrap_err().to_string();
    assert!(error.contains("triangle 0 has no area"), "{error}");
    // The time that it advises is enough.
    one.lead_body("ball", &up(10.0), needed.parse().unwrap()).unwrap();
    // So is the stiffness that it advises, at whatever speed.
    for height in [0.05, 0.06, 0.07, 0.08, 0.09] {
        let target = up(height);
        let fast = simulation("", &ball("")).lead_body("ball", &target, 0.002).unwrap_err();
        let fast = fast.to_string();
        let stiffness = fast.split(" or the scene ").nth(1).unwrap();
        let mut stiffer = simulation(stiffness, &ball(""));
        stiffer.lead_body("ball", &target, 0.002).unwrap_or_else(|error| panic!("{fast}: {error}"));
    }
    let mut particles = simulation("contact.surfaces = false", &ball(""));
    let vertices = particles.bodies()[0].1.vertices.clone();
    let target = BodyTarget::Vertices(vertices);
    let error = particles.lead_body("ball", &target, 1.0).unwrap_err().to_string();
    assert!(error.contains("contact.surfaces = true"), "{error}");
    simulation("contact.surfaces = true", &ball("")).lead_body("ball", &target, 1.0).unwrap();
    let mut waiting = simulation("settle = {}\nmotion.seconds = 1", &ball(""));
    let error = waiting.lead_body("ball", &up(0.01), 1.0).unwrap_err().to_string();
    assert!(error.contains("wait for the cloth to rest"), "{error}");
}
