//! Panels that start apart although their pattern has them cross, and girths that are girths.
#![allow(clippy::unwrap_used)]

use drape_fabric::samples;
use drape_input::Document;
use drape_scene::Scene;

const FABRIC: &str = samples::PLAIN_WEAVE;

/// Reads a garment of a pattern about a column, or returns what is said about it.
fn read(pattern: &str, column: &str) -> Result<Scene, String> {
    let documents = [Document::new("plain.toml", FABRIC), Document::new("own.toml", pattern)];
    let text = format!(
        "spacing = 0.01\nfabric.plain.file = \"plain.toml\"\n[[garment]]\nname = \"own\"\npattern = \"own.toml\"\n\
         fabric = \"plain\"\n{column}\n[contact]\noffset = 0.003\n[time]\nstep = 0.005\nend = 1\n[settle]\n"
    );
    let scene = Scene::from_documents(&Document::new("scene.toml", text), &documents);
    scene.map_err(|error| error.to_string())
}

fn column(radius: f64) -> String {
    format!("[[collider.cylinder]]\nradius = {radius}\nheight = 1.5\ncenter = [0, 0.75, 0]")
}

/// Returns how far each panel of a scene lies from where it does in another, in m: the way of its
/// first particle, which all its particles have gone.
fn ways(scene: &Scene, before: &Scene) -> Vec<[f64; 3]> {
    let way = |particle: usize| {
        let at = |scene: &Scene, k: usize| scene.start.positions[3 * particle + k];
        [0, 1, 2].map(|k| at(scene, k) - at(before, k))
    };
    let of = |panel: &drape_scene::Panel| {
        let first = way(panel.first);
        let is_same = |other: [f64; 3]| (0..3).all(|k| (other[k] - first[k]).abs() < 1e-12);
        assert!(panel.particles().all(|particle| is_same(way(particle))), "{}", panel.name);
        first
    };
    scene.panels.iter().map(of).collect()
}

/// Two panels that are sewn to each other, the right one where it is put.
const SIDE_BY_SIDE: &str = r#"length = "mm"
[panel.left]
grain = 0
rectangle = [100, 60]
origin = [-100, 0, 0]
edges = ["hem", "side", "top", "fold"]
[panel.right]
grain = 0
rectangle = [80, 60]
RIGHT
edges = ["hem", "fold", "top", "side"]
"#;
const SEWN: &str = "[seam.middle]\nsides = [[\"left.side\"], [\"right.side\"]]\n";

#[test]
fn panels_that_overlap_at_their_seam_are_moved_apart_and_that_is_told() {
    let pattern = |right: &str| SIDE_BY_SIDE.replace("RIGHT", right);
    let unsewn = pattern("origin = [-3, 0, 0]");
    assert!(read(&unsewn, "").unwrap().source.note_lines().join("\n").contains("away from"));
    for (right, apart) in [
        // In one plane, over each other by 0.4, 3 and 8 mm; and askew.
        ("origin = [-0.4, 0, 0]", "origin = [40, 0, 0]"),
        ("origin = [-3, 0, 0]", "origin = [40, 0, 0]"),
        ("origin = [-8, 1, 0]", "origin = [40, 1, 0]"),
        ("origin = [-3, 0, 0]\nturn = [0, 0, 4]", "origin = [40, 0, 0]\nturn = [0, 0, 4]"),
        // At a right angle, through each other by 3 mm.
        ("origin = [-5, 0, 3]\nturn = [0, 90, 0]", "origin = [40, 0, 3]\nturn = [0, 90, 0]"),
    ] {
        let scene = read(&[&pattern(right), SEWN].concat(), "").unwrap();
        let notes = scene.source.note_lines().join("\n");
        assert!(notes.contains("\"own.left\" starts ") && notes.contains("away from"), "{notes}");
        let elsewhere = read(&[&pattern(apart), SEWN].concat(), "").unwrap();
        assert!(!elsewhere.source.note_lines().join("\n").contains("away from"));
        let [left, _] = ways(&scene, &elsewhere)[..] else { panic!("two panels") };
        let way = left.iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!((1e-4..0.008).contains(&way), "{right}: {way} m");
    }
    // What stands in another panel unsewn, or far over it, is a mistake.
    let unsewn = pattern("origin = [-5, 0, 3]\nturn = [0, 90, 0]");
    assert!(read(&unsewn, "").unwrap_err().contains("surfaces cross at the start"));
    let far = [&pattern("origin = [-60, 0, 0]"), SEWN].concat();
    assert!(read(&far, "").unwrap_err().contains("surfaces cross at the start"));
}

