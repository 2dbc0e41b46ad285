//! Panels that are all grid: areas, conservation, and known energies.

use drape_cloth::{Cloth, Lattice};
use drape_fabric::Law;

use crate::consistency::grids;
use crate::panels::{LINEN, fabric};
use crate::shaken::{Random, balance, bent, tried};

#[test]
fn connector_areas_add_up_to_the_area_of_the_panel() {
    for (name, lattice) in grids() {
        let areas = Cloth::new(&[(&lattice, &fabric(LINEN))]).expect("a cloth").connector_areas();
        let all = [areas.traction, areas.bending, [areas.shear; 2]].concat();
        for area in all {
            let error = area / lattice.area() - 1.0;
            assert!(error.abs() < 1e-12, "{name}: {areas:?}, panel {}", lattice.area());
        }
    }
}

#[test]
fn internal_forces_and_torques_cancel() {
    let elastic: String =
        LINEN.lines().filter(|l| !l.starts_with("friction")).collect::<Vec<_>>().join("\n");
    let elastic = elastic.replace("rest_curvature = 3.0", "");
    for (name, lattice) in grids() {
        // Without friction and rest curvature nothing depends on the frozen normal.
        let (cloth, state, trial) = tried(&lattice, &fabric(&elastic), 1e-3, 0.07);
        let (force, torque) = balance(&cloth, &state, &trial);
        println!("{name}: elastic, net force {force:.1e}, net torque {torque:.1e}");
        assert!(force < 1e-12 && torque < 1e-12, "{name}: {force:e} {torque:e}");
        // The error of the frozen normal: the friction moment times the part of the curvature
        // across the normal. Noise of the positions and rotation within the step both raise it.
        for (step, shake, radius, limit) in
            [("one of a simulation", 1e-5, 0.0602, 1e-7), ("a violent one", 1e-3, 0.07, 1e-5)]
        {
            let (cloth, state, trial) = tried(&lattice, &fabric(LINEN), shake, radius);
            let (force, torque) = balance(&cloth, &state, &trial);
            println!("{name}: with friction, step {step}: force {force:.1e}, torque {torque:.1e}");
            assert!(force < 1e-12, "{name}: net force {force:e}");
            // At ragged corners yarns of two particles give normals of the first order only.
            let limit = if name == "bias" { 3.0 * limit } else { limit };
            assert!(torque < limit, "{name}: net torque {torque:e}");
        }
    }
}

#[test]
fn forces_rotate_with_the_cloth() {
    let lattice = Lattice::rectangle(0.10, 0.08, 0.012).expect("a rectangle");
    let (cloth, state, trial) = tried(&lattice, &fabric(LINEN), 1e-3, 0.07);
    let rotate = |x: &[f64]| -> Vec<f64> { x.chunks(3).flat_map(|p| [p[2], p[0], p[1]]).collect() };
    let mut forces = vec![0.0; trial.len()];
    cloth.add_forces(&state, &trial, &mut forces).expect("the lists fit");
    let mut rotated_state = cloth.state(rotate(&state.positions)).expect("fits");
    // The same path, rotated.
    let mut random = Random(7);
    rotated_state
        .clone_from(&cloth.state(rotate(&bent(&lattice, 0.4, 0.0, &mut random))).expect("fits"));
    for radius in [0.1, 0.06] {
        let positions = rotate(&bent(&lattice, radius, 1e-3, &mut random));
        cloth
            .commit(&mut rotated_state, &positions, &vec![0.0; trial.len()])
            .expect("the lists fit");
    }
    let mut rotated = vec![0.0; trial.len()];
    cloth.add_forces(&rotated_state, &rotate(&trial), &mut rotated).expect("the lists fit");
    let scale = forces.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
    for (a, b) in rotate(&forces).iter().zip(&rotated) {
        assert!((a - b).abs() < 1e-10 * scale, "{a} against {b}");
    }
}

