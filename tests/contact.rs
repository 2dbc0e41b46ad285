//! Shipped scenes of contact: no surface ever passes through another, from several starts and for
//! any number of threads, as a program finds in the frames that shares no code with the run.

#![allow(clippy::print_stdout, reason = "studies print their figures")]

#[path = "contact/hard.rs"]
mod hard;
#[path = "contact/impacts.rs"]
mod impacts;
#[path = "contact/soak.rs"]
mod soak;

use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde_json::Value;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn drape() -> Command {
    Command::cargo_bin("drape").expect("the binary is built")
}

/// Writes a scene with another start into a folder: each particle is moved at random by up to a
/// tenth of a millimetre.
fn jittered(name: &str, seed: u64, folder: &Path) -> PathBuf {
    let scenes = root().join("scenes");
    let text = std::fs::read_to_string(scenes.join(name).with_extension("toml")).expect("a scene");
    let mut scene: toml::Table = toml::from_str(&text).expect("TOML");
    let noise = toml::toml! { amplitude = 1e-4 };
    let panels = scene["panel"].as_array_mut().expect("panels");
    for (number, panel) in panels.iter_mut().enumerate() {
        let mut noise = noise.clone();
        let seed = 100 * seed as i64 + number as i64;
        noise.insert("seed".into(), toml::Value::Integer(seed));
        panel.as_table_mut().expect("a panel").insert("noise".into(), noise.into());
    }
    let place = |table: &mut toml::Table| {
        let file = scenes.join(table["file"].as_str().expect("a path"));
        table.insert("file".into(), file.to_string_lossy().into_owned().into());
    };
    let fabrics = scene["fabric"].as_table_mut().expect("fabrics");
    fabrics.iter_mut().for_each(|(_, fabric)| place(fabric.as_table_mut().expect("a fabric")));
    let meshes = scene.get_mut("collider").and_then(|colliders| colliders.get_mut("mesh"));
    for mesh in meshes.and_then(toml::Value::as_array_mut).into_iter().flatten() {
        place(mesh.as_table_mut().expect("a mesh"));
    }
    let path = folder.join("scene.toml");
    std::fs::write(&path, toml::to_string(&scene).expect("a table")).expect("it can be written");
    path
}

/// Runs a scene from a start to a time, in s, tests that its surfaces never intersect, and returns
/// its summary.
fn keeps_apart(name: &str, seed: u64, until: f64, threads: usize) -> Value {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = jittered(name, seed, folder.path());
    let settles = std::fs::read_to_string(&scene).expect("a scene").contains("[settle]");
    let output = folder.path().join("out");
    let mut command = drape();
    command.arg("run").arg(scene).arg("-o").arg(&output).arg("--json");
    command.args(["--threads", &threads.to_string(), "--until", &until.to_string()]);
    let result = command.output().expect("it runs");
    let said = String::from_utf8_lossy(&result.stderr);
    let summary: Value = serde_json::from_slice(&result.stdout)
        .unwrap_or_else(|_| panic!("{name}, start {seed}: {said}"));
    // A scene that should come to rest has not if it ends early.
    let code = result.status.code();
    assert!(code == Some(0) || code == Some(5), "{name}, start {seed}: {code:?}, {said}");
    let contact = &summary["contact"];
    assert_eq!(contact["intersections"], 0, "{name}, start {seed}");
    assert_eq!(contact["crossings_found"], 0, "{name}, start {seed}");
    // Relaxation has to meet its residual at rest only, and before that the energy left to gain. Of
    // other steps it bounds what their own error lets them leave.
    let (tolerance, share) = if settles { (1.0, 3e-3) } else { (1e-2, 0.0) };
    let solver = &summary["solver"];
    let [residual, left] =
        ["residual_max", "energy_left_max"].map(|key| solver[key].as_f64().expect("a number"));
    assert!(residual <= tolerance && left <= share, "{name}, start {seed}: {residual}, {left}");
    assert_eq!(solver["inexact_steps"], 0, "{name}, start {seed}");
    let checked = drape().arg("check").arg(&output).arg("--json").output().expect("it runs");
    let said = String::from_utf8_lossy(&checked.stderr);
    assert!(checked.status.success(), "{name}, start {seed}: {said}");
    let found: Value = serde_json::from_slice(&checked.stdout).expect("JSON");
    let run = &found[0];
    assert_eq!([&run["holds"], &run["guarded"]], [true, true], "{name}, start {seed}");
    assert!(run["frames"].as_array().is_some_and(|frames| frames.len() > 1));
    summary
}

/// Runs a scene from five starts, or as many as the variable `STARTS` says, each with one and with
/// two threads.
fn keeps_apart_from_all_starts(name: &str, until: f64) {
    let starts = std::env::var("STARTS").map_or(5, |text| text.parse().expect("a number"));
    for seed in 1..=starts {
        let ends = [1, 2].map(|threads| keeps_apart(name, seed, until, threads));
        assert_eq!(ends[0]["state_hash"], ends[1]["state_hash"], "{name}, start {seed}");
        let [one, _] = &ends;
        println!(
            "{name}, start {seed}: {} particles, {} steps, {} rejected, nearest {} m, {} CPU s",
            one["particles"],
            one["steps"],
            one["solver"]["rejected_steps"],
            one["contact"]["min_distance"],
            one["cpu_seconds"]
        );
    }
}