/// A tunnel of two flat panels in front of a column and behind it.
const TUNNEL: &str = r#"length = "mm"
[panel.front]
grain = 0
start = [-200, 0]
outline = [
    { name = "hem", to = [200, 0] },
    { name = "left", to = [200, 300] },
    { name = "top", to = [-200, 300] },
    { name = "right", to = [-200, 0] },
]
origin = [0, 600, FRONT]
[panel.back]
grain = 0
start = [-200, 0]
outline = [
    { name = "hem", to = [200, 0] },
    { name = "left", to = [200, 300] },
    { name = "top", to = [-200, 300] },
    { name = "right", to = [-200, 0] },
]
origin = [0, 600, -150]
[seam.left]
sides = [["front.left"], ["back.left"]]
reversed = true
[seam.right]
sides = [["front.right"], ["back.right"]]
reversed = true
"#;

#[test]
fn a_panel_that_is_a_little_inside_a_body_is_moved_out_of_it() {
    let at = |front: &str| read(&TUNNEL.replace("FRONT", front), &column(0.1));
    let free = at("150").unwrap();
    assert!(!free.source.note_lines().join("\n").contains("out of a body"));
    let scene = at("97").unwrap();
    let notes = scene.source.note_lines().join("\n");
    assert!(
        notes.contains("panel \"own.front\" starts ") && notes.contains("out of a body"),
        "{notes}"
    );
    assert!(!notes.contains("own.back"), "{notes}");
    let front = scene.panels.iter().position(|panel| panel.name == "own.front").unwrap();
    let way = ways(&scene, &free)[front];
    let height = 0.15 + way[2];
    assert!((0.1..0.11).contains(&height) && way[0] == 0.0 && way[1] == 0.0, "{way:?}");
    // One that is in the middle of the body is a mistake of its place.
    let said = at("20").unwrap_err();
    assert!(said.contains("starts inside the body"), "{said}");
}

/// Front and back of a skirt, whose waists are sewn to bands and dip between tips at their sides.
const TIPS: &str = r#"length = "mm"
[panel.front]
grain = 0
start = [-200, 0]
outline = [
    { name = "hem", to = [200, 0] },
    { name = "left", to = [100, 250] },
    { name = "waist", to = [-100, 250], radius = -150 },
    { name = "right", to = [-200, 0] },
]
origin = [0, 600, 90]
[panel.back]
grain = 0
start = [-200, 0]
outline = [
    { name = "hem", to = [200, 0] },
    { name = "left", to = [100, 250] },
    { name = "waist", to = [-100, 250], radius = -150 },
    { name = "right", to = [-200, 0] },
]
origin = [0, 600, -90]
[panel.band_front]
grain = 90
rectangle = [218.9, 40]
origin = [-109.45, 860, 90]
edges = ["bottom", "left", "top", "right"]
[panel.band_back]
grain = 90
rectangle = [218.9, 40]
origin = [-109.45, 860, -90]
edges = ["bottom", "left", "top", "right"]
[seam.left]
sides = [["front.left"], ["back.left"]]
reversed = true
[seam.right]
sides = [["front.right"], ["back.right"]]
reversed = true
[seam.band_left]
sides = [["band_front.left"], ["band_back.left"]]
reversed = true
[seam.band_right]
sides = [["band_front.right"], ["band_back.right"]]
reversed = true
[seam.waist_front]
sides = [["front.waist"], ["band_front.bottom"]]
[seam.waist_back]
sides = [["back.waist"], ["band_back.bottom"]]
"#;

#[test]
fn tips_beside_a_waist_are_no_girth() {
    let scene = read(TIPS, &column(0.06)).unwrap();
    let notes = scene.source.note_lines().join("\n");
    assert!(!notes.contains("too narrow"), "{notes}");
    // Where the band itself is too narrow, it is told with its seams, and the scene holds.
    let scene = read(TIPS, &column(0.078)).unwrap();
    let notes = scene.source.note_lines().join("\n");
    assert!(notes.contains("\"own\" is too narrow at a height of 0.8"), "{notes}");
    assert!(notes.contains("with seams \"band_left\", \"band_right\" measure 438 mm"), "{notes}");
}

#[test]
fn a_waist_of_660_mm_on_a_body_of_669_mm_is_told() {
    let pattern = TUNNEL.replace("200", "165").replace("FRONT", "150");
    let notes = |girth: f64| {
        let column = column(1e-3 * girth / std::f64::consts::TAU);
        read(&pattern, &column).unwrap().source.note_lines().join("\n")
    };
    let told = notes(669.0);
    assert!(told.contains("with seams \"left\", \"right\" measure 660 mm round"), "{told}");
    assert!(told.contains("and the body's hull 66"), "{told}");
    assert!(!notes(600.0).contains("too narrow"));
}
