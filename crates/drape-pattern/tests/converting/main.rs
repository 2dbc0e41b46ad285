//! Patterns of others become the project's own, and drawings, and come back.

mod added;
mod chords;
mod drawings;
mod dxf;
mod dxf_out;
mod dxf_text;
mod hidden;

use drape_input::Document;
use drape_pattern::Pattern;

fn shipped(name: &str) -> String {
    let path = format!("{}/patterns/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("it is there")
}

fn read(name: &str, text: &str) -> Pattern {
    let read = Pattern::parse(&Document::new(name, text));
    read.unwrap_or_else(|mistakes| panic!("{name}: {mistakes}\n{text}"))
}

fn refused(name: &str, text: &str, words: &[&str]) {
    let said = Pattern::parse(&Document::new(name, text)).expect_err("it is wrong").to_string();
    for word in words {
        assert!(said.contains(word), "{word:?} is not in: {said}");
    }
}

/// Whether one of the notes has some words.
fn noted(pattern: &Pattern, words: &str) -> bool {
    pattern.notes().iter().any(|note| note.to_string().contains(words))
}

/// Largest distance between the outlines of the panels of the same name, in m.
fn apart(a: &Pattern, b: &Pattern) -> f64 {
    assert_eq!(a.panels().len(), b.panels().len());
    let mut most = 0.0_f64;
    for panel in a.panels() {
        let other = b.panels().iter().find(|p| p.name() == panel.name()).expect("it has the panel");
        assert_eq!(panel.outline().len(), other.outline().len(), "{}", panel.name());
        for (edge, again) in panel.outline().iter().zip(other.outline()) {
            assert_eq!(edge.name, again.name);
            for k in 0..=20 {
                let (p, q) = (edge.at(f64::from(k) / 20.0), again.at(f64::from(k) / 20.0));
                most = most.max((p[0] - q[0]).hypot(p[1] - q[1]));
            }
            assert!((edge.hem - again.hem).abs() < 1e-7, "{}", edge.name);
        }
        assert!((panel.grain() - other.grain()).abs() < 1e-7, "{}", panel.name());
        match (panel.placement(), other.placement()) {
            (Some(place), Some(again)) => {
                let (p, q) = (place.point([0.3, -0.2]), again.point([0.3, -0.2]));
                assert!((0..3).all(|k| (p[k] - q[k]).abs() < 1e-6), "{p:?} {q:?}");
            }
            (place, again) => assert_eq!(place, again),
        }
        assert_eq!(panel.fabric(), other.fabric());
        assert_eq!(panel.folds().len(), other.folds().len());
    }
    most
}

const OWN: &str = r#"length = "cm"
[panel.front]
grain = 12
fabric = "shell"
start = [-3, 2]
outline = [
    { name = "hem", to = [22, 0], hem = 3 },
    { name = "side", to = [21, 58], cubic = [[24, 38], [23, 46]], notches = [10, 30.5] },
    { name = "a|b%7C", to = [12, 60], quadratic = [17, 57] },
    { name = "neck", to = [2, 60], radius = -5 },
    { name = "shoulder & \"co\"", to = [-3, 58], radius = 40 },
    { name = "bulge", to = [-3, 30], radius = 14.5, large = true },
    { name = "centre", to = [-3, 2] },
]
origin = [0, 40, 15]
turn = [10, 180, 5]
wrap = 20
[[panel.front.fold]]
from = [0, 20]
to = [22, 20]
angle = 90
[panel."back.left"]
grain = 0
rectangle = [22, 58]
[seam.side]
sides = [["front.side"], ["back.left.left"]]
max_ease = 1.2
allowance = 1
angle = 30
"#;

#[test]
fn patterns_come_back_from_toml_and_from_drawings() {
    let files = ["shirt.json", "skirt.json", "trousers.json", "teagan.json", "pencil-skirt.toml"];
    let all = files.map(|name| (name, shipped(name)));
    for (name, text) in all.iter().map(|(n, t)| (*n, t.as_str())).chain([("own.toml", OWN)]) {
        let pattern = read(name, text);
        let toml = read("again.toml", &pattern.to_toml("Again."));
        let off = apart(&pattern, &toml);
        assert!(off < 1e-6, "{name}: {off} m in TOML");
        let drawing = pattern.to_svg(None);
        let svg = read("again.svg", &drawing);
        let off = apart(&pattern, &svg);
        assert!(off < 1e-6, "{name}: {off} m in SVG");
        let back = read("back.toml", &svg.to_toml("Back."));
        let off = apart(&pattern, &back);
        assert!(off < 1e-5, "{name}: {off} m through SVG to TOML");
        assert_eq!(back.seams().len(), pattern.seams().len(), "{name}");
        for (seam, again) in pattern.seams().iter().zip(toml.seams()) {
            let again = toml.seams().iter().find(|s| s.name == seam.name).unwrap_or(again);
            assert_eq!((seam.reversed, seam.max_ease), (again.reversed, again.max_ease));
            assert!((seam.angle - again.angle).abs() < 1e-7);
            assert!((seam.allowance - again.allowance).abs() < 1e-7);
        }
    }
    let own = read("own.toml", OWN);
    let svg = read("again.svg", &own.to_svg(None));
    for again in [&svg, &read("again.toml", &own.to_toml(""))] {
        let notches = |pattern: &Pattern| {
            let panel = pattern.panels().iter().find(|p| p.name() == "front").expect("it is there");
            panel.outline()[1].notches.clone()
        };
        for (notch, again) in notches(&own).iter().zip(notches(again)) {
            assert!((notch - again).abs() < 1e-4, "{notch} {again}");
        }
        assert_eq!(notches(again).len(), 2);
    }
}

#[test]
fn a_converted_pattern_is_edited_by_a_line_and_read_again() {
    for name in ["shirt.json", "skirt.json", "trousers.json"] {
        let pattern = read(name, &shipped(name));
        let text = pattern.to_toml("Edited.");
        let edited = text.replacen("grain = 0    # assumed", "grain = 45", 1);
        let again = read("edited.toml", &edited);
        let turned = again.panels().iter().filter(|p| p.grain() > 0.7).count();
        assert_eq!(turned, 1, "{name}");
        assert_eq!(again.seams().len(), pattern.seams().len());
        let wrong = text.replacen("sides = [[\"", "sides = [[\"x", 1);
        refused("wrong.toml", &wrong, &["there is no panel", "help"]);
    }
}
