//! Files beyond all bounds: they are answered before anything is allocated or looped over, and the
//! answer is short, whatever the length of the file.

use std::fmt::Write;
use std::path::Path;
use std::process::Command;

/// Longest answer, in bytes: twenty mistakes with their lines, and a word on the rest.
const ANSWER_MAX: usize = 8192;

/// Scene with a spacing, a rectangle, and further lines of its panel.
fn scene(spacing: &str, rectangle: &str, more: &str) -> String {
    format!(
        "spacing = {spacing}\nfabric.plain.file = \"plain-weave.toml\"\n[[panel]]\nname = \"p\"\n\
         fabric = \"plain\"\nrectangle = {rectangle}\n{more}\n[time]\nstep = 0.005\nend = 0.01\n"
    )
}

/// Returns a text of so many parts.
fn repeated(count: usize, part: impl Fn(usize) -> String) -> String {
    (0..count).fold(String::new(), |mut text, number| {
        let _ = writeln!(text, "{}", part(number));
        text
    })
}

/// Reads a file by a command that must refuse it in few words, and returns the answer.
fn answer(folder: &Path, command: &str, file: &str) -> String {
    let mut drape = Command::new(env!("CARGO_BIN_EXE_drape"));
    let output = drape.current_dir(folder).args([command, file]).output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{command} {file}: {message}");
    assert!(output.stdout.is_empty());
    assert!(message.len() <= ANSWER_MAX, "{command} {file}: {} bytes", message.len());
    message
}

fn written(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("writes");
}

#[test]
fn scenes_beyond_all_bounds_are_answered_in_few_words() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    written(folder, "plain-weave.toml", include_str!("../fabrics/plain-weave.toml"));
    let size = "[0.2, 0.3]";
    let cases = [
        (scene("1e-9", size, ""), "spacing"),
        (scene("0.02", "[1e6, 1e6]", ""), "panel[0].rectangle"),
        (scene("0.02", size, "velocity = [0, -1e6, 0]"), "panel[0].velocity"),
        (scene("0.02", size, "spin = [0, 1e12, 0]"), "panel[0].spin"),
        (scene("0.02", size, &"x".repeat(1 << 19)), "scene.toml:7"),
        (
            scene("0.02", size, &format!("ripple = \"{}\"", "y".repeat(1_000_000))),
            "panel[0].ripple",
        ),
        (scene("0.02", size, &format!("{} = 1", "z".repeat(1_000_000))), "there is no such key"),
    ];
    for (text, word) in cases {
        written(folder, "scene.toml", &text);
        for command in ["check", "run"] {
            let told = answer(folder, command, "scene.toml");
            assert!(told.contains(word), "{word} is not in: {told}");
        }
    }
}

#[test]
fn thousands_of_mistakes_are_counted_and_the_first_twenty_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    written(folder, "plain-weave.toml", include_str!("../fabrics/plain-weave.toml"));
    for count in [2000, 4000] {
        let keys = repeated(count, |number| format!("key{number} = 1"));
        let panels = repeated(count, |number| {
            format!("[[panel]]\nname = \"p{number}\"\nfabric = \"plane\"\nrectangle = [1]")
        });
        let seams = repeated(count, |number| {
            format!("[seam.s{number}]\nsides = [[\"a.lfet\"], [\"b.right\"]]\nangle = 900")
        });
        let files = [
            ("keys.toml", scene("0.02", "[0.2, 0.3]", &keys)),
            ("panels.toml", scene("0.02", "[0.2, 0.3]", &panels)),
            (
                "seams.toml",
                format!("length = \"mm\"\n[panel.a]\ngrain = 0\nrectangle = [300, 300]\n{seams}"),
            ),
            ("sheet.toml", format!("name = \"a\"\n{keys}")),
        ];
        for (name, text) in files {
            written(folder, name, &text);
            let told = answer(folder, "check", name);
            let errors = told.lines().filter(|line| line.starts_with("error: ")).count();
            assert!(errors <= 21, "{name}: {errors} are told");
            // The rest is counted: more than are told one by one.
            assert!(told.contains("more mistakes"), "{name}: {told}");
        }
        for name in ["keys.toml", "panels.toml"] {
            answer(folder, "run", name);
        }
    }
}
