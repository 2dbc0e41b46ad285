//! What a garment does not say rightly is answered, and the remedy of each answer works.
#![allow(clippy::unwrap_used)]

use drape_fabric::samples;
use drape_input::{Document, Remedy};
use drape_scene::Scene;

const FABRIC: &str = samples::PLAIN_WEAVE;

/// A skirt round a column of 200 mm across: a front, two halves of a back, and a band.
const SKIRT: &str = r#"length = "mm"
[panel.front]
grain = 0
start = [-HALF, 0]
outline = [
    { name = "hem", to = [HALF, 0] },
    { name = "left", to = [HALF, 250] },
    { name = "top", to = [-HALF, 250] },
    { name = "right", to = [-HALF, 0] },
]
origin = [0, 600, 125]
wrap = 125
[panel.back]
grain = 0
start = [-HALF, 0]
outline = [
    { name = "hem", to = [HALF, 0] },
    { name = "right", to = [HALF, 250] },
    { name = "top_right", to = [100, 250] },
    { name = "top_left", to = [-HALF, 250] },
    { name = "left", to = [-HALF, 0] },
]
origin = [0, 600, -125]
turn = [0, 180, 0]
wrap = 125
[panel.band]
grain = 90
start = [-HALF, 0]
outline = [
    { name = "bottom", to = [HALF, 0] },
    { name = "right", to = [HALF, 60] },
    { name = "top", to = [-HALF, 60] },
    { name = "left", to = [-HALF, 0] },
]
origin = [0, 865, -125]
turn = [0, 180, 0]
wrap = 125
[seam.side_left]
sides = [["front.left"], ["back.left"]]
[seam.side_right]
sides = [["back.right"], ["front.right"]]
[seam.waist]
sides = [["back.top_right", "back.top_left"], ["band.bottom"]]
reversed = false
"#;

fn pattern(half: f64) -> String {
    SKIRT.replace("HALF", &half.to_string())
}

/// Reads the skirt at a centre, or returns what is said about it.
fn read(pattern: &str, more: &str) -> Result<Scene, String> {
    read_at(0.02, pattern, more)
}

/// Reads the skirt at a spacing, in m, and a centre, or returns what is said about it.
fn read_at(spacing: f64, pattern: &str, more: &str) -> Result<Scene, String> {
    let documents = [Document::new("plain.toml", FABRIC), Document::new("skirt.toml", pattern)];
    let text = format!(
        "spacing = {spacing}\nfabric.plain.file = \"plain.toml\"\n[[garment]]\npattern = \"skirt.toml\"\n\
         fabric = \"plain\"\n{more}\n[[collider.cylinder]]\nradius = 0.1\nheight = 1.5\n\
         center = [0, 0.75, 0]\n[contact]\noffset = 0.003\n[time]\nstep = 0.005\nend = 1\n[settle]\n"
    );
    let scene = Scene::from_documents(&Document::new("scene.toml", text), &documents);
    scene.map_err(|error| error.to_string())
}

/// Returns what stands between two texts.
fn between<'a>(text: &'a str, before: &str, after: &str) -> &'a str {
    let rest = text.split(before).nth(1).unwrap_or_else(|| panic!("no {before} in {text}"));
    rest.split(after).next().unwrap()
}

#[test]
fn a_garment_that_fits_is_not_remarked_on() {
    let scene = read(&pattern(170.0), "").unwrap();
    assert!(scene.source.notes.is_empty(), "{:?}", scene.source.notes);
}

