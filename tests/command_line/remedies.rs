//! Remedies that messages of runs advise: each is taken, and the run then ends well.

#![allow(clippy::unwrap_used)]

use std::path::PathBuf;
use std::process::{Command, Output};

const FABRIC: &str = include_str!("../fabrics/plain-weave.toml");

/// Folder with a scene and its fabric.
struct Folder {
    folder: tempfile::TempDir,
}

impl Folder {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("plain.toml"), FABRIC).unwrap();
        Self { folder }
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    }

    /// Runs `drape` with `arguments` and returns its exit code and its messages.
    fn drape(&self, arguments: &[&str]) -> (Option<i32>, String) {
        let mut command = Command::new(env!("CARGO_BIN_EXE_drape"));
        let Output { status, stderr, .. } =
            command.current_dir(self.folder.path()).args(arguments).output().unwrap();
        (status.code(), String::from_utf8_lossy(&stderr).into_owned())
    }

    /// Runs the scene `text` with `settings`.
    fn run(&self, text: &str, settings: &[&str]) -> (Option<i32>, String) {
        self.write("scene.toml", text);
        let mut arguments = vec!["run", "scene.toml", "--force", "--no-picture", "-q", "-o", "out"];
        settings.iter().for_each(|setting| arguments.extend(["--set", setting]));
        self.drape(&arguments)
    }
}

/// Returns the setting that `message` advises after the words `write `.
fn advised<'a>(message: &'a str, key: &str) -> &'a str {
    let start = message.find(&format!("write {key} = ")).expect(message) + "write ".len();
    let rest = &message[start..];
    rest.split([',', '\n']).next().unwrap().trim_end()
}

/// Returns the scene of a sheet that two balls close on, which end `gap` apart, in m.
fn closing_balls(gap: f64) -> String {
    let ball = |name: &str, side: f64| {
        let way = -side * (0.02 - gap / 2.0);
        format!(
            "[[collider.sphere]]\nname = \"{name}\"\nradius = 0.03\ncenter = [0, 0, {}]\n\
             motion = {{ times = [0.0, 0.2], shift = [[0, 0, 0], [0, 0, {way}]] }}\n",
            0.05 * side
        )
    };
    format!(
        "name = \"closing\"\nspacing = 0.02\nfabric.plain.file = \"plain.toml\"\n\
         panel = [{{ name = \"sheet\", fabric = \"plain\", rectangle = [0.2, 0.2] }}]\n\
         pin = [{{ panel = \"sheet\", edge = \"top\" }}]\n{}{}[time]\nstep = 0.005\nend = 0.3\n",
        ball("front", 1.0),
        ball("back", -1.0)
    )
}

#[test]
fn cloth_between_two_bodies_is_kept_by_the_treatment_that_is_advised() {
    let folder = Folder::new();
    let (code, message) = folder.run(&closing_balls(1.2e-4), &[]);
    assert_eq!(code, Some(5), "{message}");
    assert!(message.contains("\"front\"") && message.contains("\"back\""), "{message}");
    let thin = advised(&message, "contact.pinch");
    assert_eq!(thin, "contact.pinch = \"thin\"");
    let (code, message) = folder.run(&closing_balls(1.2e-4), &[thin]);
    assert_eq!(code, Some(0), "with {thin}: {message}");

    // With the thinnest cloth only room is left to advise, and room helps.
    let (code, message) = folder.run(&closing_balls(-1e-3), &[thin]);
    assert_eq!(code, Some(5), "{message}");
    assert!(message.contains("leave more room between them"), "{message}");
    assert!(!message.contains("write contact.pinch"), "{message}");
    let (code, message) = folder.run(&closing_balls(2e-3), &[]);
    assert_eq!(code, Some(0), "with more room: {message}");
}

#[test]
fn a_step_that_rounding_keeps_from_its_tolerance_is_solved_with_the_one_that_is_advised() {
    let folder = Folder::new();
    let root = env!("CARGO_MANIFEST_DIR");
    let scene = format!("{root}/scenes/tablecloth.toml");
    let run = |tolerance: &str| {
        let set = [
            "--set",
            "solver.error_fraction=0",
            "--set",
            "spacing=\"20 mm\"",
            "--set",
            tolerance,
            "--until",
            "0.02",
        ];
        let files = ["run", &scene, "--allow-path", root, "-o", "out", "--force", "--no-picture"];
        folder.drape(&[&files[..], &set].concat())
    };
    let (code, message) = run("solver.tolerance = 1e-10");
    assert_eq!(code, Some(5), "{message}");
    let advice = advised(&message, "solver.tolerance").to_owned();
    let (code, message) = run(&advice);
    assert!(!message.contains("did not converge"), "with {advice}: {message}");
    assert_eq!(code, Some(0), "with {advice}: {message}");
}

