//! Files that are cut off or whose bytes are changed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use drape::checkpoint::{Checkpoint, Store};
use drape::dynamics::SavedSimulation;
use tempfile::TempDir;

use crate::guard::{Sweep, is_full};
use crate::mutation::{Random, cuts, mutated};
use crate::readers;

/// Reader of a file: whether it is accepted.
type Reader = fn(&Path) -> bool;

/// Tries a file that stands in a folder with others: cut off, and with changed bytes.
fn try_file(name: &'static str, file: PathBuf, reader: Reader) {
    let whole: Arc<[u8]> = fs::read(&file).expect("it is there").into();
    assert!(reader(&file), "{name} is right before it is made wrong");
    let (above, seeds, stride) = if is_full() { (1000, 10_000, 1) } else { (10, 60, 41) };
    let mut sweep = Sweep::new(name);
    for length in cuts(whole.len(), above).into_iter().step_by(stride) {
        fs::write(&file, &whole[..length]).expect("written");
        let file = file.clone();
        sweep.case(|| format!("cut off at {length}"), move || reader(&file));
    }
    for seed in 0..seeds {
        fs::write(&file, mutated(&whole, seed)).expect("written");
        let file = file.clone();
        sweep.case(|| format!("seed {seed}"), move || reader(&file));
    }
    sweep.end();
}

/// Tries one file in a folder of its own.
fn try_bytes(name: &'static str, (file, bytes): (&str, &[u8]), reader: Reader) {
    let folder = folder();
    let file = folder.path().join(file);
    fs::write(&file, bytes).expect("written");
    try_file(name, file, reader);
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// Content of a file as text; bytes that are none are refused by the reader of documents.
fn text(file: &Path) -> Option<String> {
    String::from_utf8(fs::read(file).ok()?).ok()
}

#[test]
fn scenes() {
    let scene = |file: &Path| text(file).is_some_and(|text| readers::scene(&text, readers::FABRIC));
    try_bytes("scene", ("scene.toml", crate::numbers::CLOTH.as_bytes()), scene);
}

#[test]
fn fabrics() {
    let fabric = |file: &Path| text(file).is_some_and(|text| readers::fabric(&text));
    try_bytes("fabric", ("fabric.toml", readers::FABRIC.as_bytes()), fabric);
}

#[test]
fn sheets_and_tables() {
    for (name, file) in [("sheet", "sheet.toml"), ("CSV", "bending.csv")] {
        let folder = folder();
        fs::write(folder.path().join("sheet.toml"), readers::SHEET).expect("written");
        fs::write(folder.path().join("bending.csv"), readers::CURVE).expect("written");
        let reader: Reader = |file| readers::sheet(&file.with_file_name("sheet.toml"));
        try_file(name, folder.path().join(file), reader);
    }
}

#[test]
fn patterns() {
    let files = [
        ("pattern in TOML", "scenes/patterns/tshirt.toml"),
        ("GarmentCode", "crates/drape-pattern/patterns/skirt.json"),
        ("FreeSewing", "crates/drape-pattern/patterns/teagan.json"),
    ];
    for (name, shipped) in files {
        let shipped = readers::shipped(shipped);
        let file = shipped.file_name().and_then(|file| file.to_str()).expect("a name");
        let bytes = fs::read(&shipped).expect("it ships");
        try_bytes(name, (file, &bytes), readers::pattern);
    }
}

/// A cube, as triangles: its corners and their numbers.
fn cube() -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let corner = |k: u32| [k & 1, (k >> 1) & 1, k >> 2].map(|x| x as f32 * 0.1);
    let sides =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    ((0..8).map(corner).collect(), halves.collect())
}

