//! Fabrics for other programs.

use std::path::Path;

use crate::drape;

const WOOL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/fabrics/matsudaira-b");

/// Executes `drape fabric export` of a wool; returns what it prints, and what it says on failure.
fn export(arguments: &[&str]) -> Result<String, String> {
    let output = drape(Path::new("."), &[&["fabric", "export", WOOL], arguments].concat());
    let [stdout, stderr] =
        [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("UTF-8"));
    if output.status.success() { Ok(stdout) } else { Err(stderr) }
}

#[test]
fn a_fabric_is_written_for_other_programs_by_name_or_by_ending() {
    let folder = tempfile::tempdir().expect("a folder");
    for (format, ending) in
        [("blender", "py"), ("ppf", "toml"), ("browzwear", "csv"), ("u3m", "U3M")]
    {
        let printed = export(&["--format", format]).expect("a text");
        let path = folder.path().join("wool").with_extension(ending);
        let path = path.to_str().expect("UTF-8");
        let said = export(&["-o", path]).expect("a file");
        assert!(said.contains("what its numbers lose:\n  Friction and hysteresis"), "{said}");
        assert_eq!(std::fs::read_to_string(path).expect("a file").trim_end(), printed.trim_end());
    }
    let archive = folder.path().join("wool.u3ma");
    export(&["-o", archive.to_str().expect("UTF-8"), "--quiet"]).expect("an archive");
    assert!(std::fs::read(archive).expect("a file").starts_with(b"PK\x03\x04"));
}

#[test]
fn arguments_that_do_not_fit_are_refused_with_a_remedy_that_works() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let refused = |arguments: &[&str], words: &str| {
        let message = export(arguments).expect_err("refused");
        assert!(message.contains(words), "{message}");
    };
    refused(&[], "name the program: --format blender");
    refused(
        &["-o", &at("wool.blend")],
        "wool.blend: the ending names no format; give --format blender",
    );
    assert!(export(&["-o", &at("wool.blend"), "--format", "blender"]).is_ok());
    refused(&["-o", &at("wool.blend"), "--format", "blender"], "replace it with --force");
    assert!(export(&["-o", &at("wool.blend"), "--format", "blender", "--force"]).is_ok());
    refused(&["--format", "u3ma"], "a U3M archive is no text; give a file with -o");
    refused(
        &["--format", "ppf", "--load", "0"],
        "--load: a stiffness cannot be read at a load of 0 N/m",
    );
    assert!(export(&["--format", "ppf", "--load", "0.1"]).is_ok());
    assert!(!Path::new(&at("wool.part")).exists());
}

#[test]
fn a_load_changes_the_stretch_that_is_read() {
    let stretch = |load: &str| {
        let table = export(&["--format", "browzwear", "--load", load]).expect("a table");
        let row = table
            .lines()
            .find(|line| line.starts_with("Stretch,length"))
            .expect("a row")
            .to_owned();
        row.split(',').nth(2).expect("a value").parse::<f64>().expect("a number")
    };
    assert!(stretch("5") < stretch("100"), "{} {}", stretch("5"), stretch("100"));
}
