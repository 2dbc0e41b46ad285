//! Files stay where they belong: a scene reads and writes below its own folder and the working
//! folder, links lead nowhere else, and what is no file is refused at once.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

const FABRIC: &str = include_str!("fabrics/plain-weave.toml");

const SCENE: &str = r#"name = "towel"
spacing = 0.02
[fabric.plain]
file = "plain.toml"
[[panel]]
name = "towel"
fabric = "plain"
rectangle = [0.1, 0.1]
[time]
step = 0.005
end = 0.01
"#;

/// Longest time that a command may take to refuse something.
const PROMPT: Duration = Duration::from_secs(10);

/// Folder with a scene in `own`, a working folder `current` and another, `other`.
struct Folders(TempDir);

impl Folders {
    fn new() -> Self {
        let folders = Self(tempfile::tempdir().expect("a temporary folder"));
        for name in ["own", "current", "other"] {
            fs::create_dir(folders.at(name)).expect("made");
        }
        for folder in ["own", "other"] {
            fs::write(folders.at(folder).join("plain.toml"), FABRIC).expect("written");
        }
        folders.scene(("", ""));
        folders
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes the scene with one change.
    fn scene(&self, (from, to): (&str, &str)) {
        fs::write(self.at("own/towel.toml"), SCENE.replacen(from, to, 1)).expect("written");
    }

    /// Runs a command in the folder `current`, which must end soon.
    fn drape(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_drape"));
        command.current_dir(self.at("current")).args(arguments);
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("it starts");
        let start = Instant::now();
        while child.try_wait().expect("it is known").is_none() {
            if start.elapsed() > PROMPT {
                child.kill().expect("it ends");
                panic!("{arguments:?} hangs");
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        child.wait_with_output().expect("it has ended")
    }

    fn succeeds(&self, arguments: &[&str]) {
        let output = self.drape(arguments);
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{arguments:?} said: {message}");
    }

    /// Runs a command that must end with a code and one error, and returns its message.
    fn fails(&self, arguments: &[&str], code: i32) -> String {
        let output = self.drape(arguments);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "{arguments:?} said: {message}");
        let errors = message.lines().filter(|line| line.starts_with("error")).count();
        assert_eq!(errors, 1, "one error, not: {message}");
        // What the user types is told as it is; what a file says is cut.
        let typed: usize = arguments.iter().map(|argument| argument.len()).sum();
        assert!(message.len() < 2000 + 2 * typed, "{message}");
        message
    }
}

const RUN: [&str; 3] = ["run", "../own/towel.toml", "--no-picture"];

/// Runs a scene that names a path outside: it is refused, and run as the message advises.
fn outside(folders: &Folders, change: (&str, &str)) {
    folders.scene(change);
    let message = folders.fails(&RUN, 3);
    assert!(message.contains("own/towel.toml:"), "{message}");
    folders.succeeds(&[&RUN[..], &remedy(&message, "--allow-path")].concat());
}

/// Returns the option that a message advises, with its value.
fn remedy<'a>(message: &'a str, option: &str) -> [&'a str; 2] {
    let words: Vec<&str> = message.split_whitespace().collect();
    let pair = words.windows(2).find(|pair| pair[0] == option).expect("a remedy");
    [pair[0], pair[1]]
}

#[test]
fn a_file_that_is_larger_than_usual_is_read_where_the_user_asks_for_it() {
    let folders = Folders::new();
    let mut pattern =
        "length = \"mm\"\n[panel.flap]\ngrain = 0\nrectangle = [200, 100]\n".to_owned();
    pattern += &"# a remark of a program that writes patterns\n".repeat(500_000);
    fs::write(folders.at("current/flap.toml"), pattern).expect("written");
    let check = ["check", "flap.toml"];
    let message = folders.fails(&check, 3);
    folders.succeeds(&[&check[..], &remedy(&message, "--raise-limits")].concat());
    // A sweep hands the option on to its runs.
    let remark = format!("# {}\n", "-".repeat(1 << 20));
    folders.scene(("name", &format!("{remark}name")));
    let message = folders.fails(&RUN, 3);
    let raise = remedy(&message, "--raise-limits");
    folders.succeeds(&[&RUN[..], &raise].concat());
    let study = "scene = \"towel.toml\"\n[[axis]]\nkey = \"time.end\"\nvalues = [0.02]\n";
    fs::write(folders.at("own/study.toml"), study).expect("written");
    let sweep = ["sweep", "run", "../own/study.toml"];
    folders.fails(&sweep, 3);
    folders.succeeds(&[&sweep[..], &raise].concat());
}

#[test]
fn a_scene_reads_below_its_folder_and_the_working_folder() {
    let folders = Folders::new();
    folders.succeeds(&RUN);
    fs::copy(folders.at("own/plain.toml"), folders.at("current/near.toml")).expect("copied");
    folders.scene(("plain.toml", "../current/near.toml"));
    folders.succeeds(&[&RUN[..], &["--force"]].concat());
}

#[test]
fn what_a_scene_names_elsewhere_is_allowed_by_the_user_alone() {
    let folders = Folders::new();
    outside(&folders, ("\"plain.toml\"", "\"../other/plain.toml\""));
    assert!(folders.at("current/out/towel/summary.json").exists());
}

#[test]
fn a_link_does_not_lead_a_scene_out() {
    let folders = Folders::new();
    symlink("../other/plain.toml", folders.at("own/link.toml")).expect("linked");
    outside(&folders, ("\"plain.toml\"", "\"link.toml\""));
    symlink("round.toml", folders.at("own/round.toml")).expect("linked");
    folders.scene(("\"plain.toml\"", "\"round.toml\""));
    assert!(folders.fails(&RUN, 3).contains("circle"));
}

#[test]
fn results_of_a_scene_stay_below_its_folder() {
    for folder in ["../other/results", "../..", "/tmp"] {
        let folders = Folders::new();
        folders.scene(("[time]", &format!("[output]\nfolder = \"{folder}\"\n[time]")));
        let message = folders.fails(&RUN, 3);
        assert!(message.contains("output.folder") && message.contains("--allow-path"));
        assert_eq!(fs::read_dir(folders.at("other")).expect("there").count(), 1);
    }
    let folders = Folders::new();
    outside(&folders, ("[time]", "[output]\nfolder = \"../other/results\"\n[time]"));
    assert!(folders.at("other/results/summary.json").exists());
    // The user's own word needs nothing more.
    folders.succeeds(&[
        "run",
        "../own/towel.toml",
        "-o",
        "../other/mine",
        "--allow-path",
        "../other",
    ]);
    assert!(folders.at("other/mine/summary.json").exists());
}

#[test]
fn a_link_does_not_lead_results_out() {
    let folders = Folders::new();
    symlink(folders.at("other"), folders.at("current/out")).expect("linked");
    let message = folders.fails(&RUN, 2);
    assert!(message.contains("-o"), "{message}");
    folders.succeeds(&[&RUN[..], &["-o", "elsewhere"]].concat());
}

#[test]
fn replacing_results_touches_files_of_the_run_alone() {
    let folders = Folders::new();
    folders.succeeds(&RUN[..2]);
    let results = folders.at("current/out/towel");
    let mine = ["notes.txt", "frame-mine.npy", "frame-00099.npy"];
    for name in mine {
        fs::write(results.join(name), "mine").expect("written");
    }
    // Files of the run become links to a file of the user.
    let kept = folders.at("other/kept");
    fs::write(&kept, "kept").expect("written");
    let linked = ["summary.json", "frame-00000.npy", "picture.png", "view.html", "energy.csv"];
    for name in linked.into_iter().chain(["surfaces.part", "picture.part", "frame-00000.part"]) {
        let _ = fs::remove_file(results.join(name));
        symlink(&kept, results.join(name)).expect("linked");
    }
    folders.succeeds(&["run", "../own/towel.toml", "--force"]);
    assert_eq!(fs::read_to_string(&kept).expect("there"), "kept");
    for name in linked {
        assert!(fs::symlink_metadata(results.join(name)).expect("there").is_file(), "{name}");
    }
    for name in mine {
        assert_eq!(fs::read_to_string(results.join(name)).expect("there"), "mine", "{name}");
    }
}

fn pipe(path: &Path) {
    let made = Command::new("mkfifo").arg(path).status().expect("mkfifo runs");
    assert!(made.success());
}

#[test]
fn what_is_no_file_is_refused_at_once() {
    let folders = Folders::new();
    for name in ["pipe.toml", "pipe.csv", "pipe.obj", "pipe.json"] {
        pipe(&folders.at("own").join(name));
    }
    fs::create_dir(folders.at("own/folder.toml")).expect("made");
    let long = "x".repeat(5000);
    let bodies = |file: &str| format!("[[collider.mesh]]\nfile = \"{file}\"\n[time]");
    for name in ["pipe.toml", "folder.toml", "", "a\\u0000b", &long] {
        folders.scene(("\"plain.toml\"", &format!("\"{name}\"")));
        folders.fails(&RUN, 3);
    }
    for name in ["pipe.obj", "folder.toml", "folder.obj", &long] {
        folders.scene(("[time]", &bodies(name)));
        folders.fails(&RUN, 3);
    }
    for name in ["pipe.json", "pipe.toml", "folder.toml", &long] {
        let garment = format!("[[garment]]\npattern = \"{name}\"\nfabric = \"plain\"\n[time]");
        folders.scene(("[time]", &garment));
        folders.fails(&RUN, 3);
    }
    for path in ["../own/pipe.toml", "../own/pipe.obj", "../own/pipe.json", "/dev/zero", &long] {
        folders.fails(&["check", path], 3);
    }
    folders.fails(&["run", "/dev/zero"], 3);
    folders.fails(&["fit", "../own/pipe.toml"], 3);
    let sheet = "name = \"linen\"\nW = 18.0\nT = 0.4\n[[curve]]\ntest = \"bending\"\n\
                 direction = \"warp\"\nfile = \"FILE\"\n\
                 deformation = { column = \"curvature\", unit = \"1/cm\" }\n\
                 load = { column = \"moment\", unit = \"gf.cm/cm\" }\n";
    for name in ["pipe.csv", "folder.toml", "../other/plain.toml", &long] {
        fs::write(folders.at("own/sheet.toml"), sheet.replace("FILE", name)).expect("written");
        folders.fails(&["fit", "../own/sheet.toml"], 3);
    }
}

#[test]
fn frames_that_are_no_files_are_refused_at_once() {
    let folders = Folders::new();
    folders.succeeds(&RUN);
    let results = folders.at("current/out/towel");
    for name in ["surfaces.json", "frames.csv", "frame-00000.npy", "triangles.npy"] {
        let (path, kept) = (results.join(name), results.join("kept"));
        fs::rename(&path, &kept).expect("moved");
        pipe(&path);
        for command in ["check", "view", "picture"] {
            let code = folders.drape(&[command, "out/towel"]).status.code();
            // A picture needs the last frame alone.
            let needed = (command, name) != ("picture", "frame-00000.npy");
            assert_eq!(needed, matches!(code, Some(2..=6)), "{command} with {name}: {code:?}");
        }
        fs::remove_file(&path).expect("removed");
        fs::rename(&kept, &path).expect("moved back");
    }
}

#[test]
fn nothing_is_put_in_the_place_of_what_is_no_file() {
    let folders = Folders::new();
    pipe(&folders.at("current/pipe.toml"));
    fs::create_dir(folders.at("current/folder.toml")).expect("made");
    folders.fails(&["new", "scene", "-o", "pipe.toml", "--force"], 6);
    folders.fails(&["new", "scene", "-o", "folder.toml", "--force"], 6);
    assert!(!fs::metadata(folders.at("current/pipe.toml")).expect("there").is_file());
    // A device is left as it is.
    let null = folders.drape(&["new", "scene", "-o", "/dev/null", "--force"]).status.code();
    assert_eq!(null, Some(6));
    assert!(!fs::metadata("/dev/null").expect("there").is_file());
}
