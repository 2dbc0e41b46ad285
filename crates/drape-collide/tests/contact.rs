//! Forces, potential, stiffness and friction of contact.

#![allow(clippy::unwrap_used)]

mod support;

use drape_collide::{Body, NearestParticle, ParticleContact, ParticleSettings, Pose, Shape};
use support::{Dice, derivative, meshed, norm, primitives};

const AREA: f64 = 4e-4;

/// Slip of 1 mm at a step of 10 ms, so that one difference step suits barrier and friction.
const SLIPPERY: ParticleSettings =
    ParticleSettings { activation_distance: 1e-3, stiffness: 2e6, slip_speed: 0.1 };

/// A particle at each of several distances over a random place of the surface.
fn near(body: &Body, seed: u64) -> Vec<f64> {
    let mut dice = Dice::new(seed);
    let mut positions = Vec::new();
    for distance in [9e-4, 7e-4, 3e-4, 1.5e-4, 5e-5, -4e-4] {
        let point = dice.point(0.5);
        let proximity = body.signed_distance(point).unwrap();
        let displacement = distance - proximity.distance;
        positions.extend([0, 1, 2].map(|k| point[k] + displacement * proximity.normal[k]));
    }
    positions
}

fn forces(contact: &mut ParticleContact, positions: &[f64]) -> Vec<f64> {
    let mut forces = vec![0.0; positions.len()];
    contact.add_forces(positions, &mut forces).unwrap();
    forces
}

/// Contact of a body with the particles of `near`, in a step in which they slipped.
fn slipping(body: &Body, seed: u64) -> (ParticleContact, Vec<f64>) {
    let start = near(body, seed);
    let mut contact =
        ParticleContact::new(vec![body.clone()], SLIPPERY, vec![AREA; start.len() / 3]).unwrap();
    contact.begin(&start, 0.01).unwrap();
    let mut dice = Dice::new(seed + 100);
    // From a tenth of the sticking slip to three times it.
    let now = start.iter().enumerate().map(|(k, x)| {
        let slip = [1e-4, 4e-4, 7e-4, 1e-4, 3e-3, 2e-5][k / 3];
        x + slip * dice.roll()
    });
    (contact, now.collect())
}

fn all_bodies() -> Vec<Body> {
    let mut bodies = primitives();
    let ball = meshed(Shape::Sphere { radius: 0.3 });
    let pose = Pose::new([0.05, 0.0, 0.0]).rotated([0.3, 1.0, 0.0], 0.4);
    bodies.push(Body::new("meshed ball", Shape::Mesh(ball), pose).with_friction(0.3));
    bodies
}

#[test]
fn the_force_is_the_negative_gradient_of_the_potential() {
    for (seed, body) in all_bodies().iter().enumerate() {
        let (mut contact, positions) = slipping(body, seed as u64);
        let exact = forces(&mut contact, &positions);
        let touched = exact.chunks(3).filter(|f| f.iter().any(|v| *v != 0.0));
        assert!(touched.count() >= 5, "{}: too little contact", body.name);
        for particle in 0..positions.len() / 3 {
            let size = exact[3 * particle..][..3].iter().fold(0.0, |s: f64, f| s.max(f.abs()));
            for axis in 0..3 {
                let k = 3 * particle + axis;
                let [slope] =
                    derivative(&positions, k, 1e-6, &mut |x| [contact.potential(x).unwrap()]);
                let miss = (slope + exact[k]).abs() / size.max(1e-3);
                assert!(
                    miss < 1e-7,
                    "{}, particle {particle}: {slope:e} against {:e}",
                    body.name,
                    exact[k]
                );
            }
        }
    }
}

