//! Forces and stiffness against finite differences, conservation, the reference, and bits.

use drape_cloth::{Breen, Cloth, Error, Fold, Grain, Lattice, Mesh, ReferenceCloth, State};
use drape_fabric::Fabric;

use crate::panels::{LINEN, RICH, fabric, rectangle, shape};
use crate::shaken::{Random, balance, distance, multiply, tried};

/// Rounding of a few hundred operations on numbers of the size that is compared with.
const TOLERANCE: f64 = 1e-12;

/// A dart, a side along the grain, a round side, and a sharp corner.
const DARTED: &str = "M0 0 L35 0 L45 -45 L55 0 L100 0 C110 -30 100 -60 80 -90 L0 -80 Z";

/// Panels that are all grid.
pub fn grids() -> Vec<(&'static str, Lattice)> {
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

/// Panels with a rim.
pub fn panels() -> Vec<(&'static str, Lattice)> {
    vec![
        ("dart", shape(DARTED, 0.0, 0.011)),
        ("dart on the bias", shape(DARTED, 33.0, 0.011)),
        ("strip without cells", rectangle([0.012, 0.11], 20.0, 0.01)),
        ("triangle", shape("M0 0 L30 0 L0 -30 Z", 45.0, 0.015)),
    ]
}

/// A panel of about 100 mm with two folds that cross each other at arbitrary angles.
fn folded((name, lattice): (&'static str, Lattice)) -> (&'static str, Lattice) {
    let [low, high] = [f64::min, f64::max].map(|of: fn(f64, f64) -> f64| {
        [0, 1].map(|k| lattice.coordinates().iter().map(|c| c[k]).reduce(of).expect("a node"))
    });
    let at = |u: f64, v: f64| [low[0] + u * (high[0] - low[0]), low[1] + v * (high[1] - low[1])];
    let folds = [
        Fold { ends: [at(0.3, -0.1), at(0.6, 1.1)], angle: 1.3 },
        Fold { ends: [at(-0.1, 0.55), at(0.8, 0.52)], angle: -0.7 },
    ];
    (name, lattice.with_folds(&folds).expect("folds that cross it"))
}

/// All of them, each with the fabric that it is tried in.
fn cases() -> Vec<(&'static str, Lattice, Fabric)> {
    let of = |panels: Vec<(&'static str, Lattice)>, text: &str| {
        let fabric = fabric(text);
        panels.into_iter().map(move |(name, lattice)| (name, lattice, fabric.clone()))
    };
    let creased = grids().into_iter().map(folded).collect();
    let creased = of(creased, LINEN).chain(of(panels().into_iter().map(folded).collect(), RICH));
    of(grids(), LINEN).chain(of(panels(), RICH)).chain(creased).collect()
}

#[test]
fn forces_are_the_derivative_of_the_potential() {
    for (name, lattice, fabric) in cases() {
        let (cloth, state, trial) = tried(&lattice, &fabric, 1e-3, 0.07);
        let mut forces = vec![0.0; trial.len()];
        cloth.add_forces(&state, &trial, &mut forces).expect("the lists fit");
        let scale = forces.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
        let d = 2e-7;
        let mut worst = 0.0_f64;
        for dof in 0..trial.len() {
            let at = |k: f64| {
                let mut moved = trial.clone();
                moved[dof] += k * d;
                cloth.potential(&state, &moved).expect("the lists fit")
            };
            let slope = (at(-2.0) - 8.0 * at(-1.0) + 8.0 * at(1.0) - at(2.0)) / (12.0 * d);
            worst = worst.max((forces[dof] + slope).abs() / scale);
        }
        println!("{name}: force against potential {worst:.1e}");
        assert!(worst < 1e-7, "{name}: relative error {worst:e}");
    }
}

#[test]
fn the_stiffness_is_the_derivative_of_the_forces() {
    for (name, lattice, fabric) in cases() {
        let (cloth, state, trial) = tried(&lattice, &fabric, 1e-3, 0.07);
        let mut values = vec![0.0; 9 * cloth.sparsity().block_count()];
        cloth.add_stiffness(&state, &trial, false, &mut values).expect("the lists fit");
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
                cloth.add_forces(&state, &moved, &mut forces).expect("the lists fit");
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
    for (name, lattice, fabric) in cases() {
        let (cloth, state, trial) = tried(&lattice, &fabric, 3e-3, 0.07);
        let mut values = vec![0.0; 9 * cloth.sparsity().block_count()];
        cloth.add_stiffness(&state, &trial, true, &mut values).expect("the lists fit");
        let mut random = Random(5);
        for _ in 0..300 {
            let direction: Vec<f64> = trial.iter().map(|_| random.next()).collect();
            let product = multiply(&cloth, &values, &direction);
            let curvature: f64 = direction.iter().zip(&product).map(|(a, b)| a * b).sum();
            assert!(curvature > 0.0, "{name}: {curvature}");
        }
    }
}

#[test]
fn internal_forces_and_torques_cancel() {
    let elastic: String =
        RICH.lines().filter(|l| !l.starts_with("friction")).collect::<Vec<_>>().join("\n");
    let elastic = elastic.replace("rest_curvature = 3.0", "");
    for (name, lattice) in panels() {
        // Without friction and rest curvature nothing depends on the frozen normal.
        let (cloth, state, trial) = tried(&lattice, &fabric(&elastic), 1e-3, 0.07);
        let (force, torque) = balance(&cloth, &state, &trial);
        println!("{name}: elastic, net force {force:.1e}, net torque {torque:.1e}");
        assert!(force < 1e-12 && torque < 1e-12, "{name}: {force:e} {torque:e}");
        let (cloth, state, trial) = tried(&lattice, &fabric(RICH), 1e-5, 0.0602);
        let (force, torque) = balance(&cloth, &state, &trial);
        println!("{name}: with friction, net force {force:.1e}, net torque {torque:.1e}");
        assert!(force < 1e-12, "{name}: net force {force:e}");
        // The error of the frozen normals; those of four nodes are coarse.
        let limit = if name == "triangle" { 2e-5 } else { 1e-6 };
        assert!(torque < limit, "{name}: net torque {torque:e}");
    }
}

/// A cloth of several panels, with and without a rim.
fn mixed() -> Vec<Lattice> {
    let mut all: Vec<Lattice> = panels().into_iter().map(|(_, lattice)| lattice).collect();
    all.insert(1, Lattice::rectangle(0.1, 0.08, 0.012).expect("a rectangle"));
    all.push(Lattice::disc(0.05, 0.011).expect("a disc"));
    let creased: Vec<Lattice> = all.iter().map(|l| folded(("creased", l.clone())).1).collect();
    all.extend(creased);
    all
}

/// Waves that change with time.
fn wave(cloth: &Cloth, time: f64) -> Vec<f64> {
    let place = |&[u, v]: &[f64; 2]| {
        let height = 0.02 * (1.0 + 0.5 * time) * (20.0 * u + 13.0 * v + time).sin();
        [u * (1.0 + 0.01 * time), v + 0.05 * time * u, height]
    };
    cloth.coordinates().iter().flat_map(place).collect()
}

#[test]
fn the_batches_give_the_numbers_of_the_connectors_one_by_one() {
    let (lattices, rich) = (mixed(), fabric(RICH));
    let panels: Vec<_> = lattices.iter().map(|lattice| (lattice, &rich)).collect();
    let cloth = Cloth::new(&panels).expect("a cloth");
    let mut state = cloth.state(wave(&cloth, 0.0)).expect("it fits");
    let mut reference = ReferenceCloth::new(&panels, &cloth, &state).expect("a cloth");
    let rest = vec![0.0; 3 * cloth.particle_count()];
    let mut random = Random(3);
    for step in 0..6 {
        let time = f64::from(step % 4) * 0.3;
        let mut place = |time: f64| -> Vec<f64> {
            wave(&cloth, time).into_iter().map(|x| x + 4e-4 * random.next()).collect()
        };
        let positions = place(time);
        let before = reference.potential(&state.positions).expect("the lists fit");
        let work = cloth.potential(&state, &positions).expect("the lists fit")
            - cloth.potential(&state, &state.positions).expect("the lists fit");
        let exact = reference.potential(&positions).expect("the lists fit") - before;
        assert!((work - exact).abs() < TOLERANCE * exact.abs(), "{step}: work {work}, {exact}");
        let lost = cloth.commit(&mut state, &positions, &rest).expect("the lists fit");
        let exact = reference.commit(&positions, state.normals()).expect("the lists fit");
        assert!((lost - exact).abs() < TOLERANCE * exact.abs(), "{step}: lost {lost}, {exact}");
        let trial = place(time + 0.1);
        let (mut found, mut exact) = (rest.clone(), rest.clone());
        cloth.add_forces(&state, &trial, &mut found).expect("the lists fit");
        reference.add_forces(&trial, &mut exact).expect("the lists fit");
        let error = distance(&found, &exact);
        assert!(error < TOLERANCE, "{step}: forces {error:e}");
        for definite in [false, true] {
            let mut found = vec![0.0; 9 * cloth.sparsity().block_count()];
            let mut exact = found.clone();
            cloth.add_stiffness(&state, &trial, definite, &mut found).expect("the lists fit");
            reference.add_stiffness(&trial, definite, &mut exact).expect("the lists fit");
            let error = distance(&found, &exact);
            assert!(error < TOLERANCE, "{step}, definite {definite}: stiffness {error:e}");
        }
    }
}

/// Results of an evaluation: state, forces, stiffness, sums.
fn numbers(cloth: &Cloth) -> (State, Vec<f64>, Vec<f64>, Vec<f64>) {
    let mut state = cloth.state(wave(cloth, 0.0)).expect("it fits");
    let mut sums = Vec::new();
    let mut forces = vec![0.0; 3 * cloth.particle_count()];
    let mut values = vec![0.0; 9 * cloth.sparsity().block_count()];
    for step in 1..5 {
        let trial = wave(cloth, 0.2 * f64::from(step));
        cloth.add_forces(&state, &trial, &mut forces).expect("the lists fit");
        cloth.add_stiffness(&state, &trial, step % 2 == 0, &mut values).expect("the lists fit");
        sums.push(cloth.potential(&state, &trial).expect("the lists fit"));
        sums.push(
            cloth.commit(&mut state, &trial, &vec![0.0; trial.len()]).expect("the lists fit"),
        );
        sums.push(cloth.stored(&state).expect("the lists fit"));
    }
    (state, forces, values, sums)
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let (lattices, rich) = (mixed(), fabric(RICH));
    let panels: Vec<_> = lattices.iter().map(|lattice| (lattice, &rich)).collect();
    let cloth = Cloth::new(&panels).expect("a cloth");
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads start").install(|| numbers(&cloth))
    };
    let alone = run(1);
    assert!(alone.1.iter().all(|force| force.is_finite()));
    for threads in [2, 3, 5] {
        assert!(run(threads) == alone, "with {threads} threads");
    }
}

/// The mesh of a rectangle that is all grid.
fn grid(columns: u32, rows: u32, spacing: f64) -> Mesh {
    let points: Vec<[u32; 2]> =
        (0..=rows).flat_map(|row| (0..=columns).map(move |column| [column, row])).collect();
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    let corners = |(column, row): (u32, u32)| {
        let first = row * (columns + 1) + column;
        [first, first + 1, first + columns + 2, first + columns + 1]
    };
    Mesh {
        spacing: [spacing; 2],
        coordinates: points.iter().map(|point| point.map(|k| f64::from(k) * spacing)).collect(),
        grid: points,
        cells: cells.map(corners).collect(),
        triangles: Vec::new(),
    }
}

#[test]
fn a_panel_that_is_all_grid_is_a_rectangle_to_the_bit() {
    let rich = fabric(RICH);
    let rectangle = Lattice::rectangle(0.25, 0.5, 0.015625).expect("a rectangle");
    let cut = Lattice::from_mesh(grid(16, 32, 0.015625), Grain::default()).expect("a panel");
    assert_eq!((&cut.cells(), &cut.coordinates()), (&rectangle.cells(), &rectangle.coordinates()));
    assert_eq!(
        (cut.middle(), cut.panel_coordinates()),
        (rectangle.middle(), rectangle.panel_coordinates())
    );
    let [one, other] =
        [&rectangle, &cut].map(|lattice| Cloth::new(&[(lattice, &rich)]).expect("a cloth"));
    assert_eq!(one.sparsity(), other.sparsity());
    assert!(numbers(&one) == numbers(&other));
}

#[test]
fn what_is_no_panel_is_refused() {
    let mesh = grid(3, 2, 0.01);
    let refused = |change: &dyn Fn(&mut Mesh)| {
        let mut mesh = mesh.clone();
        change(&mut mesh);
        Lattice::from_mesh(mesh, Grain::default()).expect_err("it is wrong")
    };
    let part = |error: Error| match error {
        Error::Mesh { part, index, .. } => (part, index),
        other => panic!("{other}"),
    };
    assert!(matches!(refused(&|mesh| mesh.spacing[1] = 0.0), Error::Length { .. }));
    assert_eq!(
        part(refused(&|mesh| *mesh = Mesh { spacing: [1.0; 2], ..Mesh::default() })),
        ("panel", 0)
    );
    assert_eq!(part(refused(&|mesh| mesh.cells[2].swap(0, 1))), ("cell", 2));
    assert_eq!(part(refused(&|mesh| mesh.cells[1][3] = 99)), ("cell", 1));
    assert_eq!(part(refused(&|mesh| mesh.grid.swap(4, 5))), ("node", 5));
    assert_eq!(part(refused(&|mesh| mesh.coordinates[3][0] += 1e-3)), ("node", 3));
    assert_eq!(part(refused(&|mesh| mesh.coordinates[3][0] = f64::NAN)), ("node", 3));
    assert_eq!(part(refused(&|mesh| mesh.coordinates.push([0.1, 0.1]))), ("node", 12));
    assert_eq!(part(refused(&|mesh| mesh.triangles.push([0, 4, 1]))), ("triangle", 0));
    assert_eq!(part(refused(&|mesh| mesh.triangles.push([0, 1, 77]))), ("triangle", 0));
    let far = |mesh: &mut Mesh| mesh.grid[11] = [u32::MAX, u32::MAX];
    assert!(matches!(refused(&far), Error::TooMany { .. }));
}

#[test]
fn breens_particles_are_on_grids_alone() {
    let (_, lattice) = panels().remove(0);
    let breen = Breen::new(&[(&lattice, &fabric(RICH))]);
    assert_eq!(breen.err(), Some(Error::Rim));
}
