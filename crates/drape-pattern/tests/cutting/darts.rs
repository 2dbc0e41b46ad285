//! Darts: of a shipped skirt, closed ones inside a panel, and open ones at an edge.

use drape_input::Document;
use drape_pattern::{CutPattern, Panel, Pattern};

use crate::garments::{cut, shipped};

fn read(text: &str) -> Pattern {
    let pattern = Pattern::parse(&Document::new("darts.toml", text));
    pattern.unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"))
}

/// A back of 320 by 400 mm with more keys, on the bias or not.
fn back(grain: f64, more: &str) -> String {
    format!("length = \"mm\"\n[panel.back]\ngrain = {grain}\nrectangle = [320, 400]\n{more}")
}

/// Closed darts: straight and widest below the middle, oblique, and with curved legs.
const CLOSED: &str = r#"
[[panel.back.dart]]
name = "left"
from = [70, 340]
to = [70, 90]
width = 26
widest = 140
[[panel.back.dart]]
from = [230, 330]
to = [265, 120]
width = 20
[[panel.back.dart]]
name = "curved"
from = [150, 380]
left = [{ to = [158, 250], quadratic = [156, 330] }, { to = [152, 150], quadratic = [160, 190] }]
right = [{ to = [152, 150], radius = 900 }]
"#;

/// Names of the seams with the numbers of their pairs.
fn seams(pattern: &Pattern, cut: &CutPattern) -> Vec<(String, usize)> {
    let all = pattern.seams().iter().zip(&cut.seams);
    all.map(|(seam, nodes)| (seam.name.clone(), nodes.pairs.len())).collect()
}

#[test]
fn darts_are_open_notches_whose_legs_are_sewn_to_one_tip() {
    let pattern = shipped("pencil-skirt.toml");
    for spacing in [0.005, 0.01, 0.02] {
        let (_, cut) = cut(&pattern, spacing);
        for (seam, nodes) in pattern.seams().iter().zip(&cut.seams) {
            if !seam.name.contains("dart") {
                continue;
            }
            let [mouth, tip] = [nodes.pairs[0], nodes.pairs[nodes.pairs.len() - 1]];
            let panel = &cut.panels[tip[0].panel];
            let place = |node: u32| panel.positions[node as usize];
            assert_eq!(tip[0], tip[1], "{}: both legs end in one node", seam.name);
            assert!(panel.hard[tip[0].node as usize]);
            let depth = if panel.panel == "front" { 0.48 } else { 0.44 };
            assert!((place(tip[0].node)[1] - depth).abs() < 1e-12, "{}", seam.name);
            let width = place(mouth[0].node)[0] - place(mouth[1].node)[0];
            let expected = if panel.panel == "front" { 0.025 } else { 0.035 };
            assert!((width - expected).abs() < 1e-12, "{}: {width} m open", seam.name);
        }
    }
}

#[test]
fn darts_are_cut_as_well_on_the_bias() {
    let pattern = shipped("pencil-skirt.toml");
    let turned = |panel: &Panel| {
        panel.clone().with_grain(std::f64::consts::FRAC_PI_4).expect("it is finite")
    };
    let panels = pattern.panels().iter().map(turned).collect();
    let bias = Pattern::new(panels, pattern.seams().to_vec()).expect("it is sound");
    for spacing in [0.005, 0.01, 0.02] {
        cut(&bias, spacing);
    }
}

