//! Mistakes in pattern files are named with their place, value and remedy, all of a file together.

use drape_input::Document;
use drape_pattern::{Curve, Cutter, Mistake, Panel, Pattern, PatternNote};
use proptest::prelude::*;

/// The mistakes of a text, as they are shown.
fn mistakes(path: &str, text: &str) -> String {
    let document = Document::new(path, text);
    Pattern::parse(&document).expect_err("the text is wrong").to_string()
}

/// All of these words stand in what is said of a text.
fn says(path: &str, text: &str, words: &[&str]) {
    let said = mistakes(path, text);
    for word in words {
        assert!(said.contains(word), "\"{word}\" is not in:\n{said}");
    }
}

fn shipped(name: &str) -> String {
    let path = format!("{}/patterns/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("it is there")
}

/// A pattern of two squares of 30 cm, sewn at one edge, after some words were exchanged.
fn squares(exchanges: &[(&str, &str)]) -> String {
    let mut text = r#"length = "cm"

[panel.front]
grain = 0
start = [0, 0]
outline = [
    { name = "hem", to = [30, 0] },
    { name = "side_l", to = [30, 30] },
    { name = "waist", to = [0, 30] },
    { name = "centre", to = [0, 0] },
]

[panel.back]
grain = 0
rectangle = [30, 30]

[seam.side]
sides = [["front.side_l"], ["back.left"]]
"#
    .to_owned();
    for (from, to) in exchanges {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    text
}

#[test]
fn the_own_format_is_read() {
    let pattern = Pattern::parse(&Document::new("a.toml", squares(&[]))).expect("it is sound");
    assert_eq!(pattern.panels().len(), 2);
    assert_eq!(pattern.notes(), []);
    let seam = &pattern.seams()[0];
    assert_eq!((seam.name.as_str(), seam.reversed, seam.max_ease), ("side", false, 1.1));
    let cut = Cutter::default().cut(&pattern).expect("it can be cut");
    assert_eq!(cut.seams[0].pairs.len(), 31);
    assert_eq!(cut.particle_count(), 2 * 31 * 31 - 31);

    let text = squares(&[
        (
            "{ name = \"side_l\", to = [30, 30] }",
            "{ name = \"side_l\", to = [30, 30], radius = -40 }",
        ),
        (
            "rectangle = [30, 30]",
            "path = \"M0 0 V30 H30 V0 Z\"\nedges = [\"left\", \"b\", \"r\", \"t\"]",
        ),
    ]);
    let pattern = Pattern::parse(&Document::new("a.toml", text)).expect("it is sound");
    let [back, front] = pattern.panels() else { panic!("two panels") };
    assert_eq!(back.outline()[0].name, "left");
    assert!((back.area() - 0.09).abs() < 1e-12);
    // Turning right, the side cuts into the panel: 40 cm round, 30 cm across.
    let angle: f64 = 2.0 * (15.0_f64 / 40.0).asin();
    let Curve::Arc { sweep } = front.outline()[1].curve else { panic!("it is an arc") };
    assert!((sweep + angle).abs() < 1e-12, "{sweep}");
    let lost = 0.5 * 0.16 * (angle - angle.sin());
    assert!((front.area() - (0.09 - lost)).abs() < 1e-12);
}

#[test]
fn the_example_of_the_readme_lacks_nothing_but_its_back() {
    let readme = include_str!("../README.md");
    let (_, rest) = readme.split_once("```toml\n").expect("it has an example");
    let (example, _) = rest.split_once("```").expect("the example ends");
    let said = mistakes("a.toml", example);
    assert_eq!(said.matches("a.toml:").count(), 2, "{said}");
    assert_eq!(said.matches("there is no panel \"back\"").count(), 2, "{said}");
}

#[test]
fn folds_and_angles_of_seams_are_read() {
    let fold = "\n[[panel.back.fold]]\nfrom = [0, 10]\nto = [30, 12]\nangle = -60\n";
    let text = squares(&[]) + "angle = 30\n" + fold;
    let pattern = Pattern::parse(&Document::new("p.toml", text.clone())).expect("it is right");
    assert!((pattern.seams()[0].angle.to_degrees() - 30.0).abs() < 1e-12);
    assert!(pattern.panels()[1].folds().is_empty());
    let [fold] = pattern.panels()[0].folds() else { panic!("one fold") };
    assert!(
        fold.ends == [[0.0, 0.1], [0.3, 0.12]] && (fold.angle.to_degrees() + 60.0).abs() < 1e-12
    );
    says(
        "p.toml",
        &text.replace("= 30\n", "= 150\n"),
        &["seam", "150 is not between -140 and 140"],
    );
    says("p.toml", &text.replace("-60", "nan"), &["fold", "nan is not a finite number"]);
    says("p.toml", &text.replace("[30, 12]", "[0, 10]"), &["fold", "no length"]);
}

#[test]
fn allowances_and_hems_are_read() {
    let text = squares(&[("to = [30, 0]", "to = [30, 0], hem = 2.5")]) + "allowance = 1\n";
    let pattern = Pattern::parse(&Document::new("p.toml", text.clone())).expect("it is right");
    assert!((pattern.seams()[0].allowance - 0.01).abs() < 1e-15);
    let hems = |panel: usize| pattern.panels()[panel].outline().iter().map(|edge| edge.hem);
    assert_eq!(hems(0).collect::<Vec<_>>(), [0.0; 4]);
    assert_eq!(hems(1).collect::<Vec<_>>(), [0.025, 0.0, 0.0, 0.0]);
    // An outline that runs clockwise is reversed with its hems.
    let clockwise = squares(&[
        ("{ name = \"hem\", to = [30, 0] },\n    ", ""),
        ("{ name = \"side_l\", to = [30, 30] },\n    ", ""),
        (
            "{ name = \"waist\", to = [0, 30] }",
            "{ name = \"waist\", to = [0, 30], hem = 2 },\n    \
          { name = \"top\", to = [30, 30] },\n    { name = \"side_l\", to = [30, 0] }",
        ),
    ]);
    let pattern = Pattern::parse(&Document::new("p.toml", clockwise)).expect("it is right");
    let hemmed = pattern.panels()[1].outline().iter().filter(|edge| edge.hem > 0.0);
    let hemmed: Vec<_> = hemmed.map(|edge| (edge.name.as_str(), edge.hem)).collect();
    assert_eq!(hemmed, [("waist", 0.02)]);
    let wrong =
        |from: &str, to: &str, words: &[&str]| says("p.toml", &text.replace(from, to), words);
    wrong(
        "allowance = 1",
        "allowance = -1",
        &["p.toml:19:", "-10.0 mm is not between 0 and 300 mm"],
    );
    wrong("allowance = 1", "allowance = nan", &["seam.side.allowance: nan is not a finite number"]);
    wrong("hem = 2.5", "hem = 31", &["p.toml:7:", "310 mm is not between 0 and 300 mm"]);
    wrong("to = [30, 30]", "to = [30, 30], hem = 2", &["side_l", "has a hem", "an allowance"]);
}

#[test]
fn mistakes_of_the_own_format_have_line_value_and_remedy() {
    let toml =
        |exchanges: &[(&str, &str)], words: &[&str]| says("a.toml", &squares(exchanges), words);
    toml(&[("length = \"cm\"", "length = \"ell\"")], &["a.toml:1:", "ell", "\"cm\""]);
    toml(&[("length = \"cm\"\n", "")], &["length", "add length ="]);
    toml(&[("front]\ngrain", "front]\ngrian")], &["a.toml:4:", "grian", "did you mean `grain`?"]);
    toml(&[("to = [30, 0]", "to = [30]")], &["a.toml:7:"]);
    toml(
        &[("front.side_l\"", "front.side_m\"")],
        &["a.toml:18:", "no edge \"side_m\"", "front.side_l"],
    );
    toml(&[("front.side_l\"", "front.zip\"")], &["no edge \"zip\"", "hem, side_l, waist, centre"]);
    toml(&[("front.side_l\"", "frnt.side_l\"")], &["no panel \"frnt\"", "front.side_l"]);
    toml(&[("[\"front.side_l\"]", "[]")], &["seam side has a side without edges"]);
    toml(&[("to = [30, 30]", "to = [30, 30], large = true")], &["outline[1]", "add radius"]);
    toml(
        &[("to = [30, 30]", "to = [30, 30], radius = 20, quadratic = [40, 15]")],
        &["a.toml:8:", "no single curve"],
    );
    toml(&[("rectangle = [30, 30]", "")], &["panel back has no single shape", "rectangle ="]);
    toml(
        &[("rectangle = [30, 30]", "rectangle = [30, 30]\nedges = [\"a\"]")],
        &["names 1 edges of 4"],
    );
    toml(&[("rectangle = [30, 30]", "path = \"M0 0 L1 x\"")], &["a.toml:15:", "command 2"]);
    toml(&[("rectangle = [30, 30]", "rectangle = [30, nan]")], &["nan is not a finite"]);
    toml(
        &[("rectangle = [30, 30]", "rectangle = [30, 30]\nturn = [0, inf, 0]")],
        &["turn[1]: inf is not a finite number"],
    );
    toml(
        &[("rectangle = [30, 30]", "rectangle = [30, 30]\nwrap = -4.7")],
        &["a.toml:16:", "panel back is 300 mm wide", "a radius of -47.0 mm", "more than 47.7 mm"],
    );
    toml(
        &[("rectangle = [30, 30]", "rectangle = [30, 30]\nwrap = 0")],
        &["0.000 mm", "leave wrap"],
    );
    toml(
        &[("rectangle = [30, 30]", "rectangle = [30, 30]\nwrap = nan")],
        &["wrap: nan is not a finite"],
    );
    // One of each kind, all at once, in the order of the text.
    let said = mistakes(
        "a.toml",
        &squares(&[
            ("rectangle = [30, 30]", "rectangle = [30, 0]"),
            ("front.side_l\"", "front.zip\""),
        ]),
    );
    let (rectangle, zip) = (said.find("back"), said.find("zip"));
    assert!(rectangle.is_some() && rectangle < zip, "{said}");
}

#[test]
fn mistakes_of_outlines_and_seams_are_named() {
    let toml =
        |exchanges: &[(&str, &str)], words: &[&str]| says("a.toml", &squares(exchanges), words);
    toml(
        &[("length = \"cm\"", "length = \"m\"")],
        &["panel front is 30.00 × 30.00 m", "did you mean length = \"cm\"?", "panel back is 30"],
    );
    toml(
        &[("to = [0, 0] }", "to = [0, 0.32] }")],
        &["3.2 mm gap between the end of edge centre and the start of edge hem"],
    );
    toml(
        &[("to = [30, 30]", "to = [10, 40]"), ("to = [0, 30]", "to = [30, 30]")],
        &["edges side_l and centre cross or touch at (200.0, 200.0) mm"],
    );
    toml(&[("to = [30, 30]", "to = [30, 0]")], &["edge side_l has the length 0.000 mm"]);
    toml(&[("\"waist\"", "\"hem\"")], &["panel front has two edges named hem"]);
    toml(
        &[(
            "[[\"front.side_l\"], [\"back.left\"]]",
            "[[\"front.side_l\"], [\"back.left\"]]\n[seam.two]\nsides = [[\"front.side_l\"], [\"back.right\"]]",
        )],
        &["edge side_l of panel front is sewn twice, in seams side and two", "join both"],
    );
    toml(
        &[("rectangle = [30, 30]", "rectangle = [30, 34.5]")],
        &[
            "back.left 345 mm and front.side_l 300 mm: ratio 1.150 is above max_ease 1.1",
            "write max_ease = 1.16 if the fullness is meant",
        ],
    );
    toml(
        &[("rectangle = [30, 30]", "rectangle = [30, 60]")],
        &["ratio 2.000 is above max_ease 1.1", "write max_ease = 2 if the fullness is meant"],
    );
    toml(
        &[("rectangle = [30, 30]", "rectangle = [30, 156]")],
        &["ratio 5.200", "above 5 are not cut"],
    );
    toml(
        &[("[\"back.left\"]]", "[\"back.left\"]]\nmax_ease = 6")],
        &["max_ease is 6", "from 1 to 5"],
    );
}

#[test]
fn places_are_read_in_the_unit_of_the_file() {
    let place = "rectangle = [30, 30]\norigin = [1, 2, 3]\nturn = [0, 90, 0]\nwrap = 20";
    let text = squares(&[("rectangle = [30, 30]", place)]);
    let pattern = Pattern::parse(&Document::new("a.toml", text)).expect("it is sound");
    let [back, front] = pattern.panels() else { panic!("two panels") };
    assert_eq!(front.placement(), None);
    // A quarter of the way round, the axis is at x = 1 − 20 cm, and the panel ends behind it.
    let placement = back.placement().expect("it has a place");
    let corner = placement.point([0.1 * std::f64::consts::PI, 0.3]);
    let error = [-0.19, 0.32, -0.17].iter().zip(corner).map(|(a, b)| (a - b).abs());
    assert!(error.fold(0.0, f64::max) < 1e-12, "{corner:?}");
}

#[test]
fn quantities_may_have_a_unit_of_their_own() {
    let bare = squares(&[
        ("to = [30, 0]", "to = [30, 0], hem = 2, notches = [10]"),
        (
            "rectangle = [30, 30]",
            "rectangle = [30, 30]\norigin = [1, 2, 3]\nturn = [0, 90, 0]\nwrap = 20",
        ),
        (
            "[[\"front.side_l\"], [\"back.left\"]]",
            "[[\"front.side_l\"], [\"back.left\"]]\nangle = 30\nallowance = 1",
        ),
    ]);
    let with_units = squares(&[
        ("to = [30, 0]", "to = [\"300 mm\", 0], hem = \"20 mm\", notches = [\"0.1 m\"]"),
        (
            "rectangle = [30, 30]",
            "rectangle = [\"300 mm\", 30]\norigin = [1, \"20 mm\", 3]\nturn = [0, \"90 deg\", 0]\nwrap = \"0.2 m\"",
        ),
        (
            "[[\"front.side_l\"], [\"back.left\"]]",
            "[[\"front.side_l\"], [\"back.left\"]]\nangle = \"30 deg\"\nallowance = \"10 mm\"",
        ),
    ]);
    let read = |text: String| {
        Pattern::parse(&Document::new("p.toml", text)).expect("it is sound").to_toml("")
    };
    assert_eq!(read(with_units.clone()), read(bare));
    says(
        "p.toml",
        &with_units.replace("\"20 mm\", notches", "\"20 s\", notches"),
        &["p.toml:7:47", "not a unit of length"],
    );
}

#[test]
fn all_mistakes_of_a_file_are_told_at_once_under_their_values() {
    let text = squares(&[
        ("length = \"cm\"", "lenght = \"cm\""),
        ("grain = 0\nstart", "grian = 0\nstart"),
        ("to = [30, 30] }", "to = \"up\" }"),
        (
            "rectangle = [30, 30]",
            "rectangle = [30, 30]\nfold = [{ from = [0, 1], to = [3, 1], angle = 170 }]",
        ),
        ("\"back.left\"", "\"back.lfet\""),
    ]) + "allowance = -1\n[seam.two]\nsides = 3\n";
    let told = mistakes("p.toml", &text);
    let places: Vec<&str> = told.lines().filter(|line| line.starts_with("p.toml")).collect();
    let expected = [
        "p.toml:1:1: lenght: there is no such key",
        "p.toml:4:1: panel.front.grian: there is no such key",
        "p.toml:8:29: panel.front.outline[1].to: is text where a list is needed",
        "p.toml:16:47: panel.back.fold[0].angle: 170 is not between -140 and 140",
        "p.toml:19:29: seam.side.sides[1][0]: panel back has no edge \"lfet\"",
        "p.toml:20:13: seam.side.allowance: -10.0 mm is not between 0 and 300 mm",
        "p.toml:22:9: seam.two.sides: is a number where a list is needed",
    ];
    assert_eq!(places, expected, "{told}");
}

#[test]
fn without_a_unit_only_what_depends_on_it_is_left_unsaid() {
    let text = squares(&[("length = \"cm\"\n", ""), ("[[\"front.side_l\"]", "[[\"frnt.side_l\"]")]);
    let told = mistakes("p.toml", &(text + "allowance = 7\nangle = 200\n"));
    let messages = told.lines().filter(|line| line.starts_with("p.toml"));
    let keys: Vec<&str> =
        messages.map(|line| line.rsplit(": ").nth(1).unwrap_or_default()).collect();
    assert!(told.contains("p.toml: length: is missing"), "{told}");
    assert_eq!(keys.len(), 3, "{told}");
    says("p.toml", &squares(&[("\"cm\"", "\"ell\"")]), &["p.toml:1:10", "\"ell\" is not a unit"]);
    says("p.toml", &squares(&[("\"cm\"", "\"pt\"")]), &["p.toml:1:10", "\"pt\" is not a unit"]);
}

#[test]
fn oddities_that_prevent_nothing_are_noted() {
    let notes = |exchanges: &[(&str, &str)]| {
        let document = Document::new("a.toml", squares(exchanges));
        Pattern::parse(&document).expect("it is sound").notes().to_vec()
    };
    let clockwise = [
        ("to = [30, 0] }", "to = [0, 30] }"),
        ("\"waist\", to = [0, 30]", "\"waist\", to = [30, 0]"),
    ];
    assert_eq!(notes(&clockwise), [PatternNote::Reversed { panel: "front".into() }]);
    let grainless = [("[panel.back]\ngrain = 0", "[panel.back]")];
    assert_eq!(notes(&grainless), [PatternNote::NoGrain { panels: vec!["back".into()] }]);
    // Side by side the panels' edges face each other; turned round the seam is twisted.
    let places = [
        ("rectangle = [30, 30]", "rectangle = [30, 30]\norigin = [40, 0, 0]"),
        ("start = [0, 0]", "start = [0, 0]\norigin = [0, 0, 0]"),
    ];
    assert_eq!(notes(&places), []);
    let twisted = [places[0], places[1], ("[\"back.left\"]]", "[\"back.left\"]]\nreversed = true")];
    let said = notes(&twisted)[0].to_string();
    assert!(said.contains("side may run in the wrong sense"), "{said}");
    assert!(said.contains("316 mm apart as given and 100 mm if reversed"), "{said}");
}

#[test]
fn thin_panels_and_short_edges_are_noted_when_cut() {
    let band = |width: f64| {
        let text =
            format!("length = \"cm\"\n[panel.band]\ngrain = 10\nrectangle = [40, {width}]\n");
        let pattern = Pattern::parse(&Document::new("a.toml", text)).expect("it is sound");
        let cut = Cutter::default().cut(&pattern).expect("it can be cut");
        cut.notes.iter().map(ToString::to_string).collect::<String>()
    };
    for (width, words) in [(0.8, "band is 8."), (1.2, "band is 12."), (1.45, "band is 14.")] {
        let said = band(width);
        assert!(said.contains(words) && said.contains("fewer than 3 particles"), "{width}: {said}");
    }
    assert_eq!(band(1.6), "");

    // A smooth joint 3 mm from a corner goes; a corner 3 mm from another is a mistake.
    let joined = squares(&[(
        "{ name = \"hem\", to = [30, 0] },",
        "{ name = \"tab\", to = [0.3, 0] },{ name = \"hem\", to = [30, 0] },",
    )]);
    let pattern = Pattern::parse(&Document::new("a.toml", joined)).expect("it is sound");
    let cut = Cutter::default().cut(&pattern).expect("it can be cut");
    let said = cut.notes.iter().map(ToString::to_string).collect::<String>();
    assert!(
        said.contains("edge tab is 3.0 mm, under half the spacing (10.0 mm); joined with edge hem"),
        "{said}"
    );
    let corner = squares(&[
        ("to = [0, 30]", "to = [0.3, 30]"),
        (
            "{ name = \"centre\", to = [0, 0] },",
            "{ name = \"step\", to = [0, 29.5]},{ name = \"centre\", to = [0, 0] },",
        ),
    ]);
    let pattern = Pattern::parse(&Document::new("a.toml", corner)).expect("it is sound");
    let cut = Cutter::new(0.02).cut(&pattern).expect("short edges become one particle");
    let said = cut.notes.iter().map(ToString::to_string).collect::<String>();
    assert!(said.contains("edge step is 5.8 mm"), "{said}");
    let whole = Cutter::new(0.0116).cut(&pattern).expect("no edge is too short");
    assert!(whole.notes.is_empty(), "{:?}", whole.notes);
}

#[test]
fn mistakes_of_garmentcode_are_named_together() {
    let exchanged = |exchanges: &[(&str, &str)]| {
        let mut text: serde_json::Value =
            serde_json::from_str(&shipped("trousers.json")).expect("it is JSON");
        for (pointer, value) in exchanges {
            *text.pointer_mut(pointer).expect(pointer) = serde_json::from_str(value).expect(value);
        }
        text.to_string()
    };
    let garment = |exchanges: &[(&str, &str)], words: &[&str]| {
        says("t.json", &exchanged(exchanges), words);
    };
    garment(
        &[
            ("/pattern/stitches/0/0/panel", "\"Rfrnt\""),
            ("/pattern/stitches/1/1/edge", "9"),
            ("/pattern/panels/Lback/edges/1/curvature", "[0.1]"),
            ("/pattern/panels/Rback/edges/1/endpoints", "[3, 77]"),
        ],
        &[
            "stitches[0][0]: there is no panel \"Rfrnt\"",
            "did you mean \"Rfront\"?",
            "stitches[1][1]: panel Rback has no edge 9",
            "its edges are 0 to 4",
            "panels.Lback.edges[1].curvature is [0.1]",
            "panels.Rback.edges[1].endpoints are [3, 77]",
            "the vertices are 0 to 4",
        ],
    );
    garment(
        &[("/properties/units_in_meter", "1")],
        &["panel Lback is 38.00 × 60.00 m", "is the unit right?"],
    );
    garment(
        &[("/properties/units_in_meter", "0")],
        &["units_in_meter is 0", "100 for centimetres"],
    );
    garment(&[("/properties/curvature_coords", "\"polar\"")], &["polar", "relative"]);
    garment(&[("/pattern/stitches/1/0/edge", "1")], &["sewn twice, in seams 0 and 1"]);
    garment(
        &[("/pattern/panels/Lback/edges/2/endpoints", "[1, 3]")],
        &["gap between the end of edge 1"],
    );
    garment(&[("/pattern/stitches/0", "[1]")], &["stitches[0] has 1 entries"]);
    garment(&[("/pattern/panels/Lback/vertices", "3")], &["t.json:1:", "invalid type"]);
    says("t.json", "{\"pattern\": 1", &["t.json:1:13", "EOF"]);
    says("t.json", "[]", &["holds no pattern", "parts"]);
    says("t.pdf", "", &["files *.pdf are not read: this is a drawing for print"]);
    let missing = Pattern::read("patterns/shrt.json").expect_err("there is none").to_string();
    assert!(missing.contains("did you mean patterns/shirt.json?"), "{missing}");
}

#[test]
fn circles_and_seams_on_the_wrong_side_of_garmentcode() {
    let text = r#"{"pattern": {"panels": {"disc": {"vertices": [[0, 0], [20, 0]], "edges": [
        {"endpoints": [0, 1], "curvature": {"type": "circle", "params": [10, 0, 1]}},
        {"endpoints": [1, 0], "curvature": {"type": "circle", "params": [10, false, true]}}]}},
        "stitches": [[{"panel": "disc", "edge": 0}, {"panel": "disc", "edge": 1}, "right_wrong"]]},
        "properties": {"units_in_meter": 100}}"#;
    let pattern = Pattern::parse(&Document::new("disc.json", text)).expect("it is sound");
    assert!((pattern.panels()[0].area() - std::f64::consts::PI * 0.01).abs() < 1e-12);
    assert!(pattern.seams()[0].reversed);
    assert!(!pattern.panels()[0].was_clockwise(), "bulging right, it runs anticlockwise");
}

