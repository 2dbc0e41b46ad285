//! Files whose bytes are changed, read by the command in an address space of 1 GB: it ends within
//! seconds, with a code of the table and without a panic.

use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::guard::is_full;
use crate::machine::CODES;
use crate::mutation::{Random, mutated};
use crate::readers;

/// Longest time that a command may take.
const TIME_MAX: Duration = Duration::from_secs(10);

/// Address space of a command, in kB.
const ADDRESS_SPACE: usize = 1_000_000;

/// Seed of the first mutation, which the environment variable `FAULTS_SEED` changes.
const FIRST_SEED: u64 = 700_000;

/// File whose bytes are changed, and the commands that read it.
struct Target {
    file: &'static str,
    commands: &'static [&'static str],
}

/// Files by the commands that read them. The folder of a run is `run`, and a command replaces what
/// an earlier one wrote.
const TARGETS: [Target; 18] = [
    Target { file: "scene.toml", commands: &["check scene.toml", SHORT_RUN] },
    Target { file: "garment.toml", commands: &["check garment.toml"] },
    Target {
        file: "plain.toml",
        commands: &["check plain.toml", "fabric show plain.toml", SHORT_RUN],
    },
    Target {
        file: "sheet.toml",
        commands: &["check sheet.toml", "fit sheet.toml -o f.toml --force"],
    },
    Target { file: "bending.csv", commands: &["fit sheet.toml -o f.toml --force"] },
    Target { file: "table.csv", commands: &["convert table.csv -o s.toml --force"] },
    Target { file: "pattern.toml", commands: &["check pattern.toml", "check garment.toml"] },
    Target { file: "skirt.json", commands: &["convert skirt.json -o p.toml --force"] },
    Target { file: "teagan.json", commands: &["convert teagan.json -o p.toml --force"] },
    Target { file: "shirt.svg", commands: &["convert shirt.svg -o p.toml --force"] },
    Target { file: "body.obj", commands: &["check body.obj", SHORT_RUN] },
    Target { file: "study.toml", commands: &["check study.toml"] },
    Target { file: "run/run.json", commands: &[RESUME] },
    Target { file: "run/frames.csv", commands: &["check run", RESUME, "view run"] },
    Target {
        file: "run/surfaces.json",
        commands: &["check run", "export run --format glb -o x.glb"],
    },
    Target { file: "run/summary.json", commands: &["check run", "picture run -o p.png"] },
    Target { file: "run/status.json", commands: &["check run"] },
    Target { file: "run/checkpoint-00000001.bin", commands: &[RESUME] },
];

const SHORT_RUN: &str = "run scene.toml -o out --force --no-picture --until 0.01 --max-wall 3 -q";
const RESUME: &str = "resume run --extend 0.01 --no-picture --max-wall 3 -q";

const SCENE: &str = "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n\
    panel = [{ name = \"a\", fabric = \"plain\", rectangle = [0.1, 0.1], center = [0, 0.2, 0] }]\n\
    pin = [{ panel = \"a\", edge = \"top\" }]\n\
    collider.mesh = [{ name = \"b\", file = \"body.obj\" }]\n\
    collider.sphere = [{ radius = 0.03, center = [0, 0, 0.2] }]\n\
    contact.surfaces = true\ntime = { step = 0.005, end = 0.02 }\noutput = { every = 0.01 }\n";

const GARMENT: &str = "spacing = 0.05\nfabric.plain.file = \"plain.toml\"\n\
    garment = [{ pattern = \"pattern.toml\", fabric = \"plain\", panel.front.layer = 0 }]\n\
    time = { step = 0.005, end = 0.5 }\n";

const PATTERN: &str = "length = \"mm\"\n\
    [panel.front]\ngrain = 0\nrectangle = [300, 400]\norigin = [0, 0, 60]\n\
    [panel.back]\ngrain = 0\nrectangle = [300, 400]\norigin = [0, 0, -60]\n\
    [seam.side]\nsides = [[\"front.right\"], [\"back.right\"]]\nreversed = true\n";

const STUDY: &str = "scene = \"scene.toml\"\n\
    [[axis]]\nkey = \"time.end\"\nvalues = [0.02, 0.03]\n\
    [[sample]]\nmethod = \"sobol\"\ncount = 2\n\
    [[sample.range]]\nkey = \"panel.0.rectangle.0\"\nstart = 0.1\nend = 0.2\n";

