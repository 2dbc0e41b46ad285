//! The contact energy of a pair: continuous, and the same for whoever looks.

use crate::sheets::{sheets, surface};
use crate::support::{Dice, derivative};
use drape_collide::{
    ContactDistances, Detector, Gap, GaussNewton, Pair, PairKind, SurfaceSettings,
};

const STIFFNESS: f64 = 1e6;

fn pair(kind: PairKind, vertices: [u32; 4]) -> Pair {
    let (activation_distance, min_separation, area) = (0.5, 0.05, 1e-3);
    let parallel = if kind == PairKind::EdgeEdge { 0.1 } else { 0.0 };
    Pair {
        kind,
        features: [0, 1],
        vertices,
        activation_distance,
        min_separation,
        area,
        parallel,
        distance: 0.0,
    }
}

fn energy(kind: PairKind, positions: &[f64]) -> f64 {
    Gap::new(&pair(kind, [0, 1, 2, 3]), positions).unwrap().energy(STIFFNESS)
}

/// Random places of a pair within activation distance but not within the minimum separation.
fn places(dice: &mut Dice, kind: PairKind) -> Vec<f64> {
    loop {
        let positions: Vec<f64> = (0..12).map(|_| 0.5 * dice.roll()).collect();
        let gap = Gap::new(&pair(kind, [0, 1, 2, 3]), &positions).unwrap();
        if gap.distance() > 0.06 && gap.distance() < 0.45 {
            return positions;
        }
    }
}

#[test]
fn the_energy_is_continuous_with_its_gradient_along_any_path() {
    let mut dice = Dice::new(61);
    let mut changes = 0;
    for kind in [PairKind::VertexFace, PairKind::EdgeEdge] {
        for _ in 0..100 {
            // A straight path on which the closest points wander over all features.
            let (from, to) = (places(&mut dice, kind), places(&mut dice, kind));
            let at = |time: f64| -> Vec<f64> {
                from.iter().zip(&to).map(|(a, b)| a + time * (b - a)).collect()
            };
            let gap = |time: f64| Gap::new(&pair(kind, [0, 1, 2, 3]), &at(time)).unwrap();
            let feature = |time: f64| gap(time).weights().map(|w| w != 0.0);
            let steps = 400;
            for step in 0..steps {
                let (mut low, mut high) = (step as f64 / 400.0, (step + 1) as f64 / 400.0);
                if feature(low) == feature(high) {
                    continue;
                }
                while high - low > 1e-9 {
                    let middle = 0.5 * (low + high);
                    if feature(middle) == feature(low) { low = middle } else { high = middle }
                }
                if gap(low).clearance() < 0.01 {
                    continue;
                }
                changes += 1;
                let (below, above) = (gap(low), gap(high));
                let jump = below.energy(STIFFNESS) - above.energy(STIFFNESS);
                let (slope, other) = (below.gradient(STIFFNESS), above.gradient(STIFFNESS));
                let steepest = slope.iter().fold(0.0, |size: f64, g| size.max(g.abs()));
                // The path is at most 2 m long, and at 1 cm the curvature is 1000/m of a slope.
                assert!(jump.abs() <= 1e-7 * steepest + 1e-12, "{kind:?}: {jump:e}, {steepest}");
                for (a, b) in slope.iter().zip(&other) {
                    let turn = (a - b).abs();
                    assert!(turn <= 1e-4 * steepest + 1e-9, "{kind:?}: {a} against {b}");
                }
            }
        }
    }
    assert!(changes > 200, "only {changes} changes of feature");
}