#[test]
fn the_stiffness_is_the_negative_derivative_of_the_force() {
    for (seed, body) in all_bodies().iter().enumerate() {
        let (mut contact, positions) = slipping(body, seed as u64);
        let mut blocks = vec![[0.0; 9]; positions.len() / 3];
        contact
            .add_stiffness(&positions, false, &mut |particle, block| {
                for (sum, value) in blocks[particle].iter_mut().zip(block) {
                    *sum += value;
                }
            })
            .unwrap();
        for (particle, block) in blocks.iter().enumerate() {
            let size = block.iter().fold(0.0, |s: f64, b| s.max(b.abs()));
            for axis in 0..3 {
                let column = derivative(&positions, 3 * particle + axis, 1e-6, &mut |x| {
                    let all = forces(&mut contact, x);
                    [all[3 * particle], all[3 * particle + 1], all[3 * particle + 2]]
                });
                for row in 0..3 {
                    let miss = (column[row] + block[3 * row + axis]).abs() / size.max(1.0);
                    assert!(
                        miss < 1e-6,
                        "{}, particle {particle}: off by {miss:e} of {size}",
                        body.name
                    );
                }
            }
        }
    }
}

#[test]
fn the_definite_stiffness_never_softens() {
    for (seed, body) in all_bodies().iter().enumerate() {
        let (mut contact, positions) = slipping(body, seed as u64);
        let mut dice = Dice::new(5);
        contact
            .add_stiffness(&positions, true, &mut |particle, block| {
                for _ in 0..50 {
                    let v = dice.direction();
                    let along: f64 = (0..9).map(|k| v[k / 3] * block[k] * v[k % 3]).sum();
                    let size = block.iter().fold(0.0, |s: f64, b| s.max(b.abs()));
                    assert!(along >= -1e-14 * size, "{}, {particle}: {along}", body.name);
                }
            })
            .unwrap();
    }
}

#[test]
fn energy_and_force_do_not_jump_across_features() {
    // A circle around each body through the middle of the gap crosses faces, edges and corners.
    for body in all_bodies() {
        let mut contact = ParticleContact::new(vec![body.clone()], SLIPPERY, vec![AREA]).unwrap();
        let mut last: Option<([f64; 3], f64, Vec<f64>)> = None;
        for k in 0..20_000 {
            let angle = k as f64 * 1e-3;
            let far = [angle.cos(), angle.sin(), 0.3 * (1.7 * angle).sin()];
            // Down to half the offset by the distance itself.
            let mut point = far;
            for _ in 0..10 {
                let proximity = body.signed_distance(point).unwrap();
                let displacement = 5e-4 - proximity.distance;
                point = [0, 1, 2].map(|k| point[k] + displacement * proximity.normal[k]);
            }
            let energy = contact.potential(&point).unwrap();
            let force = forces(&mut contact, &point);
            if let Some((before, old_energy, old_force)) = last {
                let moved = norm([0, 1, 2].map(|k| point[k] - before[k]));
                let jump = (energy - old_energy).abs();
                // The pressure at half the offset is 1 kPa.
                let steepest = 2.0 * 1000.0 * AREA;
                assert!(jump <= steepest * moved + 1e-15, "{}: energy {jump:e}", body.name);
                let jump = norm([0, 1, 2].map(|k| force[k] - old_force[k]));
                // The normal turns by at most the displacement over the gap of 0.5 mm.
                let steepest = 2.0 * 1000.0 * AREA / 5e-4;
                assert!(jump <= steepest * moved + 1e-9, "{}: force {jump:e}", body.name);
            }
            last = Some((point, energy, force));
        }
    }
}

#[test]
fn a_resting_load_of_five_kilopascal_stays_outside() {
    let settings = ParticleSettings::default();
    let depth = 0.1 * settings.activation_distance;
    let pressure = settings.pressure(depth);
    assert!((pressure - 5000.0).abs() < 1e-6, "{pressure} Pa at a tenth of the gap");
    let last = settings.pressure(0.0);
    assert!((last - 10_000.0).abs() < 1e-6, "{last} Pa at the surface");
    assert_eq!(settings.pressure(settings.activation_distance), 0.0);
}

#[test]
fn nothing_acts_beyond_the_activation_distance() {
    for body in all_bodies() {
        let proximity = body.signed_distance([1.0, 1.0, 1.0]).unwrap();
        let displacement = 1.0001e-3 - proximity.distance;
        let point = [0, 1, 2].map(|k| 1.0 + displacement * proximity.normal[k]);
        let mut contact = ParticleContact::new(vec![body], SLIPPERY, vec![AREA]).unwrap();
        contact.begin(&point, 0.01).unwrap();
        assert_eq!(forces(&mut contact, &point), [0.0; 3]);
        assert_eq!(contact.potential(&point).unwrap(), 0.0);
    }
}

