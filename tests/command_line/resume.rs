//! Runs that are killed, interrupted or limited, and go on: they end in the bytes that they would
//! have had.

#![cfg(unix)]
#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use drape::dynamics::Step;
use drape::input::Document;
use drape::run::{FolderRun, RunOptions, RunRequest, Watcher, end_at};

use serde_json::Value;

use crate::signals;

/// Files that differ from run to run: times, the lock, what was asked for, states on the way.
const OWN: [&str; 4] = ["run.lock", "run.json", "status.json", "view.html"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_drape"));
    command.current_dir(root()).args(arguments).args(["--threads", "1", "-q"]);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

fn ran(arguments: &[&str], code: i32) -> String {
    let Output { status, stderr, .. } = command(arguments).output().unwrap();
    let message = String::from_utf8_lossy(&stderr).into_owned();
    assert_eq!(status.code(), Some(code), "{arguments:?}: {message}");
    message
}

/// Scene whose run is killed, with the end at which it is cut.
struct Case {
    scene: &'static str,
    until: &'static str,
}

const CASES: [Case; 4] = [
    Case { scene: "scenes/cube.toml", until: "0.5" },
    Case { scene: "scenes/tshirt.toml", until: "0.1" },
    Case { scene: "scenes/stack.toml", until: "0.05" },
    Case { scene: "scenes/skirt-turn.toml", until: "0.3" },
];

impl Case {
    fn begin(&self, out: &Path, every: &str) -> Child {
        let out = out.to_str().unwrap();
        let arguments = ["run", self.scene, "--until", self.until, "-o", out, "--no-picture"];
        let mut command = command(&arguments);
        command.args(["--checkpoint-every", every]);
        let mut hearing = signals::hearing(&command);
        hearing.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
        hearing.spawn().unwrap()
    }
}

/// Contents of the files of a run, of its summary without the times.
fn results(out: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in std::fs::read_dir(out).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if OWN.contains(&&name[..]) || name.starts_with("checkpoint-") {
            continue;
        }
        let mut bytes = std::fs::read(&path).unwrap();
        if name == "summary.json" {
            let mut summary: Value = serde_json::from_slice(&bytes).unwrap();
            summary["wall_seconds"] = 0.into();
            summary["cpu_seconds"] = 0.into();
            bytes = summary.to_string().into_bytes();
        }
        files.insert(name.into(), bytes);
    }
    assert!(files.len() > 4);
    files
}

/// Goes on until a run has ended, whatever its outcome.
fn resume_to_the_end(out: &Path) {
    let resumed = command(&["resume", out.to_str().unwrap(), "--no-picture"]).output().unwrap();
    let message = String::from_utf8_lossy(&resumed.stderr);
    let is_over = message.contains("has ended");
    assert!(matches!(resumed.status.code(), Some(0 | 5)) || is_over, "{message}");
}

/// Numbers that look random, the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Kills runs of a scene so many times at random moments, a third of them while a checkpoint is
/// written, goes on each time, and compares the results. Returns the number of kills that met a
/// run.
fn kills(case: &Case, times: usize, random: &mut Random) -> usize {
    let folder = tempfile::tempdir().unwrap();
    let whole = folder.path().join("whole");
    let begin = Instant::now();
    let _ = case.begin(&whole, "1000").wait_with_output().unwrap();
    let length = begin.elapsed();
    let expected = results(&whole);
    let mut met = 0;
    while met < times {
        let out = folder.path().join(format!("killed-{met}"));
        // One that ended before it was killed begins anew.
        let _ = std::fs::remove_dir_all(&out);
        // Every step has a checkpoint, so that many kills come while one is written.
        let mut child = case.begin(&out, if met % 3 == 0 { "0" } else { "0.05" });
        std::thread::sleep(length.mul_f64(0.02 + 0.93 * random.next()));
        if met % 3 == 0 {
            let deadline = Instant::now() + Duration::from_secs(2);
            while !out.join("checkpoint.part").exists() && Instant::now() < deadline {}
        }
        signals::send(child.id(), "-KILL");
        if child.wait().unwrap().code().is_some() {
            continue;
        }
        if !out.join("run.json").exists() {
            continue;
        }
        met += 1;
        resume_to_the_end(&out);
        let found = results(&out);
        let differ: Vec<_> =
            expected.keys().filter(|name| expected.get(*name) != found.get(*name)).collect();
        assert!(differ.is_empty() && expected.len() == found.len(), "{}: {differ:?}", case.scene);
        std::fs::remove_dir_all(&out).unwrap();
    }
    met
}