#[test]
fn edges_fade_out_as_they_become_parallel() {
    for shift in [0.0, 0.3] {
        // Two edges 0.1 m over each other, one turned by an angle about the vertical.
        let turned = |angle: f64| {
            let (sine, cosine) = angle.sin_cos();
            vec![
                -0.5,
                0.0,
                0.0,
                0.5,
                0.0,
                0.0, //
                shift - 0.5 * cosine,
                -0.5 * sine,
                0.1,
                shift + 0.5 * cosine,
                0.5 * sine,
                0.1,
            ]
        };
        let at_rest = energy(PairKind::EdgeEdge, &turned(0.0));
        assert_eq!(at_rest, 0.0);
        for angle in [1e-9, 1e-6, 1e-3] {
            let now = energy(PairKind::EdgeEdge, &turned(angle));
            let other = energy(PairKind::EdgeEdge, &turned(-angle));
            // Quadratic in the angle: 2 sin² / 0.1 of the whole.
            let whole = energy(PairKind::EdgeEdge, &turned(1.0));
            let fraction = 20.0 * angle.powi(2);
            assert!((now / whole / fraction - 1.0).abs() < 1e-3, "{now} of {whole} at {angle}");
            assert!((now - other).abs() <= 1e-9 * whole * fraction, "{now} and {other}");
        }
        let mut value = |x: &[f64]| [energy(PairKind::EdgeEdge, x)];
        let gap = Gap::new(&pair(PairKind::EdgeEdge, [0, 1, 2, 3]), &turned(1e-2)).unwrap();
        let gradient = gap.gradient(STIFFNESS);
        for k in 0..12 {
            let slope = derivative(&turned(1e-2), k, 1e-6, &mut value)[0];
            let size = gradient.iter().fold(0.0, |size: f64, g| size.max(g.abs()));
            assert!((slope - gradient[k]).abs() < 1e-5 * size, "{slope} against {}", gradient[k]);
        }
        let gap = Gap::new(&pair(PairKind::EdgeEdge, [0, 1, 2, 3]), &turned(1e-12)).unwrap();
        assert!(gap.hessian(STIFFNESS).as_flattened().iter().all(|entry| entry.is_finite()));
    }
}

#[test]
fn a_rigid_motion_changes_nothing_but_the_axes() {
    let mut dice = Dice::new(62);
    for kind in [PairKind::VertexFace, PairKind::EdgeEdge] {
        for _ in 0..300 {
            let positions = places(&mut dice, kind);
            // Rotation by a quaternion, and a shift.
            let [x, y, z] = dice.direction().map(|c| 0.8 * c);
            let w = 0.6;
            let rotate = |p: &[f64]| -> [f64; 3] {
                let t = [y * p[2] - z * p[1], z * p[0] - x * p[2], x * p[1] - y * p[0]];
                let t = t.map(|c| 2.0 * c);
                let u = [y * t[2] - z * t[1], z * t[0] - x * t[2], x * t[1] - y * t[0]];
                std::array::from_fn(|k| p[k] + w * t[k] + u[k])
            };
            let shift = dice.point(1.0);
            let moved: Vec<f64> = positions
                .chunks(3)
                .flat_map(|p| [0, 1, 2].map(|k| rotate(p)[k] + shift[k]))
                .collect();
            let (here, there) = (
                Gap::new(&pair(kind, [0, 1, 2, 3]), &positions).unwrap(),
                Gap::new(&pair(kind, [0, 1, 2, 3]), &moved).unwrap(),
            );
            let change = there.energy(STIFFNESS) / here.energy(STIFFNESS) - 1.0;
            assert!(change.abs() < 1e-9, "{change:e}");
            let (gradient, turned) = (here.gradient(STIFFNESS), there.gradient(STIFFNESS));
            let size = gradient.iter().fold(0.0, |size: f64, g| size.max(g.abs()));
            for (before, after) in gradient.chunks(3).zip(turned.chunks(3)) {
                let before = rotate(before);
                let miss = (0..3).map(|k| (before[k] - after[k]).abs()).fold(0.0, f64::max);
                assert!(miss < 1e-8 * size, "{before:?} against {after:?} of {size}");
            }
        }
    }
}

#[test]
fn the_names_of_vertices_and_sides_do_not_matter() {
    let mut dice = Dice::new(63);
    let swaps = [
        (PairKind::VertexFace, vec![[0, 2, 3, 1], [0, 3, 2, 1]]),
        (PairKind::EdgeEdge, vec![[2, 3, 0, 1], [1, 0, 2, 3], [3, 2, 1, 0]]),
    ];
    for (kind, orders) in swaps {
        for _ in 0..300 {
            let positions = places(&mut dice, kind);
            let gap = Gap::new(&pair(kind, [0, 1, 2, 3]), &positions).unwrap();
            let gradient = gap.gradient(STIFFNESS);
            let size = gradient.iter().fold(0.0, |size: f64, g| size.max(g.abs()));
            for order in &orders {
                let other = Gap::new(&pair(kind, *order), &positions).unwrap();
                assert!((other.distance() - gap.distance()).abs() < 1e-14);
                for (k, place) in other.gradient(STIFFNESS).chunks(3).enumerate() {
                    for axis in 0..3 {
                        let miss = (place[axis] - gradient[3 * order[k] as usize + axis]).abs();
                        assert!(miss < 1e-9 * size, "off by {miss} of {size}");
                    }
                }
            }
        }
    }
}

