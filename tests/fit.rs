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
    command.args(["--bending", "breen-1994"]).assert().success();
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
    for said in
        ["[Read] - tensile.csv:", "taken: ", "compared: ", "AICc", "at most 6 above the best"]
    {
        assert!(words.contains(said), "{said} is missing in\n{text}");
    }
}
