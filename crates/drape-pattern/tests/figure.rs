//! The picture of a cut pattern is sound SVG that shows all panels, seams and names.

use drape_pattern::{Cutter, Pattern, figure};

#[test]
fn the_picture_shows_every_panel_seam_and_name() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/patterns/pencil-skirt.toml");
    let pattern = Pattern::read(path).expect("it is sound");
    let cut = Cutter::new(0.02).cut(&pattern).expect("it can be cut");
    let svg = figure(&pattern, &cut);
    let document = roxmltree::Document::parse(&svg).expect("it is XML");
    let texts: Vec<&str> = document.descendants().filter_map(|n| n.text()).collect();
    for panel in pattern.panels() {
        assert!(texts.contains(&panel.name()));
        assert!(panel.outline().iter().all(|e| texts.contains(&e.name.as_str())));
    }
    // Side seams are drawn in two panels, the waist's in three, each dart and the end of the band
    // in one.
    let colours: Vec<&str> = document.descendants().filter_map(|n| n.attribute("stroke")).collect();
    let mut own: Vec<&str> = colours
        .iter()
        .copied()
        .filter(|c| !["#ffffff", "#222222", "#9aa5b1", "#c9a27a"].contains(c))
        .collect();
    assert_eq!(own.len(), 2 * 2 + 3 + 5);
    own.sort_unstable();
    own.dedup();
    assert_eq!(own.len(), 8, "every seam has its colour");
    assert!(!svg.contains("NaN") && !svg.contains("inf "));
}

#[test]
fn folds_are_dashed_within_their_panel_and_have_their_angle() {
    // A panel with an arm on either side; one line leaves it between the arms, one ends inside, one
    // lies outside.
    let text = "length = \"cm\"\n[panel.u]\ngrain = 0\nstart = [0, 0]\noutline = [\n\
                { to = [30, 0] }, { to = [30, 40] }, { to = [20, 40] }, { to = [20, 20] },\n\
                { to = [10, 20] }, { to = [10, 40] }, { to = [0, 40] }, { to = [0, 0] },\n]\n\
                [[panel.u.fold]]\nfrom = [-10, 30]\nto = [90, 30]\nangle = 90\n\
                [[panel.u.fold]]\nfrom = [5, -20]\nto = [5, 10]\nangle = -22.5\n\
                [[panel.u.fold]]\nfrom = [-5, -20]\nto = [-5, 10]\nangle = 30\n";
    let pattern = Pattern::parse(&drape_input::Document::new("a.toml", text)).expect("it is sound");
    let cut = Cutter::new(0.02).cut(&pattern).expect("it can be cut");
    let svg = figure(&pattern, &cut);
    let document = roxmltree::Document::parse(&svg).expect("it is XML");
    let dashed = document.descendants().filter(|n| n.attribute("stroke-dasharray").is_some());
    let lines: Vec<Vec<f64>> = dashed
        .map(|node| {
            let path = node.attribute("d").expect("a path").replace(['M', 'L'], " ");
            path.split_whitespace().map(|x| x.parse().expect("a number")).collect()
        })
        .collect();
    let [across, up] = &lines[..] else { panic!("{} folds", lines.len()) };
    // In mm, from the left side of the panel, and downwards from its upper one.
    let left = across[0];
    let expected = [left, across[1], left + 100.0, across[1], left + 200.0, across[1]];
    assert!(across[..6].iter().zip(expected).all(|(x, e)| (x - e).abs() < 0.11), "{across:?}");
    assert!(across.len() == 8 && (across[6] - left - 300.0).abs() < 0.11, "{across:?}");
    let top = across[1] - 100.0;
    let mut ends = [up[1] - top, up[3] - top];
    ends.sort_by(f64::total_cmp);
    assert!((ends[0] - 300.0).abs() < 0.11 && (ends[1] - 400.0).abs() < 0.11, "{up:?}");
    assert!(up.len() == 4 && (up[0] - left - 50.0).abs() < 0.11, "{up:?}");
    let texts: Vec<&str> = document.descendants().filter_map(|n| n.text()).collect();
    assert!(texts.contains(&"90°") && texts.contains(&"-22.5°") && !texts.contains(&"30°"));
}

