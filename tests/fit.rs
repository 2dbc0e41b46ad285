//! `drape fit` as a laboratory uses it: one sheet with its report, many sheets at once.

use std::path::Path;

use assert_cmd::Command;
use drape::fit::parameter_key;
use drape::kes::{Direction, Test};

fn drape() -> Command {
    Command::cargo_bin("drape").expect("it is built")
}

fn fabrics() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/fabrics"))
}

#[test]
fn a_fit_leaves_a_fabric_and_a_page_that_needs_nothing_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let (fabric, report) = (folder.path().join("cupro.toml"), folder.path().join("report"));
    let mut command = drape();
    command.arg("fit").arg(fabrics().join("cupro-weave"));
    command.arg("-o").arg(&fabric).arg("--report").arg(&report).arg("--json");
    let output = command.assert().success().get_output().stdout.clone();
    let page: serde_json::Value = serde_json::from_slice(&output).expect("JSON");
    let laws = page["laws"].as_array().expect("laws");
    assert_eq!(laws.len(), 7, "one for each curve, and the assumed one of shear");
    for law in &laws[..2] {
        let misfit = law["statistics"]["misfit"].as_f64().expect("a misfit");
        assert!(misfit < 0.011, "{}: {misfit}", law["title"]);
        let branches = law["plots"][0]["branches"].as_array().expect("branches");
        assert_eq!(branches.len(), 6, "three cycles out and back");
    }
    drape().arg("check").arg(&fabric).assert().success();
    let html = std::fs::read_to_string(report.join("cupro-weave.html")).expect("a page");
    for outside in ["http://", "https://", "src=", "@import"] {
        let there = html.replace("http://www.w3.org/2000/svg", "").contains(outside);
        assert!(!there, "the page holds {outside}");
    }
    assert_eq!(html.matches("<section class=\"law\"").count(), 7);
}

#[test]
fn the_law_can_be_chosen_by_hand() {
    let folder = tempfile::tempdir().expect("a folder");
    let fabric = folder.path().join("tagawa.toml");
    let mut command = drape();
    command.arg("fit").arg(fabrics().join("tagawa-2003")).arg("-o").arg(&fabric);
    command.args(["--bending", "piecewise"]).assert().success();
    let text = std::fs::read_to_string(&fabric).expect("a fabric");
    let fabric: toml::Table = text.parse().expect("TOML");
    let bending = fabric["warp"]["bending"].as_table().expect("a law");
    assert!(bending.contains_key("piecewise"), "{bending:?}");
    assert!(!bending.contains_key("friction"), "his law has none: {bending:?}");
    // Parameters are in the file under the keys that are told for them.
    for parameter in ["slope", "intercept", "knot"] {
        let key = parameter_key(Test::Bending, Direction::Warp, parameter).expect("a key");
        let own = key.strip_prefix("warp.bending.piecewise.").expect("a key of the law");
        assert!(bending["piecewise"][own].is_float(), "{key}");
    }
}

#[test]
fn a_former_name_of_a_law_is_accepted_with_a_note() {
    let folder = tempfile::tempdir().expect("a folder");
    let fitted = |option: &str, law: &str| {
        let fabric = folder.path().join(format!("{law}.toml"));
        let mut command = drape();
        command.arg("fit").arg(fabrics().join("tagawa-2003")).arg("-o").arg(&fabric);
        let output = command.args([option, law, "--force"]).assert().success().get_output().clone();
        let text = std::fs::read_to_string(&fabric).expect("a fabric");
        let report = String::from_utf8(output.stdout).expect("a report");
        (text, report, String::from_utf8(output.stderr).expect("messages"))
    };
    for (former, law) in [("parallel", "two-elements"), ("breen-1994", "piecewise")] {
        // The report calls the law by the name that the command takes.
        let (formerly, report, messages) = fitted("--bending", former);
        let note = format!("note: `{former}` is now called `{law}`\n");
        assert_eq!(messages, note);
        assert!(report.contains(&format!("  law      {law}: ")), "{report}");
        let (today, _, messages) = fitted("--bending", law);
        assert_eq!(formerly, today);
        assert_eq!(messages, "");
        assert_eq!(fitted("--shear", former).2, note);
    }

    // A list of known names shows no former name.
    let output = drape().args(["fit", "x", "--bending", "third"]).assert().code(2);
    let messages = String::from_utf8(output.get_output().stderr.clone()).expect("messages");
    assert!(messages.contains("two-elements") && !messages.contains("parallel"), "{messages}");
}