#[test]
fn a_waistband_is_sewn_over_the_mouths_of_darts_and_over_the_side_seam() {
    let pattern = shipped("pencil-skirt.toml");
    let (_, cut) = cut(&pattern, 0.01);
    let number = |name: &str| pattern.panels().iter().position(|p| p.name() == name).expect(name);
    let [back, band, front] = ["back", "band", "front"].map(number);
    let number = pattern.seams().iter().position(|s| s.name == "band").expect("it is there");
    let seam = &cut.seams[number];
    // Where the chain leaves a piece of the waist, one node of the band has two partners: at the
    // mouths of four darts and at one side seam.
    let twice: Vec<_> = seam.pairs.windows(2).filter(|two| two[0][0] == two[1][0]).collect();
    assert_eq!(twice.len(), 5);
    let sewn: Vec<u32> = twice.iter().map(|two| two[0][0].node).collect();
    assert!(sewn.iter().all(|&node| cut.panels[band].hard[node as usize]), "{sewn:?}");
    let panels: Vec<[usize; 2]> =
        twice.iter().map(|two| [two[0][1].panel, two[1][1].panel]).collect();
    assert_eq!(panels, [[front; 2], [front; 2], [front, back], [back; 2], [back; 2]]);
    // Both mouth nodes are the ends of the legs of one dart.
    let place = |id: drape_pattern::NodeId| cut.panels[id.panel].positions[id.node as usize];
    assert_eq!(twice[0].iter().map(|pair| place(pair[1])[0]).collect::<Vec<_>>(), [0.1075, 0.1325]);
    let band = &cut.panels[band];
    assert_eq!(
        band.edges[0].len() - 1,
        seam.pairs.len() - 1 - twice.len(),
        "all of its nodes are sewn"
    );
}

#[test]
fn closed_darts_are_holes_whose_legs_are_sewn_from_tip_to_tip() {
    for grain in [0.0, 90.0, 45.0, 17.0] {
        let pattern = read(&back(grain, CLOSED));
        let [panel] = pattern.panels() else { panic!("one panel") };
        assert_eq!((panel.darts().len(), panel.loops().count()), (3, 4));
        // The straight ones are rhombs, the curved one a polygon of many corners.
        let straight = 0.5e-6 * (250.0 * 26.0 + 35_f64.hypot(210.0) * 20.0);
        let hole = panel.loops().nth(3).expect("it has three darts");
        let points: Vec<[f64; 2]> = hole
            .iter()
            .flat_map(|edge| (0..2000).map(|k| edge.at(f64::from(k) / 2000.0)))
            .collect();
        let next = points.iter().cycle().skip(1);
        let curved: f64 =
            points.iter().zip(next).map(|(a, b)| 0.5 * (a[1] * b[0] - a[0] * b[1])).sum();
        assert!(
            curved > 1e-3 && (panel.area() - (0.128 - straight - curved)).abs() < 1e-9,
            "{curved}"
        );
        for spacing in [0.005, 0.01] {
            let (particles, cut) = cut(&pattern, spacing);
            let [own] = &cut.panels[..] else { panic!("one panel") };
            assert_eq!(own.holes.len(), 3);
            let names: Vec<String> =
                seams(&pattern, &cut).into_iter().map(|(name, _)| name).collect();
            assert_eq!(names, ["back.left", "back.dart 2", "back.curved"]);
            let mut sewn = 0;
            for (nodes, tips) in cut.seams.iter().zip([
                [[0.07, 0.34], [0.07, 0.09]],
                [[0.23, 0.33], [0.265, 0.12]],
                [[0.15, 0.38], [0.152, 0.15]],
            ]) {
                let place = |id: drape_pattern::NodeId| own.positions[id.node as usize];
                let [first, last] = [nodes.pairs[0], nodes.pairs[nodes.pairs.len() - 1]];
                assert!(first[0] == first[1] && last[0] == last[1], "both ends are one node");
                let ends = [place(first[0]), place(last[0])];
                let near = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]) < 1e-12;
                let right = (0..2).all(|k| near(ends[k], tips[k]))
                    || (0..2).all(|k| near(ends[k], tips[1 - k]));
                assert!(right, "{ends:?} and {tips:?}");
                // Left of the way from the first tip to the second is one leg, right of it the
                // other.
                let way = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
                let side =
                    |p: [f64; 2]| way[0] * (p[1] - ends[0][1]) - way[1] * (p[0] - ends[0][0]);
                for pair in &nodes.pairs[1..nodes.pairs.len() - 1] {
                    let [a, b] = pair.map(|id| side(place(id)));
                    assert!((a - b).abs() > 1e-9, "the legs are apart: {pair:?}");
                }
                assert!(nodes.breaks.is_empty() && nodes.ties.is_empty());
                sewn += nodes.pairs.len() - 2;
            }
            assert_eq!(particles, own.positions.len() - sewn, "each pair is one particle");
        }
    }
}

