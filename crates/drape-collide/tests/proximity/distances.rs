//! Distances of meshes against all pairs, and what they do not depend on.

use crate::shapes::{
    Point, Shape, distance_of_all_pairs, loose_triangles, point_triangle, segment_segment, turned,
    wavy_grid,
};
use crate::support::{Dice, norm, sub};
use drape_collide::{MeshDistance, Primitive, ProximityMesh, mesh_distance};

/// Asserts that the pair and the points that `measured` names have its distance.
fn assert_consistent(measured: &MeshDistance, shapes: [&Shape; 2]) {
    let [p, q] = measured.points;
    let scale = norm(p).max(norm(q)).max(1.0);
    assert!((norm(sub(p, q)) - measured.distance).abs() < 1e-14 * scale, "{measured:?}");
    let place = |mesh: usize, vertex: u32| shapes[mesh].positions[vertex as usize];
    let corners = |mesh: usize, triangle: u32| {
        shapes[mesh].triangles[triangle as usize].map(|corner| place(mesh, corner))
    };
    let of_pair = match (measured.pair.first, measured.pair.second) {
        (Primitive::Vertex(v), Primitive::Triangle(t)) => {
            point_triangle(place(0, v), corners(1, t))
        }
        (Primitive::Triangle(t), Primitive::Vertex(v)) => {
            point_triangle(place(1, v), corners(0, t))
        }
        (Primitive::Edge(e), Primitive::Edge(f)) => {
            segment_segment(e.map(|end| place(0, end)), f.map(|end| place(1, end)))
        }
        pair => panic!("{pair:?} of meshes that do not intersect"),
    };
    assert!((of_pair - measured.distance).abs() < 1e-12 * scale, "{of_pair} of {measured:?}");
}

#[test]
fn the_distance_is_the_least_of_all_pairs() {
    let mut dice = Dice::new(5);
    let mut nearest = Vec::new();
    for round in 0..60 {
        let count = 1 + round % 12;
        let first = loose_triangles(&mut dice, count, 2.0);
        // Some pairs of meshes are far apart, some are entangled without touching.
        let apart = [[8.0, 0.0, 0.0], [0.0, 4.5, 1.0], [2.5, 2.5, 2.5]][round as usize % 3];
        let second = loose_triangles(&mut dice, 1 + round % 7, 2.0)
            .moved(|point| turned(point, f64::from(round), apart));
        let measured = mesh_distance(&first.mesh(), &second.mesh());
        if measured.distance == 0.0 {
            continue;
        }
        let all = distance_of_all_pairs(&first, &second);
        assert!((measured.distance - all).abs() < 1e-12, "{round}: {measured:?}, {all}");
        assert_consistent(&measured, [&first, &second]);
        nearest.push(measured.distance);
    }
    assert!(nearest.len() > 40 && nearest.iter().any(|d| *d < 0.3), "{nearest:?}");
}

#[test]
fn grids_have_the_distance_of_all_pairs_also_after_a_move() {
    let (low, high) = (wavy_grid(14, 0.05, 0.0), wavy_grid(11, 0.04, 2.0));
    let mut mesh = high.mesh();
    for (angle, height) in [(0.0, 0.3), (0.4, 1.0), (1.5, 1.7), (3.0, 0.9)] {
        let high = high.moved(|point| turned(point, angle, [0.1, height, -0.2]));
        mesh.move_to(&high.positions).unwrap();
        let measured = mesh_distance(&low.mesh(), &mesh);
        let all = distance_of_all_pairs(&low, &high);
        assert!(
            all > 0.01 && (measured.distance - all).abs() < 1e-13,
            "{angle}: {measured:?}, {all}"
        );
        assert_consistent(&measured, [&low, &high]);
        // The moved mesh has the answers of a new one, up to which of two equal pairs is named.
        assert_eq!(mesh_distance(&low.mesh(), &high.mesh()).distance, measured.distance);
    }
}

