//! Impacts at known times.

use crate::shapes::{Point, Shape, turned, wavy_grid};
use crate::support::{Dice, norm, sub};
use drape_collide::{
    Impact, Primitive, PrimitivePair, ProximityMesh, earliest_impact, earliest_self_impact,
};

const TOLERANCE: f64 = 1e-7;

/// The impact of two shapes that move to `ends`.
fn impact(shapes: [&Shape; 2], ends: [&Shape; 2], tolerance: f64) -> Option<Impact> {
    let meshes = shapes.map(Shape::mesh);
    let [first, second] = [0, 1].map(|k| meshes[k].moving_to(&ends[k].positions).unwrap());
    earliest_impact(&first, &second, tolerance).unwrap()
}

fn assert_at(first_impact: &Impact, fraction: f64, tolerance: f64) {
    let early = fraction - first_impact.fraction;
    assert!((-4.0 * f64::EPSILON..=tolerance).contains(&early), "{first_impact:?} for {fraction}");
}

fn triangle(positions: [Point; 3]) -> Shape {
    Shape { positions: positions.to_vec(), triangles: vec![[0, 1, 2]] }
}

#[test]
fn a_triangle_that_falls_on_a_plane_meets_it_when_its_lowest_corner_does() {
    let floor = triangle([[-9.0, 0.0, -9.0], [0.0, 0.0, 9.0], [9.0, 0.0, -9.0]]);
    let mut dice = Dice::new(3);
    for round in 0..200 {
        let mut corners = [0; 3].map(|_| dice.point(1.0));
        let mut speeds = [0; 3].map(|_| dice.roll() - 1.5);
        corners.iter_mut().for_each(|corner| corner[1] += 1.2);
        if round % 2 == 0 {
            speeds = [speeds[0]; 3];
        }
        let start = triangle(corners);
        let end = triangle([0, 1, 2].map(|k| {
            let [x, y, z] = corners[k];
            [x + 0.3, y + 3.0 * speeds[k], z - 0.2]
        }));
        let times = [0, 1, 2].map(|k| corners[k][1] / (-3.0 * speeds[k]));
        let first = times.into_iter().fold(9e99, f64::min);
        for tolerance in [1e-2, TOLERANCE, 1e-13] {
            let first_impact = impact([&start, &floor], [&end, &floor], tolerance);
            if first > 1.0 {
                assert_eq!(first_impact, None, "{first}");
                continue;
            }
            let first_impact = first_impact.unwrap();
            assert_at(&first_impact, first, tolerance);
            assert_eq!(first_impact.pair.second, Primitive::Triangle(0));
            assert!(norm(sub(first_impact.normal, [0.0, 1.0, 0.0])) < 1e-12, "{first_impact:?}");
            let Primitive::Vertex(vertex) = first_impact.pair.first else {
                panic!("{first_impact:?}")
            };
            assert!(times[vertex as usize] <= first + tolerance, "{first_impact:?} of {times:?}");

            let swapped = impact([&floor, &start], [&floor, &end], tolerance).unwrap();
            assert_at(&swapped, first, tolerance);
            assert!(norm(sub(swapped.normal, [0.0, -1.0, 0.0])) < 1e-12, "{swapped:?}");
        }
    }
}

#[test]
fn two_edges_cross_at_a_known_fraction() {
    // Ridges of two roofs: one along x points up, one along z falls on it by 2 m from 0.8 m.
    let ridge = |points: [Point; 4]| Shape {
        positions: points.to_vec(),
        triangles: vec![[0, 1, 2], [1, 0, 3]],
    };
    let low = ridge([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 1.0], [0.0, -1.0, -1.0]]);
    let high = ridge([[0.3, 0.8, -1.0], [0.3, 0.8, 1.0], [1.3, 1.8, 0.0], [-0.7, 1.8, 0.0]]);
    let fallen = high.moved(|[x, y, z]| [x, y - 2.0, z]);
    let first_impact = impact([&low, &high], [&low, &fallen], TOLERANCE).unwrap();
    assert_at(&first_impact, 0.4, TOLERANCE);
    let edges = PrimitivePair { first: Primitive::Edge([0, 1]), second: Primitive::Edge([0, 1]) };
    assert_eq!(first_impact.pair, edges);
    assert!(norm(sub(first_impact.normal, [0.0, -1.0, 0.0])) < 1e-12, "{first_impact:?}");

    // Both move, and the whole is turned and shifted.
    let sunk = low.moved(|[x, y, z]| [x + 0.1, y + 2.0, z]);
    for angle in [0.0, 0.7, 2.0] {
        let motion = |point: Point| turned(point, angle, [3.0, -1.0, 0.5]);
        let shapes = [low.moved(motion), high.moved(motion)];
        let ends = [sunk.moved(motion), fallen.moved(motion)];
        let first_impact =
            impact([&shapes[0], &shapes[1]], [&ends[0], &ends[1]], TOLERANCE).unwrap();
        assert_at(&first_impact, 0.2, TOLERANCE);
        assert_eq!(first_impact.pair, edges);
        let down = sub(motion([0.0, -1.0, 0.0]), motion([0.0; 3]));
        assert!(norm(sub(first_impact.normal, down)) < 1e-9, "{first_impact:?}, {down:?}");
    }
}