#[test]
fn one_bad_sheet_does_not_stop_the_others() {
    let folder = tempfile::tempdir().expect("a folder");
    let sheets = folder.path().join("sheets");
    let sheet = |name: &str, text: &str| {
        std::fs::create_dir_all(sheets.join(name)).expect("a folder");
        std::fs::write(sheets.join(name).join("sheet.toml"), text).expect("writes");
    };
    sheet("linen", "name = \"linen\"\nW = 18.0\nT = 0.4\nwarp = { B = 0.1, 2HB = 0.05 }\n");
    sheet("wrong", "name = \"wrong\"\nW = -1.0\n");
    sheet("deep/silk", "name = \"silk\"\nW = 6.0\nT = 0.2\nwarp = { B = 0.01 }\n");
    let (fabrics, report) = (folder.path().join("fabrics"), folder.path().join("report"));
    let mut command = drape();
    command.arg("fit").arg(&sheets).arg("-o").arg(&fabrics).arg("--report").arg(&report);
    let assert = command.assert().code(3);
    let output = assert.get_output();
    let (out, err) =
        (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(err.contains("2 of 3 sheets fitted") && err.contains("wrong"), "{err}");
    assert_eq!(out.lines().count(), 4, "a head and a line for each sheet:\n{out}");
    for name in ["linen", "silk"] {
        assert!(fabrics.join(format!("{name}.toml")).exists(), "no fabric of {name}");
        assert!(report.join(format!("{name}.html")).exists(), "no report on {name}");
    }
    assert!(!fabrics.join("wrong.toml").exists());
}

#[test]
fn a_fabric_from_values_shows_them_again() {
    let mut command = drape();
    command.args(["fabric", "show"]).arg(fabrics().join("matsudaira-a"));
    let output = command.assert().success().get_output().stdout.clone();
    let text = String::from_utf8(output).expect("text");
    for (symbol, value) in [("B ", "0.1180"), ("2HB ", "0.1240")] {
        let row = text.lines().find(|line| line.trim_start().starts_with(symbol));
        let row = row.unwrap_or_else(|| panic!("no {symbol} in\n{text}"));
        assert!(row.contains(value), "{row}");
    }
}

#[test]
fn the_shipped_fabrics_are_listed_and_compared() {
    let mut command = drape();
    let output = command.args(["fabric", "list"]).arg(fabrics()).assert().success();
    let text = String::from_utf8_lossy(&output.get_output().stdout).into_owned();
    assert_eq!(text.lines().count(), 7, "a head and six fabrics:\n{text}");
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = drape();
    command.args(["fabric", "compare"]).arg(fabrics().join("matsudaira-a"));
    command.arg(fabrics().join("matsudaira-b")).arg("--report").arg(folder.path());
    command.assert().success();
    let page = folder.path().join("matsudaira-a-and-matsudaira-b.html");
    let html = std::fs::read_to_string(page).expect("a page");
    assert_eq!(html.matches("class=\"plot").count(), 3, "tensile, bending, shear");
}

#[test]
fn standard_errors_stand_under_the_keys_of_their_numbers() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, least) in [("cupro-weave", 8), ("tagawa-2003", 5)] {
        let path = folder.path().join(name);
        drape().arg("fit").arg(fabrics().join(name)).arg("-o").arg(&path).assert().success();
        let text = std::fs::read_to_string(&path).expect("a fabric");
        let file: toml::Value = toml::from_str(&text).expect("TOML");
        let errors = file["provenance"]["standard_errors"].as_table().expect("errors");
        assert!(errors.len() >= least, "{name}: {errors:?}");
        for (path, error) in errors {
            let steps = path.replace("[0]", ".0").replace("[1]", ".1");
            let number = steps.split('.').fold(&file, |value, step| match step.parse::<usize>() {
                Ok(index) => &value[index],
                Err(_) => &value[step],
            });
            let (number, error) = (number.as_float(), error.as_float());
            assert!(number.is_some() && error > Some(0.0), "{name} {path}: {number:?} ± {error:?}");
        }
        let reach = file["provenance"]["reach"].as_table().expect("how far it was measured");
        let of = |law: &str| reach.get(law).and_then(toml::Value::as_float);
        let stretched = of("warp.traction").expect("it was stretched");
        assert!((0.005..=0.2).contains(&stretched), "{name}: {stretched}");
        // The cupro was bent in loops, whose curvature is no measure of the test.
        assert_eq!(of("warp.bending").is_some(), name == "tagawa-2003", "{name}");
    }
}

