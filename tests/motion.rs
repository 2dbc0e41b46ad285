//! Motion of bodies after the cloth has come to rest, and cloth that is stretched beyond the
//! measurements of its fabric.

use std::path::Path;

use assert_cmd::Command;
use drape::frames::Recording;
use serde_json::Value;

const FABRIC: &str = include_str!("fabrics/plain-weave.toml");

/// Runs a scene in a folder; returns its summary, and the positions in its first and last frame.
fn run(folder: &Path, scene: &str, fabric: &str) -> (Value, [Vec<[f64; 3]>; 2]) {
    for (name, text) in [("scene.toml", scene), ("plain.toml", fabric)] {
        std::fs::write(folder.join(name), text).expect("written");
    }
    let output = folder.join("out");
    let mut command = Command::cargo_bin("drape").expect("the binary is built");
    command.arg("run").arg(folder.join("scene.toml")).arg("-o").arg(&output).arg("--json");
    let result = command.output().expect("it runs");
    assert!(result.status.success(), "{}", String::from_utf8_lossy(&result.stderr));
    let recording = Recording::open(&output).expect("a run");
    let frame = |number| recording.frame(number).expect("a frame").cloth;
    let summary = serde_json::from_slice(&result.stdout).expect("a summary");
    (summary, [0, recording.frame_count() - 1].map(frame))
}

#[test]
fn cloth_at_rest_on_a_table_turns_with_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n\
                 [[panel]]\nname = \"sheet\"\nfabric = \"plain\"\nrectangle = [0.2, 0.1]\n\
                 center = [0.05, 0.0012, 0]\nturn = [-90, 0, 0]\n\
                 [[collider.cylinder]]\nname = \"table\"\nradius = 0.3\nheight = 0.1\ncenter = [0, -0.05, 0]\n\
                 friction = 0.5\n\
                 [collider.cylinder.motion]\ntimes = [0, 0.2, 0.8, 1]\n\
                 turn = [[0, 0, 0], [0, 10, 0], [0, 80, 0], [0, 90, 0]]\n\
                 [contact]\nsurfaces = true\n[time]\nstep = 0.005\nend = 20\n[settle]\n[motion]\nseconds = 1.2\n";
    let (summary, [start, end]) = run(folder.path(), scene, FABRIC);
    assert_eq!((&summary["status"], &summary["settled"]), (&"ok".into(), &true.into()));
    let phases = summary["phases"].as_array().expect("phases");
    assert_eq!([&phases[0]["name"], &phases[1]["name"]], ["relax", "simulate"]);
    let rest = phases[1]["start"].as_f64().expect("a time");
    let whole = summary["simulated_seconds"].as_f64().expect("a time");
    // The table begins to turn when the cloth rests, and not before.
    assert!((whole - rest - 1.2).abs() < 0.006, "{rest} s of {whole} s");
    // A quarter of a turn about y takes x to -z. The tangential acceleration of some m/s² is less
    // than friction can hold.
    let off = start.iter().zip(&end).map(|([x, _, z], now)| (now[0] - z).hypot(now[2] + x));
    let off = off.fold(0.0, f64::max);
    assert!(off < 5e-4, "off by {} mm", 1e3 * off);
    assert!(summary["warnings"].as_array().expect("a list").is_empty(), "{}", summary["warnings"]);
}

#[test]
fn cloth_that_is_stretched_beyond_its_measurements_gets_a_warning() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = "spacing = 0.01\ngravity = [0, 0, 0]\nfabric.plain.file = \"plain.toml\"\n\
                 [[panel]]\nname = \"strip\"\nfabric = \"plain\"\nrectangle = [0.05, 0.1]\n\
                 [[pin]]\npanel = \"strip\"\nedge = \"bottom\"\n\
                 [[pin]]\npanel = \"strip\"\nedge = \"top\"\n\
                 [pin.motion]\ntimes = [0, 0.5]\nshift = [[0, 0, 0], [0, 0.002, 0]]\n\
                 [time]\nstep = 0.01\nend = 0.6\n";
    for (reach, told) in [(0.015, true), (0.025, false)] {
        let fabric = format!(
            "{FABRIC}\n[provenance]\nsheet = \"plain\"\nfitted_by = \"hand\"\n\
             reach = {{ \"warp.traction\" = {reach}, shear = 0.9 }}\n"
        );
        let out = folder.path().join("out");
        if out.exists() {
            std::fs::remove_dir_all(&out).expect("removed");
        }
        let (summary, _) = run(folder.path(), scene, &fabric);
        let warnings = summary["warnings"].to_string();
        assert_eq!(warnings.contains("stretch along the warp reaches 2."), told, "{warnings}");
        assert_eq!(warnings.contains("measured up to 1.5 %"), told, "{warnings}");
        assert!(!warnings.contains("shear"), "{warnings}");
    }
}

