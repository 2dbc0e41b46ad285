//! Random motions of meshes: nothing intersects before an impact, and something touches at it.

use crate::shapes::{
    Point, Shape, all_between, loose_triangles, point_triangle, segment_segment, turned, wavy_grid,
};
use crate::support::{Dice, norm, sub};
use drape_collide::{
    Primitive, ProximityMesh, earliest_impact, earliest_self_impact, mesh_distance,
};
use rayon::ThreadPoolBuilder;

/// Largest displacement of a vertex of `first` against one of `second`, in m.
fn relative_speed(first: [&[Point]; 2], second: [&[Point]; 2]) -> f64 {
    let longest = |[start, end]: [&[Point]; 2]| {
        start.iter().zip(end).map(|(a, b)| norm(sub(*b, *a))).fold(0.0, f64::max)
    };
    longest(first) + longest(second)
}

fn distance_at(shapes: [&Shape; 2], ends: [&Shape; 2], fraction: f64) -> f64 {
    let [first, second] = [0, 1].map(|k| {
        let positions = all_between(&shapes[k].positions, &ends[k].positions, fraction);
        ProximityMesh::new(&positions, &shapes[k].triangles).unwrap()
    });
    mesh_distance(&first, &second).distance
}

#[test]
fn nothing_touches_before_an_impact_and_something_does_within_the_tolerance() {
    let mut dice = Dice::new(2026);
    let (mut met, mut passed) = (0, 0);
    for round in 0..600_u32 {
        let tolerance = [1e-3, 1e-6, 1e-9][round as usize % 3];
        let count = 1 + round % 4;
        // Scales and distances from the origin differ, and some vertices move apart.
        let size = [1.0, 1e-3, 300.0][round as usize / 3 % 3];
        let place = dice.point(if round % 5 == 0 { 100.0 } else { 0.0 });
        let room = if round % 2 == 0 { 0.3 } else { 1.0 };
        let scaled =
            |shape: Shape| shape.moved(|p| [0, 1, 2].map(|axis| size * (p[axis] + place[axis])));
        let shapes = [count, 3].map(|count| loose_triangles(&mut dice, count, room));
        let apart = dice.direction().map(|part| 3.0 * part);
        let second = shapes[1].moved(|p| [0, 1, 2].map(|axis| p[axis] + apart[axis]));
        let ends = [&shapes[0], &second].map(|shape| {
            let (toward, angle) = (dice.roll() + 1.0, dice.roll());
            let is_first = std::ptr::eq(shape, &shapes[0]);
            let shift = apart.map(|part| if is_first { (0.4 + 0.6 * toward) * part } else { 0.0 });
            let mut end = shape.moved(|p| turned(p, angle, shift));
            for position in &mut end.positions {
                let jitter = dice.point(0.4);
                *position = [0, 1, 2].map(|axis| position[axis] + jitter[axis]);
            }
            end
        });
        let [first, second] = [shapes[0].clone(), second].map(scaled);
        let ends = ends.map(scaled);
        let distance = |fraction| distance_at([&first, &second], [&ends[0], &ends[1]], fraction);
        if distance(0.0) == 0.0 {
            continue;
        }

        let meshes = [first.mesh(), second.mesh()];
        let motions = [0, 1].map(|k| meshes[k].moving_to(&ends[k].positions).unwrap());
        let first_impact = earliest_impact(&motions[0], &motions[1], tolerance).unwrap();
        let until = first_impact.map_or(1.0, |impact| impact.fraction);
        for sample in 0..=40 {
            let fraction = until * f64::from(sample) / 40.0;
            assert!(distance(fraction) > 0.0, "{round}: {first_impact:?} meets at {fraction}");
        }
        let swapped = earliest_impact(&motions[1], &motions[0], tolerance).unwrap();
        match (first_impact, swapped) {
            (Some(first_impact), Some(swapped)) => {
                met += 1;
                let speed = relative_speed(
                    [&first.positions, &ends[0].positions],
                    [&second.positions, &ends[1].positions],
                );
                let rounding = 1e-13 * size * 110.0;
                let after = distance(first_impact.fraction + 2.0 * tolerance);
                let most = 2.0 * tolerance * speed + rounding;
                assert!(after <= most, "{round}: {after} m after {first_impact:?}, at most {most}");
                assert!((first_impact.fraction - swapped.fraction).abs() <= tolerance, "{round}");
                assert!((norm(first_impact.normal) - 1.0).abs() < 1e-12, "{first_impact:?}");
            }
            (None, None) => passed += 1,
            _ => panic!("{round}: {first_impact:?}, exchanged {swapped:?}"),
        }
    }
    assert!(met > 150 && passed > 100, "{met} met, {passed} passed");
}

