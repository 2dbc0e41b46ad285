//! Figures of patterns and scenes that `drape check` refuses: what is wrong is red, whether the
//! scene could be made or not.

use std::fs::{read_to_string, write};
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

const FABRIC: &str = include_str!("../fabrics/plain-weave.toml");

/// Tube of two panels that face each other.
const TUBE: &str = r#"length = "mm"
[panel.front]
grain = 0
rectangle = [300, 200]
origin = [-150, 0, 100]
[panel.back]
grain = 0
rectangle = [300, 200]
origin = [150, 0, -100]
turn = [0, 180, 0]
[seam.one]
sides = [["front.left"], ["back.right"]]
[seam.other]
sides = [["front.right"], ["back.left"]]
"#;

const SCENE: &str = r#"spacing = 0.02
fabric.plain.file = "plain.toml"
[[garment]]
pattern = "tube.toml"
fabric = "plain"
[contact]
surfaces = true
[time]
step = 0.005
end = 1
"#;

/// Returns a folder with a tube whose pattern and scene are changed.
fn folder(pattern: (&str, &str), scene: (&str, &str)) -> TempDir {
    assert!(TUBE.contains(pattern.0) && SCENE.contains(scene.0));
    let folder = tempfile::tempdir().expect("a folder");
    let put = |name: &str, text: &str| write(folder.path().join(name), text).expect("written");
    put("plain.toml", FABRIC);
    put("tube.toml", &TUBE.replace(pattern.0, pattern.1));
    put("scene.toml", &SCENE.replace(scene.0, scene.1));
    folder
}