#[test]
fn what_the_cloth_gets_the_bodies_give() {
    let bodies = vec![
        Body::new("floor", Shape::Plane, Pose::default()).with_friction(0.5),
        Body::new("ball", Shape::Sphere { radius: 0.1 }, Pose::new([0.0, 0.1, 0.0])),
    ];
    let mut contact = ParticleContact::new(bodies, SLIPPERY, vec![AREA; 4]).unwrap();
    // On the floor, on the ball, below the floor, far off.
    let mut positions = vec![0.5, 5e-4, 0.0, 0.0, 0.2005, 0.0, 0.3, -1e-3, 0.2, 0.0, 3.0, 0.0];
    contact.begin(&positions, 0.01).unwrap();
    positions[0] += 3e-4;
    positions[6] -= 2e-3;
    let all = forces(&mut contact, &positions);
    let summary = contact.summary(&positions).unwrap();
    assert_eq!((summary.touching, summary.inside, summary.invalid), (3, 1, 0));
    assert_eq!(summary.nearest, Some(NearestParticle { particle: 2, body: 0 }));
    assert!((summary.min_distance + 1e-3).abs() < 1e-15, "{}", summary.min_distance);
    for axis in 0..3 {
        let given: f64 = summary.loads.iter().map(|load| load[axis]).sum();
        let taken: f64 = all.iter().skip(axis).step_by(3).sum();
        let size: f64 = all.iter().map(|f| f.abs()).sum();
        let miss = (given + taken).abs() / size;
        assert!(miss < 1e-15, "axis {axis}: {given} given, {taken} taken");
    }
    assert!(summary.loads[0][0].abs() > 0.0, "friction must load the floor");
}

#[test]
fn a_summary_without_touch_finds_the_nearest() {
    let bodies = all_bodies();
    let contact = ParticleContact::new(bodies.clone(), SLIPPERY, vec![AREA; 50]).unwrap();
    let mut dice = Dice::new(9);
    let positions: Vec<f64> = (0..50).flat_map(|_| dice.point(1.0).map(|x| x + 3.0)).collect();
    let summary = contact.summary(&positions).unwrap();
    let all = positions.chunks(3).flat_map(|p| {
        let point = [p[0], p[1], p[2]];
        bodies.iter().map(move |body| body.signed_distance(point).unwrap().distance)
    });
    let least = all.fold(f64::INFINITY, f64::min);
    assert_eq!(summary.min_distance, least);
    assert_eq!(summary.touching, 0);
}

#[test]
fn a_lost_position_is_never_taken_for_free_space() {
    for body in all_bodies() {
        let mut contact = ParticleContact::new(vec![body], SLIPPERY, vec![AREA; 2]).unwrap();
        let mut positions = vec![5.0; 6];
        contact.begin(&positions, 0.01).unwrap();
        positions[4] = f64::NAN;
        for _ in 0..2 {
            assert!(contact.potential(&positions).unwrap().is_nan());
            let all = forces(&mut contact, &positions);
            assert_eq!(all[..3], [0.0; 3]);
            assert!(all[3..].iter().all(|f| f.is_nan()), "{all:?}");
        }
        let mut lost = false;
        contact
            .add_stiffness(&positions, true, &mut |particle, block| {
                lost |= particle == 1 && block.iter().all(|b| b.is_nan());
            })
            .unwrap();
        assert!(lost, "the stiffness hides it");
        let summary = contact.summary(&positions).unwrap();
        assert_eq!((summary.invalid, summary.touching, summary.inside), (1, 0, 0));
    }
}

