//! Starts of scenes: those whose surfaces intersect are refused, with a file of the triangles.

#[path = "start/bodies.rs"]
mod bodies;
#[path = "start/figures.rs"]
mod figures;
#[path = "start/proposals.rs"]
mod proposals;

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use tempfile::TempDir;

const FABRIC: &str = include_str!("fabrics/plain-weave.toml");

/// Scene of an upright sheet, a level one at HEIGHT that it intersects, and a ball far below.
const SCENE: &str = r#"spacing = 0.02
fabric.plain.file = "plain.toml"
[[panel]]
name = "upright"
fabric = "plain"
rectangle = [0.2, 0.2]
[[panel]]
name = "level"
fabric = "plain"
rectangle = [0.3, 0.3]
center = [0.003, HEIGHT, 0.004]
turn = [-90, 0, 0]
[[collider.sphere]]
name = "ball"
radius = 0.1
center = [0, -1, 0]
[contact]
surfaces = true
[time]
step = 0.005
end = 0.01
"#;

fn folder(height: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("plain.toml"), FABRIC).expect("writes");
    let scene = SCENE.replace("HEIGHT", height);
    std::fs::write(folder.path().join("scene.toml"), scene).expect("writes");
    folder
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("drape").expect("the binary is built");
    command.current_dir(folder).args(["run", "scene.toml"]).args(arguments).output().expect("runs")
}

/// Reads the corners of the triangles of a PLY file, with the name of their part.
fn triangles(path: &Path) -> Vec<(String, [[f64; 3]; 3])> {
    let text = std::fs::read_to_string(path).expect("was written");
    let (header, body) = text.split_once("end_header\n").expect("a header");
    let count = |element: &str| -> usize {
        let mut lines = header.lines().filter_map(|line| line.strip_prefix(element));
        lines.next().expect("an element").trim().parse().expect("a number")
    };
    let parts: Vec<&str> = header.lines().filter_map(|l| l.strip_prefix("comment part ")).collect();
    let lines: Vec<Vec<f64>> = body
        .lines()
        .map(|line| line.split(' ').map(|word| word.parse().expect("a number")).collect())
        .collect();
    let (vertices, faces) = lines.split_at(count("element vertex"));
    assert_eq!(faces.len(), count("element face"));
    let triangle = |face: &Vec<f64>| {
        assert_eq!((face.len(), face[0]), (8, 3.0));
        let corner = |k: usize| std::array::from_fn(|axis| vertices[face[k] as usize][axis]);
        let part = parts[face[7] as usize].split_once(": ").expect("a name").1;
        (part.to_owned(), [corner(1), corner(2), corner(3)])
    };
    faces.iter().map(triangle).collect()
}

#[test]
fn sheets_that_intersect_are_named_and_their_triangles_are_in_a_file() {
    let folder = folder("0.011");
    let output = run(folder.path(), &["-o", "there/results"]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{message}");
    let path = Path::new("there").join("results-start.ply");
    for words in
        ["\"upright\" and \"level\" near (", "0.0110, 0.0000) m", path.to_str().expect("text")]
    {
        assert!(message.contains(words), "{words:?} is missing in: {message}");
    }
    assert!(!message.contains("ball"), "{message}");
    assert!(!folder.path().join("there/results").exists(), "no folder for results is made");

    let triangles = triangles(&folder.path().join(path));
    let of = |name: &'static str| {
        let its = triangles.iter().filter(move |(part, _)| part == name);
        its.map(|(_, corners)| corners)
    };
    assert_eq!(of("upright").count() + of("level").count(), triangles.len());
    // The upright sheet is in the plane z = 0 and is 0.2 m wide; the level one is at a height of
    // 0.011 m.
    for corners in of("upright") {
        assert!(corners.iter().all(|p| p[2] == 0.0 && p[0].abs() <= 0.1 + 1e-12), "{corners:?}");
        let heights = corners.map(|p| p[1]);
        assert!(heights.iter().any(|y| *y <= 0.011) && heights.iter().any(|y| *y >= 0.011));
    }
    for corners in of("level") {
        assert!(corners.iter().all(|p| (p[1] - 0.011).abs() < 1e-12), "{corners:?}");
        assert!(corners.iter().any(|p| p[2] <= 0.0) && corners.iter().any(|p| p[2] >= 0.0));
    }
    // Ten columns of the upright sheet have an intersected cell, of two triangles.
    assert_eq!(of("upright").count(), 20);
    // Each triangle is there once.
    let places: BTreeSet<Vec<u64>> = triangles
        .iter()
        .map(|(_, corners)| corners.iter().flatten().map(|x| x.to_bits()).collect())
        .collect();
    assert_eq!(places.len(), triangles.len());
}

