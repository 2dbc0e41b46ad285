//! `drape convert`: patterns of others to TOML, and to drawings; exports of instruments to sheets;
//! what is asked for, and what is refused.

use std::path::Path;
use std::process::Output;

use assert_cmd::Command;

fn drape(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("drape").expect("the binary is built");
    command.current_dir(folder).args(arguments).output().expect("it runs")
}

fn shipped(name: &str) -> String {
    format!("{}/crates/drape-pattern/patterns/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_pattern_goes_to_toml_to_a_drawing_to_pages_and_back() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let run = |arguments: &[&str]| {
        let output = drape(folder, arguments);
        assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
        output
    };
    let notes = run(&["convert", &shipped("teagan.json"), "-o", "teagan.toml"]);
    assert!(text(&notes.stderr).contains("note: no seams"), "{}", text(&notes.stderr));
    let written = std::fs::read_to_string(folder.join("teagan.toml")).expect("it is written");
    assert!(written.contains("# - no seams") && written.contains("[panel.\"teagan.front\"]"));
    run(&["convert", "teagan.toml", "-o", "teagan.svg"]);
    let back = run(&["convert", "teagan.svg"]);
    assert!(text(&back.stdout).contains("[panel.\"teagan.front\"]"), "{}", text(&back.stdout));
    run(&["check", "teagan.svg", "--spacing", "20"]);
    let dxf = run(&["convert", "teagan.toml", "-o", "teagan.dxf"]);
    assert!(text(&dxf.stderr).is_empty(), "{}", text(&dxf.stderr));
    run(&["check", "teagan.dxf", "--spacing", "20"]);
    let pages = run(&["convert", "teagan.toml", "-o", "print.svg", "--paper", "a4"]);
    let pages = text(&pages.stdout);
    assert!(pages.contains("print-A1.svg") && pages.lines().count() > 8, "{pages}");
    let again = drape(folder, &["convert", "teagan.json", "-o", "teagan.toml"]);
    assert_eq!(again.status.code(), Some(3), "there is no teagan.json here");
    let exists = drape(folder, &["convert", "teagan.svg", "-o", "teagan.toml"]);
    assert_eq!(exists.status.code(), Some(2));
    assert!(text(&exists.stderr).contains("--force"), "{}", text(&exists.stderr));
    run(&["convert", "teagan.svg", "-o", "teagan.toml", "--force"]);
}

/// Table of two fabrics.
const FABRICS: &str = "Fabric,B warp,B weft,W\npoplin,0.1,0.08,12\nserge,0.3,0.2,25\n";

#[test]
fn files_of_other_programs_are_answered_with_how_to_get_a_drawing_from_them() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    // None of them is text.
    for (name, words) in [
        ("shirt.val", ["Valentina or Seamly2D", "SVG or DXF"]),
        ("shirt.vit", ["table of measurements", "*.val"]),
        ("shirt.zpac", ["CLO or Marvelous Designer", "File > Export > DXF"]),
        ("shirt.MRK", ["marker", "DXF (AAMA or ASTM)"]),
        ("shirt.pds", ["OptiTex", "File > Export"]),
        ("shirt.mdl", ["Lectra Modaris", "File > Export"]),
        ("shirt.rul", ["grade rules", "*.dxf file beside it"]),
        ("shirt.plt", ["plotter", "Inkscape"]),
    ] {
        std::fs::write(folder.join(name), [0_u8, 159, 146, 150, 0, 255]).expect("it is written");
        let scene = format!(
            "fabric.f.file = \"f.toml\"\n[[garment]]\npattern = \"{name}\"\nfabric = \"f\"\n"
        );
        std::fs::write(folder.join("scene.toml"), scene).expect("it is written");
        for arguments in [vec!["convert", name], vec!["check", name], vec!["check", "scene.toml"]] {
            let output = drape(folder, &arguments);
            let said = text(&output.stderr);
            assert_eq!(output.status.code(), Some(3), "{arguments:?}: {said}");
            assert!(
                words.iter().all(|word| said.contains(word)),
                "{arguments:?}: {words:?}: {said}"
            );
        }
    }
}

#[test]
fn what_does_not_fit_is_refused_with_a_remedy() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let drawing = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 500 500\">\
                   <path id=\"front\" d=\"M0 0H300V400H0Z\"/></svg>";
    std::fs::write(folder.join("d.svg"), drawing).expect("it is written");
    std::fs::write(folder.join("fabrics.csv"), FABRICS).expect("it is written");
    std::fs::create_dir(folder.join("empty")).expect("a folder");
    std::fs::write(folder.join("empty/note.txt"), "washed twice\n").expect("it is written");
    let shirt = shipped("shirt.json");
    for (arguments, code, words) in [
        (vec!["convert", "d.svg"], 3, "--unit mm"),
        (vec!["convert", "d.svg", "--unit", "ell"], 2, "mm, cm, m, in, pt or px"),
        (vec!["convert", &shirt, "--unit", "mm"], 3, "leave the unit out"),
        (vec!["convert", &shirt, "--size", "M"], 3, "leave the size out"),
        (vec!["convert", &shirt, "--paper", "a4"], 2, "-o NAME.svg"),
        (vec!["convert", &shirt, "-o", "a.svg", "--paper", "b9"], 2, "210x297"),
        (vec!["convert", &shirt, "-o", "a.svg", "--width", "5"], 2, "such as 900"),
        (vec!["convert", &shirt, "-o", "a.obj"], 2, "*.toml, *.svg or *.dxf"),
        (vec!["convert", "empty"], 3, "no file of the folder is a curve or a value: note.txt"),
        (vec!["convert", ".", "--size", "M"], 2, "--size is for patterns"),
        (vec!["convert", ".", "-o", "a.svg"], 2, "*.toml, or into a folder"),
        (
            vec!["convert", "fabrics.csv", "-o", "a.toml"],
            2,
            "--fabric NAME, or all of them with -o FOLDER",
        ),
        (
            vec!["convert", "fabrics.csv", "--fabric", "silk"],
            3,
            "name one of \"poplin\", \"serge\"",
        ),
        (vec!["convert", "fabrics.csv", "--paper", "a4"], 2, "--paper is for patterns"),
        (vec!["convert", "none.xlsx"], 3, "cannot open the file"),
        (vec!["convert", &shirt, "d.svg"], 2, "one pattern, file or folder at a time"),
    ] {
        let output = drape(folder, &arguments);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
        assert!(said.contains(words), "{words:?} is not in: {said}");
    }
    let asked = drape(folder, &["convert", "d.svg", "--unit", "mm"]);
    assert!(text(&asked.stdout).contains("to = [300, 0]"), "{}", text(&asked.stdout));
}

