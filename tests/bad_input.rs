//! Wrong input: one clear error, exit code 3, and nothing is written.

use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use tempfile::TempDir;

const FABRIC: &str = include_str!("fabrics/plain-weave.toml");

const SCENE: &str = r#"name = "towel"
spacing = 0.02
[fabric.plain]
file = "plain.toml"
[[panel]]
name = "towel"
fabric = "plain"
rectangle = [0.2, 0.3]
[time]
step = 0.005
end = 0.05
[output]
folder = "results"
"#;

const SHEET: &str = r#"name = "linen"
W = 18.0
T = 0.4
[[curve]]
test = "bending"
direction = "warp"
file = "bending.csv"
deformation = { column = "curvature", unit = "1/cm" }
load = { column = "moment", unit = "gf.cm/cm" }
"#;

const CURVE: &str = "curvature,moment\n0,0\n1,0.2\n2,0.32\n1,0.1\n0,-0.06\n-2,-0.32\n0,0.06\n";

/// Returns a folder with a scene, its fabric, a sheet and its curve.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let files = [
        ("towel.toml", SCENE),
        ("plain.toml", FABRIC),
        ("sheet.toml", SHEET),
        ("bending.csv", CURVE),
    ];
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("writes");
    }
    folder
}

fn drape(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("drape").expect("the binary is built");
    command.current_dir(folder).args(arguments).output().expect("it runs")
}

/// Changes one file and runs a command, which must exit with 3, report one error with the given
/// words, and write nothing.
fn mistake(file: &str, change: (&str, &str), arguments: &[&str], words: &[&str]) {
    let (good, bad) = change;
    let folder = folder();
    let path = folder.path().join(file);
    let text = std::fs::read_to_string(&path).expect("reads");
    assert!(text.contains(good), "{file} has no {good:?}");
    std::fs::write(&path, text.replacen(good, bad, 1)).expect("writes");
    check(folder.path(), arguments, words);
}

fn check(folder: &Path, arguments: &[&str], words: &[&str]) {
    let output = drape(folder, arguments);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{arguments:?} said: {message}");
    let errors = message.lines().filter(|line| line.starts_with("error")).count();
    assert_eq!(errors, 1, "one error, not: {message}");
    for word in words {
        assert!(message.contains(word), "{word:?} is missing in: {message}");
    }
    assert!(!folder.join("results").exists(), "nothing is written");
    assert!(!folder.join("fabric.toml").exists(), "nothing is written");
}

const RUN: &[&str] = &["run", "towel.toml"];
const FIT: &[&str] = &["fit", "sheet.toml", "-o", "fabric.toml"];

#[test]
fn the_files_are_right_before_they_are_made_wrong() {
    let folder = folder();
    let output = drape(folder.path(), RUN);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(folder.path().join("results/summary.json").exists());
    let output = drape(folder.path(), FIT);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(folder.path().join("fabric.toml").exists());
}

#[test]
fn an_unknown_key_names_the_one_that_was_meant() {
    let change = ("fabric = \"plain\"", "fabirc = \"plain\"");
    mistake("towel.toml", change, RUN, &["towel.toml:7", "fabirc", "did you mean `fabric`?"]);
    mistake("plain.toml", ("density", "densty"), RUN, &["plain.toml:3", "densty", "density"]);
    mistake("sheet.toml", ("load =", "laod ="), FIT, &["sheet.toml:9", "laod", "load"]);
}

#[test]
fn a_missing_file_is_named_with_its_line() {
    let change = ("file = \"plain.toml\"", "file = \"plane.toml\"");
    mistake("towel.toml", change, RUN, &["towel.toml:4", "plane.toml", "did you mean"]);
    let change = ("file = \"bending.csv\"", "file = \"binding.csv\"");
    mistake("sheet.toml", change, FIT, &["sheet.toml:7", "binding.csv"]);
    check(folder().path(), &["run", "trowel.toml"], &["trowel.toml", "did you mean", "towel.toml"]);
}

