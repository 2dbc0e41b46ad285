//! Cloth that comes to rest.

use drape_dynamics::{Status, Summary};

use crate::sheet::{CORNERS, FLAT, Sheet};

fn run(sheet: &Sheet) -> (Summary, Vec<f64>) {
    let mut simulation = sheet.simulation();
    let summary = simulation.run(&mut ()).unwrap();
    (summary, simulation.positions().to_vec())
}

fn hung(settle: &str, time: &str) -> Sheet {
    let scene = format!("{CORNERS}[settle]\n{settle}\n[time]\nstep = 0.005\n{time}\n");
    Sheet { scene, panel: FLAT.into(), ..Sheet::default() }
}

#[test]
fn a_cloth_comes_to_rest_where_its_forces_are_balanced() {
    let (summary, _) = run(&hung("residual = 1e-4", "end = 100"));
    assert_eq!(summary.status, Status::Ok);
    assert!(summary.settled && summary.imbalance <= 1e-4, "{}", summary.imbalance);
    assert!(summary.speed_max <= 2e-3, "{}", summary.speed_max);
    // Each of the steps, however long, moves the memory along and accounts for its energy.
    let energy = summary.energy.unwrap();
    assert!(energy.residual.abs() < 1e-3 * -energy.gravity, "{energy:?}");
    assert!(energy.friction_dissipated > 0.0 && energy.numerical_dissipated > 0.0, "{energy:?}");
}

#[test]
fn steps_on_the_way_leave_little_energy_and_the_last_ones_little_force() {
    let mut simulation = hung("", "end = 100").simulation();
    let mut residuals = Vec::new();
    loop {
        let step = simulation.step().unwrap();
        residuals.push(step.report.residual);
        if step.finished {
            break;
        }
    }
    // Those that are solved for their forces have at most a hundredth of g.
    assert!(residuals.iter().any(|residual| *residual > 1e-2), "{residuals:?}");
    assert!(*residuals.last().unwrap() <= 1e-4, "{residuals:?}");
}

#[test]
fn a_cloth_that_has_no_time_to_settle_is_not_said_to_have() {
    let (summary, _) = run(&hung("", "end = 0.2"));
    assert_eq!(summary.status, Status::DidNotSettle);
    assert!(!summary.settled);
    // Balance is asked for as well as speed: a slow start is no rest.
    let slow = hung("speed = 10", "end = 0.2");
    assert_eq!(run(&slow).0.status, Status::DidNotSettle);
}

#[test]
fn rest_waits_for_gravity_to_have_grown() {
    let (summary, _) = run(&hung("", "end = 100\nramp = 2"));
    assert_eq!(summary.status, Status::Ok);
    assert!(summary.simulated_seconds >= 2.0, "{}", summary.simulated_seconds);
}

#[test]
fn the_rest_reached_depends_little_on_the_strides() {
    let rest = |stride: f64| run(&hung(&format!("stride = {stride}"), "end = 1000")).0;
    let potential = |summary: &Summary| summary.energy.map(|e| e.gravity + e.elastic).unwrap();
    let (usual, fine) = (rest(0.025), rest(0.0025));
    let change = potential(&usual) / potential(&fine) - 1.0;
    println!("{} and {} steps: {change:e}", usual.steps, fine.steps);
    assert!(fine.steps > 3 * usual.steps);
    assert!(change.abs() < 0.01, "{change}");
}

#[test]
fn bodies_move_from_when_the_cloth_is_at_rest() {
    let ball = "[[collider.sphere]]\nradius = 0.05\ncenter = [0, -2, 0]\n[collider.sphere.motion]\n\
                times = [0, 0.1]\nshift = [[0, 0, 0], [0, -0.03, 0]]\n";
    let sheet = hung("", &format!("end = 100\n[motion]\nseconds = 0.05\n{ball}"));
    let mut simulation = sheet.simulation();
    let summary = simulation.run(&mut ()).unwrap();
    assert!(summary.settled && summary.phases.len() == 2, "{summary:?}");
    // Half of the way in half of its time, however long the cloth took to come to rest.
    let bodies = simulation.frame().bodies;
    let height = bodies.iter().map(|x| x[1]).sum::<f64>() / bodies.len() as f64;
    assert!((height + 2.015).abs() < 1e-6, "{height} m");
}
