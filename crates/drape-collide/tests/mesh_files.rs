//! Bodies from files: every format gives the same body, and what is wrong is refused without a
//! panic.

#![allow(clippy::unwrap_used)]

use drape_collide::{Error, Mesh, read_mesh};
use std::path::{Path, PathBuf};

/// Corners of a pyramid 2 wide and 1 high, and its triangles.
const CORNERS: [[f32; 3]; 5] =
    [[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [-1.0, 0.0, 1.0], [0.0, 1.0, 0.0]];
const TRIANGLES: [[usize; 3]; 6] =
    [[0, 1, 2], [0, 2, 3], [1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]];

fn text_stl() -> Vec<u8> {
    let mut text = "solid a pyramid\n".to_string();
    for triangle in TRIANGLES {
        text += "facet normal 0 0 0\n outer loop\n";
        for [x, y, z] in triangle.map(|corner| CORNERS[corner]) {
            text += &format!("  vertex {x:e} {y} {z}\n");
        }
        text += " endloop\nendfacet\n";
    }
    (text + "endsolid a pyramid\n").into_bytes()
}

fn binary_stl(header: &[u8]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, 0);
    bytes.extend(6_u32.to_le_bytes());
    for triangle in TRIANGLES {
        bytes.extend([0; 12]);
        let corners = triangle.map(|corner| CORNERS[corner]);
        bytes.extend(corners.iter().flatten().flat_map(|value| value.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn ply_header(format: &str, scalar: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment a pyramid\nelement vertex 5\nproperty {scalar} x\nproperty {scalar} y\n\
         property {scalar} z\nproperty uchar red\nelement face 5\nproperty list uchar int vertex_indices\nend_header\n"
    )
}

/// The base is a square.
const FACES: [&[i32]; 5] = [&[0, 1, 2, 3], &[1, 0, 4], &[2, 1, 4], &[3, 2, 4], &[0, 3, 4]];

fn text_ply() -> Vec<u8> {
    let mut text = ply_header("ascii", "float");
    CORNERS.iter().for_each(|[x, y, z]| text += &format!("{x} {y} {z} 200\n"));
    for face in FACES {
        let corners: Vec<String> = face.iter().map(i32::to_string).collect();
        text += &format!("{} {}\n", face.len(), corners.join(" "));
    }
    text.into_bytes()
}

fn binary_ply(big: bool) -> Vec<u8> {
    let format = if big { "binary_big_endian" } else { "binary_little_endian" };
    let mut bytes = ply_header(format, "double").into_bytes();
    for corner in CORNERS {
        for value in corner.map(f64::from) {
            bytes.extend(if big { value.to_be_bytes() } else { value.to_le_bytes() });
        }
        bytes.push(200);
    }
    for face in FACES {
        bytes.push(face.len() as u8);
        for index in face {
            bytes.extend(if big { index.to_be_bytes() } else { index.to_le_bytes() });
        }
    }
    bytes
}

fn obj() -> Vec<u8> {
    let mut text = String::from("o pyramid\n");
    CORNERS.iter().for_each(|[x, y, z]| text += &format!("v {x} {y} {z}\n"));
    // The last first: the parser numbers vertices as faces use them.
    for face in FACES.iter().rev() {
        let corners: Vec<String> = face.iter().map(|index| (index + 1).to_string()).collect();
        text += &format!("f {}\n", corners.join(" "));
    }
    text.into_bytes()
}

fn files() -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("obj", obj()),
        ("stl", text_stl()),
        ("stl", binary_stl(b"a pyramid")),
        // A program that begins binary files like texts.
        ("STL", binary_stl(b"solid pyramid")),
        ("ply", text_ply()),
        ("ply", binary_ply(false)),
        ("ply", binary_ply(true)),
    ]
}

/// A folder of the test's own in the system's temporary one, removed at its end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let path = std::env::temp_dir().join(format!("drape-mesh-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Folder(path)
    }

    fn write(&self, extension: &str, content: &[u8]) -> PathBuf {
        let path = self.0.join(format!("body.{extension}"));
        std::fs::write(&path, content).unwrap();
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[test]
fn every_format_gives_the_same_body() {
    let folder = Folder::new("formats");
    for (k, (extension, content)) in files().iter().enumerate() {
        let path = folder.write(extension, content);
        let file = read_mesh(&path).unwrap();
        let corners: Vec<[f64; 3]> = CORNERS.iter().map(|corner| corner.map(f64::from)).collect();
        if extension.to_lowercase() == "stl" {
            assert_eq!((file.vertices.len(), file.triangles.len()), (18, 6), "file {k}");
        } else {
            assert_eq!(file.vertices, corners, "file {k} keeps the order of its vertices");
        }
        let mesh = Mesh::load(&path, 0.01).unwrap();
        let mut vertices = mesh.vertices();
        for (vertex, &origin) in vertices.iter().zip(mesh.source_vertices()) {
            let given = file.vertices[origin as usize].map(|value| 0.01 * value);
            assert_eq!(*vertex, given, "file {k}");
        }
        vertices.sort_by(|a, b| a.partial_cmp(b).unwrap());
        let mut expected: Vec<[f64; 3]> =
            corners.iter().map(|corner| corner.map(|value| 0.01 * value)).collect();
        expected.sort_by(|a, b| a.partial_cmp(b).unwrap());
        assert_eq!((vertices, mesh.triangles().len()), (expected, 6), "file {k}");
        assert!(!mesh.was_inside_out(), "file {k}");
    }
}

#[test]
fn a_file_cut_at_any_byte_is_refused_or_still_the_body() {
    let folder = Folder::new("cut");
    for (k, (extension, content)) in files().iter().enumerate() {
        let mut whole = 0;
        for end in 0..content.len() {
            match Mesh::load(folder.write(extension, &content[..end]), 1.0) {
                // What follows the last triangle of a text, or the last digits of one that is none.
                Ok(mesh) => {
                    assert_eq!(mesh.triangles().len(), 6, "file {k} cut at {end}");
                    whole += 1;
                }
                Err(error) => {
                    assert!(error.to_string().len() > 20, "file {k} cut at {end}: {error}")
                }
            }
        }
        assert!(whole <= 16, "file {k} is read of {whole} cuts");
    }
}

#[test]
fn a_changed_byte_never_ends_in_a_panic() {
    let folder = Folder::new("changed");
    let mut refused = 0;
    for (extension, content) in files() {
        for at in (0..content.len()).step_by(3) {
            let mut changed = content.clone();
            changed[at] = [0, b'-', b'9', 0xff][at % 4];
            let read = Mesh::load(folder.write(extension, &changed), 1.0);
            refused += usize::from(read.is_err());
        }
    }
    assert!(refused > 300, "{refused} were refused");
}

#[test]
fn what_is_wrong_is_said() {
    let folder = Folder::new("wrong");
    let replaced = |bytes: Vec<u8>, old: &str, new: &str| {
        let text = String::from_utf8(bytes).unwrap();
        assert!(text.contains(old), "{old}");
        text.replacen(old, new, 1).into_bytes()
    };
    let huge_stl = || {
        let mut bytes = binary_stl(b"huge");
        bytes[80..84].fill(0xff);
        bytes
    };
    let nan_stl = || {
        let mut bytes = binary_stl(b"nan");
        bytes[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
        bytes
    };
    let cases: Vec<(&str, Vec<u8>, &[&str])> = vec![
        ("stl", huge_stl(), &["4294967295 triangles", "has 300"]),
        ("stl", nan_stl(), &["NaN", "finite"]),
        ("stl", replaced(text_stl(), "vertex -1e0", "vertex inf"), &["inf", "finite"]),
        ("stl", b"solid nothing\nendsolid nothing\n".to_vec(), &["no triangles"]),
        ("stl", Vec::new(), &["0 bytes"]),
        ("ply", Vec::new(), &["body.ply"]),
        ("ply", replaced(text_ply(), "vertex 5", "vertex 99999999999"), &["99999999999"]),
        ("ply", replaced(text_ply(), "3 1 0 4", "3 1 0 9"), &["vertex 9", "5 vertices"]),
        ("ply", replaced(text_ply(), "3 1 0 4", "3 1 0 -4"), &["face 1"]),
        ("ply", replaced(text_ply(), "3 1 0 4", "2 1 0"), &["face 1 has 2 corners"]),
        ("ply", replaced(text_ply(), "3 1 0 4", "3 0 1 4"), &["inside and outside"]),
        ("ply", replaced(text_ply(), "-1 0 -1 200", "nan 0 -1 200"), &["Line 12", "nan 0 -1 200"]),
        ("ply", replaced(text_ply(), "property float z\n", ""), &["body.ply"]),
        ("obj", replaced(obj(), "f 2 1 5\n", ""), &["open", "3 boundary edges"]),
        ("obj", replaced(obj(), "f 2 1 5\n", "f 2 1 5\nf 2 1 3\n"), &["not manifold", "has 3"]),
        ("obj", replaced(obj(), "f 2 1 5\n", "f 1 2 5\n"), &["inside and outside"]),
        ("obj", replaced(obj(), "v 0 1 0\n", "v 0 0 0\n"), &["volume"]),
        ("obj", replaced(obj(), "v 0 1 0\n", "v 0 0 -1\n"), &["no area"]),
    ];
    for (extension, content, words) in cases {
        let error = Mesh::load(folder.write(extension, &content), 1.0).expect_err(words[0]);
        let error = error.to_string();
        for word in words {
            assert!(error.contains(word), "{word:?} is missing in: {error}");
        }
    }
    let empty = ply_header("ascii", "float").replace(" 5", " 0").into_bytes();
    let error = Mesh::load(folder.write("ply", &empty), 1.0).expect_err("empty");
    assert_eq!(error, Error::EmptyMesh { vertices: 0 });
    let unknown = Mesh::load(folder.write("fbx", b""), 1.0).expect_err("unknown");
    assert!(matches!(unknown, Error::UnknownMeshFormat { .. }), "{unknown}");
    let device = Path::new("/dev/stdin");
    if device.exists() {
        let path = folder.0.join("pipe.stl");
        std::fs::create_dir(&path).unwrap();
        let error = Mesh::load(&path, 1.0).expect_err("a folder").to_string();
        assert!(error.contains("regular file"), "{error}");
    }
    // Elements of nothing, as many as can be written.
    let endless =
        "ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\nend_header\n";
    let error = Mesh::load(folder.write("ply", endless.as_bytes()), 1.0).expect_err("endless");
    assert!(error.to_string().contains("no properties"), "{error}");
}