#[test]
fn a_cylinder_has_the_energy_of_the_fabric_bent_to_its_curvature() {
    let fabric = fabric(&LINEN.replace("rest_curvature = 3.0", ""));
    let radius = 0.1;
    let mut errors = Vec::new();
    for spacing in [0.02, 0.01, 0.005] {
        let lattice = Lattice::rectangle(0.2, 0.2, spacing).expect("a rectangle");
        let cloth = Cloth::new(&[(&lattice, &fabric)]).expect("a cloth");
        let flat: Vec<f64> = lattice.coordinates().iter().flat_map(|&[u, v]| [u, 0.0, v]).collect();
        let mut state = cloth.state(flat.clone()).expect("fits");
        // The sheet turns by its length over the radius, and its chords are kept at their rest
        // length, so that bending alone stores energy.
        let turn = lattice.spacing()[1] / radius;
        let corner = 0.5 * lattice.spacing()[1] / (0.5 * turn).sin();
        let rolled: Vec<f64> = lattice
            .coordinates()
            .iter()
            .flat_map(|&[u, v]| {
                let angle = v / lattice.spacing()[1] * turn;
                [u, corner * (1.0 - angle.cos()), corner * angle.sin()]
            })
            .collect();
        // After the commit the friction has slipped by the true curvature, however far the sheet
        // rotated.
        let dissipated =
            cloth.commit(&mut state, &rolled, &vec![0.0; flat.len()]).expect("the lists fit");
        let work = cloth.stored(&state).expect("the lists fit") + dissipated;
        let bending = fabric.warp.bending;
        let exact = lattice.area() * bending.work(&bending.virgin(), 1.0 / radius);
        errors.push(work / exact - 1.0);
    }
    println!("cylinder energy errors {errors:?}");
    assert!(errors.iter().all(|e| e.abs() < 1e-10), "{errors:?}");
}

#[test]
fn a_stretched_and_sheared_sheet_pulls_as_its_laws_say() {
    let fabric = fabric(&LINEN.replace("rest_curvature = 3.0", ""));
    let lattice = Lattice::rectangle(0.1, 0.1, 0.01).expect("a rectangle");
    let cloth = Cloth::new(&[(&lattice, &fabric)]).expect("a cloth");
    let flat: Vec<f64> = lattice.coordinates().iter().flat_map(|&[u, v]| [u, 0.0, v]).collect();
    let state = cloth.state(flat).expect("fits");
    // Warp stretched by 4 %, then leaned over: the sine of the shear angle is exactly 0.1.
    let (sin, cos) = (0.1, (1.0_f64 - 0.01).sqrt());
    let place = |&[u, v]: &[f64; 2]| [u + 1.04 * v * sin, 0.0, 1.04 * v * cos];
    let leaned: Vec<f64> = lattice.coordinates().iter().flat_map(place).collect();
    let mut forces = vec![0.0; leaned.len()];
    cloth.add_forces(&state, &leaned, &mut forces).expect("the lists fit");
    // The top edge is the last row; the force on it per width, along and across the warp.
    let columns = 11;
    let top = &forces[forces.len() - 3 * columns..];
    let pull: f64 = top.chunks(3).map(|f| -(f[0] * sin + f[2] * cos)).sum::<f64>() / 0.1;
    let push: f64 = top.chunks(3).map(|f| -(f[0] * cos - f[2] * sin)).sum::<f64>() / 0.1;
    let law = fabric.warp.traction;
    let tension = law.respond(&law.virgin(), 0.04).load;
    let shear = fabric.shear.respond(&fabric.shear.virgin(), 0.1).load;
    assert!((pull / tension - 1.0).abs() < 1e-9, "tension {pull}, law {tension}");
    // Per length of the deformed edge's partner: the couple's arm is the stretched warp edge.
    let expected = shear * cos / 1.04;
    assert!((push / expected - 1.0).abs() < 1e-9, "shear {push}, law {expected}");
    let interior: f64 = forces[3 * columns..forces.len() - 3 * columns]
        .chunks(3 * columns)
        .flat_map(|row| row[3..row.len() - 3].to_vec())
        .fold(0.0, |m, f| m.max(f.abs()));
    assert!(interior < 1e-11 * tension, "inside, all forces cancel: {interior}");
}
