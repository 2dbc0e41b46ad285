//! Soak: a long run keeps its memory, and its energy balance closes.

use std::process::{Command, Stdio};
use std::time::Duration;

use serde_json::Value;

/// End of the scene, in s; the period of the ball is 2 s.
const SECONDS: u32 = 100;

/// Scene of a ball that moves to and fro at a hanging sheet.
fn scene() -> String {
    let times: Vec<u32> = (0..=SECONDS).collect();
    let shifts: Vec<[f64; 3]> =
        times.iter().map(|time| [0.0, 0.0, 0.05 * f64::from(time % 2)]).collect();
    format!(
        "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n\
         [[panel]]\nname = \"sheet\"\nfabric = \"plain\"\nrectangle = [0.25, 0.25]\n\
         [[pin]]\npanel = \"sheet\"\nedge = \"top\"\n\
         [[collider.sphere]]\nradius = 0.05\ncenter = [0, -0.02, -0.06]\nfriction = 0.3\n\
         [collider.sphere.motion]\ntimes = {times:?}\nshift = {shifts:?}\n\
         [time]\nstep = 0.005\nend = {SECONDS}\n[output]\nevery = 50\n"
    )
}

/// Resident memory of a process, in kB.
fn resident(process: u32) -> Option<f64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.split_whitespace().next()?.parse().ok()
}

/// Takes a minute of a processor.
#[test]
#[ignore = "takes a minute"]
#[cfg(target_os = "linux")]
fn memory_is_flat_and_energy_balances_over_twenty_thousand_steps() {
    let folder = tempfile::tempdir().expect("a folder");
    let fabric = include_str!("../fabrics/plain-weave.toml");
    std::fs::write(folder.path().join("plain.toml"), fabric).expect("written");
    std::fs::write(folder.path().join("scene.toml"), scene()).expect("written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_drape"));
    command.current_dir(folder.path()).args(["run", "scene.toml", "-o", "out", "--no-picture"]);
    command.args(["--threads", "1", "--checkpoint-every", "4"]);
    let mut run = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
    let mut memory = Vec::new();
    let status = loop {
        if let Some(status) = run.try_wait().expect("it is ours") {
            break status;
        }
        std::thread::sleep(Duration::from_secs(1));
        memory.extend(resident(run.id()));
    };
    assert!(status.success(), "{status}");
    let text = std::fs::read(folder.path().join("out/summary.json")).expect("a summary");
    let summary: Value = serde_json::from_slice(&text).expect("JSON");
    assert_eq!(summary["steps"], 20_000);
    let energy = |key: &str| summary["energy"][key].as_f64().expect("a number");
    let part = energy("remainder").abs() / energy("work_in");
    // The first checkpoints take what the later ones use again.
    let later = &memory[memory.len() / 3..];
    let least = later.iter().copied().fold(f64::INFINITY, f64::min);
    let growth = later.iter().copied().fold(0.0, f64::max) / least;
    println!("{least} kB, at most {growth:.4} of it; {part:.1e} of the work is unaccounted for");
    assert!(part <= 1e-6, "{}", summary["energy"]);
    assert!(growth <= 1.01, "{memory:?}");
}