#[test]
fn a_part_of_a_draft_whose_closed_paths_have_no_area_is_left_out() {
    let text = r#"{"parts":{
        "band":{"paths":{"seam":{"ops":[{"t":"M","p":[0,0]},{"t":"L","p":[300,0]},
            {"t":"L","p":[300,80]},{"t":"L","p":[0,80]},{"t":"Z"}]}}},
        "ruler":{"paths":{"stroke":{"ops":[{"t":"M","p":[0,0]},{"t":"L","p":[100,0]},{"t":"Z"}]}}}
    }}"#;
    let pattern = Pattern::parse(&Document::new("d.json", text)).expect("one part is a panel");
    let [band] = pattern.panels() else { panic!("{:?}", pattern.panels()) };
    assert!(band.name() == "band" && (band.area() - 0.024).abs() < 1e-12);
    let notes: Vec<String> = pattern.notes().iter().map(ToString::to_string).collect();
    let said = |words: &str| notes.iter().any(|note| note.contains(words));
    assert!(said("part ruler") && said("no closed path among stroke"), "{notes:?}");
}

#[test]
fn freesewing_drafts_are_unfolded_and_named_by_their_points() {
    let document = Document::new("teagan.json", shipped("teagan.json"));
    let pattern = Pattern::parse(&document).expect("it is sound");
    let names: Vec<&str> = pattern.panels().iter().map(Panel::name).collect();
    assert_eq!(
        names,
        ["teagan.back", "teagan.front", "teagan.sleeve"],
        "hidden parts are left out"
    );
    let front = &pattern.panels()[1];
    assert_eq!(front.outline()[0].name, "cbHem-hem");
    assert!(front.outline().iter().all(|e| e.name != "cfNeck-cbHem"), "the fold is no edge");
    // The hem of both halves, 296.77 mm each, with y turned up.
    let hem = &front.outline()[0];
    assert!(hem.start[0].abs() < 1e-12 && hem.start[1] == -0.644, "{hem:?}");
    assert_eq!(hem.end, [0.29677, -0.644]);
    let mirrored = front.outline().last().expect("it has edges");
    assert!((mirrored.start[0] + 0.29677).abs() < 1e-12, "{mirrored:?}");
    assert!(mirrored.end[0].abs() < 1e-12 && (mirrored.end[1] + 0.644).abs() < 1e-12);
    assert!(pattern.panels().iter().all(|p| p.grain().abs() < 1e-12 && !p.was_clockwise()));
    assert!(
        matches!(&pattern.notes()[0], PatternNote::Unfolded { edge, .. } if edge == "cbNeck-cbHem")
    );

    let other = shipped("teagan.json").replacen("\"seam\":", "\"contour\":", 1);
    let pattern = Pattern::parse(&Document::new("t.json", other)).expect("a closed path is enough");
    let said = pattern.notes().iter().any(|note| note.to_string().contains("the path \"contour\""));
    assert!(said && pattern.panels().len() == 3, "{:?}", pattern.notes());
    let empty = shipped("teagan.json").replacen("\"paths\":{", "\"paths\":{},\"other\":{", 1);
    let pattern = Pattern::parse(&Document::new("t.json", empty)).expect("two parts are enough");
    let said = pattern.notes().iter().any(|note| note.to_string().contains("the part is empty"));
    assert!(said && pattern.panels().len() == 2, "{:?}", pattern.notes());
    let wrong = shipped("teagan.json").replacen("{\"t\":\"L\"", "{\"t\":\"X\"", 20);
    says("teagan.json", &wrong, &["parts.teagan.front.paths.seam.ops[1] is no part"]);
    says("d.json", "{\"parts\": {}}", &["no part of the draft is shown"]);
}

