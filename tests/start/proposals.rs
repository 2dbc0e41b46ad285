//! Places of garments that are proposed: tried by a short sewing before they are printed.

use std::path::Path;
use std::time::{Duration, Instant};

use assert_cmd::Command;
use tempfile::TempDir;

const FABRIC: &str = include_str!("../fabrics/plain-weave.toml");

/// A tunnel of two panels about a column of 120 mm across, with sides of some length.
const TUNNEL: &str = r#"length = "mm"
[panel.front]
grain = 0
start = [-110, 0]
outline = [
    { name = "hem", to = [110, 0] },
    { name = "left", to = [110, 200] },
    { name = "top", to = [-110, 200] },
    { name = "right", to = [-110, 0] },
]
origin = [0, 600, 90]
[panel.back]
grain = 0
start = [-110, 0]
outline = [
    { name = "hem", to = [110, 0] },
    { name = "left", to = [110, 200] },
    { name = "top", to = [-110, 200] },
    { name = "right", to = [-110, 0] },
]
origin = [0, 600, -90]
[seam.left]
sides = [["front.left"], ["back.left"]]
reversed = true
[seam.right]
sides = [["front.right"], ["back.right"]]
reversed = true
"#;

/// Writes the tunnel, HALF of whose width is replaced, at a centre beside its column.
fn folder(half: &str, center: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: String| {
        std::fs::write(folder.path().join(name), text).expect("writes");
    };
    write("plain.toml", FABRIC.into());
    write("tunnel.toml", TUNNEL.replace("110", half));
    write(
        "scene.toml",
        format!(
            "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n[[garment]]\npattern = \"tunnel.toml\"\n\
             fabric = \"plain\"\n{center}\n[[collider.cylinder]]\nradius = 0.06\nheight = 1.5\n\
             center = [0, 0.75, 0]\n[contact]\noffset = 0.003\n[time]\nstep = 0.005\nend = 1\n[settle]\n"
        ),
    );
    folder
}

fn drape(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::cargo_bin("drape").expect("the binary is built");
    let output = command.current_dir(folder).args(arguments).output().expect("runs");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn a_place_at_which_the_garment_is_sewn_is_proposed_and_holds() {
    let beside = folder("110", "center = [0.5, 0, 0.1]");
    for command in ["check", "run"] {
        let (code, said) = drape(beside.path(), &[command, "scene.toml"]);
        assert_eq!(code, Some(3), "{said}");
        assert!(said.contains("and a short sewing at 30 mm closes its seams"), "{said}");
        let center = said.split("write ").nth(1).and_then(|rest| rest.split(" in its").next());
        let there = folder("110", center.expect("a centre"));
        let (code, said) = drape(there.path(), &["check", "scene.toml"]);
        assert_eq!(code, Some(0), "{said}");
    }
    let (code, said) = drape(beside.path(), &["check", "scene.toml", "--quick"]);
    assert_eq!(code, Some(3), "{said}");
    assert!(!said.contains("write center") && said.contains("without --quick"), "{said}");
}

#[test]
fn a_place_at_which_the_sewing_fails_is_not_proposed() {
    // It goes round the column only if it is stretched by a third.
    let narrow = folder("72", "center = [0.5, 0, 0.1]");
    let begin = Instant::now();
    let mut command = Command::cargo_bin("drape").expect("the binary is built");
    let output = command
        .current_dir(narrow.path())
        .args(["check", "scene.toml", "--json"])
        .output()
        .expect("runs");
    assert!(begin.elapsed() < Duration::from_secs(30), "{:?}", begin.elapsed());
    assert_eq!(output.status.code(), Some(3));
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let mistake = &found[0]["mistakes"][0];
    let help = mistake["help"].as_str().expect("a remedy");
    assert!(!help.contains("write center"), "{help}");
    assert_eq!(mistake["edits"], serde_json::json!([]), "{help}");
}