#[test]
fn a_triangle_that_swings_meets_a_point_when_its_plane_does() {
    // Corner 2 of the triangle goes from (1, 0) to (1, 1) in y, the point stands at x = 1/2 and
    // y = 1/5: the plane passes the point at the fraction 2/5.
    let start = triangle([[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
    let end = triangle([[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [1.0, 1.0, 0.0]]);
    let point = Shape { positions: vec![[0.5, 0.2, 0.1]], triangles: Vec::new() };
    let first_impact = impact([&point, &start], [&point, &end], TOLERANCE).unwrap();
    assert_at(&first_impact, 0.4, TOLERANCE);
    let slope = 0.4_f64;
    let length = (1.0 + slope * slope).sqrt();
    assert!(
        norm(sub(first_impact.normal, [-slope / length, 1.0 / length, 0.0])) < 1e-6,
        "{first_impact:?}"
    );
}

#[test]
fn points_meet_points_and_edges_only_head_on() {
    let point = |place: Point| Shape { positions: vec![place], triangles: Vec::new() };
    let rest = point([0.0; 3]);
    let first_impact =
        impact([&point([1.0, 1.0, 1.0]), &rest], [&point([-1.0; 3]), &rest], TOLERANCE).unwrap();
    assert_at(&first_impact, 0.5, TOLERANCE);
    let third = 1.0 / 3.0_f64.sqrt();
    assert!(norm(sub(first_impact.normal, [third; 3])) < 1e-9, "{first_impact:?}");
    let beside = impact([&point([1.0, 1.0, 1.0 + 1e-9]), &rest], [&point([-1.0; 3]), &rest], 1e-7);
    assert_eq!(beside, None);
}

#[test]
fn a_sheet_meets_itself_where_it_is_folded() {
    // A strip of four triangles in a V, whose flaps close: their ends are 1 m apart and meet.
    let strip = Shape {
        positions: vec![
            [0.0, 0.0, 0.0],
            [0.0, 0.0, 1.0],
            [1.0, 0.5, 0.0],
            [1.0, 0.5, 1.0],
            [1.0, -0.5, 0.2],
            [1.0, -0.5, 0.8],
        ],
        triangles: vec![[0, 2, 3], [0, 3, 1], [0, 5, 4], [0, 1, 5]],
    };
    let closed = strip.moved(|[x, y, z]| [x, -y, z]);
    let mesh = strip.mesh();
    let motion = mesh.moving_to(&closed.positions).unwrap();
    let first_impact = earliest_self_impact(&motion, TOLERANCE).unwrap().unwrap();
    assert_at(&first_impact, 0.5, TOLERANCE);
    assert_eq!(earliest_self_impact(&mesh.at_rest(), TOLERANCE).unwrap(), None);

    // A grid that waves without touching itself.
    let (flat, waves) = (wavy_grid(20, 0.0, 0.0), wavy_grid(20, 0.05, 1.0));
    let mesh = flat.mesh();
    let motion = mesh.moving_to(&waves.positions).unwrap();
    assert_eq!(earliest_self_impact(&motion, TOLERANCE).unwrap(), None);
}

#[test]
fn meshes_that_touch_or_intersect_at_the_start_meet_at_once() {
    let floor = triangle([[-9.0, 0.0, -9.0], [0.0, 0.0, 9.0], [9.0, 0.0, -9.0]]);
    let lifted = |shape: &Shape| shape.moved(|[x, y, z]| [x, y + 1.0, z]);
    // One corner on the floor, parting; and an edge through the floor.
    let touches = triangle([[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]]);
    let first_impact = impact([&touches, &floor], [&lifted(&touches), &floor], TOLERANCE).unwrap();
    assert_eq!((first_impact.fraction, first_impact.pair.first), (0.0, Primitive::Vertex(0)));
    let crosses = triangle([[0.0, -0.1, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]]);
    let first_impact = impact([&crosses, &floor], [&lifted(&crosses), &floor], TOLERANCE).unwrap();
    assert_eq!((first_impact.fraction, first_impact.normal), (0.0, [0.0; 3]));
    assert!(matches!(first_impact.pair.first, Primitive::Edge([0, _])), "{first_impact:?}");
}

#[test]
fn two_point_clouds_pass_each_other_and_a_cloud_meets_a_mesh() {
    let mut dice = Dice::new(77);
    let cloud: Vec<Point> = (0..300).map(|_| dice.point(0.5)).collect();
    let lower: Vec<Point> = cloud.iter().map(|p| [p[0], p[1] - 4.0, p[2]]).collect();
    let upper = ProximityMesh::new(&cloud, &[]).unwrap();
    let shifted: Vec<Point> = lower.iter().map(|p| [p[0] + 0.013, p[1], p[2]]).collect();
    let passed = ProximityMesh::new(&shifted, &[]).unwrap();
    let motion = upper.moving_to(&lower).unwrap();
    assert_eq!(earliest_impact(&motion, &passed.at_rest(), TOLERANCE).unwrap(), None);

    let floor = triangle([[-9.0, -1.0, -9.0], [0.0, -1.0, 9.0], [9.0, -1.0, -9.0]]).mesh();
    let first_impact = earliest_impact(&motion, &floor.at_rest(), TOLERANCE).unwrap().unwrap();
    let lowest = (0..300).min_by(|a: &usize, b| cloud[*a][1].total_cmp(&cloud[*b][1])).unwrap();
    assert_eq!(first_impact.pair.first, Primitive::Vertex(lowest as u32));
    assert_at(&first_impact, (cloud[lowest][1] + 1.0) / 4.0, TOLERANCE);
}
