//! The command line: files to start from, results that are there already, several scenes, signals,
//! completions and manual pages.

#[path = "command_line/compare.rs"]
mod compare;
#[path = "command_line/damaged.rs"]
mod damaged;
#[path = "command_line/file_kinds.rs"]
mod file_kinds;
#[path = "command_line/grading.rs"]
mod grading;
#[path = "command_line/material.rs"]
mod material;
#[path = "command_line/remedies.rs"]
mod remedies;
#[path = "command_line/report.rs"]
mod report;
#[path = "command_line/resume.rs"]
mod resume;
#[path = "command_line/sheet_values.rs"]
mod sheet_values;
#[path = "command_line/signals.rs"]
mod signals;

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::TempDir;

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_drape"));
    command.current_dir(folder).args(arguments);
    command
}

fn drape(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().expect("it runs")
}

/// Runs a command that must succeed and returns what it prints.
fn succeeds(folder: &Path, arguments: &[&str]) -> String {
    let output = drape(folder, arguments);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{arguments:?} said: {message}");
    String::from_utf8(output.stdout).expect("text")
}

/// Runs a command that must end with a code and returns its message.
fn fails(folder: &Path, arguments: &[&str], code: i32) -> String {
    let output = drape(folder, arguments);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(code), "{arguments:?} said: {message}");
    message
}

fn summary(folder: &Path) -> Value {
    let text = std::fs::read_to_string(folder.join("summary.json")).expect("a summary");
    serde_json::from_str(&text).expect("JSON")
}

/// Returns a folder with the files that `drape new` writes, and with `moving.toml`, the scene
/// without rest.
fn started() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    succeeds(folder.path(), &["new", "scene"]);
    succeeds(folder.path(), &["new", "pattern"]);
    let text = std::fs::read_to_string(folder.path().join("scene.toml")).expect("a scene");
    assert!(text.contains("\n[settle]\n"));
    let moving = text.replace("\n[settle]\n", "\n");
    std::fs::write(folder.path().join("moving.toml"), moving).expect("writes");
    folder
}

#[test]
fn files_to_start_from_run_as_they_are() {
    let folder = started();
    let folder = folder.path();
    succeeds(folder, &["check", "scene.toml", "sheet.toml", "pattern.toml"]);
    succeeds(folder, &["fit", "sheet.toml"]);
    succeeds(folder, &["run", "scene.toml"]);
    assert_eq!(summary(&folder.join("out/scene"))["settled"], true);
    let printed = succeeds(folder, &["new", "sheet", "-o", "-"]);
    let written = std::fs::read_to_string(folder.join("sheet.toml")).expect("a sheet");
    // Printed, it has no schema beside it.
    assert_eq!(written, format!("#:schema ./sheet.schema.json\n{printed}"));
}

#[test]
fn results_that_are_there_are_replaced_with_force_only() {
    let folder = started();
    let folder = folder.path();
    let run = ["run", "moving.toml", "--until", "0.01", "--no-picture"];
    let (fit, new) = (["fit", "sheet.toml", "-o", "f.toml"], ["new", "sheet"]);
    for arguments in [&run[..], &fit, &new] {
        if arguments != new {
            succeeds(folder, arguments);
        }
        let message = fails(folder, arguments, 2);
        assert!(message.contains("--force"), "{message}");
        succeeds(folder, &[arguments, &["--force"]].concat());
    }
    assert!(!folder.join("out/moving/picture.png").exists());
}

#[test]
fn the_last_line_of_a_run_names_files_that_can_be_opened() {
    let folder = started();
    let folder = folder.path();
    let run = ["run", "moving.toml", "--until", "0.01", "-o", "out/my", "--force"];
    let said = succeeds(folder, &run);
    let last = said.lines().last().expect("a line");
    assert_eq!(last, "results in out/my: picture out/my/picture.png, page out/my/view.html");
    for name in ["picture.png", "view.html"] {
        assert!(folder.join("out/my").join(name).is_file(), "{name}");
    }
    let said = succeeds(folder, &[&run[..], &["--no-picture"]].concat());
    assert_eq!(said.lines().last(), Some("results in out/my"));
    // Programs read the summary alone.
    let said = succeeds(folder, &[&run[..], &["--json"]].concat());
    assert!(serde_json::from_str::<Value>(&said).is_ok(), "{said}");
}

