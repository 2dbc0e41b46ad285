//! Distances, normals and curvatures against other computations.

#![allow(clippy::unwrap_used)]

mod support;

use drape_collide::{Body, Mesh, Pose, Shape};
use support::{Dice, derivative, meshed, norm, primitives, sub};

fn distance(body: &Body, point: [f64; 3]) -> f64 {
    body.signed_distance(point).unwrap().distance
}

#[test]
fn no_sample_of_the_surface_is_nearer_than_the_distance() {
    let mut dice = Dice::new(1);
    for body in primitives() {
        if matches!(body.shape, Shape::Plane) {
            continue;
        }
        // The outline, whose vertices are found without any distance, and points between them.
        let outline = body.triangulate().unwrap();
        let corner = |t: &[u32; 3], k: usize| outline.vertices[t[k] as usize];
        let mut samples = Vec::new();
        for t in &outline.triangles {
            let [a, b, c] = [corner(t, 0), corner(t, 1), corner(t, 2)];
            let longest = norm(sub(a, b)).max(norm(sub(b, c))).max(norm(sub(c, a)));
            let cells = (longest / 5e-3).ceil() as usize;
            for i in 0..=cells {
                for j in 0..=cells - i {
                    let (u, v) = (i as f64 / cells as f64, j as f64 / cells as f64);
                    samples.push([0, 1, 2].map(|k| a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k])));
                }
            }
        }
        // The facets of the outline span 5.6°, 8° across, and so lie up to 0.3 m * (1 - cos 4°) =
        // 0.73 mm under the surface; the samples are up to 5 mm apart.
        let sag = 7.4e-4;
        for _ in 0..100 {
            let point = dice.point(0.8);
            let exact = distance(&body, point).abs();
            let gap = samples.iter().map(|s| norm(sub(*s, point)));
            let nearest = gap.fold(f64::MAX, f64::min);
            let spread: f64 = 5e-3;
            let late = (exact * exact + spread * spread).sqrt();
            assert!(
                nearest > exact - sag && nearest < late + sag,
                "{}: {point:?} is {exact} away, but a sample is {nearest} away",
                body.name
            );
        }
    }
}

#[test]
fn known_points_have_known_distances() {
    let at =
        |shape: Shape, point: [f64; 3]| distance(&Body::new("b", shape, Pose::default()), point);
    let cube = Shape::Box { half_extents: [0.25; 3], edge_radius: 0.0 };
    let tin = Shape::Cylinder { radius: 0.1, half_height: 0.2, edge_radius: 0.0 };
    let cases = [
        (at(cube.clone(), [0.0, 0.35, 0.0]), 0.1),
        (at(cube.clone(), [0.0, 0.24, 0.0]), -0.01),
        (at(cube.clone(), [0.0, 0.28, 0.29]), 0.05),
        (at(cube, [0.27, 0.28, 0.31]), (4e-4f64 + 9e-4 + 36e-4).sqrt()),
        (at(tin.clone(), [0.3, 0.0, 0.4]), 0.4),
        (at(tin.clone(), [0.05, 0.25, 0.0]), 0.05),
        (at(tin.clone(), [0.0, 0.24, 0.13]), 0.05),
        (at(tin, [0.0, -0.05, 0.0]), -0.1),
        (at(Shape::Sphere { radius: 0.5 }, [0.0, 0.0, 0.1]), -0.4),
        (at(Shape::Plane, [3.0, -0.2, 1.0]), -0.2),
    ];
    for (k, (measured, expected)) in cases.iter().enumerate() {
        let miss = (measured - expected).abs();
        assert!(miss < 1e-15, "case {k}: {measured}, not {expected}");
    }
}

/// Points in the frame of the box of `primitives` beyond a face, an edge, a corner, and inside;
/// they serve the other forms as well.
const PLACES: [[f64; 3]; 7] = [
    [0.1, 0.33, 0.1],
    [-0.23, 0.32, 0.05],
    [0.21, -0.33, 0.27],
    [0.1, 0.05, 0.29],
    [0.12, 0.1, 0.02],
    [-0.03, 0.27, -0.05],
    [0.19, 0.285, 0.03],
];

#[test]
fn normal_and_curvature_are_the_derivatives_of_the_distance() {
    for body in primitives() {
        let pose = body.pose;
        for place in PLACES {
            // The pose is a rotation about the origin and a shift: place the point by hand.
            let point = turned_by(pose, place);
            let here = body.signed_distance(point).unwrap();
            assert!((norm(here.normal) - 1.0).abs() < 1e-14);
            for axis in 0..3 {
                let [slope] =
                    derivative(&point, axis, 1e-4, &mut |x| [distance(&body, [x[0], x[1], x[2]])]);
                let miss = (slope - here.normal[axis]).abs();
                // Fourth order: (1e-4)^4 over the cube of the smallest radius, 1e-2 m.
                assert!(miss < 1e-9, "{} at {place:?}: normal off by {miss:e}", body.name);
                let column = derivative(&point, axis, 1e-4, &mut |x| {
                    body.signed_distance([x[0], x[1], x[2]]).unwrap().normal
                });
                for row in 0..3 {
                    let miss = (column[row] - here.curvature[3 * row + axis]).abs();
                    let size = norm(column).max(1.0);
                    assert!(
                        miss < 1e-6 * size,
                        "{} at {place:?}: curvature off by {miss:e} of {size}",
                        body.name
                    );
                }
            }
        }
    }
}

fn turned_by(pose: Pose, place: [f64; 3]) -> [f64; 3] {
    let [x, y, z, w] = pose.rotation;
    let axis = [x, y, z];
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let once = cross(axis, place);
    let twice = cross(axis, once);
    [0, 1, 2].map(|k| pose.position[k] + place[k] + 2.0 * (w * once[k] + twice[k]))
}