#[test]
fn a_mirrored_copy_has_its_darts_on_the_other_side_and_comes_back_from_files() {
    let text = back(10.0, CLOSED) + "[panel.other]\ncopy_of = \"back\"\nmirrored = true\n";
    let pattern = read(&text);
    let (_, cut) = cut(&pattern, 0.01);
    assert_eq!(seams(&pattern, &cut).len(), 6);
    let holes = |pattern: &Pattern| -> Vec<Vec<[f64; 2]>> {
        let of = |panel: &Panel| -> Vec<Vec<[f64; 2]>> {
            let middle =
                |hole: &[drape_pattern::Edge]| hole.iter().map(|edge| edge.at(0.5)).collect();
            panel.loops().skip(1).map(middle).collect()
        };
        pattern.panels().iter().flat_map(of).collect()
    };
    let all = holes(&pattern);
    for (one, other) in all[..3].iter().zip(&all[3..]) {
        for p in one {
            assert!(
                other.iter().any(|q| (p[0] + q[0]).hypot(p[1] - q[1]) < 1e-12),
                "{p:?}: {other:?}"
            );
        }
    }
    for (again, format) in
        [(pattern.to_toml("Again."), "again.toml"), (pattern.to_svg(None), "again.svg")]
    {
        let read = Pattern::parse(&Document::new(format, &again));
        let read = read.unwrap_or_else(|mistakes| panic!("{mistakes}\n{again}"));
        assert_eq!(read.seams().len(), pattern.seams().len(), "{format}");
        for (one, other) in all.iter().zip(holes(&read)) {
            for p in one {
                let near = other.iter().any(|q| (p[0] - q[0]).hypot(p[1] - q[1]) < 1e-6);
                assert!(near, "{format}: {p:?}: {other:?}");
            }
        }
    }
}

/// Front with three darts in its edges: two at the waist, by depth and by tip, and one in the side.
const OPEN: &str = r#"length = "mm"
[panel.front]
grain = 0
rectangle = [300, 400]
[[panel.front.dart]]
name = "b"
edge = "top"
at = 220
width = 24
depth = 110
[[panel.front.dart]]
name = "a"
edge = "top"
at = 80
width = 20
to = [215, 300]
[[panel.front.dart]]
name = "bust"
edge = "right"
at = 250
width = 30
to = [180, 260]
[panel.band]
grain = 90
rectangle = [256, 40]
[panel.back]
grain = 0
rectangle = [300, 370]
[seam.waist]
sides = [["band.bottom"], ["front.top"]]
[seam.side]
sides = [["front.right"], ["back.left"]]
"#;