#[test]
fn of_several_scenes_one_that_fails_does_not_stop_the_rest() {
    let folder = started();
    let folder = folder.path();
    std::fs::copy(folder.join("moving.toml"), folder.join("again.toml")).expect("copies");
    let scenes = ["run", "moving.toml", "missing.toml", "again.toml", "-o", "all"];
    let message = fails(folder, &[&scenes[..], &["--until", "0.01", "--no-picture"]].concat(), 3);
    assert!(message.contains("missing.toml"), "{message}");
    let hashes = ["moving", "again"].map(|name| summary(&folder.join("all").join(name)));
    assert_eq!(hashes[0]["state_hash"], hashes[1]["state_hash"]);
}

#[test]
fn the_summary_has_the_time_of_every_frame() {
    let folder = started();
    succeeds(folder.path(), &["run", "moving.toml", "--until", "0.25", "--no-picture"]);
    let summary = summary(&folder.path().join("out/moving"));
    let times = summary["frame_times"].as_array().expect("times");
    assert_eq!(summary["frames"], times.len());
    assert_eq!((&times[0], times.last()), (&0.0.into(), Some(&summary["simulated_seconds"])));
}

#[test]
fn progress_for_programs_is_one_json_object_a_line() {
    let folder = started();
    let arguments = ["run", "scene.toml", "--until", "0.05", "--progress", "json", "-q"];
    let output = drape(folder.path(), &arguments);
    let lines = String::from_utf8(output.stderr).expect("text");
    let steps: Vec<Value> =
        lines.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    assert_eq!(steps.len(), summary(&folder.path().join("out/scene"))["steps"]);
    assert!(steps.iter().all(|step| step["phase"] == "relax" && step["time"].is_f64()));
    // The time was over before the cloth came to rest: the run is done all the same.
    assert_eq!(done(&steps).last(), Some(&1.0));
}

/// Returns how much was done after each step, which never falls and is 1 after the last one alone.
fn done(steps: &[Value]) -> Vec<f64> {
    let done: Vec<f64> =
        steps.iter().map(|step| step["done"].as_f64().expect("a number")).collect();
    assert!(done.windows(2).all(|pair| pair[0] <= pair[1]), "{done:?}");
    let (last, before) = done.split_last().expect("a step");
    assert!(*last == 1.0 && before.iter().all(|done| *done < 1.0), "{done:?}");
    let finished = steps.iter().filter(|step| step["finished"] == true).count();
    assert_eq!((finished, &steps[steps.len() - 1]["finished"]), (1, &Value::Bool(true)));
    done
}

#[test]
fn progress_counts_evenly_to_rest_and_to_the_end_of_a_time() {
    let folder = started();
    let progress = |scene: &str, more: &[&str]| -> Vec<Value> {
        let arguments = [&["run", scene, "--progress", "json", "-q"], more].concat();
        let lines = String::from_utf8(drape(folder.path(), &arguments).stderr).expect("text");
        lines.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
    };
    // To rest: every step counts, and none for more than a quarter.
    let steps = progress("scene.toml", &[]);
    let to_rest = done(&steps);
    assert!(
        to_rest.windows(2).all(|pair| pair[0] < pair[1] && pair[1] - pair[0] < 0.25),
        "{to_rest:?}"
    );
    // In time: the part of the time.
    let steps = progress("moving.toml", &["--until", "0.1"]);
    for (step, done) in steps.iter().zip(done(&steps)) {
        let time = step["time"].as_f64().expect("a time");
        assert!((done - time / 0.1).abs() < 2e-3, "{done} at {time}");
    }
}

