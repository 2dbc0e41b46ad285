//! Pins that are led, particles that are held and released.

use drape_dynamics::{Displacement, PinTarget, Simulation};

use crate::{BALL, CORNER, EDGE, MASS, PARTICLES, STEP};
use crate::{assert_closed, balanced, distance, mean, position, simulation};

/// Corner of the sheet that [`CORNER`] holds.
fn corner(simulation: &Simulation) -> usize {
    let [particle] = simulation.pin_particles(0).unwrap() else { panic!("one particle") };
    *particle
}

/// Place on a circle of 3 cm at a time, in s: a turn in 0.6 s.
fn circle(start: [f64; 3], time: f64) -> [f64; 3] {
    let angle = time / 0.6 * std::f64::consts::TAU;
    let radius = 0.03;
    [start[0] + radius * (angle.cos() - 1.0), start[1] + radius * angle.sin(), start[2]]
}

#[test]
fn a_led_pin_meets_its_path_at_the_end_of_each_step() {
    for keys in ["", "contact.surfaces = false", "solver.integrator = \"backward-euler\""] {
        let mut simulation = simulation(keys, &format!("{BALL}{CORNER}"));
        let particle = corner(&simulation);
        let start = position(&simulation, particle);
        for step in 1..=100 {
            let place = circle(start, f64::from(step) * STEP);
            let seconds = simulation.next_step();
            simulation.lead_pin(0, &PinTarget::Place(place), seconds).unwrap();
            simulation.step().unwrap();
            let miss = distance(position(&simulation, particle), place);
            assert!(miss < 1e-15, "{keys}: {miss:e} m after step {step}");
        }
        // The pin stays where it was led last.
        let last = position(&simulation, particle);
        for _ in 0..5 {
            simulation.step().unwrap();
        }
        assert!(distance(position(&simulation, particle), last) < 1e-15);
    }
}

#[test]
fn a_pin_is_led_as_by_a_motion_of_the_scene() {
    let motion = "[pin.motion]\ntimes = [0, 0.1]\nshift = [[0, 0, 0], [0.01, 0.02, 0]]\n\
                  turn = [[0, 0, 0], [0, 0, 20]]\n";
    let mut of_scene = simulation("", &format!("{EDGE}{motion}"));
    let mut led = simulation("", EDGE);
    let target = PinTarget::Rigid(Displacement {
        shift: [0.01, 0.02, 0.0],
        turn: [0.0, 0.0, 20.0],
        ..Displacement::default()
    });
    led.lead_pin(0, &target, 0.1).unwrap();
    for _ in 0..60 {
        of_scene.step().unwrap();
        led.step().unwrap();
    }
    let pairs = of_scene.positions().iter().zip(led.positions());
    let apart = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-9, "{apart:e} m apart");
    let [a, b] = [of_scene, led].map(|simulation| simulation.energy().unwrap().work_in);
    assert!((a / b - 1.0).abs() < 1e-6 && a > 0.0, "{a} J and {b} J");
}

#[test]
fn a_pin_that_holds_in_some_directions_is_led_in_these() {
    let tables = format!("{EDGE}axes = [\"y\"]\n");
    let mut simulation = simulation("", &tables);
    let target =
        PinTarget::Rigid(Displacement { shift: [0.0, 0.02, 0.0], ..Displacement::default() });
    simulation.lead_pin(0, &target, 0.1).unwrap();
    for _ in 0..50 {
        simulation.step().unwrap();
    }
    for &particle in simulation.pin_particles(0).unwrap() {
        let height = position(&simulation, particle)[1];
        // A spring of 1e5 N/m that bears the weight of a particle.
        assert!((height - 0.02).abs() < 1e-6, "{height} m");
    }
}

#[test]
fn the_work_of_a_led_pin_is_in_the_account() {
    let mut simulation = balanced("", &format!("{BALL}{CORNER}"));
    let start = position(&simulation, corner(&simulation));
    for step in 1..=60 {
        let place = circle(start, f64::from(step) * STEP);
        simulation.lead_pin(0, &PinTarget::Place(place), STEP).unwrap();
        simulation.step().unwrap();
    }
    let energy = simulation.energy().unwrap();
    assert!(energy.work_in.abs() > 1e-4 * -energy.gravity, "{energy:?}");
    assert_closed(&energy);
}

#[test]
fn a_held_particle_stays_to_the_last_bit_and_gives_up_its_kinetic_energy() {
    let mut simulation = balanced("", "");
    for _ in 0..50 {
        simulation.step().unwrap();
    }
    let speed = simulation.velocities()[3 * 24 + 1];
    assert!((speed / (-9.81 * 50.0 * STEP) - 1.0).abs() < 1e-6, "{speed} m/s");
    let before = simulation.energy().unwrap();
    let places = [0, 24].map(|particle| position(&simulation, particle));
    let pin = simulation.hold(&[24, 0, 24]).unwrap();
    assert_eq!((pin, simulation.pin_count()), (0, 1));
    assert_eq!(simulation.pin_particles(pin).unwrap(), [0, 24]);

    // A quarter of a cell and a whole one had the speed of the fall.
    let after = simulation.energy().unwrap();
    let lost = 0.5 * 1.25 * MASS / 36.0 * speed * speed;
    let taken = before.kinetic - after.kinetic;
    assert!((taken / lost - 1.0).abs() < 1e-6, "{before:?} {after:?}");
    assert!((after.work_in + taken).abs() < 1e-9 * taken, "{after:?}");
    for _ in 0..50 {
        simulation.step().unwrap();
        let now = [0, 24].map(|particle| position(&simulation, particle));
        assert_eq!(now, places);
    }
    assert_closed(&simulation.energy().unwrap());
    assert!(simulation.pin_loads()[pin].force[1] < 0.0, "the sheet hangs from the pin");
}