proptest! {
    /// No text panics, whatever was cut out of or put into a good one.
    #[test]
    fn damaged_files_are_answered(
        file in 0..5_usize,
        (from, length) in (0.0..1.0_f64, 0..40_usize),
        put in prop::sample::select(vec!["", "[", "}", "1e308", "-1", "\"", "null", "nan", "A1 1 0 0 1 5 5"]),
    ) {
        let name = ["shirt.json", "trousers.json", "teagan.json", "pencil-skirt.toml", "x.toml"][file];
        let text = if file == 4 {
            squares(&[("rectangle = [30, 30]", "path = \"M0 0 V30 H30 a 10 12 5 0 1 0 -30 Z\"")])
        } else {
            shipped(name)
        };
        let start = (from * text.len() as f64) as usize;
        let end = (start + length).min(text.len());
        prop_assume!(text.is_char_boundary(start) && text.is_char_boundary(end));
        let text = format!("{}{put}{}", &text[..start], &text[end..]);
        if let Ok(pattern) = Pattern::parse(&Document::new(name, text)) {
            let _ = Cutter::new(0.02).cut(&pattern);
        }
    }

    /// No path data panics.
    #[test]
    fn any_path_is_answered(data in "[MLHVCSQTAZmlhvcsqtaz0-9 .,e-]{0,60}", unit in prop::num::f64::ANY) {
        let _ = Panel::from_path("p", &data, unit);
    }
}

#[test]
fn traced_pictures_are_refused_before_their_lines_are_compared() {
    let path = format!("M0 0{}H0z", "h.05v.05".repeat(10_000));
    let mistakes = Panel::from_path("p", &path, 1e-3).expect_err("too many edges");
    let [Mistake::TooManyEdges { edges: 20_002, most: 20_000, .. }] = mistakes[..] else {
        panic!("{mistakes:?}")
    };

    let drawing = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100mm\" height=\"100mm\" viewBox=\"0 0 100 100\">\
         <path d=\"M0 0{}z\"/></svg>",
        "h1v1".repeat(500_000)
    );
    let mistakes = Pattern::parse(&Document::new("traced.svg", drawing)).expect_err("a picture");
    let text = mistakes.to_string();
    assert!(text.contains("its lines have 1000002 segments, more than 1000000"), "{text}");
}