#[test]
fn a_page_of_values_has_loops_with_the_values_in_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let (fabric, report) = (folder.path().join("a.toml"), folder.path().join("report"));
    let mut command = drape();
    command.arg("fit").arg(fabrics().join("matsudaira-a")).arg("-o").arg(&fabric);
    command.arg("--report").arg(&report).arg("--json");
    let output = command.assert().success().get_output().stdout.clone();
    let page: serde_json::Value = serde_json::from_slice(&output).expect("JSON");
    let laws = page["laws"].as_array().expect("laws");
    let titles: Vec<&str> = laws.iter().filter_map(|law| law["title"].as_str()).collect();
    assert_eq!(
        titles,
        ["tensile, warp", "tensile, weft", "bending, warp", "bending, weft", "shear"]
    );
    let bending = &laws[2];
    assert_eq!(bending["model"], "from the values of the sheet: B, 2HB");
    let reason = |symbol: &str| {
        let parameters = bending["parameters"].as_array().expect("parameters");
        let found = parameters.iter().find(|parameter| parameter["symbol"] == symbol);
        found.expect(symbol)["interval"]["fixed"]["reason"].to_string()
    };
    assert_eq!(reason("k_b"), "\"from B\"");
    assert!(reason("x_f").contains("ASSUMED"), "{}", reason("x_f"));
    assert!(laws[4]["model"].as_str().is_some_and(|model| model.starts_with("ASSUMED")));
    // The loop passes the marks: its values are those of the sheet.
    let plot = &bending["plots"][0];
    let points: Vec<[f64; 2]> = plot["branches"]
        .as_array()
        .expect("branches")
        .iter()
        .flat_map(|branch| branch["points"].as_array().expect("points"))
        .map(|point| ["deformation", "fitted"].map(|key| point[key].as_f64().expect("a number")))
        .collect();
    let largest = |axis: usize| points.iter().fold(0.0, |m: f64, point| m.max(point[axis].abs()));
    let scale = [largest(0), largest(1)];
    let marks = plot["marks"].as_array().expect("marks");
    assert_eq!(marks.len(), 2, "2HB and B");
    for mark in marks.iter().filter(|mark| mark["label"] == "2HB") {
        for mark in mark["points"].as_array().expect("points") {
            let away = |point: &[f64; 2]| {
                let part = |axis: usize| {
                    (point[axis] - mark[axis].as_f64().expect("a number")) / scale[axis]
                };
                part(0).hypot(part(1))
            };
            let nearest = points.iter().map(away).fold(f64::INFINITY, f64::min);
            assert!(nearest < 0.01, "{mark} is {nearest} of the plot away from the loop");
        }
    }
    let html = std::fs::read_to_string(report.join("matsudaira-a.html")).expect("a page");
    assert!(html.contains("class=\"points mark\"") && html.contains("values of the sheet"));
    let text = std::fs::read_to_string(&fabric).expect("a fabric");
    for words in
        ["# assumed: warp bending friction length", "# assumed: shear stiffness: not measured"]
    {
        assert!(text.contains(words), "{words} is missing in\n{text}");
    }
    drape().arg("check").arg(&fabric).assert().success();
}

