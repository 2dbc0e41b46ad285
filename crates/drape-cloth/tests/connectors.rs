//! Forces and tangents against finite differences, conservation, and known energies.

use drape_cloth::{Cloth, Grain, Lattice, State};
use drape_fabric::{Fabric, Law};
use drape_input::Document;

/// Linen with every feature on: toe with memory, second-order bending, nested shear friction.
const LINEN: &str = r#"
name = "linen"
density = 0.18
thickness = 0.0004
[shear]
stiffness = 40.0
growth = 6.0
friction = [{ plateau = 0.6, length = 0.006 }, { plateau = 0.2, length = 0.05 }]
locking = { onset = 0.139, limit = 0.867 }
[warp.traction]
friction = [{ plateau = 4.0, length = 0.001 }]
primed = { stiffness = 9000.0, toe_ratio = 0.6, toe_strain = 0.02, toe_strain_after = 0.03 }
[warp.bending]
rigidity = 2.5e-5
rest_curvature = 3.0
friction = [{ plateau = 9e-4, length = 3.0 }, { plateau = -2e-4, length = 20.0 }]
[weft.traction]
polynomial = { quadratic = 8.4e4, quartic = 1.2e7 }
[weft.bending]
piecewise = { slope = 2e-5, intercept = 4e-4, knot = 40.0 }
"#;

fn fabric(text: &str) -> Fabric {
    Fabric::from_document(&Document::new("linen.toml", text)).expect("the fabric is right")
}

struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }
}

/// Positions of a lattice rolled on a cylinder about an axis at 30° to the weft, and shaken.
fn bent(lattice: &Lattice, radius: f64, shake: f64, random: &mut Random) -> Vec<f64> {
    let (sin, cos) = 0.5_f64.sin_cos();
    let place = |[u, v]: [f64; 2]| {
        let (along, across) = (cos * u + sin * v, cos * v - sin * u);
        let angle = across / radius;
        [1.02 * along, 1.01 * radius * (1.0 - angle.cos()), 1.01 * radius * angle.sin()]
    };
    let shaken = |x: f64| x + shake * random.next();
    lattice.coordinates.iter().flat_map(|&c| place(c)).map(shaken).collect()
}

/// A cloth with history: committed twice on the way to a shaken shape, and a trial at the radius.
fn tried(
    lattice: &Lattice,
    fabric: &Fabric,
    (shake, radius): (f64, f64),
) -> (Cloth, State, Vec<f64>) {
    let mut random = Random(7);
    let cloth = Cloth::new(&[(lattice, fabric)]);
    let mut state = cloth.state(bent(lattice, 0.4, 0.0, &mut random)).expect("fits");
    let rest = vec![0.0; 3 * cloth.particles()];
    for way in [0.1, 0.06] {
        let positions = bent(lattice, way, shake, &mut random);
        cloth.commit(&mut state, &positions, &rest);
    }
    let trial = bent(lattice, radius, shake, &mut random);
    (cloth, state, trial)
}

fn worn(lattice: &Lattice, fabric: &Fabric, shake: f64) -> (Cloth, State, Vec<f64>) {
    tried(lattice, fabric, (shake, 0.07))
}

fn panels() -> Vec<(&'static str, Lattice)> {
    vec![
        ("rectangle", Lattice::rectangle(0.10, 0.08, 0.012).expect("a rectangle")),
        ("disc", Lattice::disc(0.05, 0.011).expect("a disc")),
        (
            "bias",
            Lattice::rectangle_at(Grain::from_degrees(33.0), [0.0; 2], [0.10, 0.08], 0.012)
                .expect("a rectangle"),
        ),
    ]
}

#[test]
fn connector_areas_add_up_to_the_area_of_the_panel() {
    for (name, lattice) in panels() {
        let areas = Cloth::new(&[(&lattice, &fabric(LINEN))]).connector_areas();
        let all = [areas.traction, areas.bending, [areas.shear; 2]].concat();
        for area in all {
            let error = area / lattice.area() - 1.0;
            assert!(error.abs() < 1e-12, "{name}: {areas:?}, panel {}", lattice.area());
        }
    }
}

