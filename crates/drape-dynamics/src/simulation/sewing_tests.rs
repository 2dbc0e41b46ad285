//! Panels that are sewn: their system's forces against its potential, and their weight at the pin.

use drape_cloth::{Cloth, SeamBending, Tie};
use drape_frames::CLOSED_GAP;
use drape_implicit::{System, check_system};
use drape_input::Document;
use drape_scene::{Pin, Scene, Seam, SeamPairs, Sewing};

use crate::record::summary::Status;
use crate::sewing::node_map::merge;
use crate::sewing::reduced_system::ReducedSystem;
use crate::sewing::reduction::Reduction;
use crate::simulation::Simulation;
use crate::world::World;
use crate::world::closing_springs::{ClosingSprings, SeamState};
use crate::world::world_tests::FABRIC;

/// Seam of the edges of both sheets: the lower one has so many arcs for each of the upper one.
fn seam_pairs(fullness: u32) -> SeamPairs {
    // The top row of the lower sheet, which is 6 arcs of the upper one high as well.
    let along = 6 * fullness + 1;
    let lower = |k: u32| 49 + along * (along - 1) + k;
    let tie = |k: u32| Tie {
        particle: lower(k),
        ends: [k / fullness, k / fullness + 1],
        fraction: f64::from(k % fullness) / f64::from(fullness),
    };
    let between = (0..6 * fullness).filter(|k| k % fullness != 0);
    let pairs = (0..7).map(|k| [k, lower(fullness * k)]).collect();
    SeamPairs { pairs, ties: between.map(tie).collect() }
}

/// Sheets of 60 × 60 mm, the upper of 7 × 7 particles, one below the other with gaps of 8 mm, sewn
/// at their edges and held at the top.
fn scene(fullness: u32) -> Scene {
    let text = r#"spacing = 0.01
contact.surfaces = false
fabric.plain.file = "plain.toml"
[[panel]]
name = "upper"
fabric = "plain"
rectangle = [0.06, 0.06]
center = [0, 0.1, 0]
noise = { amplitude = 5e-4, seed = 3 }
[[panel]]
name = "lower"
fabric = "plain"
rectangle = [0.06, 0.06]
spacing = LOWER
center = [0.004, 0.032, 0.003]
noise = { amplitude = 5e-4, seed = 4 }
[[pin]]
panel = "upper"
edge = "top"
[time]
step = 0.005
end = 60
[settle]
residual = 1e-4
"#;
    let text = text.replace("LOWER", &(0.01 / f64::from(fullness)).to_string());
    let fabric = Document::new("plain.toml", FABRIC);
    let mut scene =
        Scene::from_documents(&Document::new("scene.toml", text), &[fabric]).expect("right");
    let pairs = seam_pairs(fullness);
    let (name, breaks) = ("seam".into(), Vec::new());
    let seams = vec![Seam { name, pairs: pairs.clone(), breaks, rest_angle: 0.0 }];
    let lattices = scene.panels.iter().map(|panel| (&panel.lattice, &scene.materials[0].fabric));
    let lattices: Vec<_> = lattices.collect();
    let elastic = scene.materials[0].fabric.without_friction();
    let cloth =
        Cloth::new(&lattices.iter().map(|(lattice, _)| (*lattice, &elastic)).collect::<Vec<_>>());
    let cloth = cloth.expect("a cloth");
    let seam = drape_cloth::Seam {
        ties: pairs.ties.clone(),
        ..drape_cloth::Seam::new(pairs.pairs.clone())
    };
    let bending = SeamBending::new(&lattices, &[seam]);
    let bending = bending.expect("a seam of two edges");
    scene.cloth = scene.cloth.with_ties(&pairs.ties).expect("ties of its particles");
    scene.sewing = Some(Sewing { seams, pairs, cloth, seconds: 0.5, bending });
    scene
}

#[test]
fn the_forces_on_sewn_particles_agree_with_their_potential() {
    // With one arc on both sides, and with two and three on one.
    [1, 2, 3].into_iter().for_each(agree);
}

