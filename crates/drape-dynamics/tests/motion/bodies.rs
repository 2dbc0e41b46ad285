//! Bodies that move.

use drape_dynamics::Simulation;

use crate::sheet::{FLAT, Sheet};

fn run(sheet: &Sheet) -> Simulation {
    let mut simulation = sheet.simulation();
    while !simulation.step().unwrap().finished {}
    simulation
}

fn middle(simulation: &Simulation) -> [f64; 3] {
    let positions = simulation.positions().to_vec();
    let count = positions.len() as f64 / 3.0;
    let mut sum = [0.0; 3];
    positions.chunks_exact(3).for_each(|x| (0..3).for_each(|axis| sum[axis] += x[axis] / count));
    sum
}

#[test]
fn a_belt_carries_the_cloth_along() {
    // Longer than Coulomb's friction needs to bring it to speed, 0.1/(0.5 g) = 20 ms.
    let belt = |friction: f64| {
        let scene = format!(
            "air.density = 0.0\n[[collider.plane]]\nfriction = {friction}\n[collider.plane.motion]\n\
             times = [0, 0.5]\nshift = [[0, 0, 0], [0.05, 0, 0]]\n[time]\nstep = 0.002\nend = 0.5\n"
        );
        let panel = format!("{FLAT}center = [0, 9.9902e-4, 0]\n");
        run(&Sheet { side: 0.2, scene, panel, ..Sheet::default() })
    };
    let displacement = middle(&belt(0.5))[0];
    // It lags by half of 0.1 m/s for 20 ms, and creeps within the slip speed of 1 mm/s.
    assert!((displacement - 0.049).abs() < 7e-4, "{displacement}");
    let still = middle(&belt(0.0))[0];
    assert!(still.abs() < 1e-7, "{still}");
}

#[test]
fn the_work_of_bodies_is_accounted_for() {
    let scene = "air.density = 0.0\n[[collider.sphere]]\nradius = 0.05\ncenter = [0, -0.052, 0]\n\
                 friction = 0.3\n[collider.sphere.motion]\ntimes = [0, 0.2]\n\
                 shift = [[0, 0, 0], [0.02, 0.08, 0]]\nturn = [[0, 0, 0], [0, 40, 0]]\n\
                 [time]\nstep = 0.002\nend = 0.2\n";
    let sheet = Sheet { side: 0.2, scene: scene.into(), panel: FLAT.into(), ..Sheet::default() };
    let simulation = run(&sheet);
    let energy = simulation.energy().unwrap();
    // The ball lifts the middle of a sheet of 8 g by some centimetres.
    assert!(energy.work_in > 0.5 * energy.gravity && energy.gravity > 1e-4, "{energy:?}");
    assert!(energy.residual.abs() < 1e-6 * energy.work_in, "{energy:?}");
}