#[test]
fn a_released_sheet_falls_freely() {
    let mut simulation = balanced("solver.tolerance = 1e-8", EDGE);
    let all: Vec<usize> = (0..PARTICLES).collect();
    let pin = simulation.hold(&all).unwrap();
    assert_eq!(simulation.pin_particles(0).unwrap(), [0; 0], "the edge is taken over");
    let start = simulation.positions().to_vec();
    for _ in 0..20 {
        simulation.step().unwrap();
    }
    assert_eq!(simulation.positions(), start);
    let loads = simulation.pin_loads();
    assert_eq!(loads[0].force, [0.0; 3]);
    assert!((loads[pin].force[1] / (-9.81 * MASS) - 1.0).abs() < 1e-9, "{loads:?}");

    simulation.release(&all).unwrap();
    for _ in 0..20 {
        simulation.step().unwrap();
    }
    let before = mean(simulation.velocities());
    simulation.step().unwrap();
    let after = mean(simulation.velocities());
    let acceleration = (after[1] - before[1]) / STEP;
    assert!((acceleration / -9.81 - 1.0).abs() < 1e-6, "{acceleration} m/s²");
    let fallen = mean(&start)[1] - mean(simulation.positions())[1];
    let exact = 0.5 * 9.81 * (21.0 * STEP).powi(2);
    // BDF2 spreads the jump of the force over a step.
    assert!((fallen - exact).abs() < 9.81 * 21.0 * STEP * STEP, "{fallen} m of {exact} m");
    assert_closed(&simulation.energy().unwrap());
    assert_eq!(simulation.hold(&[5]).unwrap(), pin, "the number of the empty pin is free");
}

#[test]
fn particles_of_a_pin_are_released_alone() {
    let mut simulation = simulation("", EDGE);
    let held = simulation.pin_particles(0).unwrap().to_vec();
    let (freed, kept) = (held[0], held[held.len() - 1]);
    let start = [freed, kept].map(|particle| position(&simulation, particle));
    simulation.release(&held[..3]).unwrap();
    for _ in 0..60 {
        simulation.step().unwrap();
    }
    let [fallen, stayed] = [freed, kept].map(|particle| position(&simulation, particle));
    assert_eq!(stayed, start[1]);
    assert!(fallen[1] < start[0][1] - 0.005, "{fallen:?} of {start:?}");
    assert_eq!(simulation.pin_particles(0).unwrap(), &held[3..]);
}

#[test]
fn what_does_not_fit_is_refused_and_changes_nothing() {
    let mut simulation = simulation("", CORNER);
    let hash = simulation.state_hash();
    let place = PinTarget::Place([0.0; 3]);
    let turn = |turn: f64| {
        PinTarget::Rigid(Displacement {
            shift: [0.0; 3],
            turn: [turn, 0.0, 0.0],
            center: Some([0.0; 3]),
        })
    };
    let cases = [
        (simulation.lead_pin(9, &place, 1.0), "there is no pin 9; the simulation has 1"),
        (simulation.lead_pin(usize::MAX, &place, 1.0), "there is no pin"),
        (simulation.lead_pin(0, &place, 0.0), "a time above 0"),
        (simulation.lead_pin(0, &place, f64::NAN), "a time above 0"),
        (simulation.lead_pin(0, &PinTarget::Place([0.0, f64::NAN, 0.0]), 1.0), "NaN"),
        (simulation.lead_pin(0, &PinTarget::Place([f64::INFINITY; 3]), 1.0), "inf"),
        (simulation.lead_pin(0, &turn(f64::NAN), 1.0), "NaN"),
        (simulation.lead_pin(0, &place, 1e-4), "pin 0 moves at"),
        (simulation.lead_pin(0, &place, 1e-300), "give a length of a step"),
        (simulation.hold(&[]).map(|_| ()), "no particles to hold"),
        (simulation.hold(&[3, 49]).map(|_| ()), "there is no particle 49; the cloth has 49"),
        (simulation.release(&[usize::MAX]), "there is no particle"),
        (simulation.release(&[24]), "no pin holds particle 24"),
        (simulation.pin_particles(1).map(|_| ()), "there is no pin 1"),
    ];
    for (answer, words) in cases {
        let message = answer.expect_err(words).to_string();
        assert!(message.contains(words), "{message}");
    }
    assert_eq!(simulation.pin_count(), 1);
    simulation.release(&[corner(&simulation)]).unwrap();
    let message = simulation.lead_pin(0, &place, 1.0).unwrap_err().to_string();
    assert!(message.contains("pin 0 holds no particle any more"), "{message}");
    assert_eq!(simulation.state_hash(), hash);
}

#[test]
fn a_jump_late_in_a_run_is_refused_by_its_speed_or_its_time() {
    let mut simulation = simulation("gravity = [0, 0, 0]", CORNER);
    for _ in 0..3 {
        simulation.step().unwrap();
    }
    let start = position(&simulation, corner(&simulation));
    let place = PinTarget::Place([start[0], start[1] + 0.1, start[2]]);
    for exponent in 3..30 {
        let seconds = 10_f64.powi(-exponent);
        let message = simulation.lead_pin(0, &place, seconds).unwrap_err().to_string();
        let words = ["pin 0 moves at", "give a length of a step"];
        assert!(words.iter().any(|words| message.contains(words)), "{seconds:e}: {message}");
    }
}
