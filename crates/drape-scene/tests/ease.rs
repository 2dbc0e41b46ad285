//! Girth and ease of a tube of cloth whose lengths are known, round a column.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use drape_fabric::samples;
use drape_input::Document;
use drape_scene::{ClothPlaces, Figures, FoundBy, GirthPair, MeasuredGarment, NoGirth, Scene};

const FABRIC: &str = samples::PLAIN_WEAVE;

/// Two panels of 400 mm × 300 mm in front of and behind a column of 200 mm across; `left` is an
/// edge of the front, and sewn to the upper edge of the back.
const TUBE: &str = r#"length = "mm"
[panel.front]
grain = 0
start = [-200, 0]
outline = [
    { name = "hem", to = [200, 0] },
    { name = "left", to = [200, 300] },
    { name = "top", to = [-200, 300] },
    { name = "right", to = [-200, 0] },
]
origin = [0, 600, 140]
[panel.back]
grain = 0
start = [-200, 0]
outline = [
    { name = "hem", to = [200, 0] },
    { name = "right", to = [200, 300] },
    { name = "top", to = [-200, 300] },
    { name = "left", to = [-200, 0] },
]
origin = [0, 600, -140]
turn = [0, 180, 0]
[seam.right]
sides = [["back.right"], ["front.right"]]
"#;

const LEFT: &str = "[seam.left]\nsides = [[\"front.left\"], [\"back.left\"]]\n";

/// Reads the tube with a seam on the left or without, and with heights that the scene names.
fn tube(left: &str, unit: &str, measure: &str) -> Scene {
    let pattern = format!("{TUBE}{left}");
    let documents = [Document::new("plain.toml", FABRIC), Document::new("tube.toml", pattern)];
    let [spacing, radius, height, middle, offset] = match unit {
        "mm" => [20.0, 100.0, 1500.0, 750.0, 3.0],
        _ => [0.02, 0.1, 1.5, 0.75, 0.003],
    };
    let text = format!(
        "length = \"{unit}\"\nspacing = {spacing}\nfabric.plain.file = \"plain.toml\"\n[[garment]]\n\
         pattern = \"tube.toml\"\nfabric = \"plain\"\n{measure}\n[[collider.cylinder]]\n\
         radius = {radius}\nheight = {height}\ncenter = [0, {middle}, 0]\n[contact]\noffset = {offset}\n\
         [time]\nstep = 0.005\nend = 1\n[settle]\n"
    );
    Scene::from_documents(&Document::new("scene.toml", text), &documents).unwrap()
}

/// Measures the tube with its panels bent round an axis: the place along its girth of 800 mm
/// becomes an angle, and a radius goes with the angle. All is turned about y and shifted, and so is
/// the body.
fn measured(
    scene: &Scene,
    radius: impl Fn(f64) -> f64,
    (turn, shift): (f64, [f64; 2]),
) -> Vec<GirthPair> {
    let mut positions = scene.start.positions.clone();
    let coordinates = scene.cloth.coordinates();
    let place = |angle: f64, radius: f64| {
        let (sin, cos) = (angle + turn).sin_cos();
        [radius * cos + shift[0], radius * sin + shift[1]]
    };
    for (number, panel) in scene.panels.iter().enumerate() {
        for particle in panel.particles() {
            let along = coordinates[particle][0] + 0.2 + 0.4 * number as f64;
            // The front runs from the right to the left, the back on to the right.
            let angle = 2.0 * PI * along / 0.8;
            let [x, z] = place(angle, radius(angle));
            (positions[3 * particle], positions[3 * particle + 2]) = (x, z);
        }
    }
    let mut bodies = vec![scene.bodies[0].body.triangulate().unwrap()];
    for vertex in &mut bodies[0].vertices {
        let [x, z] = place(vertex[2].atan2(vertex[0]), vertex[0].hypot(vertex[2]));
        (vertex[0], vertex[2]) = (x, z);
    }
    let cloth = ClothPlaces { coordinates, positions: &positions };
    MeasuredGarment::all(scene)[0].girths(cloth, &Figures::new(bodies))
}

#[test]
fn a_tube_has_its_girth_as_worn_and_in_the_pattern() {
    for (unit, measure) in [
        ("m", "measure.waist = 0.75"),
        ("mm", "measure.waist = 750"),
        ("m", "measure.waist = \"75 cm\""),
    ] {
        let scene = tube(LEFT, unit, measure);
        for place in [(0.0, [0.0; 2]), (0.7, [0.3, -1.2]), (3.0, [-0.1, 0.4])] {
            // A radius at which the cloth of 800 mm is stretched to 2 π 130 mm = 817 mm.
            let girths = measured(&scene, |_| 0.13, place);
            assert_eq!(girths.len(), 1, "{girths:?}");
            let landmark = &girths[0].landmark;
            assert_eq!((landmark.name.as_str(), landmark.found_by), ("waist", FoundBy::Scene));
            assert!((landmark.height - 0.75).abs() < 1e-12);
            let own = girths[0].garment.unwrap();
            assert!((own.pattern - 0.8).abs() < 1e-9, "{own:?}");
            // Chords of 20 mm are a thousandth shorter than their arcs.
            let circle = 2.0 * PI * 0.13;
            assert!(own.worn < circle && own.worn > 0.998 * circle, "{own:?} for {circle}");
            assert!((own.hull - own.worn).abs() < 1e-9, "{own:?}");
            let body = girths[0].body;
            assert!((body / (2.0 * PI * 0.1) - 1.0).abs() < 3e-3, "{body}");
        }
    }
}