const BODY: &str = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// Returns a folder with all files, and the folder of a run that has ended.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write =
        |name: &str, text: &[u8]| fs::write(folder.path().join(name), text).expect("written");
    let texts = [
        ("scene.toml", SCENE),
        ("garment.toml", GARMENT),
        ("plain.toml", readers::FABRIC),
        ("sheet.toml", readers::SHEET),
        ("bending.csv", readers::CURVE),
        ("table.csv", readers::CURVE),
        ("pattern.toml", PATTERN),
        ("study.toml", STUDY),
        ("body.obj", BODY),
    ];
    texts.iter().for_each(|(name, text)| write(name, text.as_bytes()));
    for name in ["patterns/skirt.json", "patterns/teagan.json", "shirt.svg"] {
        let shipped = readers::shipped(&format!("crates/drape-pattern/{name}"));
        let file = Path::new(name).file_name().and_then(|name| name.to_str()).expect("a name");
        write(file, &fs::read(shipped).expect("it ships"));
    }

    let run = "run scene.toml -o run --no-picture -q";
    let child = begin(folder.path(), run);
    let output = child.wait_with_output().expect("it runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder
}

/// Begins `drape` with the `arguments` of a line, which are separated by spaces.
fn begin(folder: &Path, arguments: &str) -> Child {
    let mut command = Command::new("sh");
    let line = format!("ulimit -v {ADDRESS_SPACE}; exec \"$0\" {arguments} --threads 2");
    command.current_dir(folder).args(["-c", &line, env!("CARGO_BIN_EXE_drape")]);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    command.spawn().expect("it runs")
}

/// End of a command: its exit code, or `None` if it had to be ended, and its messages.
struct End {
    code: Option<i32>,
    message: String,
}

impl End {
    /// Runs `drape` with `arguments` and waits for its end.
    fn of(folder: &Path, arguments: &str) -> Self {
        let mut child = begin(folder, arguments);
        let mut messages = child.stderr.take().expect("it is piped");
        let reader = std::thread::spawn(move || {
            let mut bytes = Vec::new();
            let _ = messages.read_to_end(&mut bytes);
            String::from_utf8_lossy(&bytes).into_owned()
        });

        let start = Instant::now();
        while child.try_wait().expect("it is known").is_none() && start.elapsed() < TIME_MAX {
            std::thread::sleep(Duration::from_millis(2));
        }
        let _ = child.kill();
        let code = child.wait().expect("it ends").code();
        Self { code, message: reader.join().expect("it is read") }
    }

    /// Returns whether the command ended by itself, with a code of the table and without a panic.
    fn is_sound(&self) -> bool {
        self.code.is_some_and(|code| CODES.contains(&code)) && !self.message.contains("panicked")
    }
}

/// Copies the files of the folder `from` to the folder `to`, with the folders in it.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("made");
    for entry in fs::read_dir(from).expect("a folder").flatten() {
        let (path, place) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() {
            copy(&path, &place);
        } else {
            fs::copy(&path, &place).expect("copied");
        }
    }
}

#[test]
fn changed_bytes_lead_to_an_exit_code_of_the_table() {
    let whole = folder();
    let copied = || {
        let folder = tempfile::tempdir().expect("a temporary folder");
        copy(whole.path(), folder.path());
        folder
    };
    for Target { commands, .. } in &TARGETS {
        for arguments in *commands {
            let End { code, message } = End::of(copied().path(), arguments);
            assert_eq!(code, Some(0), "drape {arguments}, before a byte is changed: {message}");
        }
    }

    let cases = if is_full() { 2_000 } else { 36 };
    let first_seed = std::env::var("FAULTS_SEED").map_or(FIRST_SEED, |seed| seed.parse().unwrap());
    let mut faults: Vec<String> = Vec::new();
    let mut accepted = 0;
    for case in 0..cases {
        let Target { file, commands } = &TARGETS[case % TARGETS.len()];
        let seed = first_seed + case as u64;
        let arguments = commands[Random(seed).below(commands.len())];
        let folder = copied();
        let path = folder.path().join(file);
        let bytes = fs::read(&path).expect("it is there");
        fs::write(&path, mutated(&bytes, seed)).expect("written");

        let end = End::of(folder.path(), arguments);
        accepted += usize::from(end.code == Some(0));
        if !end.is_sound() {
            let End { code, message } = end;
            faults.push(format!("{file}, seed {seed}, drape {arguments}: {code:?}: {message}"));
        }
    }
    println!("{accepted} of {cases} changed files are accepted");
    assert!(faults.is_empty(), "{} of {cases} cases:\n{}", faults.len(), faults.join("\n"));
}
