//! Meshes that must be refused, and files that must be understood.

#![allow(clippy::unwrap_used)]

mod support;

use drape_collide::{Body, Error, Mesh, Pose, Shape};
use std::path::PathBuf;
use support::meshed;

type Triangles = (Vec<[f64; 3]>, Vec<[u32; 3]>);

fn cube() -> Triangles {
    let shape = Shape::Box { half_extents: [0.5; 3], edge_radius: 0.0 };
    let outline = Body::new("cube", shape, Pose::default()).triangulate().unwrap();
    (outline.vertices, outline.triangles)
}

fn refusal(change: impl FnOnce(&mut Triangles)) -> Error {
    let mut cube = cube();
    change(&mut cube);
    let error = Mesh::new(&cube.0, &cube.1).expect_err("refused");
    assert!(error.to_string().len() > 30, "{error}");
    error
}

#[test]
fn a_surface_that_is_none_is_refused_with_its_place() {
    use Error as E;
    let error = refusal(|(_, triangles)| triangles[3][1] = 99);
    let expected = E::MissingVertex { triangle: 3, index: 99, vertices: 8 };
    assert_eq!(error, expected);

    let error = refusal(|(_, triangles)| triangles.truncate(11));
    assert!(matches!(error, E::OpenMesh { edges: 3, .. }), "{error:?}");

    let error = refusal(|(_, triangles)| triangles[0].swap(0, 1));
    assert!(matches!(error, E::InconsistentOrientation { edges: 3, .. }), "{error:?}");

    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        let error = refusal(|(vertices, _)| vertices[2][1] = bad);
        assert!(matches!(error, E::InvalidPosition { .. }), "{error:?}");
    }

    let error = refusal(|(_, triangles)| triangles.clear());
    assert_eq!(error, E::EmptyMesh { vertices: 8 });

    // A needle between two corners and the middle of their edge.
    let error = refusal(|(vertices, triangles)| {
        let [a, b, _] = triangles[0];
        let middle = [0, 1, 2].map(|k| 0.5 * (vertices[a as usize][k] + vertices[b as usize][k]));
        vertices.push(middle);
        triangles.push([a, b, 8]);
    });
    assert!(matches!(error, E::FlatTriangle { triangle: 12, .. }), "{error:?}");

    // Two sheets back to back are closed and hold nothing.
    let sheet = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let error = Mesh::new(&sheet, &[[0, 1, 2], [0, 2, 1]]).expect_err("hollow");
    assert_eq!(error, E::NoVolume { volume: 0.0 });
}

#[test]
fn an_inverted_surface_is_turned_and_says_so() {
    let (vertices, mut triangles) = cube();
    for triangle in &mut triangles {
        triangle.swap(1, 2);
    }
    let mesh = Mesh::new(&vertices, &triangles).unwrap();
    assert!(mesh.was_inside_out());
    let body = Body::new("cube", Shape::Mesh(mesh), Pose::default());
    let inner = body.signed_distance([0.0, 0.4, 0.1]).unwrap();
    assert!((inner.distance + 0.1).abs() < 1e-15, "{inner:?}");
    assert_eq!(inner.normal, [0.0, 1.0, 0.0]);
}

#[test]
fn separate_corners_of_neighbours_become_one() {
    let (vertices, triangles) = cube();
    let loose: Vec<[f64; 3]> = triangles.iter().flatten().map(|&i| vertices[i as usize]).collect();
    let numbers: Vec<[u32; 3]> = (0..12).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let mesh = Mesh::new(&loose, &numbers).unwrap();
    assert_eq!(mesh.vertices().len(), 8);
    assert_eq!(mesh.triangles().len(), 12);
}

/// A file in the system's temporary folder, removed at the end of the test.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str, text: &[u8]) -> Scratch {
        let path =
            std::env::temp_dir().join(format!("drape-collide-{}-{name}", std::process::id()));
        std::fs::write(&path, text).unwrap();
        Scratch(path)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

/// A cube of quads as a modeller writes it: groups, materials, normals, a colour per vertex.
const CUBE: &str = "mtllib missing.mtl
o cube
v -1 -1 -1 0.5 0.5 0.5
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
vt 0 0
vn 0 0 -1
g ends
usemtl red
f 1/1/1 4/1/1 3/1/1 2/1/1
f 5//1 6//1 7//1 8//1
g sides
s 1
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f -8 -4 -1 -5
";

#[test]
fn a_file_with_groups_is_one_body() {
    let file = Scratch::new("cube.obj", CUBE.as_bytes());
    let mesh = Mesh::load(&file.0, 0.01).unwrap();
    assert_eq!((mesh.vertices().len(), mesh.triangles().len()), (8, 12));
    let body = Body::new("cube", Shape::Mesh(mesh), Pose::default());
    let above = body.signed_distance([0.002, 0.015, 0.001]).unwrap();
    assert!((above.distance - 0.005).abs() < 1e-15, "{above:?}");
}

#[test]
fn bad_files_are_refused_without_a_panic() {
    let missing = Mesh::load("no/such/file.obj", 1.0).expect_err("missing");
    assert!(missing.to_string().contains("no/such/file.obj"), "{missing}");
    let scale = Mesh::load("no/such/file.obj", 0.0).expect_err("scale");
    assert!(matches!(scale, Error::OutOfRange { .. }), "{scale:?}");
    let texts: [&[u8]; 9] = [
        b"",
        b"v 0 0 0\nv 1 0 0\n",
        b"v 0 0 zero\n",
        b"v 0 0\nf 1 1 1\n",
        b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99\n",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9\n",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\nf / / /\n",
        b"\xff\xfe\x00 not text\nv 0 0 0\nf\nf 1\nf 1 1\n",
    ];
    for (k, text) in texts.iter().enumerate() {
        let file = Scratch::new(&format!("bad-{k}.obj"), text);
        let error = Mesh::load(&file.0, 1.0).expect_err("refused");
        assert!(!error.to_string().is_empty(), "text {k}");
    }
    // Cut anywhere, the file is refused or still the cube.
    for end in 0..CUBE.len() {
        let file = Scratch::new("cut.obj", &CUBE.as_bytes()[..end]);
        if let Ok(mesh) = Mesh::load(&file.0, 1.0) {
            assert_eq!(mesh.triangles().len(), 12, "cut at {end}");
        }
    }
}

#[test]
fn a_ball_of_triangles_is_near_the_ball() {
    let exact = Body::new("ball", Shape::Sphere { radius: 0.3 }, Pose::default());
    let mesh = Shape::Mesh(meshed(Shape::Sphere { radius: 0.3 }));
    let mesh = Body::new("mesh", mesh, Pose::default());
    let mut dice = support::Dice::new(4);
    for _ in 0..1000 {
        let point = dice.point(0.5);
        let (a, b) = (exact.signed_distance(point).unwrap(), mesh.signed_distance(point).unwrap());
        // Facets of at most 6° lie up to 0.3 m (1 - cos 4.3°) = 0.84 mm under the ball.
        let miss = b.distance - a.distance;
        assert!((-1e-12..8.4e-4).contains(&miss), "{point:?}: {miss:e}");
    }
}
