//! A scene whose files are all in memory.

use std::path::Path;

use drape_collide::Triangulation;
use drape_fabric::samples::PLAIN_WEAVE;
use drape_input::{Document, FileAccess};
use drape_scene::{Scene, SceneSpec, Sources};

const SCENE: &str = "spacing = 0.02
[fabric.plain]
file = \"fabrics/plain.toml\"
[[garment]]
pattern = \"bag.toml\"
fabric = \"plain\"
[garment.panel.front]
center = [-0.1, 0.3, 0.1]
[garment.panel.back]
center = [0.1, 0.3, -0.1]
turn = [0, 180, 0]
[[collider.mesh]]
file = \"block.obj\"
motion = \"rise.pc2\"
rate = 24
[time]
step = 0.005
end = 1
";

const PATTERN: &str = "length = \"mm\"\n[from]\nfile = \"drawings/bag.svg\"\nunit = \"mm\"\n";

const DRAWING: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\">\
    <path id=\"front\" d=\"M 0 0 L 200 0 L 200 300 L 0 300 Z\"/>\
    <path id=\"back\" d=\"M 300 0 L 500 0 L 500 300 L 300 300 Z\"/></svg>";

/// A closed box between the panels.
fn block() -> Triangulation {
    let corner = |k: usize| {
        let [x, y, z] = [k & 1, k >> 1 & 1, k >> 2 & 1].map(|bit| 0.1 * bit as f64 - 0.05);
        [x, 0.45 + y, z]
    };
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Triangulation {
        vertices: (0..8).map(corner).collect(),
        triangles: faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
    }
}

/// Returns a point cache in which `mesh` rises by 1 cm.
fn rise(mesh: &Triangulation) -> Vec<u8> {
    let mut bytes = b"POINTCACHE2\0".to_vec();
    bytes.extend([1, mesh.vertices.len() as i32].map(i32::to_le_bytes).concat());
    bytes.extend([0.0_f32, 1.0].map(f32::to_le_bytes).concat());
    bytes.extend(2_i32.to_le_bytes());
    for height in [0.0, 0.01] {
        for [x, y, z] in &mesh.vertices {
            bytes.extend([*x, y + height, *z].map(|x| (x as f32).to_le_bytes()).concat());
        }
    }
    bytes
}

/// Returns an access with all files of the scene below `folder`.
fn held(folder: &Path) -> FileAccess {
    let mesh = block();
    FileAccess::default()
        .holding(folder.join("scene.toml"), SCENE.as_bytes())
        .holding(folder.join("fabrics/plain.toml"), PLAIN_WEAVE.as_bytes())
        .holding(folder.join("bag.toml"), PATTERN.as_bytes())
        .holding(folder.join("drawings/bag.svg"), DRAWING.as_bytes())
        .holding(folder.join("block.obj"), mesh.to_obj().into_bytes())
        .holding(folder.join("rise.pc2"), rise(&mesh))
}

#[test]
fn a_scene_of_files_in_memory_is_the_scene_of_the_files() {
    let folder = tempfile::tempdir().expect("a folder");
    for (path, bytes) in &held(folder.path()).held {
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        std::fs::write(path, bytes).expect("written");
    }
    let of_files = Scene::read(folder.path().join("scene.toml")).expect("a scene");

    // A folder that does not exist stands for the same files in memory.
    let nowhere = Path::new("no such folder");
    let access = held(nowhere);
    let document = Document::read_with(nowhere.join("scene.toml"), &access).expect("a text");
    let scene = Scene::from_document(&document, Sources::new(nowhere).fabrics).expect("a scene");
    assert_eq!(scene.start.positions, of_files.start.positions);
    assert_eq!(scene.source.hash, of_files.source.hash);
    let motion = |scene: &Scene| format!("{:?}", scene.bodies[0].motion);
    assert_eq!(motion(&scene), motion(&of_files));

    // The spec that the text says takes the files from its sources.
    let spec = SceneSpec::from_document(&document).expect("a spec");
    let sources = Sources { access: &access, ..Sources::new(nowhere) };
    let built = spec.build_with(&sources).expect("a scene");
    assert_eq!(built.source.hash, of_files.source.hash);
}

#[test]
fn a_file_that_is_not_in_memory_is_named() {
    let nowhere = Path::new("no such folder");
    let whole = held(nowhere);
    for path in whole.held.keys().filter(|path| !path.ends_with("scene.toml")) {
        let mut access = whole.clone();
        access.held.remove(path);
        let document = Document::read_with(nowhere.join("scene.toml"), &access).expect("a text");
        let fabrics = Sources::new(nowhere).fabrics;
        let error = Scene::from_document(&document, fabrics).expect_err("a file is missing");
        let name = path.file_name().expect("a name").to_string_lossy();
        assert!(error.to_string().contains(&*name), "{name}: {error}");
    }
}
