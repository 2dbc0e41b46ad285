//! Machines that refuse: full disks, closed outputs, little memory, few and many threads.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::TempDir;

use crate::readers;

/// Exit codes that the help lists.
pub const CODES: [i32; 8] = [0, 2, 3, 4, 5, 6, 7, 8];

const TIME_MAX: Duration = Duration::from_secs(10);

const SCENE: &str = "spacing = 0.01\nfabric.plain.file = \"plain.toml\"\n\
    panel = [{ name = \"a\", fabric = \"plain\", rectangle = [0.2, 0.2] }]\n\
    pin = [{ panel = \"a\", edge = \"top\" }]\ntime = { step = 0.005, end = 0.05 }\n";

fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("plain.toml"), readers::FABRIC).expect("written");
    fs::write(folder.path().join("sheet.toml"), readers::SHEET).expect("written");
    fs::write(folder.path().join("bending.csv"), readers::CURVE).expect("written");
    fs::write(folder.path().join("scene.toml"), SCENE).expect("written");
    folder
}

/// Runs a line of shell, in which `$0` is the program; it must end soon, with a code of the table,
/// and leave no half of a file.
fn shell(folder: &Path, line: &str) -> Output {
    let mut command = Command::new("sh");
    command.current_dir(folder).args(["-c", line, env!("CARGO_BIN_EXE_drape")]);
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let start = Instant::now();
    let output = command.output().expect("it runs");
    assert!(start.elapsed() < TIME_MAX, "{line} took {:?}", start.elapsed());
    let told = String::from_utf8_lossy(&output.stderr);
    let known = output.status.code().is_some_and(|code| CODES.contains(&code));
    assert!(known, "{line}: {:?}: {told}", output.status);
    assert!(!told.contains("panicked"), "{line}: {told}");
    whole(folder);
    output
}

/// Asserts that no file of a folder is a half of one.
fn whole(folder: &Path) {
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        let ending = path.extension().unwrap_or_default().to_string_lossy().into_owned();
        match ending.as_str() {
            _ if path.is_dir() => whole(&path),
            "part" => panic!("{} is left", path.display()),
            "json" => {
                let text = fs::read_to_string(&path).expect("text");
                serde_json::from_str::<Value>(&text).expect("all of it");
            }
            "npy" => {
                let bytes = fs::read(&path).expect("bytes");
                let header = usize::from(u16::from_le_bytes([bytes[8], bytes[9]])) + 10;
                assert!(bytes.len() > header && (bytes.len() - header).is_multiple_of(2));
            }
            "html" => assert!(fs::read_to_string(&path).expect("text").contains("</html>")),
            "png" => assert!(fs::read(&path).expect("bytes").ends_with(b"IEND\xaeB`\x82")),
            _ => {}
        }
    }
}

#[test]
fn files_beyond_a_limit_end_with_6() {
    // Blocks of 512 bytes: from none at all to all that is needed.
    let mut codes = Vec::new();
    for blocks in [0, 1, 4, 20, 60, 200, 2000, 20_000] {
        let folder = folder();
        for command in ["run scene.toml", "fit sheet.toml", "new pattern"] {
            let line = format!("ulimit -f {blocks}; exec \"$0\" {command}");
            codes.push((blocks, shell(folder.path(), &line).status.code()));
        }
    }
    assert!(codes[..3].iter().all(|(_, code)| *code == Some(6)), "{codes:?}");
    assert!(codes[codes.len() - 3..].iter().all(|(_, code)| *code == Some(0)), "{codes:?}");
}

#[test]
fn a_full_disk_ends_with_a_code() {
    let folder = folder();
    for size in ["4k", "40k", "120k", "300k", "1m", "20m"] {
        // A namespace of its own, where systems allow it; elsewhere the limit above stands for it.
        let line = format!(
            "mkdir -p small; unshare -rm sh -c 'mount -t tmpfs -o size={size} tmpfs small && \
             \"$0\" run scene.toml -o small/run; code=$?; ls small/run/*.part >&2 2>/dev/null && exit 70; \
             exit $code' \"$0\" || {{ code=$?; [ $code = 1 ] && exit 6; exit $code; }}"
        );
        shell(folder.path(), &line);
    }
}