#[test]
fn names_are_escaped() {
    let text = "length = \"cm\"\n[panel.\"a<b&c\"]\ngrain = 0\nrectangle = [30, 30]\n";
    let document = drape_input::Document::new("a.toml", text);
    let pattern = Pattern::parse(&document).expect("it is sound");
    let cut = Cutter::new(0.02).cut(&pattern).expect("it can be cut");
    let svg = figure(&pattern, &cut);
    let document = roxmltree::Document::parse(&svg).expect("it is XML");
    assert!(document.descendants().any(|n| n.text() == Some("a<b&c")));
}

/// A panel of 300 by 200 mm, and one of 100 by 240 mm that is sewn to its right side.
const PAIR: &str = "length = \"mm\"\n[panel.a]\ngrain = 0\nrectangle = [300, 200]\n\
                    [panel.b]\ngrain = 30\nrectangle = [100, 240]\n\
                    [seam.s]\nsides = [[\"a.right\"], [\"b.left\"]]\nmax_ease = 1.3\n";

/// The picture of a pattern that is cut at 20 mm.
fn picture(text: &str) -> String {
    let pattern = Pattern::parse(&drape_input::Document::new("a.toml", text)).expect("it is sound");
    let cut = Cutter::new(0.02).cut(&pattern).expect("it can be cut");
    figure(&pattern, &cut)
}

/// The numbers in path data.
fn numbers(path: &str) -> Vec<f64> {
    let words = path.replace(|c: char| c.is_ascii_alphabetic(), " ");
    words.split_whitespace().map(|x| x.parse().expect("a number")).collect()
}

/// Paths of a document that have a value of an attribute.
fn paths<'a>(document: &'a roxmltree::Document<'_>, key: &str, value: &str) -> Vec<&'a str> {
    let all = document.descendants().filter(|n| n.attribute(key) == Some(value));
    all.filter_map(|n| n.attribute("d")).collect()
}

/// Left, upper, right and lower side of the outlines.
fn boxes(document: &roxmltree::Document<'_>) -> Vec<[f64; 4]> {
    let of = |path: &&str| {
        let all = numbers(path);
        let start = [f64::MAX, f64::MAX, f64::MIN, f64::MIN];
        all.chunks(2)
            .fold(start, |b, p| [b[0].min(p[0]), b[1].min(p[1]), b[2].max(p[0]), b[3].max(p[1])])
    };
    paths(document, "fill", "#faf7f2").iter().map(of).collect()
}

/// Lines of a path of the mesh: both ends.
fn lines(path: &str) -> Vec<[f64; 4]> {
    let all = numbers(path);
    all.chunks(4).map(|l| [l[0], l[1], l[0] + l[2], l[1] + l[3]]).collect()
}

#[test]
fn panels_lie_apart_on_the_sheet_at_true_scale() {
    let svg = picture(PAIR);
    let document = roxmltree::Document::parse(&svg).expect("it is XML");
    let view = numbers(document.root_element().attribute("viewBox").expect("it has one"));
    let [a, b] = boxes(&document)[..] else { panic!("two panels") };
    for (found, size) in [(a, [300.0, 200.0]), (b, [100.0, 240.0])] {
        let off = [found[2] - found[0] - size[0], found[3] - found[1] - size[1]];
        assert!(off.iter().all(|x| x.abs() < 0.11), "{found:?}");
        assert!(found[0] > 0.0 && found[1] > 0.0 && found[2] < view[2] && found[3] < view[3]);
    }
    assert!(a[2] < b[0] || b[2] < a[0] || a[3] < b[1] || b[3] < a[1], "{a:?} {b:?}");
}