#[test]
fn sheets_that_are_too_close_are_named_too() {
    // The minimum separation is 0.14 mm of the thickness of 0.4 mm; the lower edge of the upright
    // sheet is 0.1 mm above the level one.
    let folder = folder("-0.1001");
    let output = run(folder.path(), &[]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{message}");
    for words in
        ["start 1.000e-4 m apart", "1.400e-4 m is kept", "\"upright\" and \"level\" near ("]
    {
        assert!(message.contains(words), "{words:?} is missing in: {message}");
    }
    // The results would go to out/scene.
    let found = triangles(&folder.path().join("out/scene-start.ply"));
    let low = found.iter().filter(|(part, _)| part == "upright");
    assert!(low.clone().count() >= 10);
    assert!(low.flat_map(|(_, corners)| corners).all(|p| p[1] < -0.1 + 0.021));
}

#[test]
fn a_long_list_of_intersections_is_cut_short() {
    let folder = folder("0.011");
    let path = folder.path().join("scene.toml");
    // Sheets of 81 particles a side in the same plane intersect everywhere.
    let scene = SCENE.replace("HEIGHT", "0").replace("spacing = 0.02", "spacing = 0.0025");
    let scene = scene.replace("turn = [-90, 0, 0]", "").replace("0.003, 0, 0.004", "0.001, 0, 0");
    std::fs::write(&path, scene).expect("writes");
    let output = run(folder.path(), &[]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{message}");
    assert!(
        message.contains("the first 1000 of ") && message.contains("pairs of triangles"),
        "{message}"
    );
    let found = triangles(&folder.path().join("out/scene-start.ply")).len();
    assert!((100..=2000).contains(&found), "{found} triangles");
}

#[test]
fn sheets_that_are_too_close_start_if_their_minimum_separation_may_grow() {
    // The lower edge of the upright sheet is 0.05 mm above the level one.
    let folder = folder("-0.10005");
    let path = folder.path().join("scene.toml");
    let scene = std::fs::read_to_string(&path).expect("reads");
    let refused = run(folder.path(), &[]);
    let message = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(refused.status.code() == Some(3) && message.contains("contact.grow"), "{message}");
    let scene = scene
        .replace("surfaces = true", "surfaces = true\ngrow = 0.05")
        .replace("end = 0.01", "end = 0.1\n[output]\nevery = 0.01");
    std::fs::write(&path, scene).expect("writes");
    let output = run(folder.path(), &["-o", "out", "--json"]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{message}");
    let summary: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let contact = &summary["contact"];
    assert_eq!(contact["grown"], 1.0, "{contact}");
    assert!((contact["grown_from"].as_f64().expect("a part") - 0.125).abs() < 1e-9, "{contact}");
    let check = |folder: &Path| {
        let mut command = Command::cargo_bin("drape").expect("the binary is built");
        command.current_dir(folder).args(["check", "out", "--json"]).output().expect("runs")
    };
    let checked = check(folder.path());
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));
    let found: serde_json::Value = serde_json::from_slice(&checked.stdout).expect("JSON");
    let grown: Vec<f64> = found[0]["frames"]
        .as_array()
        .expect("frames")
        .iter()
        .map(|frame| frame["grown"].as_f64().expect("a part"))
        .collect();
    assert!(grown.is_sorted() && grown[0] < 0.2 && grown.last() == Some(&1.0), "{grown:?}");
    // A frame that claims the full minimum separation fails.
    let list = folder.path().join("out/frames.csv");
    let text = std::fs::read_to_string(&list).expect("reads");
    let whole: String = text
        .lines()
        .map(|line| match line.split(',').collect::<Vec<_>>()[..] {
            ["0", time, _, bodies, touched, hash] => {
                format!("0,{time},1.0,{bodies},{touched},{hash}\n")
            }
            _ => format!("{line}\n"),
        })
        .collect();
    assert!(whole != text, "the frame has its fraction");
    std::fs::write(&list, whole).expect("writes");
    assert_eq!(check(folder.path()).status.code(), Some(4));
}