#[test]
fn a_reversed_seam_is_answered_with_the_sense_that_fits() {
    let good = "sides = [[\"front.left\"], [\"back.left\"]]";
    let wrong = pattern(170.0).replace(good, &format!("{good}\nreversed = true"));
    let said = read(&wrong, "").unwrap_err();
    assert!(said.contains("seam.side_left: the seam is reversed: its stitches are"), "{said}");
    let line = between(&said, "[seam.side_left]: ", "; or");
    assert_eq!(line, format!("{good}, without reversed = true"));
    assert!(read(&wrong.replace("reversed = true", ""), "").is_ok());
    // The twist may be meant.
    assert!(read(&wrong, "[sew]\ntwisted = [\"side_left\"]").is_ok());
    let said = read(&wrong, "[sew]\ntwisted = [\"side_lef\"]").unwrap_err();
    assert!(said.contains("did you mean \"side_left\"?"), "{said}");
}

#[test]
fn a_twisted_seam_is_answered_with_the_order_that_fits() {
    let good =
        "sides = [[\"back.top_right\", \"back.top_left\"], [\"band.bottom\"]]\nreversed = false";
    let unequal = pattern(170.0).replace("[100, 250]", "[0, 250]");
    // Backwards is no other seam, as long as both sides are.
    let backwards =
        "sides = [[\"back.top_left\", \"back.top_right\"], [\"band.bottom\"]]\nreversed = false";
    assert!(read(&unequal.replace(good, backwards), "").is_ok());
    // Two parts of the band that contradict the back.
    let parts =
        "{ name = \"bottom\", to = [0, 0] },\n    { name = \"bottom_right\", to = [170, 0] },";
    let whole = "{ name = \"bottom\", to = [170, 0] },";
    let crossed = "sides = [[\"back.top_right\", \"back.top_left\"], [\"band.bottom\", \"band.bottom_right\"]]";
    assert!(unequal.contains(whole));
    let wrong = unequal.replace(whole, parts).replace(good, crossed);
    let said = read(&wrong, "").unwrap_err();
    assert!(said.contains("seam.waist: the seam is twisted: its stitches are"), "{said}");
    let line = between(&said, "[seam.waist]: ", "; or").to_owned();
    let mended = wrong.replace(crossed, &line);
    assert!(read(&mended, "").is_ok(), "{said}");
}

#[test]
fn a_garment_beside_its_body_gets_the_centre_at_which_it_is_about_it() {
    for (center, words) in [
        ("[0, -0.95, 0]", "\"skirt\" starts at the feet of the body, not about it"),
        ("[0.4, 0, 0.1]", "\"skirt\" starts beside the body, not about it"),
        ("[0, 1.0, 0]", "\"skirt\" starts above the body, not about it"),
        ("[0.05, 0, 0]", "of \"skirt\" starts inside the body"),
    ] {
        let said = read(&pattern(170.0), &format!("center = {center}")).unwrap_err();
        assert!(said.contains(words), "{said}");
        let center = between(&said, "write ", " in its [[garment]]").to_owned();
        let scene = read(&pattern(170.0), &center);
        let scene = scene.unwrap_or_else(|said| panic!("{center}: {said}"));
        assert!(scene.source.notes.is_empty(), "{:?}", scene.source.notes);
    }
}

#[test]
fn a_skirt_that_is_too_narrow_is_answered_with_what_is_missing() {
    // Only the sewing shows whether it closes.
    let said = read(&pattern(130.0), "").unwrap().source.note_lines().join("\n");
    assert!(said.contains("\"skirt\" is too narrow at a height of"), "{said}");
    assert!(said.contains("with seams \"side_left\", \"side_right\" measure 520 mm"), "{said}");
    assert!(said.contains(" mm round, and the body's hull 62"), "{said}");
    assert!(said.contains("its seams may stay open"), "{said}");
    let missing: f64 = between(&said, "widen it there by ", " mm").parse().unwrap();
    // There are two panels, each with two sides.
    let wider = read(&pattern(130.0 + 0.25 * missing), "").unwrap();
    assert!(!wider.source.note_lines().join("\n").contains("would stretch"), "{missing} mm more");
    // Where little is missing, the seams close.
    let scene = read(&pattern(158.0), "").unwrap();
    let notes = scene.source.note_lines().join("\n");
    assert!(
        notes.contains("\"skirt\" is too narrow") && notes.contains("would stretch by"),
        "{notes}"
    );
    assert!(!notes.contains("its seams may stay open"), "{notes}");
    assert!(!notes.contains("choose a smaller spacing"), "{notes}");
}