#[test]
fn cloth_between_balls_and_on_needles_is_kept_apart() {
    keeps_apart("needles", 1, 0.4, 2);
    keeps_apart("pinch", 1, 1.0, 2);
}

/// End of a run of `pinch.toml`.
struct Pinched {
    code: Option<i32>,
    summary: Value,
    /// Exit code of `drape check`.
    checked: Option<i32>,
}

/// Runs `pinch.toml` with a policy (`contact.pinch`) and with balls that approach by a distance, in
/// m.
fn pinched(policy: &str, shift: &str, threads: usize) -> Pinched {
    let folder = tempfile::tempdir().expect("a folder");
    let path = jittered("pinch", 1, folder.path());
    let text = std::fs::read_to_string(&path).expect("a scene").replace("0.0197", shift);
    assert!(text.contains(shift), "{text}");
    let mut scene: toml::Table = toml::from_str(&text).expect("TOML");
    scene.insert("contact".into(), toml::toml! { pinch = policy }.into());
    std::fs::write(&path, toml::to_string(&scene).expect("a table")).expect("it can be written");
    let output = folder.path().join("out");
    let mut command = drape();
    command.arg("run").arg(&path).arg("-o").arg(&output).arg("--json");
    let result = command.args(["--threads", &threads.to_string()]).output().expect("it runs");
    let summary = serde_json::from_slice(&result.stdout).expect("a summary");
    let checked = drape().arg("check").arg(&output).output().expect("it runs");
    Pinched { code: result.status.code(), summary, checked: checked.status.code() }
}

#[test]
fn cloth_that_bodies_close_on_ends_the_run_or_is_thinned_or_released() {
    // The balls leave 0.2 mm and the gap between their triangles and the sphere; the minimum
    // separation is 0.17 mm from each.
    let Pinched { code, summary, checked } = pinched("error", "0.0199", 2);
    assert_eq!((code, checked), (Some(5), Some(5)), "{summary}");
    assert_eq!(summary["status"], "solver failed");
    // With 0.4 mm more between the balls the run goes on to its end.
    let reason = summary["reason"].as_str().expect("a reason");
    assert!(reason.contains("leave more room between them"), "{reason}");
    assert_eq!(pinched("error", "0.0197", 2).code, Some(0));
    let counts = |summary: &Value| {
        let count = |key: &str| summary["contact"][key].as_u64().expect("a count");
        ["thinned_max", "released_max", "intersections", "crossings_found"].map(count)
    };
    assert_eq!(counts(&summary), [0; 4]);
    let set_free = |summary: &Value| summary["energy"]["pinch_released"].as_f64().expect("J");
    assert_eq!(set_free(&summary), 0.0);

    let ends = [1, 2].map(|threads| pinched("thin", "0.0199", threads));
    let [Pinched { code, summary, checked }, Pinched { summary: other, .. }] = &ends;
    assert_eq!((*code, *checked), (Some(0), Some(0)), "{summary}");
    let [thinned, rest @ ..] = counts(summary);
    assert!((1..50).contains(&thinned) && rest == [0; 3], "{summary}");
    let nearest = summary["contact"]["min_distance"].as_f64().expect("a distance");
    assert!(
        nearest > 1.7e-5 && nearest < 1.7e-4,
        "{nearest} m, less than elsewhere and more than a tenth of that"
    );
    assert_eq!(summary["state_hash"], other["state_hash"]);

    // Balls that intersect leave no room at all.
    assert_eq!(pinched("thin", "0.0203", 2).code, Some(5));
    let ends = [1, 2].map(|threads| pinched("release", "0.0203", threads));
    let [Pinched { code, summary, checked }, Pinched { summary: other, .. }] = &ends;
    // Some frames have cloth inside a ball; at the end it has slid out and is kept apart again.
    assert_eq!((*code, *checked), (Some(4), Some(4)), "{summary}");
    assert_eq!(summary["status"], "certificate failed");
    // The contact with a ball that passes is let go with its energy.
    let [free, given] = [set_free(summary), summary["energy"]["work_in"].as_f64().expect("J")];
    assert!(free > 1e-6 && free < given, "{summary}");
    assert!(summary["contact"]["intersections_max"].as_u64() > Some(0), "{summary}");
    let [thinned, released, rest @ ..] = counts(summary);
    assert!(thinned == 0 && (1..50).contains(&released) && rest == [0; 2], "{summary}");
    assert_eq!(summary["state_hash"], other["state_hash"]);
}

/// Takes three minutes of a processor.
#[test]
#[ignore = "takes minutes"]
fn twenty_and_fifty_sheets_are_kept_apart() {
    for name in ["stack-20", "stack-50"] {
        keeps_apart(name, 1, 0.1, 2);
    }
}

/// Makes a test of each scene, with its end in s; all together take half an hour of two cores.
macro_rules! scenes {
    ($($test:ident $name:literal $until:literal)*) => {
        $(
            #[test]
            #[ignore = "takes minutes"]
            fn $test() {
                keeps_apart_from_all_starts($name, $until);
            }
        )*
    };
}

scenes! {
    accordion "accordion" 1.6
    cube "cube" 1.0
    funnel "funnel" 0.8
    needles "needles" 0.4
    pinch "pinch" 1.0
    reef_knot "reef-knot" 3.0
    slope "slope" 0.5
    sphere "sphere" 0.5
    stack "stack" 0.2
    tablecloth "tablecloth" 1.0
    twist "twist" 1.5
}