#[test]
fn a_wrong_unit_names_the_known_ones() {
    let change = ("name = \"towel\"\nspacing", "name = \"towel\"\nlength = \"inch\"\nspacing");
    mistake("towel.toml", change, RUN, &["towel.toml:2", "inch", "mm"]);
    mistake("sheet.toml", ("\"1/cm\"", "\"1/yard\""), FIT, &["sheet.toml:8", "1/yard", "1/cm"]);
}

#[test]
fn nan_is_refused_wherever_it_stands() {
    mistake("towel.toml", ("step = 0.005", "step = nan"), RUN, &["towel.toml:10", "nan is not"]);
    mistake(
        "plain.toml",
        ("density = 0.12", "density = nan"),
        RUN,
        &["plain.toml:3", "nan is not"],
    );
    mistake("bending.csv", ("2,0.32", "2,nan"), FIT, &["bending.csv:4", "nan"]);
}

#[test]
fn a_curve_of_no_or_one_point_is_refused() {
    mistake("bending.csv", (&CURVE[17..], ""), FIT, &["bending.csv", "point"]);
    mistake("bending.csv", (&CURVE[21..], ""), FIT, &["bending.csv", "point"]);
}

#[test]
fn a_negative_density_is_refused() {
    mistake("plain.toml", ("0.12", "-0.12"), RUN, &["plain.toml:3", "-0.12", "help"]);
    mistake("sheet.toml", ("W = 18.0", "W = -18.0"), FIT, &["sheet.toml:2", "-18", "help"]);
}

#[test]
fn a_spacing_larger_than_the_panel_is_refused() {
    mistake(
        "towel.toml",
        ("spacing = 0.02", "spacing = 2"),
        RUN,
        &["towel.toml:2", "write spacing = \"100 mm\" or less"],
    );
}

#[test]
fn several_mistakes_are_reported_together() {
    let folder = folder();
    let text = SCENE.replace("step = 0.005", "step = -1").replace("[0.2, 0.3]", "[0.2, -0.3]");
    std::fs::write(folder.path().join("towel.toml"), text).expect("writes");
    let output = drape(folder.path(), &["check", "towel.toml"]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3));
    for place in ["towel.toml:8", "towel.toml:10"] {
        assert!(message.contains(place), "{place} is missing in: {message}");
    }
}

#[test]
fn earlier_results_are_kept_unless_their_loss_is_allowed() {
    let folder = folder();
    let arguments = ["run", "towel.toml", "-o", "mine"];
    assert!(drape(folder.path(), &arguments).status.success());
    assert_eq!(drape(folder.path(), &arguments).status.code(), Some(2));
    assert!(drape(folder.path(), &[&arguments[..], &["--force"]].concat()).status.success());
}

#[test]
fn a_body_of_another_unit_or_with_holes_is_told_from_one() {
    let corners = "v 0 0 0\nv 1700 0 0\nv 0 1700 0\nv 0 0 1700\n";
    let faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    let scene = |scale: &str| {
        let body =
            format!("[[collider.mesh]]\nfile = \"body.obj\"\n{scale}center = [0, -9000, 0]\n");
        format!("{SCENE}{body}")
    };
    let folder = folder();
    let write = |name: &str, text: String| {
        std::fs::write(folder.path().join(name), text).expect("writes");
    };
    write("body.obj", format!("{corners}{faces}"));
    write("towel.toml", scene(""));
    check(folder.path(), RUN, &["towel.toml", "1700.0000 m long", "scale = 0.001"]);
    write("towel.toml", scene("scale = 0.000001\n"));
    check(folder.path(), RUN, &["towel.toml", "0.0017 m long", "unit"]);
    write("towel.toml", scene("scale = 0.001\n"));
    write("body.obj", corners.to_owned() + &faces[8..]);
    check(
        folder.path(),
        RUN,
        &["towel.toml", "the mesh is open: 3 boundary edges", "fill the holes"],
    );
}