#[test]
fn lines_of_the_grid_cross_a_rectangle_from_side_to_side() {
    let svg = picture("length = \"mm\"\n[panel.a]\ngrain = 0\nrectangle = [300, 200]\n");
    let document = roxmltree::Document::parse(&svg).expect("it is XML");
    let [left, top, right, bottom] = boxes(&document)[0];
    // Cells of 20 mm: 15 columns and 10 rows.
    let mut expected: Vec<[f64; 4]> = (0..=15)
        .map(|k| left + 20.0 * f64::from(k))
        .map(|x| [x, bottom, x, top])
        .chain((0..=10).map(|k| bottom - 20.0 * f64::from(k)).map(|y| [left, y, right, y]))
        .collect();
    for line in lines(paths(&document, "stroke", "#9aa5b1")[0]) {
        let same = |e: &[f64; 4]| e.iter().zip(line).all(|(a, b)| (a - b).abs() < 0.21);
        let number = expected.iter().position(same).unwrap_or_else(|| panic!("{line:?}"));
        expected.remove(number);
    }
    assert!(expected.is_empty(), "{expected:?} are not drawn");
}

#[test]
fn the_rim_is_drawn_within_the_panel_in_lines_as_long_as_the_spacing() {
    let svg = picture(PAIR);
    let document = roxmltree::Document::parse(&svg).expect("it is XML");
    let [left, top, right, bottom] = boxes(&document)[1];
    let rim = lines(paths(&document, "stroke", "#c9a27a")[1]);
    // At least one line to each of the 34 nodes of the outline.
    assert!(rim.len() > 34, "{} lines", rim.len());
    for line in rim {
        let length = (line[2] - line[0]).hypot(line[3] - line[1]);
        assert!((10.0..40.0).contains(&length), "{line:?}");
        let inside = |x: f64, y: f64| {
            (left - 0.11..right + 0.11).contains(&x) && (top - 0.11..bottom + 0.11).contains(&y)
        };
        assert!(inside(line[0], line[1]) && inside(line[2], line[3]), "{line:?}");
    }
}

#[test]
fn the_arrowhead_of_a_seam_points_away_from_its_first_stitch() {
    let svg = picture(PAIR);
    let document = roxmltree::Document::parse(&svg).expect("it is XML");
    let view = document.root_element();
    let letter: f64 = numbers(view.attribute("font-size").expect("it has one"))[0];
    let all = document.descendants().filter_map(|n| n.attribute("d"));
    let marks: Vec<&str> = all.filter(|d| d.contains('a')).collect();
    assert_eq!(marks.len(), 2, "one in each panel");
    // Both sides of the seam start below: at the right side of the first, the left of the second.
    for (marks, [x, bottom, height]) in
        marks.iter().zip([(0, 2, 200.0), (1, 0, 240.0)].map(|(panel, side, height)| {
            let outline = boxes(&document)[panel];
            [outline[side], outline[3], height]
        }))
    {
        let (dot, arrow) = marks.split_once('Z').expect("it ends");
        let (dot, arrow) = (numbers(dot), numbers(arrow));
        let centre = [dot[0] + dot[2], dot[1]];
        assert!((centre[0] - x).abs() < 0.21 && (centre[1] - bottom).abs() < 0.21, "{centre:?}");
        let (tip, base) = (&arrow[..2], [2, 3].map(|k| 0.5 * (arrow[k] + arrow[k + 2])));
        assert!((tip[0] - x).abs() < 0.11 && (base[0] - x).abs() < 0.21, "{arrow:?}");
        assert!((base[1] - tip[1] - letter).abs() < 0.21, "{arrow:?} points up");
        // The middle of the seam is between two stitches, or at one.
        assert!((tip[1] - (bottom - 0.5 * height)).abs() < 20.0, "{arrow:?}");
    }
}