#[test]
fn meshes() {
    let (corners, triangles) = cube();
    let obj: String = corners
        .iter()
        .map(|[x, y, z]| format!("v {x} {y} {z}\n"))
        .chain(triangles.iter().map(|t| format!("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1)))
        .collect();
    try_bytes("OBJ", ("cube.obj", obj.as_bytes()), readers::mesh);

    let at = |k: u32| corners[k as usize];
    let facet = |t: &[u32; 3]| {
        let corners = t.map(|k| at(k).map(|x| x.to_string()).join(" "));
        let vertices = corners.map(|corner| format!("vertex {corner}\n")).concat();
        format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    let facets: String = triangles.iter().map(facet).collect();
    let stl = format!("solid cube\n{facets}endsolid cube\n");
    try_bytes("STL in text", ("cube.stl", stl.as_bytes()), readers::mesh);

    let mut stl = vec![b' '; 80];
    stl.extend((triangles.len() as u32).to_le_bytes());
    for triangle in &triangles {
        stl.extend([0; 12]);
        let numbers = triangle.iter().flat_map(|&k| at(k));
        numbers.for_each(|x| stl.extend(x.to_le_bytes()));
        stl.extend([0; 2]);
    }
    try_bytes("STL in bytes", ("cube.stl", &stl), readers::mesh);

    let header = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\nelement vertex {}\nproperty float x\nproperty float y\n\
             property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
            corners.len(),
            triangles.len()
        )
    };
    let rows = corners.iter().map(|[x, y, z]| format!("{x} {y} {z}\n"));
    let faces = triangles.iter().map(|[a, b, c]| format!("3 {a} {b} {c}\n"));
    let ply = header("ascii") + &rows.chain(faces).collect::<String>();
    try_bytes("PLY in text", ("cube.ply", ply.as_bytes()), readers::mesh);

    let mut ply = header("binary_little_endian").into_bytes();
    corners.iter().flatten().for_each(|x| ply.extend(x.to_le_bytes()));
    for triangle in &triangles {
        ply.push(3);
        triangle.iter().for_each(|k| ply.extend(k.to_le_bytes()));
    }
    try_bytes("PLY in bytes", ("cube.ply", &ply), readers::mesh);

    let mut cache = b"POINTCACHE2\0".to_vec();
    cache.extend(1_u32.to_le_bytes());
    cache.extend((corners.len() as u32).to_le_bytes());
    cache.extend(0_f32.to_le_bytes());
    cache.extend(1_f32.to_le_bytes());
    cache.extend(3_u32.to_le_bytes());
    for _ in 0..3 {
        corners.iter().flatten().for_each(|x| cache.extend(x.to_le_bytes()));
    }
    try_bytes("PC2", ("cube.pc2", &cache), readers::point_cache);
}

#[test]
fn frames() {
    let scene = "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n\
                 panel = [{ name = \"a\", fabric = \"plain\", rectangle = [0.1, 0.1] }]\n\
                 collider.sphere = [{ radius = 0.03, center = [0, 0, 0.1] }]\n\
                 time = { step = 0.005, end = 0.02 }\noutput = { every = 0.01 }\n";
    let files = ["surfaces.json", "frames.csv", "energy.csv", "frame-00001.npy", "triangles.npy"];
    for name in files {
        let folder = folder();
        let at = |name: &str| folder.path().join(name);
        fs::write(at("plain.toml"), readers::FABRIC).expect("written");
        fs::write(at("scene.toml"), scene).expect("written");
        let mut run = Command::new(env!("CARGO_BIN_EXE_drape"));
        run.current_dir(folder.path()).args(["run", "scene.toml", "-o", "run", "--no-picture"]);
        let output = run.output().expect("it runs");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let file = at("run").join(name);
        let reader: Reader = |file| readers::frames(file.parent().expect("a folder"));
        try_file(name, file, reader);
    }
}

/// Bytes of the checkpoint of a finished run.
fn checkpoint() -> Vec<u8> {
    let folder = folder();
    fs::write(folder.path().join("plain.toml"), readers::FABRIC).expect("written");
    let scene = "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n\
                 panel = [{ name = \"a\", fabric = \"plain\", rectangle = [0.04, 0.04] }]\n\
                 time = { step = 0.005, end = 0.01 }\n";
    fs::write(folder.path().join("scene.toml"), scene).expect("written");
    let mut run = Command::new(env!("CARGO_BIN_EXE_drape"));
    run.current_dir(folder.path()).args(["run", "scene.toml", "-o", "run", "--no-picture"]);
    let output = run.output().expect("it runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    fs::read(folder.path().join("run/checkpoint-00000001.bin")).expect("it is left")
}

#[test]
fn checkpoints() {
    let whole = checkpoint();
    let reader: Reader = |file| {
        let found = Store::new(file.parent().expect("a folder")).read().expect("it is read");
        // What is no checkpoint is told, and nothing of it is used.
        assert_eq!(found.newest.is_none(), found.damaged.len() == 1);
        found.newest.is_some_and(|newest| SavedSimulation::read(&newest).is_ok())
    };
    try_bytes("checkpoint", ("checkpoint-00000001.bin", &whole), reader);
    // Each of these bits is one that was written.
    let bits = if is_full() { 10_000 } else { 100 };
    let mut random = Random(1);
    for _ in 0..bits {
        let bit = random.below(8 * whole.len());
        let mut flipped = whole.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        assert!(Checkpoint::decode(&flipped).is_err(), "bit {bit} is not missed");
    }
}
