//! Folders of runs that were damaged, planted or left behind: each fault is told, and a run that is
//! refused leaves the folder as it was.

#![cfg(unix)]
#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

/// Longest time that a command may take, after which it is ended: a pipe would let it wait for
/// ever.
const PATIENCE: Duration = Duration::from_secs(120);

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_drape"));
    command.current_dir(env!("CARGO_MANIFEST_DIR")).args(arguments).args(["--threads", "1"]);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// Returns the exit code and the messages of a `command`.
fn ended(mut command: Command) -> (Option<i32>, String) {
    let mut child = command.spawn().unwrap();
    let begin = Instant::now();
    while child.try_wait().unwrap().is_none() && begin.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(5));
    }
    let _ = child.kill();
    let Output { status, stderr, .. } = child.wait_with_output().unwrap();
    (status.code(), String::from_utf8_lossy(&stderr).into_owned())
}

/// Run of a falling cloth in a folder, which has ended.
struct EndedRun {
    folder: tempfile::TempDir,
}

impl EndedRun {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let run = folder.path().join("run");
        let run = run.to_str().unwrap();
        let arguments =
            ["run", "scenes/cube.toml", "--until", "0.1", "--no-picture", "-o", run, "-q"];
        assert_eq!(ended(command(&arguments)).0, Some(5), "it has not settled yet");
        Self { folder }
    }

    /// Returns a copy of the folder of the run.
    fn copy(&self) -> Copied {
        let folder = tempfile::tempdir().unwrap();
        let run = folder.path().join("run");
        fs::create_dir(&run).unwrap();
        for entry in fs::read_dir(self.folder.path().join("run")).unwrap() {
            let from = entry.unwrap().path();
            fs::copy(&from, run.join(from.file_name().unwrap())).unwrap();
        }
        Copied { _folder: folder, run }
    }
}

/// Copy of the folder of a run.
struct Copied {
    _folder: tempfile::TempDir,
    run: PathBuf,
}

impl Copied {
    fn path(&self, name: &str) -> PathBuf {
        self.run.join(name)
    }

    fn ends(&self, arguments: &[&str]) -> (Option<i32>, String) {
        let all = [&arguments[..1], &[self.run.to_str().unwrap()], &arguments[1..]].concat();
        ended(command(&all))
    }

    fn resumed(&self) -> (Option<i32>, String) {
        self.ends(&["resume", "--extend", "0.02", "--no-picture", "-q"])
    }

    /// Names and contents of the regular files.
    fn files(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        let paths = fs::read_dir(&self.run).unwrap().map(|entry| entry.unwrap().path());
        let regular = paths.filter(|path| fs::symlink_metadata(path).unwrap().is_file());
        regular.map(|path| (path.clone(), fs::read(&path).unwrap())).collect()
    }

    fn change(&self, name: &str, change: impl FnOnce(Vec<u8>) -> Vec<u8>) {
        let path = self.path(name);
        let content = fs::read(&path).unwrap();
        fs::write(&path, change(content)).unwrap();
    }
}

/// Returns the lines of a table without the one of `number`, from 0.
fn without_line(table: Vec<u8>, number: usize) -> Vec<u8> {
    let text = String::from_utf8(table).unwrap();
    let lines = text.split_inclusive('\n').enumerate();
    lines.filter(|(index, _)| *index != number).map(|(_, line)| line).collect::<String>().into()
}

/// Returns bytes of which the one from the end is another.
fn flipped(mut bytes: Vec<u8>) -> Vec<u8> {
    let last = bytes.len() - 3;
    bytes[last] ^= 1;
    bytes
}