#[test]
fn a_fit_says_what_was_read_and_why_a_law_was_taken() {
    let mut command = drape();
    let folder = tempfile::tempdir().expect("a folder");
    command.arg("fit").arg(fabrics().join("tagawa-2003")).arg("-o");
    let output = command.arg(folder.path().join("f.toml")).assert().success().get_output().clone();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    for said in [
        "[Read] - tensile.csv, tensile warp:",
        "taken: ",
        "model parameters misfit AICc above best weight",
        "chosen",
    ] {
        assert!(words.contains(said), "{said} is missing in\n{text}");
    }
}

/// Workbook of a laboratory: specimens of KES values in one sheet, curves of three tests in others.
fn laboratory_book() -> Vec<u8> {
    let mut book = rust_xlsxwriter::Workbook::new();
    let sheet = book.add_worksheet().set_name("Summary").expect("a name");
    let heads =
        ["Test", "Symbol", "Unit", "Warp 1", "Warp 2", "Warp 3", "Weft 1", "Weft 2", "Weft 3"];
    for (column, head) in heads.into_iter().enumerate() {
        sheet.write(2, column as u16, head).expect("written");
    }
    sheet
        .write(0, 0, "Textile laboratory")
        .expect("written")
        .write(0, 2, "Report 17")
        .expect("written");
    let values = [
        ("Bending", "B", "gf.cm2/cm", [0.112, 0.061]),
        ("Bending", "2HB", "gf.cm/cm", [0.045, 0.030]),
        ("Tensile", "LT", "-", [0.80, 0.78]),
        ("Tensile", "RT", "%", [58.0, 55.0]),
        ("Tensile", "EM", "%", [4.1, 7.9]),
        ("Compression", "T0", "mm", [0.61, 0.0]),
        ("Weight", "W", "g/m2", [213.0, 0.0]),
    ];
    for (row, (test, symbol, unit, means)) in values.into_iter().enumerate() {
        let row = row as u32 + 3;
        for (column, text) in [test, symbol, unit].into_iter().enumerate() {
            sheet.write(row, column as u16, text).expect("written");
        }
        let specimens =
            means.into_iter().flat_map(|mean| [0.97, 1.0, 1.03].map(|part| part * mean));
        for (column, value) in specimens.enumerate().filter(|(_, value)| *value > 0.0) {
            sheet.write(row, column as u16 + 3, value).expect("written");
        }
    }
    let steps = (-80..=80).chain((-80..80).rev());
    let shear: Vec<[f64; 2]> = steps
        .enumerate()
        .map(|(index, step)| {
            let (angle, side) = (0.1 * f64::from(step), if index <= 160 { 0.5 } else { -0.5 });
            [angle, 0.75 * angle + side]
        })
        .collect();
    for (name, factor) in [("Shear warp", 1.0), ("Shear weft", 0.97)] {
        let sheet = book.add_worksheet().set_name(name).expect("a name");
        sheet
            .write(0, 0, "Angle (deg)")
            .expect("written")
            .write(0, 1, "Force (gf/cm)")
            .expect("written");
        for (row, [angle, force]) in shear.iter().enumerate() {
            let row = row as u32 + 1;
            sheet
                .write(row, 0, *angle)
                .expect("written")
                .write(row, 1, factor * force)
                .expect("written");
        }
    }
    book.save_to_buffer().expect("a workbook")
}