#[test]
fn names_of_edges_stand_beside_the_middle_of_their_edges_inside() {
    let svg = picture("length = \"mm\"\n[panel.a]\ngrain = 0\nrectangle = [300, 200]\n");
    let document = roxmltree::Document::parse(&svg).expect("it is XML");
    let [left, top, right, bottom] = boxes(&document)[0];
    let view = document.root_element();
    let letter: f64 = numbers(view.attribute("font-size").expect("it has one"))[0];
    let middle = [0.5 * (left + right), 0.5 * (top + bottom)];
    for (name, at, inward) in [
        ("bottom", [middle[0], bottom], [0.0, -1.0]),
        ("right", [right, middle[1]], [-1.0, 0.0]),
        ("top", [middle[0], top], [0.0, 1.0]),
        ("left", [left, middle[1]], [1.0, 0.0]),
    ] {
        let node =
            document.descendants().find(|n| n.has_tag_name("text") && n.text() == Some(name));
        let node = node.unwrap_or_else(|| panic!("{name} is not written"));
        let [x, y, size] = ["x", "y", "font-size"]
            .map(|key| numbers(node.attribute(key).expect("it is placed"))[0]);
        // From the line that the letters stand on to the middle of their height.
        let arm = [x - at[0], y - 0.35 * size - at[1]];
        let off = arm[0] * inward[0] + arm[1] * inward[1];
        let along = (arm[0] * inward[1] - arm[1] * inward[0]).abs();
        assert!(off > 0.5 * letter && off < 1.5 * letter, "{name} is {off} mm inside");
        // Half a spacing where the middle is a node.
        assert!(along < 10.2, "{name} is {along} mm from the middle");
    }
}

#[test]
fn darts_are_holes_in_the_cloth_with_legs_in_the_colour_of_their_seam() {
    let svg = picture(
        "length = \"mm\"\n[panel.a]\ngrain = 0\nrectangle = [300, 400]\n\
         [[panel.a.dart]]\nname = \"eye\"\nfrom = [100, 340]\nto = [100, 120]\nwidth = 30\n\
         [[panel.a.dart]]\nname = \"bust\"\nedge = \"right\"\nat = 200\nwidth = 40\ndepth = 120\n",
    );
    let document = roxmltree::Document::parse(&svg).expect("it is XML");
    let texts: Vec<&str> = document.descendants().filter_map(|n| n.text()).collect();
    for name in ["eye left", "eye right", "bust left", "bust right", "right 1", "right 2"] {
        let name = [name, &format!("{name} 1")].map(|name| texts.contains(&name));
        assert!(name[0] || name[1], "{texts:?}");
    }
    // The fill leaves the hole out: the path runs round both, and by the rule of even and odd.
    let [fill] = paths(&document, "fill", "#faf7f2")[..] else { panic!("one panel") };
    assert_eq!(fill.matches('M').count(), 2);
    let [left, top, ..] = boxes(&document)[0];
    let rings: Vec<Vec<f64>> = fill.split('M').skip(1).map(numbers).collect();
    let area = |ring: &[f64]| {
        let p = |k: usize| [ring[2 * k % ring.len()], ring[(2 * k + 1) % ring.len()]];
        let cross = |k: usize| p(k)[0] * p(k + 1)[1] - p(k)[1] * p(k + 1)[0];
        (0..ring.len() / 2).map(cross).sum::<f64>().abs() / 2.0
    };
    assert!((area(&rings[0]) - (300.0 * 400.0 - 0.5 * 40.0 * 120.0)).abs() < 60.0);
    assert!((area(&rings[1]) - 0.5 * 220.0 * 30.0).abs() < 30.0, "{}", area(&rings[1]));
    let inside = rings[1]
        .chunks(2)
        .all(|p| (84.0..116.0).contains(&(p[0] - left)) && (59.0..281.0).contains(&(p[1] - top)));
    assert!(inside, "{:?}", rings[1]);
    // No line of the mesh crosses the middle of the hole.
    let mesh = ["#9aa5b1", "#c9a27a"].map(|colour| paths(&document, "stroke", colour));
    for line in mesh.into_iter().flatten().flat_map(lines) {
        for k in 0..=20 {
            let t = f64::from(k) / 20.0;
            let p = [0, 1].map(|k| line[k] + t * (line[k + 2] - line[k]));
            let off = (p[0] - left - 100.0).abs() / 15.0 + (p[1] - top - 170.0).abs() / 110.0;
            assert!(off > 0.9, "{line:?} crosses the dart");
        }
    }
    let seams = document.descendants().filter_map(|n| n.attribute("stroke"));
    let mut colours: Vec<&str> =
        seams.filter(|colour| colour.starts_with("hsl") || colour.len() == 7).collect();
    colours.retain(|c| !["#ffffff", "#222222", "#9aa5b1", "#c9a27a"].contains(c));
    colours.sort_unstable();
    colours.dedup();
    assert_eq!(colours.len(), 2, "one of each dart");
}
