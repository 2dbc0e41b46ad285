//! Every command that is given a file of another kind says what the file is and which command takes
//! it.

use std::path::Path;

use tempfile::TempDir;

use crate::{fails, succeeds};

/// Files of each kind, with their kinds in words.
const FILES: [(&str, &str); 12] = [
    ("scene.toml", "a scene"),
    ("wool.toml", "a fabric"),
    ("sheet.toml", "a sheet of measurements"),
    ("pattern.toml", "a pattern"),
    ("study.toml", "a study"),
    ("skirt.json", "a drawing of a pattern"),
    ("body.obj", "a mesh of a body"),
    ("loop.csv", "a table"),
    ("book.xlsx", "a workbook"),
    ("wool.u3ma", "a U3M material"),
    ("run", "a run"),
    ("run/picture.png", "a picture"),
];

/// Commands without their file, with the kinds that they take.
const COMMANDS: [(&[&str], &[&str]); 12] = [
    (&["run"], &["a scene"]),
    (&["converge", "--spacings", "100,50"], &["a scene"]),
    (&["fit"], &["a sheet of measurements", "a table", "a workbook"]),
    (&["fabric", "show"], &["a fabric", "a sheet of measurements"]),
    (&["fabric", "compare", "wool.toml"], &["a fabric", "a sheet of measurements"]),
    (&["fabric", "export", "--format", "ppf"], &["a fabric", "a sheet of measurements"]),
    (&["test"], &["a fabric", "a sheet of measurements"]),
    (&["sweep", "plan"], &["a study"]),
    (&["view"], &["a run"]),
    (&["picture"], &["a run"]),
    (&["resume"], &["a run"]),
    (&["export", "-o", "x.obj"], &["a run"]),
];

/// Returns a folder with a file of each kind.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let copy =
        |from: &str, to: &str| std::fs::copy(root.join(from), path.join(to)).expect("a copy");
    let write = |name: &str, text: &str| std::fs::write(path.join(name), text).expect("a file");
    copy("tests/fabrics/plain-weave.toml", "wool.toml");
    copy("fabrics/matsudaira-b/sheet.toml", "sheet.toml");
    copy("crates/drape-pattern/patterns/skirt.json", "skirt.json");
    succeeds(path, &["new", "pattern"]);
    write("body.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    write("loop.csv", "Symbol,Unit,Warp,Weft\nB,gf.cm2/cm,0.11,0.06\n2HB,gf.cm/cm,0.04,0.03\n");
    book(&path.join("book.xlsx"));
    write(
        "study.toml",
        "scene = \"scene.toml\"\n[[axis]]\nkey = \"time.end\"\nvalues = [0.01, 0.02]\n",
    );
    let scene = "spacing = 0.1\nfabric.wool.file = \"wool.toml\"\n[[panel]]\nname = \"cloth\"\n\
                 fabric = \"wool\"\nrectangle = [0.2, 0.2]\n[time]\nstep = 0.01\nend = 0.02\n";
    write("scene.toml", scene);
    succeeds(path, &["fabric", "export", "wool.toml", "-o", "wool.u3ma"]);
    succeeds(path, &["run", "scene.toml", "-o", "run"]);
    folder
}

/// Writes a workbook with a table of values.
fn book(path: &Path) {
    let mut book = rust_xlsxwriter::Workbook::new();
    let sheet = book.add_worksheet();
    for (row, line) in ["Symbol,Unit,Warp,Weft", "B,gf.cm2/cm,0.11,0.06"].iter().enumerate() {
        for (column, cell) in line.split(',').enumerate() {
            sheet.write(row as u32, column as u16, cell).expect("a cell");
        }
    }
    book.save(path).expect("a file");
}

/// Returns the commands in a message that name a file, without `drape`.
fn remedies(message: &str) -> Vec<Vec<String>> {
    let help = message.split("help: ").nth(1).expect("a remedy");
    let quoted = help.split('`').skip(1).step_by(2);
    let commands = quoted.filter(|command| !command.contains("FOLDER"));
    commands.map(|command| command.split(' ').skip(1).map(str::to_owned).collect()).collect()
}

#[test]
fn a_file_of_another_kind_is_named_with_the_commands_that_take_it() {
    let folder = folder();
    let path = folder.path();
    let mut taken = Vec::new();
    for (command, wanted) in COMMANDS {
        for (file, kind) in FILES {
            if wanted.contains(&kind) {
                continue;
            }
            let message = fails(path, &[command, &[file]].concat(), 3);
            assert!(
                message.contains(&format!("{file}: this is {kind}, not ")),
                "{command:?}: {message}"
            );
            assert!(message.contains(wanted[0]), "{command:?}: {message}");
            taken.extend(remedies(&message));
        }
    }
    // The remedies work. A pattern is there already.
    taken.sort();
    taken.dedup();
    assert!(taken.len() > 10, "{taken:?}");
    for remedy in taken {
        let mut arguments: Vec<&str> = remedy.iter().map(String::as_str).collect();
        if arguments[0] == "convert" {
            arguments.push("--force");
        }
        succeeds(path, &arguments);
    }
}

#[test]
fn what_a_scene_names_is_of_the_right_kind() {
    let folder = folder();
    let path = folder.path();
    let set = "fabric.wool.file=\"study.toml\"";
    let message = fails(path, &["run", "scene.toml", "-o", "other", "--set", set], 3);
    assert!(
        message.contains("this is a study, not a fabric or a sheet of measurements"),
        "{message}"
    );
}

#[test]
fn kinds_are_told_on_standard_input_and_in_folders_too() {
    let folder = folder();
    let path = folder.path();
    let mut command = crate::command(path, &["run", "-"]);
    command.stdin(std::fs::File::open(path.join("wool.toml")).expect("a file"));
    let message = String::from_utf8(command.output().expect("it runs").stderr).expect("text");
    assert!(message.contains("<standard input>: this is a fabric, not a scene"), "{message}");
    assert!(message.contains("`drape fabric show -`"), "{message}");

    let inside = fails(path, &["view", "run/summary.json"], 3);
    assert!(inside.contains("this is a file in the folder of a run, not a run"), "{inside}");
    assert!(inside.contains("`drape view run` shows it"), "{inside}");
    std::fs::create_dir(path.join("wool")).expect("a folder");
    std::fs::copy(path.join("sheet.toml"), path.join("wool/sheet.toml")).expect("a copy");
    let sheet = fails(path, &["run", "wool"], 3);
    assert!(sheet.contains("wool: this is a sheet of measurements, not a scene"), "{sheet}");
    assert!(sheet.contains("fabric.NAME.file = \"wool/sheet.toml\""), "{sheet}");
}

#[test]
fn what_is_like_no_kind_is_read_with_its_mistakes() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    std::fs::write(path.join("odd.toml"), "colour = \"blue\"\n").expect("a file");
    let message = fails(path, &["run", "odd.toml"], 3);
    assert!(message.contains("colour") && !message.contains("this is"), "{message}");
}

#[test]
fn a_study_is_described() {
    let folder = folder();
    let text = succeeds(folder.path(), &["check", "study.toml"]);
    assert!(text.contains("study of the scene scene.toml, 2 points"), "{text}");
    assert!(text.contains("time.end: 0.01, 0.02"), "{text}");
}