#[test]
fn a_terminal_gets_no_control_characters_from_the_input() {
    let folder = started();
    let path = folder.path().join("scene.toml");
    let text = std::fs::read_to_string(&path).expect("a scene");
    let bad = text.replace("name = \"cloth\"", "name = \"\\u001b[31mcloth\"\nmesh = \"\\u001b\"");
    std::fs::write(&path, bad).expect("writes");
    let message = fails(folder.path(), &["check", "scene.toml"], 3);
    assert!(!message.contains('\u{1b}'), "{message:?}");
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_a_summary_the_last_frame_and_a_checkpoint() {
    let folder = started();
    let out = folder.path().join("out/scene");
    let running = command(folder.path(), &["run", "scene.toml", "--threads", "1"]);
    let mut running = signals::hearing(&running);
    let running = running.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("it runs");
    let deadline = Instant::now() + Duration::from_secs(60);
    while !out.join("frame-00001.npy").exists() {
        assert!(Instant::now() < deadline, "no frame after a minute");
        std::thread::sleep(Duration::from_millis(5));
    }
    let id = running.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().expect("kill").success());
    let output = running.wait_with_output().expect("it ends");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{message}");
    let summary = summary(&out);
    assert_eq!(summary["status"], "interrupted");
    let last = summary["frames"].as_u64().expect("a count") - 1;
    assert!(out.join(format!("frame-{last:05}.npy")).exists());
    assert!(out.join("checkpoint-00000001.bin").exists());
}

#[test]
fn shells_and_man_know_every_command() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    succeeds(folder.path(), &["man", "-o", "man"]);
    for name in
        ["new", "fit", "fabric", "run", "resume", "validate", "test", "check", "bench", "schema"]
    {
        let page = std::fs::read_to_string(folder.path().join(format!("man/drape-{name}.1")));
        assert!(page.expect("a page").contains(".SH"), "drape-{name}.1");
        for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
            let script = succeeds(folder.path(), &["completions", shell]);
            assert!(script.contains(name), "{shell}: {name}");
        }
    }
    let help = succeeds(folder.path(), &["--help"]);
    for code in ["0 ", "2 ", "3 ", "4 ", "5 ", "6 ", "7 ", "8 ", "70", "130"] {
        assert!(help.contains(&format!("\n  {code}")), "exit code {code}");
    }
}

#[test]
fn checks_and_lists_have_a_form_for_programs() {
    let folder = started();
    std::fs::write(folder.path().join("wrong.toml"), "spacing = -1\n[time]\n").expect("writes");
    let output = drape(folder.path(), &["check", "scene.toml", "wrong.toml", "--json"]);
    assert_eq!(output.status.code(), Some(3));
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!((&found[0]["holds"], &found[1]["holds"]), (&true.into(), &false.into()));
    assert_eq!(found[0]["mistakes"], Value::Array(Vec::new()));
    let mistakes = found[1]["mistakes"].as_array().expect("mistakes");
    assert!(mistakes.iter().any(|mistake| mistake["line"].is_u64()), "{found}");
    for arguments in [&["list", "."][..], &["show", "sheet.toml"], &["compare", ".", "."]] {
        let printed = succeeds(folder.path(), &[&["fabric"], arguments, &["--json"]].concat());
        let value: Value = serde_json::from_str(&printed).expect("JSON");
        assert!(printed.contains("my fabric"), "{value}");
    }
}

#[test]
fn the_time_of_a_run_is_told_from_its_first_steps() {
    let folder = started();
    let told = succeeds(folder.path(), &["check", "--time", "scene.toml"]);
    let line = told.lines().find(|line| line.contains("time: ")).expect("a line of the time");
    assert!(
        line.contains("at the pace of the first") || line.contains("the whole run in"),
        "{line}"
    );
    let found: Value = serde_json::from_str(&succeeds(
        folder.path(),
        &["check", "--time", "--json", "scene.toml"],
    ))
    .expect("JSON");
    assert!(found[0]["time"].as_str().is_some_and(|time| time.starts_with("time: ")), "{found}");
    let told = succeeds(folder.path(), &["check", "scene.toml"]);
    assert!(!told.contains("time: "), "{told}");
}

