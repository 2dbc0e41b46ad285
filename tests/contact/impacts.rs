//! Impacts: bodies and edges that move into held cloth at 1 to 20 m/s.

use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;

/// Length of a step, in s, in which a body at 20 m/s moves by ten spacings of 10 mm.
const STEP: f64 = 0.005;

/// What moves.
#[derive(Debug, Clone, Copy)]
enum Kind {
    /// Ball into the middle of the sheet.
    Ball,
    /// Flat box into the middle of the sheet.
    Plate,
    /// Cylinder that is pressed into the sheet and turns; the speed is that of its surface.
    Drum,
    /// Pinned edge that moves below the rest of the sheet.
    Edge,
}

/// Impact on a sheet of 25 cm that is held at two edges.
#[derive(Debug, Clone, Copy)]
struct Impact {
    kind: Kind,
    /// Speed, in m/s; 0 leaves everything at rest.
    speed: f64,
    /// Spacing of the sheet, in m.
    spacing: f64,
}

impl Impact {
    /// Scene of the impact.
    fn scene(self) -> String {
        let Self { kind, speed, spacing } = self;
        let (turn, moving, seconds) = match kind {
            Kind::Ball => {
                let body = "[[collider.sphere]]\nradius = 0.04\ncenter = [0, 0, -0.06]\n";
                let [motion, end] = rise(speed, 0.08);
                (0, format!("{body}[collider.sphere.motion]\n{motion}"), end)
            }
            Kind::Plate => {
                let body = "[[collider.box]]\nsize = [0.1, 0.1, 0.02]\nedge_radius = 0.002\n\
                            center = [0, 0, -0.03]\n";
                let [motion, end] = rise(speed, 0.06);
                (0, format!("{body}[collider.box.motion]\n{motion}"), end)
            }
            Kind::Drum => {
                let body = "[[collider.cylinder]]\nradius = 0.05\nheight = 0.15\n\
                            center = [0, 0, -0.0515]\nfriction = 0.3\n";
                let angle = (speed * 0.03 / 0.05_f64).to_degrees();
                let motion = format!(
                    "times = [0, 0.03]\nshift = [[0, 0, 0], [0, 0, 0.01]]\n\
                     turn = [[0, 0, 0], [0, {angle}, 0]]\n"
                );
                (0, format!("{body}[collider.cylinder.motion]\n{motion}"), "0.035".into())
            }
            Kind::Edge => {
                let [middle, end] = [0.05 / speed, 0.3 / speed];
                let motion = format!(
                    "times = [0, {middle}, {end}]\n\
                     shift = [[0, 0, 0], [-0.03, 0.04, 0], [-0.2, -0.12, 0]]\n"
                );
                (-90, format!("[pin.motion]\n{motion}"), format!("{}", end + STEP))
            }
        };
        let (moving, seconds) = match speed > 0.0 {
            true => (moving, seconds),
            false => (String::new(), "0.25".into()),
        };
        format!(
            "spacing = {spacing}\nfabric.plain.file = \"plain.toml\"\n\
             [[panel]]\nname = \"sheet\"\nfabric = \"plain\"\nrectangle = [0.25, 0.25]\n\
             turn = [{turn}, 0, 0]\n\
             [[pin]]\npanel = \"sheet\"\nedge = \"left\"\n\
             [[pin]]\npanel = \"sheet\"\nedge = \"right\"\n{moving}\
             [time]\nstep = {STEP}\nend = {seconds}\n"
        )
    }

    /// Runs the impact and returns its summary. Its surfaces never intersect, as a program finds
    /// that shares no code with the run.
    fn run(self) -> Value {
        let folder = tempfile::tempdir().expect("a folder");
        let (scene, output) = (folder.path().join("scene.toml"), folder.path().join("out"));
        std::fs::write(&scene, self.scene()).expect("written");
        write_fabric(folder.path());
        let mut command = drape();
        command.arg("run").arg(&scene).arg("-o").arg(&output).args(["--json", "--threads", "1"]);
        let result = command.output().expect("it runs");
        let said = String::from_utf8_lossy(&result.stderr);
        assert!(result.status.success(), "{self:?}: {said}");
        let summary: Value = serde_json::from_slice(&result.stdout).expect("a summary");
        assert_eq!(summary["contact"]["crossings_found"], 0, "{self:?}");
        let checked = drape().arg("check").arg(&output).output().expect("it runs");
        assert!(checked.status.success(), "{self:?}: {}", String::from_utf8_lossy(&checked.stderr));
        summary
    }
}

