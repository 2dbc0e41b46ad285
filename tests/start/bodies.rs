//! Bodies in scenes: what a check says of each, what contact cannot promise on it, and where a
//! garment starts on it.

use std::fs::read_to_string;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use drape::input::Document;
use serde_json::Value;
use tempfile::TempDir;

const FABRIC: &str = include_str!("../fabrics/plain-weave.toml");

/// Scene of a sheet at HEIGHT and the body of a file.
const SCENE: &str = r#"spacing = 0.02
fabric.plain.file = "plain.toml"
[[panel]]
name = "sheet"
fabric = "plain"
rectangle = [0.1, 0.1]
center = [0, HEIGHT, 0]
turn = [-90, 0, 0]
[[collider.mesh]]
name = "blocks"
file = "blocks.obj"
scale = 1
[time]
step = 0.005
end = 0.01
"#;

/// Returns the OBJ file of cubes of 0.3 m, closed each, that begin at some places along x.
fn cubes(starts: &[f64]) -> String {
    let mut text = String::new();
    for (number, start) in starts.iter().enumerate() {
        for corner in 0..8 {
            let at = |axis: i32| if corner >> axis & 1 == 1 { 0.15 } else { -0.15 };
            text += &format!("v {} {} {}\n", start + at(0), at(1), at(2) + 0.01 * *start);
        }
        // Anticlockwise seen from outside; corner 1 + x + 2y + 4z.
        for face in
            [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]]
        {
            let [a, b, c, d] = face.map(|corner| corner + 8 * number);
            text += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
        }
    }
    text
}

fn folder(starts: &[f64], height: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let write =
        |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("written");
    write("plain.toml", FABRIC);
    write("blocks.obj", &cubes(starts));
    write("scene.toml", &SCENE.replace("HEIGHT", height));
    folder
}

