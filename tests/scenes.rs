//! Shipped scenes, run as a user runs them.

use std::path::Path;

use assert_cmd::Command;
use drape::frames::Recording;
use serde_json::Value;

/// Runs a shipped scene and returns its summary.
fn run(scene: &str, arguments: &[&str], output: &Path) -> Value {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut command = Command::cargo_bin("drape").expect("the binary is built");
    command.arg("run").arg(root.join("scenes").join(scene)).arg("-o").arg(output);
    let result = command.args(arguments).arg("--json").output().expect("it runs");
    let message = String::from_utf8_lossy(&result.stderr);
    assert!(result.status.success(), "{scene}: {message}");
    serde_json::from_slice(&result.stdout).expect("the summary is JSON")
}

fn number(summary: &Value, key: &str) -> f64 {
    let value = key.split('.').fold(summary, |value, part| &value[part]);
    value.as_f64().unwrap_or_else(|| panic!("{key} is {value}"))
}

/// Returns the heights of the cloth's particles, row by row along the warp.
fn heights(output: &Path) -> Vec<f64> {
    let recording = Recording::open(output).expect("a run");
    let last = recording.frame(recording.frame_count() - 1).expect("a frame");
    last.cloth.iter().map(|[_, y, _]| *y).collect()
}

#[test]
fn a_measured_fabric_comes_to_rest_on_a_cube() {
    let folder = tempfile::tempdir().expect("a folder");
    let summary = run("cube.toml", &[], folder.path());
    assert_eq!(summary["status"], "ok");
    assert_eq!(summary["particles"], 51 * 51);
    assert_eq!(summary["settled"], true);
    assert_eq!(summary["contact"]["intersections"], 0);
    assert!(number(&summary, "contact.min_distance") > 1e-3, "half the contact offset is kept");
    assert!(number(&summary, "imbalance") <= 1e-3);
    // A metre of this cloth weighs 1 N/m. Its law reaches that load below 1 % of strain; over the
    // corners of the cube the load of a quarter of the cloth converges.
    let p99 = number(&summary, "strain.traction_p99");
    assert!((1e-4..1e-2).contains(&p99), "99 of 100 segments are strained by less than {p99}");
    assert!(number(&summary, "strain.traction_max") < 0.03);
    // No energy is gained: that of the fall is stored or lost, and every loss is positive.
    let energy = |part: &str| number(&summary, &format!("energy.{part}"));
    for part in ["elastic", "friction_dissipated", "body_dissipated", "numerical_dissipated"] {
        assert!(energy(part) > 0.0, "{part} is {} J", energy(part));
    }
    assert!(energy("kinetic") < 1e-6 * -energy("gravity"), "at rest: {} J", energy("kinetic"));
    let open = energy("remainder").abs() / -energy("gravity");
    assert!(open < 1e-6, "{open:e} of the energy is not accounted for");

    // Four corners hang, each below the middle of its sides; the fabric is anisotropic, so the
    // corners agree with their opposites better than with their neighbours.
    let heights = heights(folder.path());
    let at = |column: usize, row: usize| heights[51 * row + column];
    let corners = [at(0, 0), at(50, 0), at(50, 50), at(0, 50)];
    let sides = [at(25, 0), at(50, 25), at(25, 50), at(0, 25)];
    for corner in corners {
        for side in sides {
            assert!(corner < side - 0.05, "corners {corners:?} hang below sides {sides:?}");
        }
    }
    let spread = corners.iter().fold(0.0, |s: f64, c| s.max((c - corners[0]).abs()));
    assert!(spread < 0.02, "the corners hang alike: {corners:?}");
    assert!((at(25, 25) - 0.502).abs() < 2e-3, "the middle lies on the cube: {}", at(25, 25));
}

#[test]
fn the_same_scene_gives_the_same_bits_for_any_number_of_threads() {
    let hashes: Vec<String> = ["1", "2", "4"]
        .iter()
        .map(|threads| {
            let folder = tempfile::tempdir().expect("a folder");
            let summary =
                run("curtain.toml", &["--threads", threads, "--until", "0.1"], folder.path());
            summary["state_hash"].as_str().expect("a hash").to_owned()
        })
        .collect();
    assert_eq!(hashes[0], hashes[1]);
    assert_eq!(hashes[0], hashes[2]);
}

#[test]
fn breens_particles_come_to_rest_on_a_cube_and_keep_apart() {
    let folder = tempfile::tempdir().expect("a folder");
    let summary = run("cube-cotton-breen.toml", &[], folder.path());
    assert_eq!(summary["settled"], true);
    assert_eq!(summary["contact"]["intersections"], 0);
    assert_eq!(number(&summary, "energy.friction_dissipated"), 0.0);
    let open = number(&summary, "energy.remainder").abs() / -number(&summary, "energy.gravity");
    assert!(open < 1e-6, "{open:e} of the energy is not accounted for");
    // The weight of a metre stretches the yarns by 1 % and compresses none by as much; a quarter of
    // the cloth hangs from the corners.
    let most = number(&summary, "strain.traction_max");
    assert!((0.01..0.02).contains(&most), "the longest segment is strained by {most}");
    let heights = heights(folder.path());
    let at = |column: usize, row: usize| heights[51 * row + column];
    let corners = [at(0, 0), at(50, 0), at(50, 50), at(0, 50)];
    let spread = corners.iter().fold(0.0, |s: f64, c| s.max((c - corners[0]).abs()));
    assert!(spread < 0.01, "the corners hang alike: {corners:?}");
}

#[test]
fn a_run_that_does_not_settle_says_so_and_keeps_its_results() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut command = Command::cargo_bin("drape").expect("the binary is built");
    command.arg("run").arg(root.join("scenes/cube.toml")).arg("-o").arg(folder.path());
    let result = command.args(["--until", "0.1", "--force"]).output().expect("it runs");
    assert_eq!(result.status.code(), Some(5));
    let message = String::from_utf8_lossy(&result.stderr);
    assert!(message.contains("did not come to rest"), "{message}");
    let summary = std::fs::read(folder.path().join("summary.json")).expect("was written");
    let summary: Value = serde_json::from_slice(&summary).expect("JSON");
    assert_eq!(summary["status"], "did not settle");
    assert!(folder.path().join("picture.png").exists());
}