#[test]
fn a_damaged_file_is_told_before_anything_changes() {
    type Change = fn(Vec<u8>) -> Vec<u8>;
    let ended = EndedRun::new();
    assert_eq!(ended.copy().resumed().0, Some(5), "nothing is wrong yet");

    let cases: [(&str, Change, &str); 14] = [
        ("run.json", |_| Vec::new(), "run.json"),
        ("run.json", |text| text[..text.len() / 2].to_vec(), "run.json"),
        ("run.json", |_| br#"{"scene": 3}"#.to_vec(), "run.json"),
        ("run.json", |_| vec![0xff; 40], "run.json"),
        ("frames.csv", |_| Vec::new(), "frames.csv has 0 frames"),
        ("frames.csv", |table| without_line(table, 1), "frames.csv, line 2"),
        ("frames.csv", |table| without_line(table, 0), "frames.csv"),
        ("frames.csv", |_| vec![0xff; 40], "frames.csv"),
        ("energy.csv", |_| b"number,time,kinetic\n0,0,x\n".to_vec(), "energy.csv, line 2"),
        ("frame-00001.npy", flipped, "frame-00001.npy: the frame, its bodies"),
        ("frame-00000.npy", |array| array[..array.len() - 8].to_vec(), "frame-00000.npy"),
        ("frame-00000.npy", |array| vec![0; array.len()], "frame-00000.npy"),
        ("bodies-00000.npy", flipped, "frame-00000.npy: the frame, its bodies"),
        ("surfaces.json", |_| b"{".to_vec(), "surfaces.json"),
    ];
    for (name, change, words) in cases {
        let run = ended.copy();
        run.change(name, change);
        let before = run.files();
        if name != "surfaces.json" {
            let (code, message) = run.resumed();
            assert_eq!(code, Some(3), "resume, {name}: {message}");
            assert!(message.contains(words), "resume, {name}: {message}");
            assert!(before == run.files(), "resume changed the folder of a damaged {name}");
        }
        if name != "run.json" {
            let (code, message) = run.ends(&["check"]);
            let words = if words.ends_with("0 frames") { "0 of " } else { words };
            assert_eq!(code, Some(3), "check, {name}: {message}");
            assert!(message.contains(words), "check, {name}: {message}");
        }
    }
}

#[test]
fn a_remedy_of_a_damaged_file_helps() {
    let run = EndedRun::new().copy();
    run.change("frame-00001.npy", flipped);
    let (code, message) = run.ends(&["check"]);
    assert!(code == Some(3) && message.contains("run the scene again"), "{message}");
    let folder = run.run.to_str().unwrap();
    let again = ["run", "scenes/cube.toml", "--until", "0.1", "--no-picture", "--force", "-o"];
    assert_eq!(ended(command(&[&again[..], &[folder]].concat())).0, Some(5));
    let (code, message) = run.ends(&["check"]);
    assert!(code == Some(5) && message.contains("did not settle"), "{message}");
}

#[test]
fn links_pipes_devices_and_folders_in_place_of_files_are_refused() {
    let ended = EndedRun::new();
    let checkpoints = fs::read_dir(ended.folder.path().join("run")).unwrap();
    let mut names = checkpoints.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let checkpoint = names.find(|name| name.starts_with("checkpoint-")).unwrap();
    let kinds: [fn(&Path, &Path); 5] = [
        |place, theirs| symlink(theirs, place).unwrap(),
        |place, _| symlink("/dev/zero", place).unwrap(),
        |place, _| symlink("not-there", place).unwrap(),
        |place, _| fs::create_dir(place).unwrap(),
        |place, _| {
            let made = Command::new("mkfifo").arg(place).status().unwrap();
            assert!(made.success());
        },
    ];
    let cases = [("run.lock", 6), (&checkpoint[..], 6), ("frames.csv", 3), ("run.json", 2)];
    for (name, code) in cases {
        for (kind, plant) in kinds.iter().enumerate() {
            let run = ended.copy();
            let theirs = run.path("theirs");
            fs::rename(run.path(name), &theirs).unwrap();
            plant(&run.path(name), &theirs);
            if kind == 0 && !matches!(name, "run.lock") && !name.starts_with("checkpoint-") {
                // A link to a file that can be read does no harm here.
                continue;
            }
            let before = run.files();
            let (found, message) = run.resumed();
            assert_eq!(found, Some(code), "{name}, kind {kind}: {message}");
            assert!(message.contains(name), "{name}, kind {kind}: {message}");
            assert!(before == run.files(), "{name}, kind {kind}");
        }
    }
}

#[test]
fn a_checkpoint_that_cannot_be_written_ends_with_code_6() {
    let run = EndedRun::new().copy();
    fs::create_dir(run.path("checkpoint.part")).unwrap();
    let (code, message) = run.resumed();
    assert_eq!(code, Some(6), "{message}");
    assert!(message.contains("cannot write the checkpoint"), "{message}");
}

#[test]
fn the_status_of_a_process_that_is_gone_is_told_once_and_corrected() {
    let run = EndedRun::new().copy();
    let summary = fs::read(run.path("summary.json")).unwrap();
    fs::remove_file(run.path("summary.json")).unwrap();
    let plant = |status: Value| fs::write(run.path("status.json"), status.to_string()).unwrap();
    let state = || -> Value {
        let text = fs::read(run.path("status.json")).unwrap();
        serde_json::from_slice::<Value>(&text).unwrap()["state"].take()
    };

    for arguments in [&["check"][..], &["export", "--format", "obj", "-o", "/dev/null"], &["view"]]
    {
        plant(json!({ "state": "running", "process": 12345, "expected_end": 1 }));
        let (_, message) = run.ends(arguments);
        let words = "the process 12345 that ran the scene in";
        assert!(message.contains(words) && message.contains("drape resume"), "{message}");
        assert_eq!(state(), "killed", "{arguments:?}");
        let (_, message) = run.ends(arguments);
        assert!(!message.contains(words), "it is told once: {message}");
    }

    // A process that holds the lock is still there.
    plant(json!({ "state": "running", "process": 12345 }));
    let lock = fs::File::open(run.path("run.lock")).unwrap();
    lock.lock().unwrap();
    let (_, message) = run.ends(&["check"]);
    assert!(!message.contains("is gone") && state() == "running", "{message}");
    drop(lock);

    // A process that was ended after its summary has ended its run.
    fs::write(run.path("summary.json"), summary).unwrap();
    let (_, message) = run.ends(&["check"]);
    assert!(!message.contains("is gone") && state() == "did not settle", "{message}");
}
