//! States saved in memory, after steering: a simulation that is reset repeats its bytes.

use drape_checkpoint::{Checkpoint, Identity};
use drape_dynamics::{BodyTarget, Displacement, PinTarget, SavedSimulation, Simulation};
use rayon::ThreadPoolBuilder;

use crate::{BALL, EDGE, MASS, PARTICLES, scene};

/// Keys of the scenes: with surfaces, with particles, and with steps of a chosen error.
const KEYS: [&str; 3] = [
    "air.density = 1.2",
    "air.density = 1.2\ncontact.surfaces = false",
    "air.density = 1.2\ntime = { step = 0.002, end = 10, error = 1e-5 }",
];

/// Tables of the scenes: a ball that the scene turns, and pins that the scene moves and releases.
fn tables() -> String {
    let turning = "[collider.sphere.motion]\ntimes = [0, 0.5]\nturn = [[0, 0, 0], [0, 90, 0]]\n";
    let moving = "motion = { times = [0, 1], shift = [[0, 0, 0], [0, 0.02, 0]] }\n";
    let bottom = EDGE.replace("top", "bottom");
    format!("{BALL}{turning}{EDGE}{moving}{bottom}release = 0.05\n")
}

fn simulation(keys: &str) -> Simulation {
    Simulation::new(scene(keys, &tables())).unwrap()
}

/// Steers everything that can be steered.
fn steer(simulation: &mut Simulation) {
    simulation.set_gravity([0.5, -4.0, 0.0]).unwrap();
    simulation.set_air_velocity([0.0, 1.0, 2.0]).unwrap();
    let mut forces = vec![0.0; 3 * PARTICLES];
    forces[3 * 24 + 1] = 2e-4;
    simulation.apply_forces(&forces).unwrap();
    let held = simulation.hold(&[3, 10]).unwrap();
    let lift = PinTarget::Rigid(Displacement {
        shift: [0.0, 0.01, 0.0],
        turn: [0.0, 5.0, 0.0],
        ..Displacement::default()
    });
    simulation.lead_pin(held, &lift, 0.06).unwrap();
    let first = simulation.pin_particles(0).unwrap()[0];
    simulation.lead_pin(0, &lift, 0.08).unwrap();
    simulation.release(&[first]).unwrap();
    let lower =
        BodyTarget::Rigid(Displacement { shift: [0.0, -0.004, 0.0], ..Displacement::default() });
    simulation.lead_body("ball", &lower, 0.04).unwrap();
}

/// Makes `steps` steps and returns the hash of the state after each, with what a picture shows.
fn run(simulation: &mut Simulation, steps: usize) -> Vec<String> {
    let mut states = Vec::new();
    for _ in 0..steps {
        simulation.step().unwrap();
        let bodies = simulation.bodies();
        let energy = simulation.energy();
        states.push(format!("{} {energy:?} {bodies:?}", simulation.state_hash()));
    }
    states
}

#[test]
fn a_reset_simulation_repeats_its_bytes() {
    for keys in KEYS {
        let mut simulation = simulation(keys);
        run(&mut simulation, 5);
        let calm = simulation.saved();
        let unsteered = run(&mut simulation, 30);
        simulation.resume(calm.clone()).unwrap();
        steer(&mut simulation);
        let first = run(&mut simulation, 10);
        let steered = simulation.saved();
        let second = run(&mut simulation, 30);
        assert_ne!(first, unsteered[..10], "{keys}");

        // To a state after steering: all that was steered goes on.
        simulation.resume(steered.clone()).unwrap();
        assert!(run(&mut simulation, 30) == second, "{keys}: after steering");
        // To a state before steering: nothing of it is left.
        simulation.resume(calm.clone()).unwrap();
        assert_eq!((simulation.gravity(), simulation.pin_count()), ([0.0, -9.81, 0.0], 2));
        assert!(run(&mut simulation, 30) == unsteered, "{keys}: without steering");
        // The same steering has the same results.
        simulation.resume(calm).unwrap();
        steer(&mut simulation);
        assert!(run(&mut simulation, 10) == first, "{keys}: steered again");
        assert!(run(&mut simulation, 30) == second, "{keys}: steered again");
    }
}

#[test]
fn a_new_simulation_goes_on_from_a_steered_state_in_memory_or_in_bytes() {
    for keys in KEYS {
        let mut simulation = simulation(keys);
        run(&mut simulation, 5);
        steer(&mut simulation);
        run(&mut simulation, 10);
        let saved = simulation.saved();
        let mut checkpoint = Checkpoint::new(Identity::new("test"));
        saved.write(&mut checkpoint).unwrap();
        let mut bytes = Vec::new();
        checkpoint.encode(&mut bytes).unwrap();
        let read = SavedSimulation::read(&Checkpoint::decode(&bytes).unwrap()).unwrap();
        let on = run(&mut simulation, 30);
        for saved in [saved, read] {
            let mut anew = self::simulation(keys);
            anew.resume(saved).unwrap();
            assert_eq!(anew.gravity(), [0.5, -4.0, 0.0]);
            assert_eq!(anew.pin_count(), 3);
            assert!(run(&mut anew, 30) == on, "{keys}");
        }
    }
}

#[test]
fn bodies_are_where_the_saved_state_has_them_before_the_next_step() {
    for keys in KEYS {
        let mut simulation = simulation(keys);
        steer(&mut simulation);
        run(&mut simulation, 10);
        let (saved, bodies) = (simulation.saved(), simulation.bodies());
        run(&mut simulation, 10);
        simulation.resume(saved).unwrap();
        let pairs = simulation.bodies().into_iter().zip(bodies);
        for ((_, now), (_, before)) in pairs {
            let vertices = now.vertices.iter().flatten().zip(before.vertices.iter().flatten());
            let apart = vertices.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-12, "{keys}: {apart:e} m");
        }
    }
}

#[test]
fn threads_change_no_bit_of_a_steered_run() {
    let run = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut simulation = simulation(KEYS[0]);
            run(&mut simulation, 5);
            steer(&mut simulation);
            run(&mut simulation, 40)
        })
    };
    let one = run(1);
    assert!([2, 5].iter().all(|&threads| run(threads) == one));
}

#[test]
fn a_relaxing_cloth_is_reset_with_the_gravity_of_all_its_grids() {
    let keys = "settle = { speed = 0.02, residual = 0.02 }\nrefine.spacings = [0.06, 0.04]\n\
                time = { step = 0.005, end = 100 }";
    let scene = || Simulation::new(scene(keys, EDGE)).unwrap();
    let mut simulation = scene();
    simulation.step().unwrap();
    simulation.set_gravity([0.0, -3.0, 0.0]).unwrap();
    let saved = simulation.saved();
    let refused = [
        simulation.hold(&[0]).map(|_| ()),
        simulation.release(&[0]),
        simulation.lead_pin(0, &PinTarget::Place([0.0; 3]), 1.0),
    ];
    for answer in refused {
        let message = answer.unwrap_err().to_string();
        assert!(message.contains("coarser grid"), "{message}");
    }
    while !simulation.step().unwrap().finished {}
    let load = simulation.pin_loads()[0].force[1];
    assert!((load / (-MASS * 3.0) - 1.0).abs() < 0.05, "{load} N");
    let mut anew = scene();
    anew.resume(saved).unwrap();
    while !anew.step().unwrap().finished {}
    assert_eq!(anew.state_hash(), simulation.state_hash());
}