#[test]
fn forces_are_the_derivative_of_the_potential() {
    for (name, lattice) in panels() {
        let (cloth, state, trial) = worn(&lattice, &fabric(LINEN), 1e-3);
        let mut forces = vec![0.0; trial.len()];
        cloth.add_forces(&state, &trial, &mut forces);
        let scale = forces.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
        let d = 2e-7;
        let mut worst = 0.0_f64;
        for dof in 0..trial.len() {
            let at = |k: f64| {
                let mut moved = trial.clone();
                moved[dof] += k * d;
                cloth.potential(&state, &moved)
            };
            let slope = (at(-2.0) - 8.0 * at(-1.0) + 8.0 * at(1.0) - at(2.0)) / (12.0 * d);
            worst = worst.max((forces[dof] + slope).abs() / scale);
        }
        println!("{name}: force against potential {worst:.1e}");
        assert!(worst < 1e-7, "{name}: relative error {worst:e}");
    }
}

/// Multiplies the symmetric block matrix with a vector.
fn multiply(cloth: &Cloth, values: &[f64], vector: &[f64]) -> Vec<f64> {
    let pattern = cloth.pattern();
    let mut product = vec![0.0; vector.len()];
    for row in 0..cloth.particles() {
        for slot in pattern.offsets[row]..pattern.offsets[row + 1] {
            let column = pattern.columns[slot];
            for i in 0..3 {
                for j in 0..3 {
                    let value = values[9 * slot + 3 * i + j];
                    product[3 * row + i] += value * vector[3 * column + j];
                    if row != column {
                        product[3 * column + j] += value * vector[3 * row + i];
                    }
                }
            }
        }
    }
    product
}

#[test]
fn the_stiffness_is_the_derivative_of_the_forces() {
    for (name, lattice) in panels() {
        let (cloth, state, trial) = worn(&lattice, &fabric(LINEN), 1e-3);
        let mut values = vec![0.0; 9 * cloth.pattern().blocks()];
        cloth.add_stiffness(&state, &trial, false, &mut values);
        let mut random = Random(11);
        let mut worst = 0.0_f64;
        for _ in 0..20 {
            let direction: Vec<f64> = trial.iter().map(|_| random.next()).collect();
            let product = multiply(&cloth, &values, &direction);
            // Of the size at which truncation and rounding balance, away from the laws' corners.
            let d = 2e-8;
            let at = |k: f64| {
                let moved: Vec<f64> =
                    trial.iter().zip(&direction).map(|(x, v)| x + k * d * v).collect();
                let mut forces = vec![0.0; trial.len()];
                cloth.add_forces(&state, &moved, &mut forces);
                forces
            };
            let (m2, m1, p1, p2) = (at(-2.0), at(-1.0), at(1.0), at(2.0));
            let scale = product.iter().fold(0.0, |m: f64, p| m.max(p.abs()));
            for dof in 0..trial.len() {
                let slope = (m2[dof] - 8.0 * m1[dof] + 8.0 * p1[dof] - p2[dof]) / (12.0 * d);
                worst = worst.max((product[dof] + slope).abs() / scale);
            }
        }
        println!("{name}: stiffness against forces {worst:.1e}");
        assert!(worst < 1e-6, "{name}: relative error {worst:e}");
    }
}

#[test]
fn the_definite_stiffness_has_no_negative_direction() {
    for (name, lattice) in panels() {
        let (cloth, state, trial) = worn(&lattice, &fabric(LINEN), 3e-3);
        let mut values = vec![0.0; 9 * cloth.pattern().blocks()];
        cloth.add_stiffness(&state, &trial, true, &mut values);
        let mut random = Random(5);
        for _ in 0..300 {
            let direction: Vec<f64> = trial.iter().map(|_| random.next()).collect();
            let product = multiply(&cloth, &values, &direction);
            let curvature: f64 = direction.iter().zip(&product).map(|(a, b)| a * b).sum();
            assert!(curvature > 0.0, "{name}: {curvature}");
        }
    }
}

/// Sums of the internal forces and torques over the sums of their magnitudes.
fn balance(cloth: &Cloth, state: &State, trial: &[f64]) -> (f64, f64) {
    let mut forces = vec![0.0; trial.len()];
    cloth.add_forces(state, trial, &mut forces);
    let (mut force, mut torque, mut size, mut lever) = ([0.0; 3], [0.0; 3], 0.0, 0.0);
    for (x, f) in trial.chunks(3).zip(forces.chunks(3)) {
        let cross =
            [x[1] * f[2] - x[2] * f[1], x[2] * f[0] - x[0] * f[2], x[0] * f[1] - x[1] * f[0]];
        for axis in 0..3 {
            force[axis] += f[axis];
            torque[axis] += cross[axis];
        }
        let norm = |v: &[f64]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
        size += norm(f);
        lever += norm(&cross);
    }
    let norm = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
    (norm(force) / size, norm(torque) / lever)
}

