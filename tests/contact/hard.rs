//! Hard scenes: thin ribbons, many layers, fast bodies, sharp edges, pinched cloth, long runs. No
//! surface passes through another, and the check says what the run says.

use toml::Table;

use crate::{drape, root};

/// Number of starts of each scene, which differ by their noise.
const STARTS: i64 = 4;

/// Returns the hard scenes by their names.
fn scenes() -> Table {
    let path = root().join("tests/contact/hard.toml");
    let text = std::fs::read_to_string(path).expect("it ships");
    let mut scenes: Table = toml::from_str(&text).expect("TOML");
    scenes.remove("scene").and_then(|scenes| scenes.try_into().ok()).expect("scenes")
}

/// Runs the scene `name` from the start number `start` and checks its frames.
fn run_and_check(name: &str, mut scene: Table, start: i64) {
    let panels = scene["panel"].as_array_mut().expect("panels").iter_mut();
    for (number, panel) in panels.enumerate() {
        let noise = panel["noise"].as_table_mut().expect("noise");
        noise.insert("seed".into(), (1 + start + 7 * number as i64).into());
    }
    let folder = tempfile::tempdir().expect("a folder");
    let fabric = include_str!("../fabrics/plain-weave.toml");
    std::fs::write(folder.path().join("plain.toml"), fabric).expect("written");
    scene.insert("fabric".into(), toml::toml! { plain = { file = "plain.toml" } }.into());
    std::fs::write(folder.path().join("scene.toml"), scene.to_string()).expect("written");

    let mut run = drape();
    run.current_dir(folder.path()).args(["run", "scene.toml", "-o", "out", "--no-picture", "-q"]);
    let run = run.output().expect("it runs");
    let mut check = drape();
    check.current_dir(folder.path()).args(["check", "out", "-q"]);
    let check = check.output().expect("it runs");
    let [told, found] = [&run, &check].map(|end| String::from_utf8_lossy(&end.stderr).into_owned());
    assert_eq!(run.status.code(), Some(0), "{name} from start {start}: {told}");
    assert_eq!(check.status.code(), Some(0), "{name} from start {start}: {found}");

    let summary = std::fs::read(folder.path().join("out/summary.json")).expect("a summary");
    let summary: serde_json::Value = serde_json::from_slice(&summary).expect("JSON");
    assert_eq!(summary["contact"]["intersections_max"], 0, "{name} from start {start}");
}

#[test]
fn a_strip_a_blade_and_a_pinch_keep_surfaces_apart() {
    for (name, scene) in scenes() {
        if ["twist2", "blade", "snap", "drag-edge"].contains(&&*name) {
            run_and_check(&name, scene.try_into().expect("a scene"), 0);
        }
    }
}

#[test]
#[ignore = "takes minutes"]
fn twenty_hard_scenes_from_four_starts_keep_surfaces_apart() {
    let scenes = scenes();
    assert_eq!(scenes.len(), 20);
    for (name, scene) in scenes {
        let scene: Table = scene.try_into().expect("a scene");
        for start in 0..STARTS {
            run_and_check(&name, scene.clone(), start);
        }
    }
}