fn agree(fullness: u32) {
    let mut world = World::new(scene(fullness)).expect("contact");
    let pairs = seam_pairs(fullness);
    let mut positions = world.state.positions.clone();
    // With their closing springs, each particle by itself.
    let trial = |positions: &[f64]| -> Vec<f64> {
        let shake = |(k, x): (usize, &f64)| x + 2e-4 * (1.7 * k as f64).sin();
        positions.iter().enumerate().map(shake).collect()
    };
    let away = trial(&positions);
    let check = check_system(&mut world, &positions, &away, 0.2).expect("sound");
    assert!(check.force_error < 1e-6 && check.stiffness_error < 1e-5, "{check:?}");

    merge(&pairs, world.cloth.masses(), &mut positions);
    world.finish_sewing(0.5, &positions);
    let mut reduction = Reduction::new(&world, &pairs).expect("pairs of its particles");
    let own = reduction.restrict(&positions);
    let mut sewn = ReducedSystem { world: &mut world, reduction: &mut reduction };
    let along = 6 * fullness as usize + 1;
    assert_eq!(sewn.particle_count(), 49 + along * (along - 1));
    let mass: f64 = sewn.masses().iter().sum();
    assert!((mass / (2.0 * 0.06 * 0.06 * 0.15) - 1.0).abs() < 1e-12);
    let away = trial(&own);
    let check = check_system(&mut sewn, &own, &away, 0.005).expect("sound");
    assert!(check.force_error < 1e-6 && check.stiffness_error < 1e-5, "{check:?}");
    assert!(check.definite_shift <= 1e-10, "{check:?}");
}

#[test]
fn sewn_sheets_hang_from_their_pin_with_all_their_weight() {
    [1, 3].into_iter().for_each(hang);
}

fn hang(fullness: u32) {
    let mut simulation = Simulation::new(scene(fullness)).expect("it starts");
    let summary = simulation.run(&mut ()).expect("it runs");
    assert_eq!(summary.status, Status::Ok, "{:?}", summary.reason);
    let positions = simulation.positions().to_vec();
    let pairs = seam_pairs(fullness);
    for [a, b] in &pairs.pairs {
        let place = |node: &u32| &positions[3 * *node as usize..][..3];
        assert_eq!(place(a), place(b), "what is sewn is in one place");
    }
    assert!(pairs.gaps(&positions).all(|gap| gap < 1e-15), "what is tied is between");
    let weight = 2.0 * 0.06 * 0.06 * 0.15 * 9.81;
    let [load] = simulation.pin_loads()[..] else { panic!("one pin") };
    assert!((load.force[1] / -weight - 1.0).abs() < 1e-3, "{load:?} and {weight}");
    let residual = summary.energy.map(|energy| energy.residual);
    assert!(residual.is_some_and(|r| r.abs() < 1e-9), "{residual:?}");
}

#[test]
fn contact_of_the_sides_of_a_seam_ends_where_they_may_be_merged() {
    let pairs = seam_pairs(1);
    let start = World::new(scene(1)).expect("contact").state.positions;
    let mut springs = ClosingSprings::new(&pairs, &start, 0.5);
    let widest = springs.widest_gap(&start).width;
    let mut closed = start.clone();
    merge(&pairs, &vec![1.0; start.len() / 3], &mut closed);
    // The last is open by twice the gap of a closed seam, and the one after by half of it.
    let opened = |gap: f64| {
        let mut positions = closed.clone();
        positions[3 * pairs.pairs[0][0] as usize] += gap;
        positions
    };
    let mut widest_after = |positions: &[f64], time: f64| {
        springs.begin(positions, time);
        let gaps = pairs.pairs.iter().flatten().map(|&particle| springs.gaps()[particle as usize]);
        gaps.fold(0.0, f64::max)
    };
    for (time, positions, expected) in [
        (0.0, &start, widest),
        (0.25, &start, 0.5 * widest),
        (0.48, &start, 0.04 * widest),
        // Whatever is prescribed, sides that are not there yet are kept apart.
        (0.5, &start, CLOSED_GAP),
        (0.5, &opened(2e-4), CLOSED_GAP),
        (0.5, &opened(5e-5), 0.0),
        // Contact cannot begin between sides that may intersect.
        (0.5, &opened(2e-4), 0.0),
    ] {
        let gap = widest_after(positions, time);
        assert!((gap - expected).abs() < 1e-12, "{gap} and {expected} m after {time} s");
    }
    let is_closed = |positions: &[f64], time, imbalance| {
        matches!(springs.state(positions, time, imbalance, 5e-4), SeamState::Closed { .. })
    };
    assert!(is_closed(&closed, 0.5, 0.2) && is_closed(&closed, 1.0, 5.0));
    assert!(!is_closed(&closed, 0.5, 5.0) && !is_closed(&closed, 0.4, 0.2));
    // A seam that stays open by half a millimetre at most may be merged a tenth later.
    let mut nearly = closed.clone();
    let is_nearly_closed = |positions: &[f64], time, imbalance| {
        matches!(springs.state(positions, time, imbalance, 5e-4), SeamState::NearlyClosed(_))
    };
    nearly[3 * pairs.pairs[0][0] as usize] += 4e-4;
    assert!(is_nearly_closed(&nearly, 0.56, 0.2) && !is_nearly_closed(&nearly, 0.54, 0.2));
    assert!(!is_nearly_closed(&nearly, 0.56, 5.0) && !is_nearly_closed(&nearly, 1.0, 0.2));
    nearly[3 * pairs.pairs[0][0] as usize] += 2e-4;
    assert!(!is_nearly_closed(&nearly, 0.56, 0.2));
    assert!(
        matches!(springs.state(&start, 1.0, 0.2, 5e-4), SeamState::Failed(gap) if gap.width == widest)
    );
}