#[test]
fn a_skirt_whose_polygon_is_too_narrow_fits_at_the_smaller_spacing_that_is_advised() {
    let notes = |spacing| read_at(spacing, &pattern(162.5), "").unwrap().source.note_lines();
    let told = notes(0.05).join("\n");
    assert!(told.contains(" mm in all, choose a smaller spacing, or start it"), "{told}");
    assert_eq!(notes(0.02), Vec::<String>::new());
}

/// Two panels side by side, sewn across a gap, and a third that stands in it.
const GAP: &str = r#"length = "mm"
[panel.left]
grain = 0
rectangle = [100, 60]
origin = [-120, 0, 0]
edges = ["hem", "side", "top", "fold"]
[panel.right]
grain = 0
rectangle = [100, 60]
origin = [20, 0, 0]
edges = ["hem", "fold", "top", "side"]
[panel.flap]
grain = 0
rectangle = [100, 60]
origin = [0, HEIGHT, 50]
turn = [0, 90, 0]
[seam.middle]
sides = [["left.side"], ["right.side"]]
"#;

#[test]
fn stitches_through_another_panel_are_told() {
    let notes = |height: &str| {
        let pattern = GAP.replace("HEIGHT", height);
        let documents = [Document::new("plain.toml", FABRIC), Document::new("gap.toml", pattern)];
        let text = "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n[[garment]]\n\
                    pattern = \"gap.toml\"\nfabric = \"plain\"\n[time]\nstep = 0.005\nend = 1\n";
        let scene = Scene::from_documents(&Document::new("scene.toml", text), &documents);
        scene.unwrap().source.notes
    };
    let told = notes("0");
    let words = "seam \"middle\": 4 of 4 stitches lead through the panel \"flap\" at the start";
    let note = told.iter().find(|note| note.text.contains(words));
    let remedy = note.unwrap_or_else(|| panic!("{told:?}")).remedy.as_ref();
    assert_eq!(remedy, Some(&Remedy::ShowStart { scene: "scene.toml".into() }));
    assert!(notes("200").is_empty());
}

#[test]
fn what_the_scene_does_not_give_of_the_place_of_a_panel_stays_that_of_the_pattern() {
    let skirt = pattern(170.0);
    let positions = |skirt: &str, keys: &str| {
        let keys = if keys.is_empty() { "" } else { &format!("[garment.panel.back]\n{keys}") };
        let scene = read(
            skirt,
            &format!("{keys}\n[sew]\ntwisted = [\"side_left\", \"side_right\", \"waist\"]"),
        );
        scene.unwrap().start.positions
    };
    // The back of the pattern, and the same with another place or another turn.
    let own = "origin = [0, 600, -125]\nturn = [0, 180, 0]";
    assert!(skirt.contains(own));
    let changed = |to: &str| positions(&skirt.replacen(own, to, 1), "");
    let moved = changed("origin = [0, 580, -165]\nturn = [0, 180, 0]");
    let turned = changed("origin = [0, 600, -125]\nturn = [0, 176, 0]");
    assert!(moved != positions(&skirt, "") && turned != positions(&skirt, ""));
    // Lengths of the scene are in m.
    assert_eq!(positions(&skirt, "center = [0, 0.58, -0.165]"), moved);
    assert_eq!(positions(&skirt, "turn = [0, 176, 0]"), turned);
    assert_eq!(positions(&skirt, "center = [0, 0.58, -0.165]\nturn = [0, 180, 0]"), moved);
    assert_eq!(positions(&skirt, "wrap = 0.125\nturn = [0, 176, 0]"), turned);
}