#[test]
fn the_order_of_positions_and_the_threads_do_not_change_a_bit() {
    let ball = Shape::Mesh(meshed(Shape::Sphere { radius: 0.3 }));
    let bodies = vec![
        Body::new("ball", ball, Pose::default()).with_friction(0.3),
        Body::new("floor", Shape::Plane, Pose::new([0.0, -0.3, 0.0])),
    ];
    let n = 2000;
    let mut dice = Dice::new(3);
    // A swarm that settles on the ball in ten moves.
    let directions: Vec<[f64; 3]> = (0..n).map(|_| dice.direction()).collect();
    let swarm = |k: i32| -> Vec<f64> {
        let radius = 0.2995 + 0.3 * 0.5f64.powi(k);
        directions.iter().flat_map(|d| d.map(|x| x * radius)).collect()
    };
    let run = |threads: usize, moves: std::ops::Range<i32>| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut contact =
                ParticleContact::new(bodies.clone(), SLIPPERY, vec![AREA; n]).unwrap();
            for k in moves {
                contact.begin(&swarm(k), 0.01).unwrap();
            }
            let last = swarm(12);
            (forces(&mut contact, &last), contact.potential(&last).unwrap())
        })
    };
    let reference = run(1, 0..12);
    assert!(reference.1 > 0.0, "no contact");
    assert!(run(2, 0..12) == reference, "two threads differ from one");
    assert!(run(5, 0..12) == reference, "five threads differ from one");
    assert!(run(1, 11..12) == reference, "the past changes an answer");
}

#[test]
fn bad_bodies_and_settings_are_named() {
    let ball = |radius: f64| Body::new("ball", Shape::Sphere { radius }, Pose::default());
    let good = ParticleSettings::default();
    let build = |body: Body, settings: ParticleSettings, area: f64| {
        ParticleContact::new(vec![body], settings, vec![AREA, area])
            .map(|_| ())
            .map_err(|error| error.to_string())
    };
    assert_eq!(build(ball(1.0), good, AREA), Ok(()));
    let thick = Shape::Box { half_extents: [0.1, 0.2, 0.3], edge_radius: 0.15 };
    let cases = [
        (build(ball(-1.0), good, AREA), "radius of the body `ball` is -1"),
        (build(ball(f64::NAN), good, AREA), "NaN"),
        (build(ball(1.0).with_friction(-0.1), good, AREA), "friction coefficient"),
        (build(Body::new("box", thick, Pose::default()), good, AREA), "edge radius"),
        (
            build(ball(1.0), ParticleSettings { activation_distance: 0.0, ..good }, AREA),
            "contact offset",
        ),
        (
            build(ball(1.0), ParticleSettings { stiffness: f64::INFINITY, ..good }, AREA),
            "stiffness",
        ),
        (build(ball(1.0), ParticleSettings { slip_speed: -1.0, ..good }, AREA), "slip speed"),
        (build(ball(1.0), good, f64::NAN), "particle 1"),
    ];
    for (answer, words) in cases {
        let message = answer.expect_err(words);
        assert!(message.contains(words), "{message}");
    }
}

#[test]
fn a_body_that_cannot_be_moved_there_stays_where_it_is() {
    let ball = Body::new("ball", Shape::Sphere { radius: 0.1 }, Pose::default());
    let settings = ParticleSettings::default();
    let mut contact = ParticleContact::new(vec![ball], settings, vec![AREA]).unwrap();
    let positions = [0.0, 0.1005, 0.0];
    contact.begin(&positions, 1e-2).unwrap();
    let before = forces(&mut contact, &positions);
    let far = Pose::new([0.0, f64::NAN, 0.0]);
    let bent = Pose { rotation: [0.0, 0.0, 0.0, 2.0], ..Pose::default() };
    for (body, pose, words) in [
        (9, Pose::default(), "there is no body 9"),
        (usize::MAX, far, "there is no body"),
        (0, far, "position of the body `ball`"),
        (0, bent, "the rotation [0.0, 0.0, 0.0, 2.0] has length 2"),
    ] {
        let message = contact.move_body(body, pose).expect_err(words).to_string();
        assert!(message.contains(words), "{message}");
    }
    assert_eq!(contact.bodies()[0].pose, Pose::default());
    assert_eq!(forces(&mut contact, &positions), before);
}