#[test]
fn folds_are_followed_along_the_cloth_and_spanned_by_the_hull() {
    let scene = tube(LEFT, "m", "measure.waist = 0.75");
    let radius = |angle: f64| 0.122 + 0.012 * (5.0 * angle).cos();
    let own = measured(&scene, radius, (0.0, [0.0; 2]))[0].garment.unwrap();
    // The length of the waves, by many points.
    let at = |k: u32| {
        let angle = 2.0 * PI * f64::from(k) / 20_000.0;
        [radius(angle) * angle.cos(), radius(angle) * angle.sin()]
    };
    let chord = |k: u32| {
        let ([a, b], [c, d]) = (at(k), at(k + 1));
        (c - a).hypot(d - b)
    };
    let exact: f64 = (0..20_000).map(chord).sum();
    assert!((own.worn / exact - 1.0).abs() < 0.01, "{own:?} for {exact}");
    assert!((own.pattern - 0.8).abs() < 1e-9, "{own:?}");
    // The length of a hull is the mean of its width over all directions, times π (Cauchy).
    let reach = |angle: f64| {
        let along = |[x, z]: [f64; 2]| x * angle.cos() + z * angle.sin();
        (0..2000).map(|k| along(at(10 * k))).fold(0.0, f64::max)
    };
    let hull: f64 = (0..720).map(|k| reach(2.0 * PI * f64::from(k) / 720.0) * PI / 360.0).sum();
    assert!(hull < exact && own.hull < own.worn, "{own:?}");
    assert!((own.hull / hull - 1.0).abs() < 0.003, "{own:?} for {hull}");
}

#[test]
fn a_front_that_is_not_sewn_is_open_and_cloth_on_one_side_is_not_worn() {
    let scene = tube("", "m", "measure.waist = 0.75");
    let girths = measured(&scene, |_| 0.13, (0.4, [0.1, 0.0]));
    assert_eq!(girths.len(), 1);
    assert_eq!(girths[0].garment, Err(NoGirth::Open));
    assert!((girths[0].body / (2.0 * PI * 0.1) - 1.0).abs() < 3e-3);

    // Flat beside the body, it is not worn; and at a height where there is none of it neither.
    let beside = {
        let cloth = ClothPlaces {
            coordinates: scene.cloth.coordinates(),
            positions: &scene.start.positions.iter().map(|x| x + 0.5).collect::<Vec<_>>(),
        };
        let bodies = vec![scene.bodies[0].body.triangulate().unwrap()];
        MeasuredGarment::all(&scene)[0].girths(cloth, &Figures::new(bodies))
    };
    assert_eq!(beside, []);
    let scene = tube(LEFT, "m", "measure.waist = 0.95\nmeasure.knee = 7");
    assert_eq!(measured(&scene, |_| 0.13, (0.0, [0.0; 2])), []);
}

#[test]
fn a_column_has_no_waist_of_its_own() {
    let scene = tube(LEFT, "m", "");
    assert_eq!(measured(&scene, |_| 0.13, (0.0, [0.0; 2])), []);
}

#[test]
fn cloth_that_is_smaller_than_a_named_girth_is_told_with_both_figures() {
    // 800 mm round a column of 628 mm is enough, and 600 mm is not.
    let told = |scene: &Scene| {
        let mut notes = scene.source.note_lines().into_iter();
        notes.find(|note| note.contains("ease is"))
    };
    let scene = tube(LEFT, "m", "measure.waist = 0.75");
    assert_eq!(told(&scene), None);
    let narrow = TUBE.replace("200", "150");
    let pattern = format!("{narrow}{LEFT}");
    let documents = [Document::new("plain.toml", FABRIC), Document::new("tube.toml", pattern)];
    let text = "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n[[garment]]\npattern = \"tube.toml\"\n\
                fabric = \"plain\"\nmeasure.waist = 0.75\n[[collider.cylinder]]\nradius = 0.1\n\
                height = 1.5\ncenter = [0, 0.75, 0]\n[contact]\noffset = 0.003\n[time]\nstep = 0.005\nend = 1\n\
                [settle]\n";
    let scene = Scene::from_documents(&Document::new("scene.toml", text), &documents).unwrap();
    let note = told(&scene).unwrap_or_else(|| panic!("{:?}", scene.source.notes));
    for words in
        ["at the waist (0.75 m)", "measure 600 mm", "and the body 62", "ease is −2", "front"]
    {
        assert!(note.contains(words), "{words:?}: {note}");
    }
}

#[test]
fn a_height_that_cannot_be_is_a_mistake() {
    let documents =
        [Document::new("plain.toml", FABRIC), Document::new("tube.toml", format!("{TUBE}{LEFT}"))];
    let text = "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n[[garment]]\npattern = \"tube.toml\"\n\
                fabric = \"plain\"\nmeasure.waist = 1080\n[time]\nstep = 0.005\nend = 1\n";
    let read = Scene::from_documents(&Document::new("scene.toml", text), &documents);
    let said = read.unwrap_err().to_string();
    assert!(said.contains("scene.toml:6") && said.contains("1080"), "{said}");
    assert!(said.contains("1080 mm"), "the remedy: {said}");
}