fn drape() -> Command {
    Command::cargo_bin("drape").expect("the binary is built")
}

fn write_fabric(folder: &Path) {
    let fabric = include_str!("../fabrics/plain-weave.toml");
    std::fs::write(folder.join("plain.toml"), fabric).expect("written");
}

/// Keys of a motion upwards by a length, in m, at a speed, in m/s, and the end of its scene, in s.
fn rise(speed: f64, length: f64) -> [String; 2] {
    let seconds = length / speed;
    let motion = format!("times = [0, {seconds}]\nshift = [[0, 0, 0], [0, 0, {length}]]\n");
    [motion, format!("{}", seconds + STEP)]
}

/// CPU time of a sub-step, in s.
fn seconds_of_sub_step(summary: &Value) -> f64 {
    let count = summary["solver"]["sub_steps"].as_f64().expect("a count");
    summary["cpu_seconds"].as_f64().expect("seconds") / count
}

#[test]
fn cloth_stands_fast_impacts() {
    for kind in [Kind::Ball, Kind::Plate, Kind::Drum, Kind::Edge] {
        let summary = Impact { kind, speed: 10.0, spacing: 0.02 }.run();
        let counts = ["steps", "sub_steps"]
            .map(|key| summary[key].as_u64().or(summary["solver"][key].as_u64()).expect("a count"));
        // 50 mm in a step are sub-steps of 20 mm at most.
        assert!(counts[1] >= 3 * (counts[0] - 1), "{kind:?}: {summary}");
    }
}

#[test]
fn a_contact_that_is_stiffened_is_said() {
    let folder = tempfile::tempdir().expect("a folder");
    write_fabric(folder.path());
    let scene = folder.path().join("scene.toml");
    for (speed, said) in [(0.01, false), (20.0, true)] {
        let impact = Impact { kind: Kind::Ball, speed, spacing: 0.02 };
        std::fs::write(&scene, impact.scene()).expect("written");
        let checked = drape().arg("check").arg(&scene).output().expect("it runs");
        assert!(checked.status.success());
        let text =
            String::from_utf8_lossy(&checked.stdout) + String::from_utf8_lossy(&checked.stderr);
        assert_eq!(text.contains("to stop what moves at 20 m/s"), said, "{text}");
    }
}

/// Prints a row of the table; returns the cost of a sub-step over that of a quiet one, in s.
fn print_row(kind: Kind, speed: f64, summary: &Value, quiet: f64) -> f64 {
    let cost = seconds_of_sub_step(summary) / quiet;
    let solver = &summary["solver"];
    println!(
        "{kind:?} {speed} m/s: {} s in {} sub-steps of {} iterations, {} tangents, {} iterations of CG in all, \
         {} rejected, {} CPU s, a sub-step {cost:.1} times a quiet one, nearest {} m",
        summary["simulated_seconds"],
        solver["sub_steps"],
        solver["iterations_mean"],
        solver["tangents"],
        solver["linear_iterations"],
        solver["rejected_steps"],
        summary["cpu_seconds"],
        summary["contact"]["min_distance"]
    );
    cost
}

/// Prints a table of twenty impacts, and of the same scenes at rest. Takes minutes of a processor.
#[test]
#[ignore = "takes minutes"]
fn twenty_impacts() {
    let mut costs = Vec::new();
    for kind in [Kind::Ball, Kind::Plate, Kind::Drum, Kind::Edge] {
        let at_rest = Impact { kind, speed: 0.0, spacing: 0.01 }.run();
        let quiet = seconds_of_sub_step(&at_rest);
        print_row(kind, 0.0, &at_rest, quiet);
        for speed in [1.0, 3.0, 5.0, 10.0, 20.0] {
            let summary = Impact { kind, speed, spacing: 0.01 }.run();
            costs.push(print_row(kind, speed, &summary, quiet));
        }
    }
    assert_eq!(costs.len(), 20);
}