#[test]
fn a_killed_run_goes_on_to_the_same_bytes() {
    kills(&CASES[2], 4, &mut Random(1));
}

#[test]
#[ignore = "minutes: 200 kills over four scenes"]
fn two_hundred_kills_lose_nothing() {
    let mut random = Random(7);
    let counts = CASES.map(|case| kills(&case, 50, &mut random));
    assert_eq!(counts.iter().sum::<usize>(), 200);
}

#[test]
fn a_run_without_a_checkpoint_does_not_go_on_with_another_scene() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(root().join("scenes/slope.toml")).unwrap();
    let fabrics = root().join("fabrics");
    let text = text.replace("\"../fabrics", &format!("\"{}", fabrics.display()));
    let (scene, out) = (folder.path().join("scene.toml"), folder.path().join("out"));
    std::fs::write(&scene, &text).unwrap();
    let [scene_path, out_path] = [&scene, &out].map(|path| path.to_str().unwrap());
    let root_path = root().to_str().unwrap();
    let allowed = ["--allow-path", root_path, "--no-picture"];
    ran(&[&["run", scene_path, "-o", out_path, "--until", "0.02"], &allowed[..]].concat(), 0);

    // As after a kill in its first minute.
    let kill = || {
        std::fs::remove_file(out.join("summary.json")).unwrap();
        for entry in std::fs::read_dir(&out).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "bin") {
                std::fs::remove_file(path).unwrap();
            }
        }
    };
    kill();
    std::fs::write(&scene, text.replace("friction = 0.501", "friction = 0.4")).unwrap();
    let resume = [&["resume", out_path], &allowed[..]].concat();
    let message = ran(&resume, 3);
    assert!(message.contains("this has changed: the scene"), "{message}");
    std::fs::write(&scene, &text).unwrap();
    ran(&resume, 0);

    // A request that was damaged is told, and does not panic.
    kill();
    let request = std::fs::read_to_string(out.join("run.json")).unwrap();
    for every in ["-1", "1e300"] {
        let damaged = request
            .replace("\"checkpoint_every\": 60.0", &format!("\"checkpoint_every\": {every}"));
        assert_ne!(damaged, request);
        std::fs::write(out.join("run.json"), damaged).unwrap();
        let message = ran(&resume, 3);
        assert!(message.contains("is not a time from 0 to 1e9 s"), "{message}");
    }
}

#[test]
fn signals_and_limits_leave_a_run_that_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let case = Case { scene: "scenes/stack.toml", until: "0.06" };
    let whole = folder.path().join("whole");
    assert!(case.begin(&whole, "1000").wait().unwrap().success());
    let expected = results(&whole);
    let signals = [("-INT", 130), ("-TERM", 143), ("-HUP", 129), ("-XCPU", 152), ("-USR1", 138)];
    for (signal, code) in signals {
        let out = folder.path().join(signal);
        let child = case.begin(&out, "1000");
        let deadline = Instant::now() + Duration::from_secs(60);
        while !out.join("status.json").exists() {
            assert!(Instant::now() < deadline, "no step after a minute");
            std::thread::sleep(Duration::from_millis(2));
        }
        signals::send(child.id(), signal);
        let begin = Instant::now();
        let ended = child.wait_with_output().unwrap();
        let message = String::from_utf8_lossy(&ended.stderr).into_owned();
        assert_eq!(ended.status.code(), Some(code), "{message}");
        assert!(begin.elapsed() < Duration::from_secs(2), "{:?}", begin.elapsed());
        let status: Value =
            serde_json::from_slice(&std::fs::read(out.join("status.json")).unwrap()).unwrap();
        assert_eq!(status["state"], "interrupted");
        // A second run is refused, and its advice is right.
        let place = out.to_str().unwrap();
        let refused = ran(&["run", case.scene, "-o", place], 2);
        let advice = format!("drape resume {place}");
        assert!(refused.contains(&advice) && message.contains(&advice), "{refused} {message}");
        ran(&["resume", place, "--no-picture"], 0);
        assert!(results(&out) == expected, "{signal}");
        let over = ran(&["resume", place], 2);
        assert!(over.contains("--extend"), "{over}");
    }
    let out = folder.path().join("limited");
    let place = out.to_str().unwrap();
    let message = ran(
        &[
            "run",
            case.scene,
            "--until",
            case.until,
            "-o",
            place,
            "--no-picture",
            "--max-disk",
            "0.001",
        ],
        8,
    );
    assert!(message.contains("--max-disk"), "{message}");
    ran(&["resume", place, "--no-picture"], 0);
    assert!(results(&out) == expected);
}