/// Checks a file with a figure, and returns the exit code with what is said on standard error.
fn check(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::cargo_bin("drape").expect("the binary is built");
    let output = command.current_dir(folder).arg("check").args(arguments).output().expect("runs");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Returns the number of pixels of a picture that are red, as what is wrong is, and of those that
/// are green, as the second seam is.
fn coloured_pixels(path: &Path) -> [usize; 2] {
    let file = std::io::BufReader::new(std::fs::File::open(path).expect("a picture"));
    let mut reader = png::Decoder::new(file).read_info().expect("PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut pixels).expect("pixels");
    let pixels = || pixels[..info.buffer_size()].chunks(info.color_type.samples());
    [0, 1].map(|k| {
        let others = [0, 1, 2].into_iter().filter(move |other| *other != k);
        let is_alone = |p: &&[u8]| {
            p[k] > 90 && others.clone().all(|other| u16::from(p[k]) > 2 * u16::from(p[other]))
        };
        pixels().filter(is_alone).count()
    })
}

#[test]
fn a_seam_that_is_reversed_is_red_in_space_and_the_others_are_not_drawn() {
    let folder = folder(
        (
            "sides = [[\"front.right\"], [\"back.left\"]]",
            "sides = [[\"front.right\"], [\"back.left\"]]\nreversed = true",
        ),
        ("", ""),
    );
    let (code, said) = check(folder.path(), &["scene.toml", "--figure", "wrong.png"]);
    assert!(code == Some(3) && said.contains("seam.other: the seam is reversed"), "{said}");
    let [red, green] = coloured_pixels(&folder.path().join("wrong.png"));
    assert!(red > 1000 && green == 0, "{red} and {green} pixels");
    let (code, _) = check(folder.path(), &["scene.toml", "--figure", "wrong.svg"]);
    let svg = read_to_string(folder.path().join("wrong.svg")).expect("a figure");
    assert!(code == Some(3) && svg.contains(">other</text>") && !svg.contains(">one</text>"));
    // In a scene that is right the seam has its own colour.
    let right = self::folder(("", ""), ("", ""));
    let (code, said) = check(right.path(), &["scene.toml", "--figure", "right.png"]);
    assert_eq!(code, Some(0), "{said}");
    let [_, green] = coloured_pixels(&right.path().join("right.png"));
    assert!(green > 1000, "{green} pixels");
}

#[test]
fn surfaces_that_cross_are_red_in_space() {
    let folder = folder(
        (
            "origin = [150, 0, -100]\nturn = [0, 180, 0]",
            "origin = [0, 70, 200]\nturn = [10, 90, 0]",
        ),
        ("surfaces = true", "surfaces = true\n[sew]\ntwisted = [\"one\", \"other\"]"),
    );
    let (code, said) = check(folder.path(), &["scene.toml", "--figure", "wrong.png"]);
    assert!(code == Some(3) && said.contains("\"back\" and \"front\""), "{said}");
    assert!(!said.contains("no figure"), "{said}");
    let [red, green] = coloured_pixels(&folder.path().join("wrong.png"));
    assert!(red > 1000 && green == 0, "{red} and {green} pixels");
}

#[test]
fn what_keeps_a_scene_from_being_made_is_red_on_the_flat_panels() {
    let gap = (
        "rectangle = [300, 200]\norigin = [-150, 0, 100]",
        "start = [0, 0]\noutline = [{ name = \"hem\", to = [300, 0] }, { name = \"right\", to = [300, 200] }, \
         { name = \"left\", to = [0, 30] }]\norigin = [-150, 0, 100]",
    );
    let folder = folder(gap, ("", ""));
    for file in ["scene.toml", "tube.toml"] {
        let (code, said) = check(folder.path(), &[file, "--figure", "wrong.svg"]);
        assert!(code == Some(3) && said.contains("panel front"), "{file}: {said}");
        let figure = folder.path().join("wrong.svg");
        let svg = read_to_string(&figure).expect("a figure");
        assert!(svg.contains("class=\"gap\"") && svg.contains(">back</text>"), "{file}");
        std::fs::remove_file(figure).expect("it is removed");
    }
    // A flat drawing is no picture of space: its name says so.
    let (code, said) = check(folder.path(), &["scene.toml", "--figure", "wrong.png"]);
    assert!(code == Some(3) && said.contains("drawn flat, as wrong.svg"), "{said}");
    assert!(folder.path().join("wrong.svg").is_file() && !folder.path().join("wrong.png").exists());
    // Of a text without a line nothing can be drawn, which is said.
    write(folder.path().join("tube.toml"), "length = [").expect("written");
    for file in ["scene.toml", "tube.toml"] {
        let (code, said) = check(folder.path(), &[file, "--figure", "none.svg"]);
        assert!(code == Some(3) && said.contains("no figure: "), "{file}: {said}");
        assert!(!folder.path().join("none.svg").exists());
    }
}

#[test]
fn programs_get_what_a_mistake_speaks_of_and_its_remedy_as_an_edit() {
    let folder = folder(
        (
            "sides = [[\"front.right\"], [\"back.left\"]]",
            "sides = [[\"front.rigth\"], [\"back.left\"]]",
        ),
        ("", ""),
    );
    let path = folder.path().join("tube.toml");
    let mut command = Command::cargo_bin("drape").expect("the binary is built");
    let output = command.current_dir(folder.path()).args(["check", "tube.toml", "--json"]);
    let output = output.output().expect("runs");
    assert_eq!(output.status.code(), Some(3));
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let [mistake] = &found[0]["mistakes"].as_array().expect("a list")[..] else {
        panic!("{found}")
    };
    assert_eq!(mistake["subject"], serde_json::json!({ "seam": "other" }));
    assert_eq!(mistake["key"], "seam.other.sides[0][0]");
    let [edit] = &mistake["edits"].as_array().expect("a list")[..] else { panic!("{found}") };
    let word = |key: &str| edit[key].as_str().expect("text").to_owned();
    assert_eq!([word("file"), word("key")], ["tube.toml", "seam.other.sides[0][0]"]);
    // The edit is made as any program can make it.
    let text = read_to_string(&path).expect("a pattern");
    write(&path, text.replace(&word("old"), &word("new"))).expect("written");
    assert_eq!(check(folder.path(), &["tube.toml"]).0, Some(0));
}