#[test]
fn cloth_that_is_deformed_beyond_what_is_plausible_gets_a_warning_with_the_place() {
    // A strip of 0.1 m whose upper edge is led by a shift, in m. Its fabric has no ranges.
    let warnings_after = |shift: [f64; 2]| {
        let folder = tempfile::tempdir().expect("a folder");
        let [x, y] = shift;
        let scene = format!(
            "spacing = 0.01\ngravity = [0, 0, 0]\nfabric.plain.file = \"plain.toml\"\n\
             [[panel]]\nname = \"strip\"\nfabric = \"plain\"\nrectangle = [0.05, 0.1]\n\
             [[pin]]\npanel = \"strip\"\nedge = \"bottom\"\n\
             [[pin]]\npanel = \"strip\"\nedge = \"top\"\n\
             [pin.motion]\ntimes = [0, 0.5]\nshift = [[0, 0, 0], [{x}, {y}, 0]]\n\
             [time]\nstep = 0.01\nend = 0.6\n"
        );
        let (summary, _) = run(folder.path(), &scene, FABRIC);
        summary["warnings"].to_string()
    };
    // Stretched by 8 and by 30 %.
    assert_eq!(warnings_after([0.0, 0.008]), "[]");
    let stretched = warnings_after([0.0, 0.03]);
    assert!(stretched.contains("stretch along the warp reaches 3"), "{stretched}");
    assert!(stretched.contains("in \\\"strip\\\" near ("), "{stretched}");
    assert!(stretched.contains("doubtful beyond 10.0 %"), "{stretched}");
    assert!(!stretched.contains("shear"), "{stretched}");
    // The upper edge moves on a circle about the lower one, so that the warp keeps its length and
    // turns by 60 degrees.
    let sheared = warnings_after([0.0866, -0.05]);
    assert!(sheared.contains("shear reaches ") && sheared.contains("beyond 45.0°"), "{sheared}");
    assert!(!sheared.contains("stretch along the weft"), "{sheared}");
}

/// Root-mean-square distance of two lists of positions, in m.
fn distance(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let square =
        |(a, b): (&[f64; 3], &[f64; 3])| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>();
    (a.iter().zip(b).map(square).sum::<f64>() / a.len() as f64).sqrt()
}

#[test]
fn the_solver_errs_a_tenth_of_what_the_steps_do() {
    let folder = tempfile::tempdir().expect("a folder");
    let swing = |solver: &str| {
        let scene = format!(
            "spacing = 0.04\nair.density = 0\nfabric.plain.file = \"plain.toml\"\n{solver}\n\
             [contact]\nsurfaces = false\n[[panel]]\nname = \"sheet\"\nfabric = \"plain\"\n\
             rectangle = [1, 1]\nturn = [-90, 0, 0]\n[[pin]]\npanel = \"sheet\"\n\
             points = [[0, 1], [1, 1]]\n[time]\nstep = {}\nend = 0.3\n[output]\nevery = 0.3\n",
            if solver.contains("1e-6") { 0.001 } else { 0.005 },
        );
        let folder = folder.path().join(solver.len().to_string());
        std::fs::create_dir_all(&folder).expect("a folder");
        let (summary, [_, end]) = run(&folder, &scene, FABRIC);
        (summary["solver"]["tangents"].as_u64().expect("a number"), end)
    };
    let (most, exact) = swing("solver.error_fraction = 0");
    let (_, short) = swing("solver = { error_fraction = 0, tolerance = 1e-6 }");
    let (fewer, usual) = swing("");
    let [step, solver] = [&short, &usual].map(|end| distance(end, &exact));
    assert!(solver < 0.1 * step, "{solver:e} m beside {step:e} m");
    assert!(4 * fewer < 3 * most, "{fewer} tangents instead of {most}");
}