#[test]
fn a_list_of_nowhere_fails() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let message = fails(folder.path(), &["fabric", "list", "nowhere"], 3);
    assert!(message.contains("nowhere"), "{message}");
}

/// Writes a mesh as OBJ.
fn write_obj(path: &Path, vertices: &[[f64; 3]], triangles: &[[usize; 3]]) {
    let lines = vertices.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let faces = triangles.iter().map(|t| {
        let [a, b, c] = t.map(|vertex| vertex + 1);
        format!("f {a} {b} {c}\n")
    });
    std::fs::write(path, lines.chain(faces).collect::<String>()).expect("writes");
}

#[test]
fn a_body_that_is_open_is_reported_repaired_and_then_taken() {
    let folder = started();
    let folder = folder.path();
    // A tent of four triangles on a square of 2 cm, which has lost its floor, one triangle turned.
    let vertices =
        [[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [-1.0, 0.0, 1.0], [0.0, 2.0, 0.0]];
    let vertices = vertices.map(|vertex| vertex.map(|x| 0.01 * x));
    write_obj(&folder.join("tent.obj"), &vertices, &[[0, 4, 1], [1, 4, 2], [2, 4, 3], [0, 3, 4]]);
    let tent = ["check", "tent.obj", "--scale", "1"];
    let report = String::from_utf8(drape(folder, &tent).stdout).expect("text");
    assert!(report.contains("not closed") && report.contains("hole: 4 edges"), "{report}");
    let said = fails(folder, &tent, 3);
    assert!(said.contains("a scene refuses it as well"), "{said}");

    let text = std::fs::read_to_string(folder.join("moving.toml")).expect("a scene");
    let ball = text.find("[[collider.sphere]]").expect("a ball");
    let mesh = "[[collider.mesh]]\nname = \"tent\"\nfile = \"tent.obj\"\n\n[contact]";
    let after = text.find("[contact]").expect("contact") + "[contact]".len();
    let scene = [&text[..ball], mesh, &text[after..]].concat();
    std::fs::write(folder.join("tent.toml"), &scene).expect("writes");
    let refused = fails(folder, &["check", "tent.toml"], 3);
    let commands: Vec<&str> =
        refused.split('`').filter(|part| part.starts_with("drape check")).collect();
    let [_, mend] = commands[..] else { panic!("no remedy in: {refused}") };
    let words: Vec<&str> = mend.split(' ').skip(1).collect();
    let mended = succeeds(folder, &[&words[..], &["--scale", "1", "--spacing", "20"]].concat());
    assert!(mended.contains("closed at"), "{mended}");
    let named = refused.split("file = \"").last().and_then(|rest| rest.split('"').next());
    let named = named.expect("a name");
    std::fs::write(folder.join("tent.toml"), scene.replace("tent.obj", named)).expect("writes");
    succeeds(folder, &["check", "tent.toml"]);
}

#[test]
fn a_body_in_centimetres_is_asked_for_its_unit() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let body = std::fs::read_to_string(root.join("scenes/bodies/body.obj")).expect("a body");
    let centimetres = |line: &str| match line.strip_prefix("v ") {
        Some(numbers) => {
            let numbers = numbers.split_whitespace().map(|x| x.parse::<f64>().expect("a number"));
            let numbers: Vec<String> = numbers.map(|x| format!("{}", 100.0 * x)).collect();
            format!("v {}\n", numbers.join(" "))
        }
        None => format!("{line}\n"),
    };
    std::fs::write(folder.join("body.obj"), body.lines().map(centimetres).collect::<String>())
        .expect("writes");
    let skirt = std::fs::read_to_string(root.join("scenes/skirt.toml")).expect("a scene");
    let patterns = format!("{}/scenes/patterns", root.display());
    let fabrics = format!("{}/fabrics", root.display());
    let scene = skirt
        .replace("\"patterns/", &format!("\"{patterns}/"))
        .replace("../fabrics", &fabrics)
        .replace("bodies/body.obj", "body.obj")
        .replace("spacing = 0.01", "spacing = 0.03");
    std::fs::write(folder.join("skirt.toml"), &scene).expect("writes");
    let check = ["check", "skirt.toml", "--allow-path", root.to_str().expect("text")];
    let refused = fails(folder, &check, 3);
    assert!(refused.contains("scale = 0.01"), "{refused}");
    let mended = scene.replace("file = \"body.obj\"", "file = \"body.obj\"\nscale = 0.01");
    std::fs::write(folder.join("skirt.toml"), mended).expect("writes");
    succeeds(folder, &check);
    let report = succeeds(folder, &["check", "body.obj"]);
    assert!(report.contains("centimetres") && report.contains("closed"), "{report}");
}