#[test]
#[cfg(target_os = "linux")]
fn signals_that_are_ignored_at_the_start_stay_ignored() {
    let folder = tempfile::tempdir().unwrap();
    let case = Case { scene: "scenes/stack.toml", until: "0.06" };
    let out = folder.path().join("run");
    // As nohup and `&` in a script start a program.
    let place = out.to_str().unwrap();
    let run = command(&["run", case.scene, "--until", case.until, "--no-picture", "-o", place]);
    let mut shell = Command::new("sh");
    shell.args(["-c", "trap '' HUP INT; exec \"$@\"", "sh"]).arg(run.get_program());
    shell.args(run.get_args()).current_dir(root()).stderr(Stdio::piped());
    let child = shell.spawn().unwrap();
    let deadline = Instant::now() + Duration::from_secs(60);
    while !out.join("status.json").exists() {
        assert!(Instant::now() < deadline, "no step after a minute");
        std::thread::sleep(Duration::from_millis(2));
    }
    // The run would end at once, or at its next step, if it heard one of the first two.
    signals::send(child.id(), "-HUP");
    signals::send(child.id(), "-INT");
    let heard = Instant::now() + Duration::from_millis(600);
    while Instant::now() < heard && !out.join("summary.json").exists() {
        std::thread::sleep(Duration::from_millis(5));
    }
    signals::send(child.id(), "-TERM");
    let ended = child.wait_with_output().unwrap();
    let message = String::from_utf8_lossy(&ended.stderr).into_owned();
    assert!(matches!(ended.status.code(), Some(0 | 143)), "{:?}: {message}", ended.status);
}

#[test]
fn one_run_at_a_time_writes_to_a_folder() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut child = CASES[0].begin(&out, "1000");
    let deadline = Instant::now() + Duration::from_secs(60);
    while !out.join("frames.csv").exists() {
        assert!(Instant::now() < deadline, "no frames after a minute");
        std::thread::sleep(Duration::from_millis(2));
    }
    let place = out.to_str().unwrap();
    for arguments in
        [["run", CASES[0].scene, "--force", "-o", place].as_slice(), &["resume", place]]
    {
        let refused = ran(arguments, 2);
        assert!(refused.contains("another run is writing"), "{refused}");
    }
    signals::send(child.id(), "-KILL");
    child.wait().unwrap();
    // The lock is gone with its process.
    ran(&["run", CASES[2].scene, "--until", "0.01", "--force", "-o", place, "--no-picture"], 0);
}

/// Watcher of a program that panics after some steps.
struct Panicking(usize);

impl Watcher for Panicking {
    fn step(&mut self, _: &Step, _: f64) {
        assert!(self.0 > 0, "a mistake of the program");
        self.0 -= 1;
    }

    fn is_interrupted(&self) -> bool {
        false
    }
}

#[test]
fn a_run_whose_program_panics_goes_on_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let [whole, out] = ["whole", "panicked"].map(|name| folder.path().join(name));
    let scene = root().join("scenes/cube.toml");
    let named = ["run", scene.to_str().unwrap(), "--until", "0.1", "--no-picture", "-o"];
    ran(&[&named[..], &[whole.to_str().unwrap()]].concat(), 5);

    let mut read = drape::run::scene_of(&Document::read(&scene).unwrap()).unwrap();
    end_at(&mut read, 0.1).unwrap();
    let request = RunRequest::new(&scene, Some(0.1), 0.0);
    let program = PathBuf::from(env!("CARGO_BIN_EXE_drape"));
    let run =
        FolderRun::begin(read, &out, &request, &RunOptions { program, ..RunOptions::default() });
    let run = run.unwrap();
    let panicked = catch_unwind(AssertUnwindSafe(|| run.run(&mut Panicking(3)).map(drop)));
    assert!(panicked.is_err());
    let status: Value =
        serde_json::from_slice(&std::fs::read(out.join("status.json")).unwrap()).unwrap();
    assert_eq!(status["state"], "panicked", "{status}");
    assert_eq!(checkpoints(&out).len(), 2);

    ran(&["resume", out.to_str().unwrap(), "--no-picture"], 5);
    assert!(results(&out) == results(&whole));
}

