//! Scenes whose panels are coarser where an earlier run was flat.

use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::drape;

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A sheet that hangs over a rail, with its fabric beside it.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let fabric = Path::new(env!("CARGO_MANIFEST_DIR")).join("fabrics/matsudaira-b/sheet.toml");
    std::fs::copy(fabric, folder.path().join("wool.toml")).expect("a sheet");
    let scene = r#"
name = "rail"
spacing = "5 mm"
[fabric.wool]
file = "wool.toml"
[[panel]]
name = "sheet"
fabric = "wool"
rectangle = [0.4, 0.2]
turn = [-90, 0, 0]
[[collider.cylinder]]
name = "rail"
radius = 0.01
height = 0.4
center = [0, -0.012, 0]
turn = [90, 0, 0]
[contact]
surfaces = false
[time]
step = 0.005
end = 0.15
[output]
every = 0.05
"#;
    std::fs::write(folder.path().join("rail.toml"), scene).expect("a scene");
    folder
}

fn summary(folder: &Path, run: &str) -> Value {
    let text = std::fs::read_to_string(folder.join(run).join("summary.json")).expect("a summary");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn a_panel_is_coarser_where_an_earlier_run_was_flat_and_the_remedies_work() {
    let own = folder();
    let at = own.path();
    let grading = ["--set", "grading.run=\"coarse\""];
    // No run yet: the message names the command that makes it.
    let graded = |out: &str, more: &[&str]| {
        let all = ["run", "rail.toml", "-q", "--no-picture", "-o", out];
        drape(at, &[&all, &grading[..], more].concat())
    };
    let refused = graded("fine", &[]);
    let message = text(&refused.stderr);
    assert_eq!(refused.status.code(), Some(3), "{message}");
    assert!(message.contains("grading.run") && message.contains("--set spacing="), "{message}");
    let coarse = drape(
        at,
        &["run", "rail.toml", "--set", "spacing=\"10 mm\"", "-o", "coarse", "-q", "--no-picture"],
    );
    assert!(coarse.status.success(), "{}", text(&coarse.stderr));

    let run = graded("fine", &["--threads", "1", "--state-hash"]);
    assert!(run.status.success(), "{}", text(&run.stderr));
    let fine = summary(at, "fine");
    let particles = fine["particles"].as_u64().expect("a number");
    assert!((600..2000).contains(&particles), "{particles} of 3321 particles");
    for threads in ["2", "3"] {
        let again = graded("again", &["--threads", threads, "--state-hash", "--force"]);
        assert!(again.status.success(), "{}", text(&again.stderr));
        assert_eq!(summary(at, "again")["step_hashes"], fine["step_hashes"], "{threads} threads");
    }
    let checked = drape(at, &[&["check", "rail.toml"], &grading[..]].concat());
    let told = text(&checked.stdout);
    assert!(told.contains("where it is flat up to 0.02000"), "{told}");

    // Its own folder, a panel that the run does not have, an angle out of range.
    let own_folder = graded("coarse", &["--force"]);
    assert_eq!(own_folder.status.code(), Some(2), "{}", text(&own_folder.stderr));
    assert!(text(&own_folder.stderr).contains("another folder"));
    assert!(at.join("coarse/summary.json").exists(), "the run is kept");
    let other = graded("fine", &["--set", "panel.0.name=\"other\"", "--force"]);
    assert!(text(&other.stderr).contains("no panel \"other\""), "{}", text(&other.stderr));
    let breen = graded("fine", &["--set", "model=\"breen-1994\"", "--force"]);
    assert!(text(&breen.stderr).contains("leave [grading] out"), "{}", text(&breen.stderr));
    // Beside a fold, here one across the flat end of the sheet, particles are as near as elsewhere
    // without grading.
    let fold = "panel.0.fold=[{ from = [0.02, 0], to = [0.02, 0.2], angle = 90 }]";
    let folded = graded("folded", &["--set", fold]);
    assert!(folded.status.success(), "{}", text(&folded.stderr));
    let count = summary(at, "folded")["particles"].as_u64().expect("a number");
    assert!(count > particles, "{count} particles, {particles} without a fold");
    let wide = graded("fine", &["--set", "grading.angle=100", "--force"]);
    assert!(text(&wide.stderr).contains("between 0.1 and 90"), "{}", text(&wide.stderr));
}