#[test]
fn a_panel_that_slid_off_is_told_and_rests_with_a_pin_or_a_floor() {
    let folder = Folder::new();
    let scene = |more: &str| {
        format!(
            "name = \"lone\"\nspacing = 0.03\nfabric.plain.file = \"plain.toml\"\n\
             panel = [{{ name = \"cloth\", fabric = \"plain\", rectangle = [0.3, 0.3], center = [0.1, 0.23, 0], turn = [90, 0, 0] }}]\n\
             time = {{ step = 0.005, end = 30 }}\nsettle = {{}}\n{more}\n"
        )
    };
    let ball = "[[collider.sphere]]\nname = \"ball\"\nradius = 0.1\ncenter = [0, 0.1, 0]";
    let floor = "[[collider.plane]]\nname = \"floor\"";
    let of_panel = |more: &str| folder.run(&scene(more), &[]);

    let (code, message) = of_panel(ball);
    assert_eq!(code, Some(5), "{message}");
    assert!(message.contains("the panel \"cloth\" fell off"), "{message}");
    assert!(message.contains("put a body below it") && !message.contains("more time"), "{message}");
    let pinned = format!("{ball}\n[[pin]]\npanel = \"cloth\"\npoints = [[0.0, 0.3]]");
    for held in [format!("{ball}\n{floor}"), pinned] {
        let (code, message) = of_panel(&held);
        assert_eq!(code, Some(0), "{message}");
    }

    // Without a body nothing can hold it.
    let (code, message) = of_panel("");
    assert_eq!(code, Some(5), "{message}");
    assert!(message.contains("the panel \"cloth\" falls"), "{message}");
    assert!(!message.contains("more time"), "{message}");
}

#[test]
fn a_mistake_in_a_seam_of_the_scene_is_placed_there() {
    let folder = Folder::new();
    folder.write(
        "pattern.toml",
        "length = \"mm\"\n\
         panel.front = { grain = 0, rectangle = [300, 400], origin = [0, 0, 60] }\n\
         panel.back = { grain = 0, rectangle = [300, 400], origin = [0, 0, -60] }\n\
         seam.side = { sides = [[\"front.right\"], [\"back.right\"]], reversed = true }\n\
         seam.top = { sides = [[\"front.top\"], [\"back.top\"]], reversed = true }\n",
    );
    let garment = "[[garment]]\nname = \"NAME\"\npattern = \"pattern.toml\"\nfabric = \"plain\"\n";
    let (one, two) = (garment.replace("NAME", "one"), garment.replace("NAME", "two"));
    let head =
        "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\ntime = { step = 0.005, end = 0.5 }\n";
    let sides =
        |front: &str, back: &str| format!("sides = [[\"front.{front}\"], [\"back.{back}\"]]");
    let cases = [
        ("side", format!("{}\nreversed = false", sides("right", "right")), "reversed"),
        ("left", format!("{}\nreversed = false", sides("left", "left")), "reversed"),
        ("left", sides("lefft", "left"), "no edge"),
        ("left", format!("{}\nreversed = true", sides("left", "bottom")), "max_ease"),
        ("again", format!("{}\nreversed = true", sides("right", "left")), "sewn twice"),
        ("zip", format!("{}\nreversed = true", sides("top", "bottom")), "sewn twice"),
        ("left", format!("{}\nallowance = 4", sides("left", "left")), "allowance"),
    ];
    for (seam, table, words) in cases {
        let text = format!(
            "{head}{one}panel.front.layer = 0\n{two}center = [1, 0, 0]\n[garment.seam.{seam}]\n{table}\n"
        );
        let first_line =
            text.lines().position(|line| line.starts_with("[garment.seam")).unwrap() + 1;
        folder.write("scene.toml", &text);
        let (code, message) = folder.drape(&["check", "scene.toml"]);
        assert_eq!(code, Some(3), "{seam}, {words}: {message}");
        assert!(message.contains(words), "{seam}, {words}: {message}");
        let place = message.split("--> scene.toml:").nth(1).expect(&message);
        let line: usize = place.split(':').next().unwrap().parse().unwrap();
        let lines = first_line..first_line + 1 + table.lines().count();
        assert!(lines.contains(&line), "{seam}, {words}: line {line}, not {lines:?}: {message}");
        assert!(message.contains(&format!("garment[1].seam.{seam}")), "{message}");
    }
}
