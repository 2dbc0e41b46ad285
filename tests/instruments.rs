//! `drape test`: fabrics in simulated instruments.

use std::path::{Path, PathBuf};

use assert_cmd::Command;

fn drape() -> Command {
    Command::cargo_bin("drape").expect("it is built")
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn json(command: &mut Command) -> serde_json::Value {
    let output = command.arg("--json").assert().success().get_output().stdout.clone();
    serde_json::from_slice(&output).expect("JSON")
}

#[test]
fn a_sheet_is_fitted_and_tested_and_a_page_is_left() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = drape();
    command.arg("test").arg(root().join("fabrics/tagawa-2003")).args(["--spacing", "10"]);
    let rows = json(command.arg("--report").arg(folder.path()));
    let rows = rows.as_array().expect("a list");
    assert_eq!(rows.len(), 6, "three tests, two directions");
    for row in rows {
        assert!(row["distance"].as_f64().expect("a number") < 0.02, "{row}");
    }
    let page = std::fs::read_to_string(folder.path().join("tagawa-2003-tested.html"));
    let page = page.expect("a page");
    assert!(page.contains("Simulated specimens") && page.matches("<svg").count() >= 3);
}

#[test]
fn a_drape_has_a_coefficient_and_nodes() {
    let mut command = drape();
    command.arg("test").arg(root().join("fabrics/matsudaira-a"));
    command.args(["--drape", "--starts", "2", "--spacing", "12"]);
    let page = json(&mut command);
    let evaluations = page["evaluations"].as_array().expect("a list");
    let of = |k: usize| evaluations[k]["coefficient"].as_f64().expect("a number");
    // With friction, without, and both ends of the three parameters that the sheet leaves open.
    assert_eq!(evaluations.len(), 8);
    assert!(of(1) < of(0), "{evaluations:?}");
    // The limp end of each, then the stiff one.
    assert!(of(2) < of(3) && of(4) < of(5) && of(6) < of(7), "{evaluations:?}");
    assert!((0..8).all(|k| of(k) > 0.2 && of(k) < 1.0));
}

#[test]
fn arguments_that_cannot_be_tested_are_refused() {
    let sheet = root().join("fabrics/matsudaira-a");
    drape().arg("test").arg(&sheet).args(["--spacing", "0.1"]).assert().code(2);
    drape().arg("test").arg(&sheet).args(["--starts", "3"]).assert().code(2);
    drape().arg("test").arg(&sheet).args(["--drape", "--starts", "1"]).assert().code(2);
    drape().arg("test").arg("no-such-fabric.toml").assert().code(3);
}

/// Finds the numbers of two tables that differ by more than a part in a million, by key.
fn differences(key: &str, a: &toml::Value, b: &toml::Value, found: &mut Vec<String>) {
    match (a, b) {
        (toml::Value::Table(a), toml::Value::Table(b)) if a.keys().eq(b.keys()) => {
            a.iter()
                .for_each(|(name, a)| differences(&format!("{key}.{name}"), a, &b[name], found));
        }
        (toml::Value::Array(a), toml::Value::Array(b)) if a.len() == b.len() => {
            a.iter().zip(b).for_each(|(a, b)| differences(key, a, b, found));
        }
        (toml::Value::Float(a), toml::Value::Float(b)) if (a - b).abs() <= 1e-6 * b.abs() => {}
        _ if a == b => {}
        _ => found.push(format!("{key}: {a} and {b}")),
    }
}

#[test]
fn the_fabrics_of_the_validation_are_those_of_the_sheets() {
    let folder = tempfile::tempdir().expect("a folder");
    let kept = root().join("crates/drape-validate/fabrics");
    let files: Vec<PathBuf> =
        std::fs::read_dir(&kept).expect("a folder").map(|e| e.expect("an entry").path()).collect();
    assert_eq!(files.len(), 6);
    for file in files {
        let name = file.file_stem().expect("a name").to_string_lossy().into_owned();
        let fitted = folder.path().join(format!("{name}.toml"));
        let sheet = root().join("fabrics").join(&name);
        drape().arg("fit").arg(sheet).arg("-o").arg(&fitted).assert().success();
        let read = |path: &Path| -> toml::Value {
            toml::from_str(&std::fs::read_to_string(path).expect("a file")).expect("TOML")
        };
        let mut found = Vec::new();
        let (mut kept, mut fitted) = (read(&file), read(&fitted));
        for fabric in [&mut kept, &mut fitted] {
            // Standard errors and correlations are not used, and change more than the numbers
            // themselves.
            let provenance = fabric["provenance"].as_table_mut().expect("a table");
            provenance.remove("standard_errors");
            provenance.remove("correlations");
        }
        differences(&name, &kept, &fitted, &mut found);
        assert!(found.is_empty(), "run `drape fit` again for {found:?}");
    }
}