/// Runs a command with a file as its standard input.
fn piped(folder: &Path, arguments: &[&str], file: &str) -> Output {
    let input = std::fs::File::open(folder.join(file)).expect("it is there");
    command(folder, arguments).stdin(input).output().expect("it runs")
}

#[test]
fn a_dash_is_standard_input_and_output() {
    let folder = started();
    let folder = folder.path();
    let pipe = |arguments: &[&str], file: &str| {
        let output = piped(folder, arguments, file);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{arguments:?} said: {message}");
        String::from_utf8(output.stdout).expect("text")
    };
    let fabric = pipe(&["fit", "-", "-o", "-"], "sheet.toml");
    assert_eq!(fabric, succeeds(folder, &["fit", "sheet.toml", "-o", "-"]));
    std::fs::write(folder.join("fabric.toml"), &fabric).expect("writes");
    for (kind, first) in
        [("scene", "scene"), ("sheet", "sheet"), ("fabric", "fabric"), ("pattern", "pattern")]
    {
        let file = format!("{kind}.toml");
        let found = pipe(&["check", "-"], &file);
        assert!(found.starts_with(&format!("<standard input>: {first}")), "{found}");
        let named = succeeds(folder, &["check", &file]);
        assert_eq!(found.replace("<standard input>", &file), named);
    }
    for file in ["sheet.toml", "fabric.toml"] {
        let shown = pipe(&["fabric", "show", "-"], file);
        assert_eq!(shown, succeeds(folder, &["fabric", "show", file]), "{file}");
    }
    let converted = pipe(&["convert", "-", "-o", "-"], "pattern.toml");
    let named = succeeds(folder, &["convert", "pattern.toml"]);
    assert_eq!(converted.replace("<standard input>", "pattern.toml"), named);
    pipe(&["convert", "-", "-o", "pattern.svg"], "pattern.toml");
    // What is no TOML is told by its text.
    assert!(pipe(&["check", "-"], "pattern.svg").starts_with("<standard input>: pattern"));
    pipe(&["run", "-", "--until", "0.01", "--no-picture"], "moving.toml");
    succeeds(folder, &["run", "moving.toml", "--until", "0.01", "--no-picture"]);
    let hashes = ["standard-input", "moving"].map(|name| summary(&folder.join("out").join(name)));
    assert_eq!(hashes[0]["state_hash"], hashes[1]["state_hash"]);
}

#[test]
fn mistakes_of_standard_input_have_their_lines() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    std::fs::write(folder.join("a.toml"), "spacing = \"1 s\"\n[time]\nstep = 0.1\nend = 1\n")
        .expect("writes");
    std::fs::write(folder.join("b.toml"), b"name = \"crep\xe9\"\n").expect("writes");
    for arguments in [["check", "-"], ["run", "-"]] {
        let output = piped(folder, &arguments, "a.toml");
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(3), "{message}");
        assert!(message.contains("<standard input>:1:11"), "{message}");
        assert!(message.contains("1 | spacing = \"1 s\""), "{message}");
    }
    let output = piped(folder, &["fit", "-"], "b.toml");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{message}");
    assert!(message.contains("<standard input>: is not UTF-8"), "{message}");
}