#[test]
fn open_darts_are_cut_into_an_edge_over_which_seams_run_on() {
    let pattern = read(OPEN);
    let front = pattern.panels().iter().find(|panel| panel.name() == "front").expect("it is there");
    let names: Vec<&str> = front.outline().iter().map(|edge| edge.name.as_str()).collect();
    let expected = [
        "bottom",
        "right 1",
        "bust left",
        "bust right",
        "right 2",
        "top 1",
        "a left",
        "a right",
        "top 2",
        "b left",
        "b right",
        "top 3",
        "left",
    ];
    assert_eq!(names, expected);
    let cut_away = 0.5 * (0.024 * 0.11 + 0.02 * 0.1 + 0.03 * 0.12);
    assert!((front.area() - (0.12 - cut_away)).abs() < 1e-12, "{} m²", front.area());
    for spacing in [0.005, 0.01, 0.02] {
        let (_, cut) = cut(&pattern, spacing);
        let number =
            |name: &str| pattern.seams().iter().position(|seam| seam.name == name).expect(name);
        let [waist, side] = ["waist", "side"].map(|name| &cut.seams[number(name)]);
        assert_eq!((waist.breaks.len(), side.breaks.len()), (2, 1), "one for each mouth");
        for name in ["front.a", "front.b", "front.bust"] {
            let pairs = &cut.seams[number(name)].pairs;
            let is_one = |pair: &[drape_pattern::NodeId; 2]| pair[0] == pair[1];
            assert_eq!(pairs.iter().filter(|pair| is_one(pair)).count(), 1, "{name} has one tip");
            assert!(pairs.len() as f64 > 0.09 / spacing, "{name}: {} pairs", pairs.len());
        }
    }
    let again = read(&pattern.to_toml(""));
    assert_eq!(again.seams().len(), pattern.seams().len());
    assert!((again.panels()[2].area() - front.area()).abs() < 1e-9);
}

#[test]
fn darts_that_cannot_be_sewn_are_answered_with_their_panel_and_their_edge() {
    let says = |more: &str, words: &[&str]| {
        let said = Pattern::parse(&Document::new("darts.toml", back(0.0, more)));
        let said = said.expect_err(more).to_string();
        assert!(words.iter().all(|word| said.contains(word)), "{words:?}: {said}");
    };
    let dart = |keys: &str| format!("[[panel.back.dart]]\nname = \"d\"\n{keys}\n");
    says(
        &dart("from = [70, 340]\nto = [70, -10]\nwidth = 20"),
        &[
            "darts.toml:5:",
            "panel back: dart d meets edge bottom near",
            "edge, at, width and depth",
        ],
    );
    says(
        &dart("from = [400, 300]\nto = [400, 100]\nwidth = 20"),
        &["dart d is not in the cloth of the panel"],
    );
    says(
        &(dart("from = [70, 340]\nto = [70, 100]\nwidth = 20")
            + &dart("from = [40, 200]\nto = [100, 200]\nwidth = 9").replace("\"d\"", "\"e\"")),
        &["dart[1]", "meets edge d left"],
    );
    says(&dart("from = [70, 340]\nwidth = 20"), &["dart[0]: to is missing", "the other tip"]);
    says(
        &dart("from = [70, 340]\nto = [70, 100]"),
        &["has no single form", "width for straight legs"],
    );
    says(
        &dart("from = [70, 340]\nto = [70, 100]\nwidth = 20\nwidest = 250"),
        &["widest", "between 0 and 240 mm"],
    );
    says(&dart("from = [70, 340]\nto = [70, 100]\nwidth = 0"), &["gives the dart no area"]);
    says(&dart("to = [70, 100]\nwidth = 20"), &["neither closed nor open"]);
    says(
        &dart("edge = \"tpo\"\nat = 100\nwidth = 20\ndepth = 90"),
        &["panel back has no edge \"tpo\"", "top"],
    );
    says(
        &dart("edge = \"top\"\nat = 315\nwidth = 20\ndepth = 90"),
        &["the mouth of dart d is from 305 mm to 325 mm along edge top, which is 320 mm long"],
    );
    says(
        &dart("edge = \"top\"\nat = 100\nwidth = 20\ndepth = 500"),
        &["panel back: edges", "cross or touch"],
    );
    says(&dart("edge = \"top\"\nat = 100\nwidth = 20"), &["no single tip", "depth"]);
    says(
        &dart("from = [70, 340]\nleft = [{ to = [80, 100] }]\nright = [{ to = [60, 100] }]"),
        &["its legs do not end in one tip"],
    );
    says(
        &dart("from = [70, 340]\nleft = [{ to = [80, 100] }]\nright = [{ to = [80, 100] }]"),
        &["panel back", "dart"],
    );
}