#[test]
fn places_that_take_no_files_end_with_6() {
    let folder = folder();
    for place in ["plain.toml/run", "/proc/drape", "/dev/null/run"] {
        for command in [format!("run scene.toml -o {place}"), format!("fit sheet.toml -o {place}")]
        {
            let output = shell(folder.path(), &format!("exec \"$0\" {command}"));
            assert_eq!(output.status.code(), Some(6), "{command}");
        }
    }
}

#[test]
fn closed_outputs_and_an_empty_environment_are_no_faults() {
    let folder = folder();
    let lines = [
        "exec \"$0\" check scene.toml plain.toml sheet.toml >&-",
        "exec \"$0\" check scene.toml >&- 2>&- <&-",
        "exec \"$0\" check missing.toml 2>&-",
        "\"$0\" schema scene | true",
        "\"$0\" check scene.toml --json | true",
        "exec \"$0\" run scene.toml -o closed >&- 2>&-",
        "exec \"$0\" check scene.toml > /dev/full",
        "exec \"$0\" check missing.toml 2> /dev/full",
        "exec env -i \"$0\" run scene.toml -o bare",
        "exec env -u HOME \"$0\" fit sheet.toml -o fitted.toml",
    ];
    let codes = lines.map(|line| shell(folder.path(), line).status.code());
    assert_eq!(codes.map(|code| code.unwrap_or(-1)), [0, 0, 3, 0, 0, 0, 6, 3, 0, 0]);
}

#[test]
fn little_memory_is_enough_for_1_to_8_threads_with_the_same_result() {
    let folder = folder();
    // Debug assertions and line tables make the program 70 MiB larger, and each thread keeps 64 MiB
    // of addresses for its memory.
    let kibibytes = if cfg!(debug_assertions) { 655_360 } else { 524_288 };
    let mut hashes = Vec::new();
    for threads in 1..=8 {
        let line = format!(
            "ulimit -v {kibibytes}; exec \"$0\" run scene.toml -o run --force --no-picture --threads {threads}"
        );
        let output = shell(folder.path(), &line);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let text = fs::read_to_string(folder.path().join("run/summary.json")).expect("a summary");
        let summary: Value = serde_json::from_str(&text).expect("JSON");
        hashes.push(summary["state_hash"].clone());
    }
    assert!(hashes.iter().all(|hash| *hash == hashes[0] && hash.is_string()), "{hashes:?}");
}

/// Checks a scene with one change, and returns its only error.
fn refused(file: &str, (from, to): (&str, &str)) -> String {
    let folder = folder();
    let path = folder.path().join(file);
    let text = fs::read_to_string(&path).expect("text");
    assert!(text.contains(from), "{file} has no {from}");
    fs::write(&path, text.replacen(from, to, 1)).expect("written");
    let output = shell(folder.path(), "exec \"$0\" check scene.toml");
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{to}: {told}");
    told
}

#[test]
fn wrong_units_are_asked_about() {
    let asked = |told: &str| {
        ["did you mean", "is the unit right"].iter().any(|question| told.contains(question))
    };
    let cases = [
        ("scene.toml", ("rectangle = [0.2, 0.2]", "rectangle = [1000, 1000]")),
        ("scene.toml", ("rectangle = [0.2, 0.2]", "rectangle = [20000, 20000]")),
        ("scene.toml", ("spacing = 0.01", "spacing = 10")),
        ("plain.toml", ("density = 0.12", "density = 200.0")),
        ("plain.toml", ("thickness = 0.0004", "thickness = 0.4")),
    ];
    for (file, change) in cases {
        let told = refused(file, change);
        assert!(asked(&told), "{file}: {change:?}: {told}");
    }
}