/// Runs the program, and returns its exit code with what it says on both outputs.
fn drape(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::cargo_bin("drape").expect("the binary is built");
    let output = command.current_dir(folder).args(arguments).output().expect("runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

/// Returns what a run says on standard error, and its summary.
fn run(folder: &Path) -> (String, Value) {
    let (code, _, said) = drape(folder, &["run", "scene.toml", "-o", "there", "--no-picture"]);
    assert_eq!(code, Some(0), "{said}");
    let summary = read_to_string(folder.join("there/summary.json")).expect("a summary");
    (said, serde_json::from_str(&summary).expect("JSON"))
}

#[test]
fn a_good_body_has_a_line_and_nothing_that_contact_cannot_promise() {
    let folder = folder(&[0.0], "0.2");
    let (code, said, _) = drape(folder.path(), &["check", "scene.toml"]);
    assert_eq!(code, Some(0), "{said}");
    let line = "  body \"blocks\": mesh, 0.300 × 0.300 × 0.300 m, 27.00 l, 12 triangles with edges of \
                300.0 mm, closed, 1 part, nowhere through itself\n";
    assert!(said.contains(line), "{said}");
    assert!(!said.contains("note:"), "{said}");
    let (said, summary) = run(folder.path());
    assert!(!said.contains("note:"), "{said}");
    assert_eq!(summary["contact_limits"], Value::Array(Vec::new()));
}

#[test]
fn a_body_that_passes_through_itself_is_told_by_check_run_and_summary() {
    let folder = folder(&[0.0, 0.2], "0.2");
    let told = "body \"blocks\" passes through its own surface with ";
    let (code, said, _) = drape(folder.path(), &["check", "scene.toml"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("2 parts, through itself at ") && said.contains(told), "{said}");
    let (said, summary) = run(folder.path());
    assert!(said.contains(told), "{said}");
    let limits = summary["contact_limits"].as_array().expect("a list");
    assert!(limits.len() == 1 && limits[0].as_str().is_some_and(|limit| limit.contains(told)));
    // What it advises lists the places.
    let (code, said, _) = drape(folder.path(), &["check", "blocks.obj"]);
    assert!(code == Some(0) && said.contains("pass through the body's own surface"), "{said}");
}

/// Returns the STL file, in text, of an OBJ file of triangles: each corner is a vertex of its own.
fn stl(obj: &str) -> String {
    let words = |line: &str| line.split(' ').skip(1).map(str::to_owned).collect::<Vec<String>>();
    let vertices: Vec<Vec<String>> =
        obj.lines().filter(|line| line.starts_with("v ")).map(words).collect();
    let mut text = String::from("solid body\n");
    for face in obj.lines().filter(|line| line.starts_with("f ")).map(words) {
        text += "facet normal 0 0 0\nouter loop\n";
        for corner in face {
            let number: usize = corner.parse().expect("a number");
            text += &format!("vertex {}\n", vertices[number - 1].join(" "));
        }
        text += "endloop\nendfacet\n";
    }
    text + "endsolid body\n"
}

#[test]
fn a_check_of_a_body_and_a_scene_judge_alike() {
    let folder = folder(&[0.0], "0.2");
    let folder = folder.path();
    let one = cubes(&[0.0]);
    // The second half of two cubes at one place is the same cube again.
    let twice = cubes(&[0.0, 0.0]);
    let open = one.trim_end().rsplit_once('\n').expect("lines").0.to_owned() + "\n";
    for (name, text, is_right) in [
        ("one.obj", one.clone(), true),
        ("one.stl", stl(&one), true),
        ("twice.obj", twice.clone(), false),
        ("twice.stl", stl(&twice), false),
        ("open.obj", open.clone(), false),
        ("open.stl", stl(&open), false),
    ] {
        std::fs::write(folder.join(name), text).expect("written");
        let scene = SCENE.replace("HEIGHT", "0.2").replace("blocks.obj", name);
        std::fs::write(folder.join("scene.toml"), &scene).expect("written");
        let (of_scene, _, refusal) = drape(folder, &["check", "scene.toml"]);
        let (of_body, said, mistake) = drape(folder, &["check", name, "--scale", "1"]);
        assert_eq!((of_scene, of_body), (Some(if is_right { 0 } else { 3 }), of_scene), "{name}");
        assert_eq!(said.contains(", closed\n"), is_right, "{name}: {said}");
        if is_right {
            continue;
        }
        let fault =
            mistake.lines().next().and_then(|line| line.split(": ").last()).expect("a fault");
        assert!(refusal.contains(fault), "{name}: {fault} is not in {refusal}");
        // What is mended is taken by both.
        let mend = [
            "check",
            name,
            "--scale",
            "1",
            "--repair",
            "mended.obj",
            "--force",
            "--spacing",
            "200",
        ];
        let (code, said, failed) = drape(folder, &mend);
        assert!(code == Some(0) && said.starts_with("repaired\n"), "{name}: {said}{failed}");
        std::fs::write(folder.join("scene.toml"), scene.replace(name, "mended.obj"))
            .expect("written");
        assert_eq!(drape(folder, &["check", "scene.toml"]).0, Some(0), "{name}");
        assert_eq!(drape(folder, &["check", "mended.obj", "--scale", "1"]).0, Some(0), "{name}");
    }
}

#[test]
fn a_fault_that_a_repair_left_is_not_to_be_repaired_again() {
    // Three triangles meet in one edge: no repair makes a closed surface of them.
    let folder = folder(&[0.0], "0.2");
    let fan = "v 0 0 0\nv 0 0.3 0\nv 0.3 0 0\nv -0.3 0 0.1\nv 0 0 0.4\nf 1 2 3\nf 1 2 4\nf 1 2 5\n";
    for (name, proposed) in [("fan.obj", true), ("fan-repaired.obj", false)] {
        std::fs::write(folder.path().join(name), fan).expect("written");
        let scene = SCENE.replace("HEIGHT", "0.2").replace("blocks.obj", name);
        std::fs::write(folder.path().join("scene.toml"), scene).expect("written");
        for arguments in [&["check", name, "--scale", "1"][..], &["check", "scene.toml"]] {
            let (code, _, failed) = drape(folder.path(), arguments);
            assert_eq!(code, Some(3), "{failed}");
            assert_eq!(failed.contains("--repair"), proposed, "{failed}");
            assert_eq!(failed.contains("in a modelling program"), !proposed, "{failed}");
        }
    }
}

#[test]
fn a_body_with_lips_that_nearly_touch_is_sound_and_stays_so() {
    // Two cubes, corner before corner, 0.4 µm apart.
    let folder = folder(&[0.0, 0.0], "0.2");
    let beside = |(number, line): (usize, &str)| match line.strip_prefix("v ") {
        Some(place) if number >= 20 => {
            let (x, rest) = place.split_once(' ').expect("three numbers");
            format!("v {} {rest}\n", x.parse::<f64>().expect("a number") + 0.300_000_4)
        }
        _ => format!("{line}\n"),
    };
    let text: String = cubes(&[0.0, 0.0]).lines().enumerate().map(beside).collect();
    std::fs::write(folder.path().join("blocks.obj"), text).expect("written");
    let (code, said, failed) =
        drape(folder.path(), &["check", "blocks.obj", "--scale", "1", "--repair", "same.obj"]);
    assert!(code == Some(0) && said.starts_with("sound\n"), "{said}{failed}");
    let (code, said, failed) = drape(folder.path(), &["check", "same.obj", "--scale", "1"]);
    assert!(code == Some(0) && said.contains("16 vertices, 24 triangles"), "{said}{failed}");
}

#[test]
fn cloth_wholly_inside_a_body_is_refused_and_starts_where_it_is_outside() {
    let inside = folder(&[0.0], "0");
    let (code, _, said) = drape(inside.path(), &["check", "scene.toml"]);
    assert_eq!(code, Some(3), "{said}");
    assert!(said.contains("particles start inside a body"), "{said}");
    assert!(said.contains("move or turn the panel so that it starts outside"), "{said}");
    let outside = folder(&[0.0], "0.2");
    assert_eq!(drape(outside.path(), &["check", "scene.toml"]).0, Some(0));
}

#[test]
fn fine_triangles_are_told_and_the_remedy_thins_them() {
    let folder = folder(&[0.0], "0.2");
    let scene = SCENE.replace("HEIGHT", "0.2").replace("spacing = 0.02", "spacing = 0.05");
    let scene = scene.replace("file = \"blocks.obj\"", "file = \"ball.obj\"");
    std::fs::write(folder.path().join("scene.toml"), &scene).expect("written");
    std::fs::write(folder.path().join("ball.obj"), ball(0.15, 192)).expect("written");
    let (code, said, failed) = drape(folder.path(), &["check", "scene.toml"]);
    assert_eq!(code, Some(0), "{said}{failed}");
    let advice = said.split("`drape ").nth(1).and_then(|rest| rest.split('`').next());
    let advice = advice.unwrap_or_else(|| panic!("no advice in {said}"));
    let (code, _, failed) = drape(folder.path(), &advice.split(' ').collect::<Vec<_>>());
    assert_eq!(code, Some(0), "{advice}: {failed}");
    let scene = scene.replace("ball.obj", "ball-repaired.obj");
    std::fs::write(folder.path().join("scene.toml"), scene).expect("written");
    let (code, said, failed) = drape(folder.path(), &["check", "scene.toml"]);
    assert!(code == Some(0) && !said.contains("finer than"), "{said}{failed}");
}

/// Returns the OBJ file of a ball of a radius in m, with so many meridians and half as many
/// parallels.
fn ball(radius: f64, meridians: usize) -> String {
    let parallels = meridians / 2;
    let mut text = format!("v 0 {radius} 0\nv 0 -{radius} 0\n");
    for k in 1..parallels {
        let (up, level) = (k as f64 * std::f64::consts::PI / parallels as f64).sin_cos();
        for m in 0..meridians {
            let (sin, cos) = (m as f64 * std::f64::consts::TAU / meridians as f64).sin_cos();
            text += &format!("v {} {} {}\n", radius * up * sin, radius * level, radius * up * cos);
        }
    }
    let number = |k: usize, m: usize| 3 + (k - 1) * meridians + m % meridians;
    for m in 0..meridians {
        text += &format!("f 1 {} {}\n", number(1, m), number(1, m + 1));
        text += &format!("f 2 {} {}\n", number(parallels - 1, m + 1), number(parallels - 1, m));
        for k in 1..parallels - 1 {
            let [a, b] = [number(k, m), number(k, m + 1)];
            let [c, d] = [number(k + 1, m), number(k + 1, m + 1)];
            text += &format!("f {a} {c} {d}\nf {a} {d} {b}\n");
        }
    }
    text
}

#[test]
fn garments_at_the_feet_are_worn_at_the_centre_that_is_advised() {
    let root = env!("CARGO_MANIFEST_DIR");
    let scenes = Path::new(root).join("scenes");
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["tshirt", "skirt", "trousers", "circle-skirt"] {
        let text = read_to_string(scenes.join(name).with_extension("toml")).expect("a scene");
        let absolute = |path: &str| format!("\"{}/{path}/", scenes.display());
        let text = text.replace("\"patterns/", &absolute("patterns"));
        let text = text.replace("\"bodies/", &absolute("bodies"));
        let text = text.replace("\"../fabrics/", &absolute("../fabrics"));
        let text = text.replace("spacing = 0.01", "spacing = 0.02");
        let with = |center: &str| {
            let text = text.replace("fabric = \"wool\"", &format!("fabric = \"wool\"\n{center}"));
            read(&folder.path().join("scene.toml"), text)
        };
        let said = with("center = [0.01, -1.35, 0.02]").expect_err("at the feet");
        assert!(said.contains("starts at the feet of the body"), "{name}: {said}");
        let advice = advice(&said);
        with(advice).unwrap_or_else(|said| panic!("{name} at {advice}: {said}"));
    }
}

#[test]
fn a_shirt_of_another_program_crosses_no_hand_at_the_centre_that_is_advised() {
    let root = env!("CARGO_MANIFEST_DIR");
    let folder = tempfile::tempdir().expect("a folder");
    for spacing in [25, 15] {
        let with = |center: &str| {
            let text = format!(
                "spacing = \"{spacing} mm\"\nfabric.wool.file = \"{root}/fabrics/matsudaira-b/sheet.toml\"\n\
                 [[garment]]\npattern = \"{root}/crates/drape-pattern/patterns/shirt.json\"\nfabric = \"wool\"\n{center}\n\
                 [[collider.mesh]]\nfile = \"{root}/scenes/bodies/body.obj\"\n\
                 [contact]\noffset = 0.003\n[time]\nstep = 0.005\nend = 60\n[settle]\n"
            );
            read(&folder.path().join("scene.toml"), text)
        };
        let said = with("center = [0, 0, 0]").expect_err("not about the body");
        let advice = advice(&said);
        with(advice).unwrap_or_else(|said| panic!("{spacing} mm at {advice}: {said}"));
    }
}

/// Reads a scene, by the library, which proposes places and does not try them; or returns its
/// mistakes.
fn read(path: &Path, text: String) -> Result<(), String> {
    let root = [PathBuf::from(env!("CARGO_MANIFEST_DIR"))];
    let document = Document::new(path, text).allowing(&root);
    drape::run::scene_of(&document).map(|_| ()).map_err(|error| error.to_string())
}

/// Returns the line that a message advises to write.
fn advice(said: &str) -> &str {
    let advice = said.split("write ").nth(1).and_then(|rest| rest.split(" in its").next());
    advice.unwrap_or_else(|| panic!("no advice in {said}"))
}

#[test]
fn a_garment_is_drawn_at_its_start_with_its_seams() {
    let root = env!("CARGO_MANIFEST_DIR");
    let scene = Path::new(root).join("scenes/seam-strip.toml");
    let folder = tempfile::tempdir().expect("a folder");
    let scene = scene.display().to_string();
    for name in ["start.svg", "start.png"] {
        let (code, _, said) =
            drape(folder.path(), &["check", &scene, "--figure", name, "--allow-path", root]);
        assert_eq!(code, Some(0), "{said}");
    }
    let svg = read_to_string(folder.path().join("start.svg")).expect("a figure");
    assert!(svg.contains("<image ") && svg.contains(">middle</text>"));
    let png = std::fs::read(folder.path().join("start.png")).expect("a picture");
    assert!(png.starts_with(b"\x89PNG") && png.len() > 10_000, "{} bytes", png.len());
}
