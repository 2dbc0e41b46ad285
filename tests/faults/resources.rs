//! Resources are known before they are used: what does not fit into memory is refused with a
//! spacing that does.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const FABRIC: &str = include_str!("../fabrics/plain-weave.toml");

/// Runs `drape check` with an address space of 512 MB.
fn check(folder: &Path, scene: &str) -> Output {
    fs::write(folder.join("plain.toml"), FABRIC).expect("written");
    fs::write(folder.join("scene.toml"), scene).expect("written");
    let command = r#"ulimit -v 524288; exec "$0" check scene.toml --threads 2"#;
    let mut shell = Command::new("sh");
    shell.current_dir(folder).args(["-c", command, env!("CARGO_BIN_EXE_drape")]);
    shell.output().expect("it runs")
}

fn scene(spacing: &str) -> String {
    format!(
        "name = \"sheet\"\nspacing = {spacing}\nfabric.plain.file = \"plain.toml\"\n\
         panel = [{{ name = \"a\", fabric = \"plain\", rectangle = [2, 2] }}]\n\
         time = {{ step = 0.005, end = 1 }}\n"
    )
}

#[test]
fn a_scene_that_does_not_fit_into_memory_is_refused_with_a_spacing_that_does() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = check(folder.path(), &scene("\"1.2 mm\""));
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{message}");
    assert!(message.contains("for which there is memory"), "{message}");
    let advice = message.split("write spacing = ").nth(1).expect("a remedy");
    let spacing = advice.split(" or more").next().expect("a spacing");
    let output = check(folder.path(), &scene(spacing));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "with {spacing}: {message}");
}

#[test]
fn a_check_says_what_a_run_takes_within_a_factor_of_two() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = scene("\"10 mm\"").replace("end = 1", "end = 0.02");
    let output = check(folder.path(), &text);
    let text = String::from_utf8_lossy(&output.stdout);
    let line = text.lines().find(|line| line.contains("a run takes about")).expect("a line");
    let number = |words: &str| {
        let before = line.split(words).next().expect("a number").trim_end();
        let mut words = before.rsplit(' ');
        let unit = words.next().expect("a unit");
        let number: f64 = words.next().expect("a number").parse().expect("a number");
        number * if unit == "MB" { 1e6 } else { 1e3 }
    };
    let (memory, disk) = (number(" of memory"), number(" of disk"));
    let mut run = Command::new(env!("CARGO_BIN_EXE_drape"));
    run.current_dir(folder.path()).args(["run", "scene.toml"]);
    let mut child = run.spawn().expect("it runs");
    let status = format!("/proc/{}/status", child.id());
    let mut peak = 0.0_f64;
    while child.try_wait().expect("it is known").is_none() {
        let text = fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok());
        peak = peak.max(1024.0 * kilobytes.unwrap_or_default());
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    assert!(peak < 2.0 * memory && memory < 2.0 * peak, "{memory} said, {peak} taken: {line}");
    let files = fs::read_dir(folder.path().join("out/scene")).expect("results").flatten();
    let taken: u64 = files.map(|file| file.metadata().expect("a file").len()).sum();
    assert!((taken as f64) < 2.0 * disk && disk < 2.0 * taken as f64, "{disk} said, {taken} taken");
}
