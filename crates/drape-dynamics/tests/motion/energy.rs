//! Balance of the energy, step by step.

use drape_dynamics::{Energy, Simulation};

use crate::sheet::{CORNERS, FLAT, Sheet};

/// Energy that changed its place in a step: half of what all entries gained and lost.
fn exchanged(before: &Energy, after: &Energy) -> f64 {
    let entries = |e: &Energy| {
        let held = [e.kinetic, e.elastic, e.gravity, e.contact, e.work_in];
        let lost = [e.friction_dissipated, e.body_dissipated, e.air_dissipated];
        (held, lost, e.numerical_dissipated)
    };
    let ((h0, l0, n0), (h1, l1, n1)) = (entries(before), entries(after));
    let moved = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (b - a).abs()).sum::<f64>();
    0.5 * (moved(&h0, &h1) + moved(&l0, &l1) + (n1 - n0).abs())
}

/// The largest part of the energy exchanged in a step that the entries leave open, and that goes
/// into the turning of the normals.
fn worst(simulation: &mut Simulation) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    let mut before = simulation.energy().unwrap();
    loop {
        let step = simulation.step().unwrap();
        let after = simulation.energy().unwrap();
        let exchanged = exchanged(&before, &after);
        let open = (after.residual - before.residual).abs() / exchanged;
        let turning = (after.rotation_dissipated - before.rotation_dissipated).abs() / exchanged;
        worst = [worst[0].max(open), worst[1].max(turning)];
        before = after;
        if step.finished {
            return worst;
        }
    }
}

/// A sheet that swings in air onto a ball with friction, pulled at one corner.
fn onto_a_ball(integrator: &str, bending_friction: bool, step: f64) -> Simulation {
    let scene = format!(
        "[[pin]]\npanel = \"sheet\"\npoints = [[0, SIDE]]\n[[pin]]\npanel = \"sheet\"\n\
         points = [[SIDE, SIDE]]\nmotion.times = [0, 0.5]\nmotion.shift = [[0, 0, 0], [-0.1, 0.1, 0]]\n\
         [[collider.sphere]]\nradius = 0.2\ncenter = [0, -0.4, 0]\nfriction = 0.3\n\
         [solver]\nintegrator = \"{integrator}\"\n[time]\nstep = {step}\nend = 0.5\n"
    );
    let panel = FLAT.into();
    Sheet { particles: 21, scene, panel, bending_friction, ..Sheet::default() }.simulation()
}

#[test]
fn every_step_accounts_for_its_energy() {
    for integrator in ["backward-euler", "bdf2"] {
        let mut simulation = onto_a_ball(integrator, true, 0.005);
        let [open, _] = worst(&mut simulation);
        let energy = simulation.energy().unwrap();
        println!("{integrator}: {open:e}\n{energy:?}");
        for (entry, joules) in [
            ("the fabric", energy.friction_dissipated),
            ("the ball", energy.body_dissipated),
            ("the air", energy.air_dissipated),
            ("the pin", energy.work_in.abs()),
        ] {
            assert!(joules > 1e-5, "{integrator}: {entry} took {joules} J");
        }
        assert!(open <= 1e-6, "{integrator}: {open:e} of the energy of a step is missing");
    }
}

#[test]
fn what_the_connectors_remember_is_what_their_potential_says() {
    // Without friction in bending nothing depends on the normals.
    let [_, turning] = worst(&mut onto_a_ball("bdf2", false, 0.005));
    assert!(turning <= 1e-6, "{turning:e} of the energy of a step is missing");
}

#[test]
fn freezing_the_normals_costs_little() {
    let cost = |step: f64| {
        let mut simulation = onto_a_ball("bdf2", true, step);
        worst(&mut simulation);
        let energy = simulation.energy().unwrap();
        energy.rotation_dissipated / energy.friction_dissipated
    };
    let (long, short) = (cost(0.005), cost(0.00125));
    println!("{long:e} and {short:e} of the friction");
    assert!(long.abs() < 0.02 && short.abs() < long.abs(), "{long:e}, {short:e}");
}

/// What a swing loses without any friction, over what it exchanges: all the ups and downs of its
/// weight.
///
/// Much of it is lost when the falling cloth is caught by its corners: the waves that run through
/// it then are too short for the steps.
fn loss(integrator: &str, step: f64, (particles, end): (usize, f64)) -> f64 {
    let scene = format!(
        "air.density = 0.0\n{CORNERS}[solver]\nintegrator = \"{integrator}\"\n[time]\n\
         step = {step}\nend = {end}\n"
    );
    let sheet = Sheet { particles, friction: false, scene, panel: FLAT.into(), ..Sheet::default() };
    let mut simulation = sheet.simulation();
    let (mut fall, mut last) = (0.0_f64, 0.0);
    let mut exchanged = 0.0;
    while !simulation.step().unwrap().finished {
        let energy = simulation.energy().unwrap();
        exchanged += (energy.gravity - last).abs();
        last = energy.gravity;
        fall = fall.max(-energy.gravity);
    }
    let lost = simulation.energy().unwrap().numerical_dissipated;
    println!(
        "n = {particles}, {integrator} at {step} s for {end} s: lost {lost:.5} J, fell {fall:.5} J, \
         exchanged {exchanged:.5} J: {:.3} % and {:.3} % per second",
        100.0 * lost / fall / end,
        100.0 * lost / exchanged
    );
    lost / exchanged
}

#[test]
fn the_second_order_formula_loses_a_small_part_of_what_the_first_order_one_does() {
    let second = loss("bdf2", 0.005, (15, 1.0));
    let first = loss("backward-euler", 0.005, (15, 1.0));
    assert!(second > 0.0 && second < 0.04, "{second}");
    assert!(first > 3.0 * second, "{first} against {second}");
}

#[test]
#[ignore = "a study of some minutes"]
fn losses_of_a_violent_swing() {
    for particles in [20, 40] {
        for step in [0.001, 0.0025, 0.005] {
            for integrator in ["bdf2", "backward-euler"] {
                loss(integrator, step, (particles, 1.0));
            }
        }
    }
}