#[test]
fn the_definite_part_is_what_stays_on_a_straight_approach() {
    let mut dice = Dice::new(64);
    for _ in 0..100 {
        let positions = places(&mut dice, PairKind::VertexFace);
        let gap = Gap::new(&pair(PairKind::VertexFace, [0, 1, 2, 3]), &positions).unwrap();
        let GaussNewton { factor, distance_gradient } = gap.gauss_newton(STIFFNESS);
        assert!(factor >= 0.0);
        // The vertex goes along the normal: the distance changes evenly, the normal does not.
        let normal = gap.normal();
        let hessian = gap.hessian(STIFFNESS);
        let along = |k: usize| if k < 3 { normal[k] } else { 0.0 };
        let mut whole = 0.0;
        for (i, row) in hessian.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                whole += along(i) * along(j) * entry;
            }
        }
        let slope: f64 = (0..12).map(|k| along(k) * distance_gradient[k]).sum();
        let part = factor * slope * slope;
        assert!((slope - 1.0).abs() < 1e-12, "{slope}");
        assert!((whole - part).abs() < 1e-8 * part, "{whole} against {part}");
    }
}

#[test]
fn the_pressure_between_sheets_does_not_depend_on_the_mesh() {
    let pressure = |sides: [usize; 2], body: bool| {
        pressure(
            (sides, body),
            (4e-4, ContactDistances { activation_distance: 3e-4, min_separation: 1e-4 }),
            STIFFNESS,
        )
    };
    for body in [false, true] {
        let even = pressure([21, 21], body);
        let finer = pressure([61, 61], body);
        assert!((finer / even - 1.0).abs() < 0.02, "{even} and {finer} Pa");
        // Where the meshes differ the edges and the coarser mesh's vertices count for less.
        for sides in [[21, 61], [21, 151], [61, 21], [6, 61], [21, 2]] {
            let uneven = pressure(sides, body);
            assert!(uneven > 0.3 * even && uneven < even, "{uneven} and {even} Pa");
        }
    }
}

#[test]
fn a_pressed_pile_is_as_thick_as_the_stiffness_was_asked_for() {
    for (thickness, pressed) in [(5e-4, 3.5e-4), (5e-4, 4.5e-4), (1e-3, 3e-4)] {
        let half = ContactDistances {
            activation_distance: 0.5 * thickness,
            min_separation: 0.25 * pressed,
        };
        let of_pair = ContactDistances {
            activation_distance: 2.0 * half.activation_distance,
            min_separation: 2.0 * half.min_separation,
        };
        let stiffness = SurfaceSettings::stiffness_for_pressure(4900.0, pressed, of_pair);
        let found = pressure(([61, 61], false), (pressed, half), stiffness);
        // What of the sheets does not lie over the other is a fiftieth of them.
        assert!((found / 4900.0 - 1.0).abs() < 0.05, "{found} Pa");
    }
}

/// Mean pressure, in Pa, between two sheets of a quarter of a square metre and so many vertices
/// along their sides, of which the second may be a body; off by some of a cell, so that each point
/// of either stands for the same area.
fn pressure(
    (sides, body): ([usize; 2], bool),
    (distance, half): (f64, ContactDistances),
    stiffness: f64,
) -> f64 {
    let mut parts = sheets(1, sides[0], 0.5 / (sides[0] - 1) as f64);
    let other = sheets(1, sides[1], 0.5 / (sides[1] - 1) as f64);
    let first = parts.areas.len();
    parts.rest_positions.extend(&other.rest_positions);
    let lifted = |t: &[u32; 3]| t.map(|v| v + first as u32);
    parts.triangles.extend(other.triangles.iter().map(lifted));
    parts.areas.extend(&other.areas);
    parts.groups.extend(vec![1; other.areas.len()]);
    parts.distances = vec![half; 2];
    parts.free_vertices = if body { first } else { parts.areas.len() };
    let mut positions = parts.rest_positions.clone();
    for place in positions[3 * first..].chunks_mut(3) {
        place[2] = distance;
        (place[0], place[1]) = (place[0] + 1.7e-3, place[1] + 2.9e-3);
    }
    let surface = surface(&parts);
    let mut detector = Detector::default();
    let pairs = detector.detect(&surface, &positions, 1e-4).unwrap();
    let force = |pair: &Pair| {
        let gap = Gap::new(pair, &positions).unwrap();
        gap.normal_force(stiffness) * gap.normal()[2].abs()
    };
    pairs.as_slice().iter().map(force).sum::<f64>() / 0.25
}