#[test]
fn distances_stay_under_exchange_and_rigid_motion() {
    let mut dice = Dice::new(9);
    for round in 0..30 {
        let first = loose_triangles(&mut dice, 5, 1.0);
        let second = loose_triangles(&mut dice, 4, 1.0).moved(|p| [p[0] + 3.0, p[1], p[2]]);
        let measured = mesh_distance(&first.mesh(), &second.mesh());
        let swapped = mesh_distance(&second.mesh(), &first.mesh());
        assert!((measured.distance - swapped.distance).abs() < 1e-14, "{measured:?}, {swapped:?}");
        for (point, mirrored) in measured.points.into_iter().zip(swapped.points.into_iter().rev()) {
            assert!(norm(sub(point, mirrored)) < 1e-9, "{measured:?}, {swapped:?}");
        }

        let motion = |point: Point| turned(point, f64::from(round), [0.3, -2.0, 5.0]);
        let moved = mesh_distance(&first.moved(motion).mesh(), &second.moved(motion).mesh());
        assert!((moved.distance - measured.distance).abs() < 1e-13, "{moved:?}, {measured:?}");
        for (point, before) in moved.points.into_iter().zip(measured.points) {
            assert!(norm(sub(point, motion(before))) < 1e-7, "{point:?}, {before:?}");
        }
    }
}

#[test]
fn meshes_that_intersect_have_no_distance_and_name_an_edge_and_a_triangle() {
    // A needle through a large triangle, far from all edges and vertices.
    let plate = Shape {
        positions: vec![[-9.0, 0.0, -9.0], [9.0, 0.0, -9.0], [0.0, 0.0, 9.0]],
        triangles: vec![[0, 1, 2]],
    };
    let needle = Shape {
        positions: vec![[0.1, 3.0, 0.2], [0.1, -1.0, 0.2], [0.2, -1.0, 0.2]],
        triangles: vec![[0, 1, 2]],
    };
    let measured = mesh_distance(&plate.mesh(), &needle.mesh());
    assert_eq!(measured.distance, 0.0);
    assert_eq!(measured.pair.first, Primitive::Triangle(0));
    assert!(matches!(measured.pair.second, Primitive::Edge([0, _])), "{measured:?}");
    assert!(
        measured.points[0][1].abs() < 1e-15 && measured.points[0] == measured.points[1],
        "{measured:?}"
    );
    assert_eq!(mesh_distance(&needle.mesh(), &plate.mesh()).pair.second, measured.pair.first);
}

#[test]
fn points_and_edges_have_distances_like_triangles() {
    let mut dice = Dice::new(31);
    let cloud: Vec<Point> = (0..200).map(|_| dice.point(1.0)).collect();
    let probes: Vec<Point> = (0..40).map(|_| dice.point(3.0)).collect();
    let mesh = ProximityMesh::new(&cloud, &[]).unwrap();
    for probe in &probes {
        let measured = mesh_distance(&ProximityMesh::new(&[*probe], &[]).unwrap(), &mesh);
        let all = cloud.iter().map(|point| norm(sub(*point, *probe))).fold(9e99, f64::min);
        assert!((measured.distance - all).abs() < 1e-14, "{measured:?}, {all}");
        assert!(matches!(measured.pair.second, Primitive::Vertex(_)), "{measured:?}");
    }

    // A yarn of 39 edges, and the cloud.
    let edges: Vec<[u32; 2]> = (0..39).map(|k| [k + 1, k]).collect();
    let yarn = ProximityMesh::with_edges(&probes, &[], &edges).unwrap();
    let measured = mesh_distance(&yarn, &mesh);
    let all = edges.iter().flat_map(|edge| {
        let edge = edge.map(|end| probes[end as usize]);
        cloud.iter().map(move |point| crate::shapes::point_segment(*point, edge))
    });
    let all = all.fold(9e99, f64::min);
    assert!((measured.distance - all).abs() < 1e-14, "{measured:?}, {all}");
    assert!(matches!(measured.pair.first, Primitive::Edge([a, b]) if b == a + 1), "{measured:?}");
}
