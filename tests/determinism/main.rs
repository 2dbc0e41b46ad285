//! Determinism: nine runs give the hashes of `golden.txt` after every step, in optimised builds in
//! one, two and three threads, in builds with overflow checks in two.
//!
//! A change of the physics or of the order of a sum changes the hashes: `DETERMINISM=write cargo
//! test --release --test determinism` writes them anew, and the change goes with them into one
//! commit. `crates/SIMD.md` says what differs by processor. Another processor or build is checked
//! with the command that runs its program: `DRAPE="qemu-x86_64 -cpu Nehalem target/release/drape"
//! cargo test --release --test determinism`.

#![allow(clippy::unwrap_used)]

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

/// Run of a shipped scene, made smaller.
struct Case {
    name: &'static str,
    scene: &'static str,
    /// Texts of the scene and what stands in their place.
    changes: &'static [[&'static str; 2]],
    /// End of the run, in s.
    until: f64,
}

const CASES: [Case; 9] = [
    Case {
        name: "friction",
        scene: "slope.toml",
        changes: &[["friction = 0.501", "friction = 0.3"]],
        until: 0.2,
    },
    Case { name: "sewing", scene: "seam-strip.toml", changes: &[], until: 1.8 },
    Case {
        name: "bdf2-onto-a-ball",
        scene: "sphere.toml",
        changes: &[["spacing = 0.02", "spacing = 0.05"], ["[settle]", ""], ["0.605", "0.603"]],
        until: 0.3,
    },
    Case {
        name: "moving-bodies",
        scene: "pinch.toml",
        changes: &[["spacing = 0.01", "spacing = 0.02"]],
        until: 0.45,
    },
    Case {
        name: "bending-hysteresis",
        scene: "twist.toml",
        changes: &[["spacing = 0.01", "spacing = 0.02"], ["[0, 5]", "[0, 1]"]],
        until: 0.2,
    },
    Case {
        name: "breen-to-rest",
        scene: "cube-wool-breen.toml",
        changes: &[["spacing = 0.02", "spacing = 0.05"]],
        until: 0.6,
    },
    Case {
        name: "chosen-error",
        scene: "accordion.toml",
        changes: &[
            ["spacing = 0.005", "spacing = 0.0125"],
            ["step = 0.005", "step = 0.005\nerror = 1e-4"],
        ],
        until: 0.15,
    },
    Case {
        name: "newton",
        scene: "swing-vacuum.toml",
        changes: &[["[time]", "[solver]\nmethod = \"newton\"\n[time]"]],
        until: 0.08,
    },
    Case {
        name: "stack",
        scene: "stack.toml",
        changes: &[["spacing = 0.0125", "spacing = 0.03"]],
        until: 0.15,
    },
];

/// Numbers of threads; without optimisation each run takes ten times as long.
const THREADS: &[usize] = if cfg!(debug_assertions) { &[2] } else { &[1, 2, 3] };

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn golden_file() -> PathBuf {
    root().join("tests/determinism/golden.txt")
}

/// Command that runs the program.
fn program() -> Command {
    let given = std::env::var("DRAPE").unwrap_or_default();
    let mut words = given.split_whitespace();
    let mut command = Command::new(words.next().unwrap_or(env!("CARGO_BIN_EXE_drape")));
    command.args(words).current_dir(root());
    command
}

impl Case {
    /// Writes the scene to a folder.
    fn write(&self, folder: &Path) -> PathBuf {
        let mut text = std::fs::read_to_string(root().join("scenes").join(self.scene)).unwrap();
        for [from, to] in self.changes {
            assert!(text.contains(from), "{}: {from} is not in {}", self.name, self.scene);
            text = text.replace(from, to);
        }
        for (from, to) in [("\"../", ""), ("\"patterns/", "scenes/patterns/")] {
            text = text.replace(from, &format!("\"{}/{to}", root().display()));
        }
        let scene = folder.join(format!("{}.toml", self.name));
        std::fs::write(&scene, text).unwrap();
        scene
    }

    /// Hashes after the steps of a run in so many threads.
    fn hashes(&self, threads: usize) -> Vec<String> {
        let folder = TempDir::new().unwrap();
        let scene = self.write(folder.path());
        let mut command = program();
        command.arg("run").arg(scene).arg("-o").arg(folder.path().join("out"));
        command.arg("--allow-path").arg(root()).args([
            "--state-hash",
            "--json",
            "--no-picture",
            "-q",
        ]);
        command.args(["--threads", &threads.to_string(), "--until", &self.until.to_string()]);
        let output = command.output().unwrap();
        let name = self.name;
        let message = String::from_utf8_lossy(&output.stderr);
        let summary: Value =
            serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{name}: {message}"));
        // One that asks for rest has no time for it.
        let status = summary["status"].as_str().unwrap();
        assert!(matches!(status, "ok" | "did not settle"), "{name}: {status}: {message}");
        assert_eq!(summary["step_hashes"]["every"], 1, "{name}");
        let hashes = summary["step_hashes"]["hashes"].as_array().unwrap();
        hashes.iter().map(|hash| hash.as_str().unwrap().to_owned()).collect()
    }
}

/// Golden hashes of a case.
fn golden(name: &str) -> Vec<String> {
    let text = std::fs::read_to_string(golden_file()).unwrap();
    let mut lines = text.lines().map(|line| line.split_whitespace());
    let own = lines.find_map(|mut line| (line.next() == Some(name)).then_some(line));
    own.unwrap_or_else(|| panic!("no {name} in golden.txt")).map(str::to_owned).collect()
}

#[test]
fn nine_runs_give_the_golden_hashes_for_any_number_of_threads() {
    if std::env::var("DETERMINISM").is_ok_and(|word| word == "write") {
        let mut text = String::new();
        for case in &CASES {
            writeln!(text, "{} {}", case.name, case.hashes(1).join(" ")).unwrap();
        }
        std::fs::write(golden_file(), text).unwrap();
    }
    let mut differ = Vec::new();
    for case in &CASES {
        let expected = golden(case.name);
        assert!(expected.len() >= 10, "{} has {} steps", case.name, expected.len());
        for &threads in THREADS {
            let found = case.hashes(threads);
            let first = expected.iter().zip(&found).position(|(a, b)| a != b);
            if let Some(step) = first {
                differ.push(format!("{}, {threads} threads: from step {}", case.name, step + 1));
            } else if expected.len() != found.len() {
                let [golden, own] = [expected.len(), found.len()];
                differ.push(format!("{}, {threads} threads: {own} steps, not {golden}", case.name));
            }
        }
    }
    assert!(differ.is_empty(), "runs differ from golden.txt: {differ:#?}");
}