#[test]
fn a_box_of_triangles_is_the_box() {
    let shape = Shape::Box { half_extents: [0.2, 0.3, 0.25], edge_radius: 0.0 };
    let pose = Pose::new([0.1, -0.2, 0.3]).rotated([1.0, 2.0, -0.5], 0.7);
    let exact = Body::new("box", shape.clone(), pose);
    let meshed = Body::new("mesh", Shape::Mesh(meshed(shape)), pose);
    let mut dice = Dice::new(2);
    let mut inside = 0;
    for _ in 0..5000 {
        let point = dice.point(0.6);
        let (a, b) =
            (exact.signed_distance(point).unwrap(), meshed.signed_distance(point).unwrap());
        inside += usize::from(a.distance < 0.0);
        let miss = (a.distance - b.distance).abs();
        assert!(miss < 1e-14, "{point:?}: distance off by {miss:e}");
        let miss = norm(sub(a.normal, b.normal));
        assert!(miss < 1e-12, "{point:?}: normal off by {miss:e}");
        let size = a.curvature.iter().fold(1.0, |most: f64, c| most.max(c.abs()));
        for (a, b) in a.curvature.iter().zip(b.curvature) {
            assert!((a - b).abs() < 1e-10 * size, "{point:?}: {a} or {b}");
        }
    }
    assert!(inside > 100, "only {inside} points were inside");
}

#[test]
fn a_hollow_corner_is_inside_on_both_sides_of_it() {
    // An L of two unit squares and a corner cut out, one unit deep: the reflex edge is at (1, 1).
    let profile = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let mut vertices = Vec::new();
    for z in [0.0, 1.0] {
        vertices.extend(profile.map(|[x, y]| [x, y, z]));
    }
    let mut triangles = Vec::new();
    for [a, b, c] in [[0, 1, 3], [1, 2, 3], [0, 3, 5], [3, 4, 5]] {
        triangles.push([a, c, b]);
        triangles.push([a + 6, b + 6, c + 6]);
    }
    for a in 0..6u32 {
        let b = (a + 1) % 6;
        triangles.push([a, b, b + 6]);
        triangles.push([a, b + 6, a + 6]);
    }
    let mesh = Mesh::new(&vertices, &triangles).unwrap();
    assert!(!mesh.was_inside_out());
    let body = Body::new("L", Shape::Mesh(mesh), Pose::default());
    // In the solid the reflex edge is the nearest point; in the notch a face is.
    let deep = distance(&body, [0.7, 0.6, 0.5]);
    assert!((deep + 0.5).abs() < 1e-15, "{deep}");
    let notch = distance(&body, [1.2, 1.1, 0.5]);
    assert!((notch - 0.1).abs() < 1e-15, "{notch}");
}

#[test]
fn a_point_that_is_no_point_gets_no_distance() {
    let mut bodies = primitives();
    let cube = Shape::Box { half_extents: [0.25; 3], edge_radius: 0.0 };
    bodies.push(Body::new("mesh", Shape::Mesh(meshed(cube)), Pose::default()));
    for body in bodies {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for axis in 0..3 {
                let mut point = [0.3, 0.2, 0.1];
                point[axis] = bad;
                let answer = body.signed_distance(point).unwrap();
                assert!(answer.distance.is_nan(), "{}: {answer:?}", body.name);
                assert!(answer.normal.iter().all(|n| n.is_nan()), "{answer:?}");
            }
        }
    }
}

#[test]
fn outlines_are_closed_and_have_the_volume_of_the_body() {
    use std::f64::consts::PI;
    let volumes = [
        // Of the ball, the box, the rounded box (Steiner's formula) and the cylinder, each with the
        // fraction that facets of 5.6° may lose: of a disc 1 - sin(2π/64)/(2π/64) = 0.16 %, of a
        // ball three times its largest sag of 0.24 %, of the rounded box that of its rounded part.
        (4.0 / 3.0 * PI * 0.3f64.powi(3), 7.3e-3),
        (0.4 * 0.6 * 0.5, 1e-14),
        (
            {
                let (a, b, c, r) = (0.3, 0.5, 0.4, 0.05);
                let edges = PI * r * r * (a + b + c);
                let sides = 2.0 * r * (a * b + b * c + c * a);
                a * b * c + sides + edges + 4.0 / 3.0 * PI * r.powi(3)
            },
            2e-4,
        ),
        (PI * 0.2 * 0.2 * 0.6, 1.7e-3),
    ];
    for (body, (expected, lost)) in primitives().iter().zip(volumes) {
        let outline = body.triangulate().unwrap();
        // Only a closed surface passes.
        let mesh = Mesh::new(&outline.vertices, &outline.triangles).unwrap();
        assert!(!mesh.was_inside_out(), "{}", body.name);
        let corner =
            |t: &[u32; 3], k: usize| sub(outline.vertices[t[k] as usize], body.pose.position);
        let volume: f64 = outline
            .triangles
            .iter()
            .map(|t| {
                let [a, b, c] = [corner(t, 0), corner(t, 1), corner(t, 2)];
                (a[0] * (b[1] * c[2] - b[2] * c[1])
                    + a[1] * (b[2] * c[0] - b[0] * c[2])
                    + a[2] * (b[0] * c[1] - b[1] * c[0]))
                    / 6.0
            })
            .sum();
        let loss = 1.0 - volume / expected;
        assert!(
            (-1e-14..lost).contains(&loss),
            "{}: {volume} m³ instead of {expected} m³",
            body.name
        );
        for vertex in &outline.vertices {
            let off = distance(body, *vertex).abs();
            assert!(off < 1e-15, "{}: a vertex is {off:e} off", body.name);
        }
    }
}