#[test]
fn internal_forces_and_torques_cancel() {
    let elastic: String =
        LINEN.lines().filter(|l| !l.starts_with("friction")).collect::<Vec<_>>().join("\n");
    let elastic = elastic.replace("rest_curvature = 3.0", "");
    for (name, lattice) in panels() {
        // Without friction and rest curvature nothing depends on the frozen normal.
        let (cloth, state, trial) = worn(&lattice, &fabric(&elastic), 1e-3);
        let (force, torque) = balance(&cloth, &state, &trial);
        println!("{name}: elastic, net force {force:.1e}, net torque {torque:.1e}");
        assert!(force < 1e-12 && torque < 1e-12, "{name}: {force:e} {torque:e}");
        // The frozen normal's share: the friction moment times the part of the curvature across
        // the normal. Noise of the positions and turning within the step both raise it.
        for (step, shake, radius, limit) in
            [("one of a simulation", 1e-5, 0.0602, 1e-7), ("a violent one", 1e-3, 0.07, 1e-5)]
        {
            let (cloth, state, trial) = tried(&lattice, &fabric(LINEN), (shake, radius));
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
fn forces_turn_with_the_cloth() {
    let lattice = Lattice::rectangle(0.10, 0.08, 0.012).expect("a rectangle");
    let (cloth, state, trial) = worn(&lattice, &fabric(LINEN), 1e-3);
    let turn = |x: &[f64]| -> Vec<f64> { x.chunks(3).flat_map(|p| [p[2], p[0], p[1]]).collect() };
    let mut forces = vec![0.0; trial.len()];
    cloth.add_forces(&state, &trial, &mut forces);
    let mut turned_state = cloth.state(turn(&state.positions)).expect("fits");
    // The same history, turned.
    let mut random = Random(7);
    turned_state
        .clone_from(&cloth.state(turn(&bent(&lattice, 0.4, 0.0, &mut random))).expect("fits"));
    for radius in [0.1, 0.06] {
        let positions = turn(&bent(&lattice, radius, 1e-3, &mut random));
        cloth.commit(&mut turned_state, &positions, &vec![0.0; trial.len()]);
    }
    let mut turned = vec![0.0; trial.len()];
    cloth.add_forces(&turned_state, &turn(&trial), &mut turned);
    let scale = forces.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
    for (a, b) in turn(&forces).iter().zip(&turned) {
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
        let cloth = Cloth::new(&[(&lattice, &fabric)]);
        let flat: Vec<f64> = lattice.coordinates.iter().flat_map(|&[u, v]| [u, 0.0, v]).collect();
        let mut state = cloth.state(flat.clone()).expect("fits");
        // The sheet turns by its length over the radius, and its chords are kept at their rest length, so that
        // bending alone stores energy.
        let turn = lattice.spacing[1] / radius;
        let corner = 0.5 * lattice.spacing[1] / (0.5 * turn).sin();
        let rolled: Vec<f64> = lattice
            .coordinates
            .iter()
            .flat_map(|&[u, v]| {
                let angle = v / lattice.spacing[1] * turn;
                [u, corner * (1.0 - angle.cos()), corner * angle.sin()]
            })
            .collect();
        // Accepted, the friction has slipped by the true curvature, however far the sheet turned.
        let committed = cloth.commit(&mut state, &rolled, &vec![0.0; flat.len()]);
        let work = cloth.stored(&state) + committed.dissipated;
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
    let cloth = Cloth::new(&[(&lattice, &fabric)]);
    let flat: Vec<f64> = lattice.coordinates.iter().flat_map(|&[u, v]| [u, 0.0, v]).collect();
    let state = cloth.state(flat).expect("fits");
    // Warp stretched by 4 %, then leaned over: the sine of the shear angle is exactly 0.1.
    let (sin, cos) = (0.1, (1.0_f64 - 0.01).sqrt());
    let place = |&[u, v]: &[f64; 2]| [u + 1.04 * v * sin, 0.0, 1.04 * v * cos];
    let leaned: Vec<f64> = lattice.coordinates.iter().flat_map(place).collect();
    let mut forces = vec![0.0; leaned.len()];
    cloth.add_forces(&state, &leaned, &mut forces);
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