#[test]
fn seams_that_are_held_apart_end_the_run() {
    let mut scene = scene(1);
    // Both sides of the seam are held.
    let pin = scene.pins[0].clone();
    let particles: Vec<usize> = (0..7).chain(49 + 42..49 + 49).collect();
    let place = |&p: &usize| std::array::from_fn(|axis| scene.start.positions[3 * p + axis]);
    let start = particles.iter().map(place).collect();
    scene.pins.push(Pin { particles, start, ..pin });
    let mut simulation = Simulation::new(scene).expect("it starts");
    let summary = simulation.run(&mut ()).expect("it runs");
    assert_eq!(summary.status, Status::SeamsOpen);
    let reason = summary.reason.expect("it says why");
    assert!(
        reason.contains("\"upper\" and \"lower\"") && reason.contains("open by 9."),
        "{reason}"
    );
}

#[test]
fn a_seam_that_misses_by_little_is_sewn_stretched() {
    let mut scene = scene(1);
    // Both sides of the seam are held, and miss each other by a twentieth of the spacing.
    for (upper, lower) in (0..7).zip(49 + 42..49 + 49) {
        let place: [f64; 3] = std::array::from_fn(|k| scene.start.positions[3 * upper + k]);
        let place = [place[0], place[1] - 5e-4, place[2]];
        scene.start.positions[3 * lower..][..3].copy_from_slice(&place);
    }
    let pin = scene.pins[0].clone();
    let particles: Vec<usize> = (0..7).chain(49 + 42..49 + 49).collect();
    let place = |&p: &usize| std::array::from_fn(|axis| scene.start.positions[3 * p + axis]);
    let start = particles.iter().map(place).collect();
    scene.pins.push(Pin { particles, start, ..pin });
    let mut simulation = Simulation::new(scene).expect("it starts");
    let summary = simulation.run(&mut ()).expect("it runs");
    let told = summary.warnings.join("; ");
    assert!(
        told.contains("the seam \"seam\" between \"upper\" and \"lower\" is sewn stretched: ")
            && told.contains(" in straight pieces of 10 mm, 0.")
            && told.contains(" N at a stitch"),
        "{:?} {:?} {told}",
        summary.status,
        summary.reason
    );
    assert_ne!(summary.status, Status::SeamsOpen);
}

#[test]
fn values_of_merged_particles_are_those_of_their_independent_ones() {
    let world = World::new(scene(1)).expect("contact");
    let one = SeamPairs { pairs: vec![[3, 60]], ties: Vec::new() };
    let reduction = Reduction::new(&world, &one).expect("particles");
    let mut values: Vec<f64> = (0..3 * 98).map(f64::from).collect();
    merge(&one, world.cloth.masses(), &mut values);
    let [m, n] = [3, 60].map(|node| world.cloth.masses()[node]);
    let mean = (m * 9.0 + n * 180.0) / (m + n);
    assert!((values[9] - mean).abs() < 1e-12 && values[9] == values[180]);
    let mut wide = vec![f64::NAN; values.len()];
    reduction.prolong(&reduction.restrict(&values), &mut wide);
    assert_eq!(wide, values);
}
