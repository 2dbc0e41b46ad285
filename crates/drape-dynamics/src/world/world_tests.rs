//! The world as a system: its forces against its potential, and the formula's loss against the work
//! of its forces.

use drape_implicit::{Integrator, IntegratorState, Settings, Stepper, System, check_system};
use drape_input::Document;
use drape_scene::Scene;

use crate::world::{Contact, World};

pub(crate) const FABRIC: &str = r#"name = "plain"
density = 0.15
thickness = 0.0003
shear = { stiffness = 35.0, growth = 4.0, friction = [{ plateau = 0.5, length = 0.004 }] }
[warp]
traction.primed = { stiffness = 5000.0, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.015 }
traction.friction = [{ plateau = 4.0, length = 0.001 }]
bending = { rigidity = 1.2e-5, friction = [{ plateau = 6e-4, length = 4.0 }] }
[weft]
traction.primed = { stiffness = 4000.0, toe_ratio = 0.7, toe_strain = 0.02, toe_strain_after = 0.03 }
bending = { rigidity = 0.8e-5, friction = [{ plateau = 4e-4, length = 4.0 }] }
"#;

/// 7 × 7 particles lying 2 mm deep in the range of contact with a ball, in air.
fn world(more: &str) -> World {
    let (more, surfaces) = match more {
        "surfaces" => ("", true),
        more => (more, false),
    };
    let text = format!(
        r#"spacing = 0.02
fabric.plain.file = "plain.toml"
{more}
[[panel]]
name = "cloth"
fabric = "plain"
rectangle = [0.12, 0.12]
center = [0, 0.3035, 0]
turn = [-90, 0, 0]
noise = {{ amplitude = 5e-4, seed = 3 }}
[[collider.sphere]]
radius = 0.3
friction = 0.3
[contact]
offset = 0.005
surfaces = {surfaces}
[time]
step = 0.005
end = 1.0
"#
    );
    let fabric = Document::new("plain.toml", FABRIC);
    let scene = Document::new("scene.toml", text);
    World::new(Scene::from_documents(&scene, &[fabric]).expect("a right scene")).expect("contact")
}

/// Moves the world by a few steps, so that everything has velocities and memories.
fn moved(world: &mut World) -> IntegratorState {
    let settings = Settings { integrator: Integrator::BackwardEuler, ..Settings::default() };
    let mut motion = IntegratorState::at_rest(world.state.positions.clone());
    let mut stepper = Stepper::new(world, settings).expect("good settings");
    for _ in 0..5 {
        let report = match world.contact.surfaces().is_some() {
            true => stepper.advance_filtered(world, &mut motion, 0.005),
            false => stepper.advance(world, &mut motion, 0.005),
        };
        report.expect("solvable");
    }
    motion
}

#[test]
fn forces_potential_and_stiffness_agree_in_contact_and_in_air() {
    let held = "[[pin]]\npanel = \"cloth\"\nedge = \"top\"\naxes = [\"y\", \"z\"]\n\
                [pin.motion]\ntimes = [0, 1]\nshift = [[0, 0, 0], [0.1, 0.3, -0.2]]";
    for more in ["", "settle = {}", "model = \"breen-1994\"", held] {
        let mut world = world(more);
        let motion = moved(&mut world);
        let Contact::Particles(bodies) = &world.contact else { panic!("no surfaces") };
        assert!(
            bodies.contact.summary(&motion.positions).unwrap().touching > 3,
            "it touches the ball"
        );
        let step = |(x, v): (&f64, &f64)| x + 0.004 * v;
        let trial: Vec<f64> = motion.positions.iter().zip(&motion.velocities).map(step).collect();
        let check = check_system(&mut world, &motion.positions, &trial, 0.005).expect("sound");
        // Differences extend across the ends of the contact's and the frictions' ranges, where
        // second derivatives jump; without contact the errors are a hundred times smaller.
        assert!(check.force_error < 1e-6, "{check:?}");
        assert!(check.stiffness_error < 1e-5, "{check:?}");
        assert!(check.definite_shift <= 1e-10, "{check:?}");
    }
}

#[test]
fn forces_and_potential_agree_where_surfaces_touch() {
    let mut world = world("surfaces");
    let motion = moved(&mut world);
    let touching =
        |world: &World| world.contact.surfaces().map(|s| s.contact.pairs().summary().touching);
    assert!(touching(&world).is_some_and(|pairs| pairs > 10), "{:?}", touching(&world));
    let step = |(x, v): (&f64, &f64)| x + 0.001 * v;
    let trial: Vec<f64> = motion.positions.iter().zip(&motion.velocities).map(step).collect();
    let check = check_system(&mut world, &motion.positions, &trial, 0.001).expect("sound");
    assert!(check.force_error < 1e-6, "{check:?}");
    assert!(check.definite_shift <= 1e-10, "{check:?}");
}

#[test]
fn the_loss_of_backward_euler_is_what_its_formula_says() {
    let (mut world, mut twin) = (world(""), world(""));
    let mut motion = moved(&mut world);
    moved(&mut twin);
    let settings = Settings {
        integrator: Integrator::BackwardEuler,
        tolerance: 1e-9,
        energy_balance: true,
        ..Settings::default()
    };
    let mut stepper = Stepper::new(&world, settings).expect("good settings");
    let before = motion.clone();
    let report = stepper.advance(&mut world, &mut motion, 0.005).expect("solvable");
    assert_eq!(report.sub_steps, 1);
    let loss = report.energy.expect("asked for").numerical_dissipation;

    // The same by the work of the forces along the step, in a twin that has not made it.
    twin.begin(before.time + 0.005, 0.005, &before.positions, &mut before.positions.clone());
    let displacements: Vec<f64> =
        motion.positions.iter().zip(&before.positions).map(|(end, start)| end - start).collect();
    let mut power = |part: f64| -> f64 {
        let place: Vec<f64> = before
            .positions
            .iter()
            .zip(&displacements)
            .map(|(start, moved)| start + part * moved)
            .collect();
        let mut forces = vec![0.0; displacements.len()];
        twin.forces(&place, &mut forces);
        forces.iter().zip(&displacements).map(|(force, moved)| force * moved).sum()
    };
    let end = power(1.0);
    // Midpoints: the kinks of contact and friction allow for no better rule.
    let count = 4000;
    let work: f64 = (0..count).map(|k| power((f64::from(k) + 0.5) / f64::from(count))).sum();
    let changes = motion.velocities.chunks_exact(3).zip(before.velocities.chunks_exact(3));
    let kinetic: f64 = changes
        .zip(world.masses())
        .map(|((now, past), mass)| {
            0.5 * mass * now.iter().zip(past).map(|(a, b)| (a - b) * (a - b)).sum::<f64>()
        })
        .sum();
    let formula = kinetic + work / f64::from(count) - end;
    let miss = (loss / formula - 1.0).abs();
    assert!(loss > 0.0 && miss < 1e-4, "{loss:e} J against {formula:e} J");
    let energy = report.energy.expect("asked for");
    assert!(energy.open().abs() < 1e-5 * loss && energy.unproved == 0.0, "{energy:?}");
}