#[test]
fn a_workbook_is_fitted_by_a_first_command() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    std::fs::write(folder.join("book.xlsx"), laboratory_book()).expect("written");
    let run = |arguments: &[&str], code: i32| {
        let output =
            drape().current_dir(folder).args(arguments).assert().code(code).get_output().clone();
        let [out, err] =
            [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).expect("text"));
        (out, err)
    };
    let (out, _) = run(&["fit", "book.xlsx", "--report", "page"], 0);
    let words = out.split_whitespace().collect::<Vec<_>>().join(" ");
    for said in [
        "B warp = 0.112 ± 0.00336 gf.cm2/cm: book.xlsx, sheet \"Summary\", line 4: mean of 3 specimens",
        "book.xlsx, shear warp: 321 points; sheet \"Shear warp\"",
        "sheet written to book.sheet.toml",
        "fabric written to book.toml",
        "report written to page/book.html",
    ] {
        assert!(words.contains(said), "{said} is missing in\n{out}");
    }
    // The page shows what was read, and each number its interval.
    let html = std::fs::read_to_string(folder.join("page/book.html")).expect("a page");
    assert!(html.contains("mean of 3 specimens"), "what was read is on the page");
    // What was written is not lost, and its remedy works: the sheet is fitted to the same fabric.
    let (_, err) = run(&["fit", "book.xlsx"], 2);
    assert!(err.contains("drape fit book.sheet.toml, or replace it with --force"), "{err}");
    run(&["fit", "book.xlsx", "--force"], 0);
    let first = std::fs::read_to_string(folder.join("book.toml")).expect("a fabric");
    run(&["fit", "book.sheet.toml", "--force"], 0);
    assert_eq!(std::fs::read_to_string(folder.join("book.toml")).expect("a fabric"), first);
    let (checked, _) = run(&["check", "book.xlsx"], 0);
    assert!(
        checked.contains("drafted, with 12 values") && checked.contains("2 curves"),
        "{checked}"
    );
    // The fabric alone, and the sheet beside it wherever it is.
    let (toml, _) = run(&["fit", "book.xlsx", "-o", "-"], 0);
    assert!(toml.contains("[shear"), "{toml}");
    run(&["fit", "book.xlsx", "-o", "fabrics/cloth.toml"], 0);
    assert!(folder.join("fabrics/cloth.sheet.toml").exists());
    run(&["check", "fabrics/cloth.toml", "fabrics/cloth.sheet.toml"], 0);
}

#[test]
fn a_folder_and_an_archive_are_fitted_and_a_draft_without_numbers_is_answered() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    std::fs::create_dir(folder.join("lab")).expect("a folder");
    std::fs::write(folder.join("lab/values.csv"), "Item,Warp,Weft\nB,0.1,0.08\nW,12,\n")
        .expect("written");
    drape().current_dir(folder).args(["fit", "lab"]).assert().success();
    assert!(folder.join("lab/sheet.toml").exists() && folder.join("lab/fabric.toml").exists());
    // The second time it is the folder of a sheet.
    drape().current_dir(folder).args(["fit", "lab", "--force"]).assert().success();
    let mut archive =
        zip::ZipWriter::new(std::fs::File::create(folder.join("lab.zip")).expect("made"));
    archive.start_file("values.csv", zip::write::SimpleFileOptions::default()).expect("started");
    std::io::Write::write_all(&mut archive, b"Item,Warp,Weft\nB,0.1,0.08\nW,12,\n")
        .expect("written");
    archive.finish().expect("finished");
    drape().current_dir(folder).args(["fit", "lab.zip"]).assert().success();
    let fabrics = ["lab/fabric.toml", "lab.toml"].map(|name| {
        let text = std::fs::read_to_string(folder.join(name)).expect("a fabric");
        text.lines()
            .filter(|line| line.contains("stiffness") || line.contains("rigidity"))
            .collect::<String>()
    });
    assert_eq!(fabrics[0], fabrics[1]);
    let rows: String = (0..40).map(|i| format!("{i},{}\n", i * i)).collect();
    std::fs::write(folder.join("bias 45°.csv"), format!("Strain (%),Force (gf/cm)\n{rows}"))
        .expect("written");
    let output = drape()
        .current_dir(folder)
        .args(["fit", "bias 45°.csv"])
        .assert()
        .code(3)
        .get_output()
        .clone();
    let err = String::from_utf8_lossy(&output.stderr);
    for said in
        ["nothing in the tables can be fitted yet", "on the bias", "drape fit bias-45°.sheet.toml"]
    {
        assert!(err.contains(said), "{said} is missing in\n{err}");
    }
    assert!(folder.join("bias-45°.sheet.toml").exists(), "the sheet to complete");
}