#[test]
fn a_table_of_several_fabrics_goes_to_a_sheet_each() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    std::fs::write(folder.join("fabrics.csv"), FABRICS).expect("it is written");
    let run = |arguments: &[&str]| {
        let output = drape(folder, arguments);
        assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
        text(&output.stdout)
    };
    let said = run(&["convert", "fabrics.csv", "-o", "sheets"]);
    assert!(said.contains("poplin.sheet.toml") && said.contains("serge.sheet.toml"), "{said}");
    assert!(run(&["convert", "fabrics.csv", "--fabric", "serge"]).contains("B = 0.3"));
    assert!(run(&["check", "sheets/serge.sheet.toml"]).contains("0.25 kg/m²"));
    assert_eq!(run(&["check", "fabrics.csv"]).matches("drafted, with 3 values").count(), 2);
    // A fit of the table makes the same sheets, and a fabric each.
    run(&["fit", "fabrics.csv", "-o", "fabrics"]);
    for name in ["poplin", "serge"] {
        let sheets = ["sheets", "fabrics"].map(|place| {
            std::fs::read_to_string(folder.join(place).join(format!("{name}.sheet.toml")))
                .expect("a sheet")
        });
        assert_eq!(sheets[0], sheets[1]);
        assert!(folder.join("fabrics").join(format!("{name}.toml")).exists(), "{name}");
    }
    run(&["fit", "fabrics.csv", "--fabric", "poplin", "-o", "one.toml"]);
    assert!(folder.join("one.sheet.toml").exists() && folder.join("one.toml").exists());
}

/// Export of a strip in gf/cm, with its direction in a line above.
fn export(direction: &str, stiffness: f64) -> String {
    let way = (0..=40).chain((0..40).rev()).enumerate();
    let row = |(index, step): (usize, i32)| {
        let strain = 0.1 * f64::from(step);
        let shape = if index > 40 { 0.25 * strain } else { 1.0 };
        format!("{strain:.3};{:.5}\r\n", stiffness * strain * strain * shape).replace('.', ",")
    };
    let rows: String = way.map(row).collect();
    format!("KES-FB1-A\r\nDirection;{direction}\r\n\r\nStrain (%);Force (gf/cm)\r\n{rows}")
}

#[test]
fn a_folder_of_exports_goes_to_a_sheet_that_is_checked_and_fitted() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let exports = folder.join("exports");
    std::fs::create_dir(&exports).expect("a folder");
    for (name, direction, stiffness) in [("a.txt", "Warp", 31.0), ("b.txt", "Weft", 20.0)] {
        std::fs::write(exports.join(name), export(direction, stiffness)).expect("written");
    }
    std::fs::write(exports.join("values.csv"), "Item,Unit,Value\nW,mg/cm2,12.4\nT0,mm,0.5\n")
        .expect("written");
    let run = |arguments: &[&str]| {
        let output = drape(folder, arguments);
        assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
        text(&output.stdout)
    };
    let said = run(&["convert", "exports", "-o", "drafted/sheet.toml"]);
    assert!(said.contains("2 curves, 2 values, 0 sections"), "{said}");
    let hand = "name = \"exports\"\nW = 12.4\nT0 = 0.5\n\
                [[curve]]\ntest = \"tensile\"\ndirection = \"warp\"\nfile = \"a.txt\"\n\
                [[curve]]\ntest = \"tensile\"\ndirection = \"weft\"\nfile = \"b.txt\"\n";
    std::fs::write(exports.join("sheet.toml"), hand).expect("written");
    for sheet in ["drafted", "exports"] {
        assert!(run(&["check", sheet]).contains("2 curves"), "{sheet}");
        run(&["fit", sheet, "-o", &format!("{sheet}.toml")]);
    }
    let fabric = |name: &str| {
        let text = std::fs::read_to_string(folder.join(name)).expect("a fabric");
        let mut fabric: toml::Table = text.parse().expect("TOML");
        fabric.remove("provenance");
        fabric
    };
    assert_eq!(fabric("drafted.toml"), fabric("exports.toml"));
    let again = drape(folder, &["convert", "exports", "-o", "drafted"]);
    assert_eq!(again.status.code(), Some(2), "{}", text(&again.stderr));
    run(&["convert", "exports", "-o", "drafted", "--force"]);
    assert!(run(&["convert", "exports"]).contains("file = \"a.txt\""), "for the folder itself");
}
