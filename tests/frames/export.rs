//! Runs that are exported for other programs: which files there are, and what is refused.

use std::path::Path;

use tempfile::TempDir;

use super::drape;

/// Scene of a sheet that falls beside a box, with a frame every 20 ms and one more at the end.
const SCENE: &str = r#"spacing = 0.05
fabric.plain.file = "plain.toml"
[[panel]]
name = "a \"sheet\""
fabric = "plain"
rectangle = [0.2, 0.2]
center = [0, 0.2, 0]
[[collider.box]]
name = "box"
size = [0.1, 0.1, 0.1]
center = [0.5, 0, 0]
[time]
step = 0.005
end = 0.05
[output]
every = 0.02
folder = "run"
"#;

/// Returns a folder with the run.
pub(crate) fn run() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let fabric = include_str!("../fabrics/plain-weave.toml");
    std::fs::write(folder.path().join("plain.toml"), fabric).expect("writes");
    std::fs::write(folder.path().join("scene.toml"), SCENE).expect("writes");
    let output = drape(folder.path(), &["run", "scene.toml", "--no-picture"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder
}

/// Exports the run and returns what is said, on stdout and on stderr.
fn export(folder: &Path, arguments: &[&str]) -> (String, String) {
    let output = drape(folder, &[&["export", "run"], arguments].concat());
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{arguments:?}: {said}");
    (String::from_utf8_lossy(&output.stdout).into_owned(), said)
}

/// Returns the names of the files of a folder.
fn files(folder: &Path) -> Vec<String> {
    let entries =
        std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry"));
    let mut names: Vec<String> =
        entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn every_format_has_its_files() {
    let folder = run();
    let rows: [(&[&str], &[&str]); 11] = [
        (&["-o", "1/a.obj"], &["a.obj"]),
        (&["-o", "2/a.obj", "--frames", "1.."], &["a-00001.obj", "a-00002.obj", "a-00003.obj"]),
        (&["-o", "3/a.glb"], &["a.glb"]),
        (&["-o", "4/a.usda"], &["a.usda"]),
        (&["-o", "5/a.pc2"], &["a.obj", "a.pc2"]),
        (&["-o", "6/a.mdd"], &["a.mdd", "a.obj"]),
        (&["-o", "7/a.vtp", "--frame", "2"], &["a-bodies.vtp", "a.vtp"]),
        (&["-o", "8/a.pvd"], &["a", "a.pvd"]),
        (&["-o", "9/a", "--format", "npz"], &["a"]),
        (&["-o", "10/a.CSV"], &["a.CSV"]),
        (&["-o", "11/a.svg", "--map", "shear"], &["a.svg"]),
    ];
    for (number, (arguments, expected)) in (1..).zip(rows) {
        export(folder.path(), arguments);
        assert_eq!(files(&folder.path().join(format!("{number}"))), expected, "{arguments:?}");
    }
    // A body that rests has one file.
    let cloth = (0..4).map(|number| format!("cloth-0000{number}.vtp"));
    let expected: Vec<String> =
        std::iter::once("bodies-00000.vtp".to_owned()).chain(cloth).collect();
    let found = files(&folder.path().join("8/a"));
    assert_eq!(found, expected);
}

#[test]
fn a_shorter_sequence_leaves_no_file_of_a_longer_one() {
    let folder = run();
    for other in ["a-000003.obj", "a-00005.obj", "b-00002.obj", "a-00002.mtl"] {
        std::fs::create_dir_all(folder.path().join("a")).expect("a folder");
        std::fs::write(folder.path().join("a").join(other), "another's").expect("writes");
    }
    export(folder.path(), &["-o", "a/a.obj", "--frames", "0..3"]);
    export(folder.path(), &["-o", "a/a.obj", "--frames", "0..1", "--force"]);
    // What is not the next of the sequence is another's.
    let others = ["a-00002.mtl", "a-000003.obj", "a-00005.obj", "b-00002.obj"];
    let mut expected = [&["a-00000.obj", "a-00001.obj"][..], &others].concat();
    expected.sort_unstable();
    assert_eq!(files(&folder.path().join("a")), expected);
}

#[test]
fn the_object_of_the_last_frame_is_that_of_the_run() {
    let folder = run();
    export(folder.path(), &["-o", "last.obj"]);
    let read = |path: &str| std::fs::read(folder.path().join(path)).expect("reads");
    assert_eq!(read("last.obj"), read("run/last.obj"));
}

#[test]
fn frames_that_are_missed_or_repeated_are_told() {
    let folder = run();
    let (done, said) = export(folder.path(), &["-o", "a.pc2", "--fps", "100"]);
    assert!(said.contains("do not follow each other at 100 frames per second"), "{said}");
    assert!(done.contains("100 per second, in a.pc2"), "{done}");
    let (_, said) = export(folder.path(), &["-o", "a.usda", "--fps", "100"]);
    assert_eq!(said, "", "it keeps the times");
}

#[test]
fn what_cannot_be_exported_is_refused_with_a_remedy_that_works() {
    let folder = run();
    let refused = |arguments: &[&str], code: i32, told: &str| {
        let output = drape(folder.path(), &[&["export", "run"], arguments].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
        assert!(said.contains(told), "{arguments:?}: {said}");
    };
    refused(&["-o", "garment"], 2, "add it, such as --format glb");
    for (name, told) in [
        (
            "a.abc",
            "no format abc; the formats are obj, glb, usda, pc2, mdd, vtp, npz, csv, svg, png, apng; programs",
        ),
        ("a.fbx", "glb too"),
        ("a.USD", "may be renamed to *.usd"),
        ("a.xyz", "the formats are obj, glb"),
    ] {
        refused(&["-o", name], 2, told);
    }
    export(folder.path(), &["-o", "garment", "--format", "glb"]);
    refused(&["-o", "garment", "--format", "glb"], 2, "replace it with --force");
    export(folder.path(), &["-o", "garment", "--format", "glb", "--force"]);
    refused(&["-o", "a.obj", "--frames", "1-2"], 2, "such as 10..20");
    refused(&["-o", "a.obj", "--frames", "2..1"], 2, "the first is at most the last");
    refused(&["-o", "a.obj", "--frame", "7"], 3, "its frames are 0 to");
    refused(&["-o", "a.obj", "--fps", "0"], 2, "above 0");
    refused(&["-o", "a.svg", "--map", "colour"], 2, "take one of strain-warp, strain-weft, shear");
    refused(&["-o", "a.svg", "--map", "seam-gap"], 2, "what is known is strain-warp");
    refused(&["-o", "a.svg", "--frames", "0..1"], 2, "name it with --frame");
    export(folder.path(), &["-o", "a.svg", "--frame", "1"]);
    refused(&["-o", "a.glb", "--map", "shear"], 2, "leave it out");
    refused(&["-o", "garment/a.obj"], 6, "cannot write");
    // Of the rest object too.
    export(folder.path(), &["-o", "a.obj"]);
    refused(&["-o", "a.pc2"], 2, "a.obj exists");
    let output = drape(folder.path(), &["export", "scene.toml", "-o", "b.obj"]);
    assert_eq!(output.status.code(), Some(3), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(!folder.path().join("a.part").exists());
}