#[test]
fn an_impact_stays_under_rigid_motion_and_for_any_number_of_threads() {
    let (low, high) = (wavy_grid(25, 0.05, 0.0), wavy_grid(30, 0.06, 2.0));
    let mut dice = Dice::new(12);
    for round in 0..20 {
        let jitter = dice.point(0.2);
        let above = high.moved(|p| turned(p, 0.1 * jitter[0], [0.0, 0.5, 0.1]));
        let below = above.moved(|p| [p[0] + jitter[0], p[1] - 1.0 + 0.2 * p[0], p[2] + jitter[2]]);
        let fractions = [0.0, 1.1, 2.3].map(|angle| {
            let motion = |p: Point| turned(p, angle, [0.5 * angle, 0.0, -angle]);
            let [low, above, below] = [&low, &above, &below].map(|shape| shape.moved(motion));
            let meshes = [low.mesh(), above.mesh()];
            let answers = [1, 2, 3].map(|threads| {
                let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                pool.install(|| {
                    let falls = meshes[1].moving_to(&below.positions).unwrap();
                    earliest_impact(&meshes[0].at_rest(), &falls, 1e-9).unwrap().unwrap()
                })
            });
            assert!(answers.iter().all(|answer| *answer == answers[0]), "{answers:?}");
            (answers[0].fraction, answers[0].pair)
        });
        for (fraction, pair) in fractions {
            assert!((fraction - fractions[0].0).abs() < 2e-9, "{round}: {fractions:?}");
            assert_eq!(pair, fractions[0].1, "{round}: {fractions:?}");
        }
    }
}

#[test]
fn a_crumpling_sheet_does_not_intersect_itself_before_it_meets_itself() {
    let flat = wavy_grid(12, 0.02, 0.0);
    let mut dice = Dice::new(8);
    let mut met = 0;
    for _ in 0..30 {
        let end = Shape {
            positions: flat
                .positions
                .iter()
                .map(|p| {
                    let jitter = dice.point(0.04);
                    [0.4 * p[0] + jitter[0], p[1] + 3.0 * jitter[1], 0.5 * p[2] + jitter[2]]
                })
                .collect(),
            ..flat.clone()
        };
        let mesh = flat.mesh();
        let motion = mesh.moving_to(&end.positions).unwrap();
        let first_impact = earliest_self_impact(&motion, 1e-8).unwrap();
        let meets_itself = |fraction: f64| {
            let positions = all_between(&flat.positions, &end.positions, fraction);
            let mesh = ProximityMesh::new(&positions, &flat.triangles).unwrap();
            earliest_self_impact(&mesh.at_rest(), 1e-8).unwrap().is_some()
        };
        let until = first_impact.map_or(1.0, |impact| impact.fraction);
        assert!((0..50).all(|k| !meets_itself(until * f64::from(k) / 50.0)), "{first_impact:?}");
        if let Some(impact) = first_impact {
            met += 1;
            let after = all_between(&flat.positions, &end.positions, impact.fraction + 1e-8);
            let place = |vertex: u32| after[vertex as usize];
            let distance = match (impact.pair.first, impact.pair.second) {
                (Primitive::Edge(e), Primitive::Edge(f)) => {
                    segment_segment(e.map(place), f.map(place))
                }
                (Primitive::Vertex(v), Primitive::Triangle(t))
                | (Primitive::Triangle(t), Primitive::Vertex(v)) => {
                    point_triangle(place(v), flat.triangles[t as usize].map(place))
                }
                pair => panic!("{pair:?}"),
            };
            assert!(distance < 2e-8, "{distance} m after {impact:?}");
        }
    }
    assert!(met > 10, "{met}");
}