/// Returns the checkpoints of a folder with their bytes, the oldest first.
fn checkpoints(out: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let paths = std::fs::read_dir(out).unwrap().map(|entry| entry.unwrap().path());
    let is_one = |path: &PathBuf| path.to_str().unwrap().contains("checkpoint-");
    let mut found: Vec<_> =
        paths.filter(is_one).map(|path| (path.clone(), std::fs::read(path).unwrap())).collect();
    found.sort();
    found
}

#[test]
#[ignore = "minutes: a run goes on 1 000 times"]
fn a_thousand_flipped_bits_are_detected_and_the_checkpoint_before_is_used() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let place = out.to_str().unwrap();
    let stack = &CASES[2];
    ran(
        &[
            "run",
            stack.scene,
            "--until",
            "0.02",
            "-o",
            place,
            "--no-picture",
            "--checkpoint-every",
            "0",
        ],
        0,
    );
    let expected = results(&out);
    let kept = checkpoints(&out);
    assert_eq!(kept.len(), 2);
    let (newest, whole) = &kept[1];
    let mut random = Random(3);
    for _ in 0..1000 {
        for (path, _) in checkpoints(&out) {
            std::fs::remove_file(path).unwrap();
        }
        kept.iter().for_each(|(path, bytes)| std::fs::write(path, bytes).unwrap());
        let bit = (8.0 * whole.len() as f64 * random.next()) as usize;
        let mut bytes = whole.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        std::fs::write(newest, bytes).unwrap();
        // The run is as if it had not ended.
        std::fs::remove_file(out.join("summary.json")).unwrap();
        let told = ran(&["resume", place, "--no-picture"], 0);
        assert!(told.contains("damaged") && !told.contains("begins anew"), "bit {bit}: {told}");
        assert!(results(&out) == expected, "bit {bit}");
    }
}

#[test]
fn what_changed_is_named_and_damage_leads_to_the_checkpoint_before() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    let fabric = root().join("fabrics/matsudaira-a/sheet.toml");
    let text = std::fs::read_to_string(root().join("scenes/stack.toml")).unwrap();
    let text = text.replace("../fabrics/matsudaira-a/sheet.toml", fabric.to_str().unwrap());
    std::fs::write(&scene, &text).unwrap();
    let allow = root().join("fabrics");
    let out = folder.path().join("out");
    let (place, scene_path) = (out.to_str().unwrap(), scene.to_str().unwrap());
    let allow = ["--allow-path", allow.to_str().unwrap()];
    let run = ["run", scene_path, "--until", "0.03", "-o", place, "--no-picture"];
    let run = [&run[..], &allow, &["--checkpoint-every", "0"]].concat();
    ran(&run, 0);
    let expected = results(&out);
    // The run is as if it had not ended.
    std::fs::remove_file(out.join("summary.json")).unwrap();
    let resume = [&["resume", place, "--no-picture"][..], &allow].concat();
    std::fs::write(&scene, text.replace("friction = 0.3", "friction = 0.4")).unwrap();
    let refused = ran(&resume, 3);
    assert!(refused.contains("the scene") && refused.contains("undo the change"), "{refused}");
    std::fs::write(&scene, &text).unwrap();
    let mut checkpoints: Vec<PathBuf> = std::fs::read_dir(&out)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.to_str().unwrap().contains("checkpoint-"))
        .collect();
    checkpoints.sort();
    assert_eq!(checkpoints.len(), 2);
    let mut bytes = std::fs::read(&checkpoints[1]).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&checkpoints[1], bytes).unwrap();
    let told = ran(&resume, 0);
    assert!(told.contains("damaged"), "{told}");
    assert!(results(&out) == expected);
    // Both are damaged: the run begins anew, and says so.
    std::fs::remove_file(out.join("summary.json")).unwrap();
    for entry in std::fs::read_dir(&out).unwrap() {
        let path = entry.unwrap().path();
        if path.to_str().unwrap().contains("checkpoint-") {
            std::fs::write(path, b"DRAPECKP").unwrap();
        }
    }
    let told = ran(&resume, 0);
    assert!(told.contains("damaged") && told.contains("begins anew"), "{told}");
    assert!(results(&out) == expected);
}
