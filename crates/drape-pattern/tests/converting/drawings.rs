//! Drawings in SVG, and pages.

use drape_input::Document;
use drape_pattern::{Edge, Paper, Pattern, Request, Unit};

use crate::{OWN, apart, noted, read, refused, shipped};

#[test]
fn a_drawing_that_was_moved_and_changed_keeps_what_it_still_says() {
    let own = read("own.toml", OWN);
    let drawing = own.to_svg(None);
    let moved = drawing.replacen(
        "<g class=\"panel\"",
        "<g transform=\"translate(40 -7)\" class=\"panel\"",
        1,
    );
    assert!(apart(&own, &read("moved.svg", &moved)) < 1e-6, "the origin moves along");
    // A panel with another number of edges: its edges are numbered, and its seam is lost, with
    // notes.
    let corner = drawing.replacen("data-edges=\"bottom|", "data-edges=\"", 1);
    let cut = read("cut.svg", &corner);
    assert!(noted(&cut, "numbered anew") && noted(&cut, "side"), "{:?}", cut.notes());
    assert!(cut.seams().is_empty());
    // Without the panel, its seam goes too.
    let (before, rest) = drawing.split_once("<g class=\"panel\"").expect("it has a panel");
    let (_, after) = rest.split_once("</g>").expect("the group ends");
    let one = read("one.svg", &format!("{before}{after}"));
    assert!(one.panels().len() == 1 && one.seams().is_empty() && noted(&one, "left out too: side"));
}

#[test]
fn pages_show_all_of_the_pattern_at_true_scale() {
    let shirt = read("shirt.json", &shipped("shirt.json"));
    for (word, size) in
        [("a4", [210.0, 297.0]), ("letter", [215.9, 279.4]), ("500x400", [500.0, 400.0])]
    {
        let paper = Paper::parse(word).expect("a paper");
        assert_eq!(paper.size, size);
        let pages = shirt.to_pages(paper);
        let area: f64 = shirt.panels().iter().map(|p| p.area()).sum::<f64>() * 1e6;
        assert!(pages.len() as f64 * size[0] * size[1] > area, "{} pages", pages.len());
        for page in &pages {
            let head =
                format!("width=\"{}mm\" height=\"{}mm\" viewBox=\"0 0 {0} {1}\"", size[0], size[1]);
            assert!(page.svg.contains(&head), "{}", &page.svg[..200]);
            let words = [format!("data-page=\"{}\"", page.name), "50 mm long".into()];
            assert!(
                words.iter().all(|w| page.svg.contains(w))
                    && page.svg.matches("\"cross\"").count() == 4
            );
            roxmltree::Document::parse(&page.svg).expect("it is XML");
        }
        let named = |panel: &str| pages.iter().any(|p| p.svg.contains(&format!("\"{panel}\"")));
        assert!(shirt.panels().iter().all(|panel| named(panel.name())));
        refused("page.svg", &pages[0].svg, &["page A1 of a print", "read the *.toml"]);
    }
    assert!(["a9", "10x10", "x", "1e9x5", "nanxnan"].iter().all(|w| Paper::parse(w).is_none()));
}

/// A drawing with a panel of 300 by 400 units, a grain line, a notch and a mark.
fn drawing(size: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" {size}>\n<g id=\"bodice\"><path id=\"path12\" d=\"M10 10 h300 v400 \
         h-300 z\"/>\n<line class=\"grain\" x1=\"100\" y1=\"300\" x2=\"200\" y2=\"100\"/>\n<path id=\"notch1\" d=\"M310 \
         110 h-5\"/><circle cx=\"60\" cy=\"60\" r=\"5\"/><rect x=\"50\" y=\"200\" width=\"60\" height=\"60\"/></g>\n</svg>"
    )
}

#[test]
fn the_unit_of_a_drawing_is_detected_or_asked_for() {
    for (size, side) in [
        ("width=\"600mm\" height=\"500mm\" viewBox=\"0 0 600 500\"", 0.3),
        ("width=\"60cm\" viewBox=\"0 0 600 500\"", 0.3),
        ("width=\"6in\" height=\"5in\" viewBox=\"0 0 600 500\"", 0.00254 * 30.0),
        ("width=\"600pt\" height=\"500pt\" viewBox=\"0 0 600 500\"", 300.0 * 0.0254 / 72.0),
        ("width=\"100cm\"", 300.0 * 0.0254 / 96.0),
        (
            "xmlns:i=\"http://www.inkscape.org/namespaces/inkscape\" i:version=\"1.3\" viewBox=\"0 0 9 9\"",
            300.0 * 0.0254 / 96.0,
        ),
    ] {
        let pattern = read("d.svg", &drawing(size));
        let [panel] = pattern.panels() else { panic!("{size}: one panel") };
        assert_eq!(panel.name(), "bodice");
        let width = panel.outline().iter().map(Edge::length).fold(f64::MAX, f64::min);
        assert!((width - side).abs() < 1e-9, "{size}: {width} m");
        // Drawn from (100, 300) to (200, 100): to the right and up.
        assert!((panel.grain() + 0.5_f64.atan()).abs() < 1e-9, "{}", panel.grain());
        let notched: Vec<&Edge> =
            panel.outline().iter().filter(|e| !e.notches.is_empty()).collect();
        assert_eq!(notched.len(), 1, "{size}");
        assert!(noted(&pattern, "a unit of the drawing is"));
        let inner = ["it lies in panel bodice", "2 closed shapes under 20 mm"];
        assert!(inner.iter().any(|words| noted(&pattern, words)), "{:?}", pattern.notes());
    }
    for size in [
        "viewBox=\"0 0 600 500\"",
        "width=\"600\" height=\"500\"",
        "width=\"100%\"",
        "width=\"600px\"",
    ] {
        let text = drawing(size);
        refused(
            "d.svg",
            &text,
            &[
                "does not say how long",
                "\"bodice\"",
                "400.0 units",
                "400 mm",
                "141 mm",
                "106 mm",
                "unit = \"mm\" (or cm, m, in, pt, px)",
            ],
        );
        // The remedy.
        let folder = std::env::temp_dir().join(format!("drape-unit-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        std::fs::write(folder.join("d.svg"), &text).expect("it is written");
        let asked = Request { unit: Unit::parse("mm"), ..Request::new(folder.join("d.svg")) };
        let pattern = Pattern::read_as(&asked).expect("the unit is known");
        assert!((pattern.panels()[0].area() - 0.12).abs() < 1e-9);
        let added = "length = \"mm\"\n[from]\nfile = \"d.svg\"\nunit = \"mm\"\n[panel.bodice]\ngrain = 90\n";
        let pattern =
            Pattern::parse(&Document::new(folder.join("d.toml"), added)).expect("as well");
        assert!((pattern.panels()[0].grain().to_degrees() - 90.0).abs() < 1e-9);
        std::fs::remove_dir_all(&folder).expect("it is removed");
    }
    refused(
        "d.svg",
        &drawing("width=\"600m\" height=\"-5mm\" viewBox=\"0 0 600 500\""),
        &["height is \"-5mm\""],
    );
    refused(
        "d.svg",
        &drawing("width=\"6mm\" viewBox=\"0 0 600 500\""),
        &[
            "no closed shape of 20 mm",
            "largest shape is 4.0 mm",
            "6mm for 600 units",
            "if the unit is wrong",
        ],
    );
    refused("d.svg", &drawing("viewBox=\"0 0 b\""), &["viewBox is", "0 0 210 297"]);
}

#[test]
fn transforms_shapes_and_lines_drawn_apart_make_outlines() {
    let svg = |body: &str| {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"600mm\" viewBox=\"0 0 600 600\">{body}</svg>"
        )
    };
    let area = |body: &str| 1e6 * read("d.svg", &svg(body)).panels()[0].area();
    assert!((area("<circle cx=\"300\" cy=\"200\" r=\"100\"/>") - 31415.93).abs() < 0.01);
    assert!(
        (area("<g transform=\"rotate(30) scale(2)\"><circle r=\"50\"/></g>") - 31415.93).abs()
            < 0.01
    );
    let skewed = area("<g transform=\"scale(2 1)\"><circle r=\"50\"/></g>");
    assert!((skewed - 15707.96).abs() < 0.1, "{skewed}");
    let mirrored = area(
        "<g transform=\"matrix(-1 0 0 1 300 0)\"><path d=\"M0 0H100V50A50 50 0 0 1 50 100H0Z\"/></g>",
    );
    assert!(
        (mirrored - (10000.0 - 2500.0 + 625.0 * std::f64::consts::PI)).abs() < 0.01,
        "{mirrored}"
    );
    let round = area("<rect width=\"100\" height=\"80\" rx=\"10\"/>");
    assert!((round - (8000.0 - 100.0 * (4.0 - std::f64::consts::PI))).abs() < 0.01, "{round}");
    let lines = "<g id=\"p\"><path d=\"M0 0L100 0M100 100L100 0M0 100L0 0M100 100C80 90 20 90 0 100\"/></g>";
    let pattern = read("d.svg", &svg(lines));
    assert_eq!(pattern.panels()[0].outline().len(), 4);
    // A cut line round a sewing line.
    let both =
        "<path id=\"cut\" d=\"M0 0H220V320H0Z\"/><path id=\"sew\" d=\"M10 10H210V310H10Z\"/>";
    let pattern = read("d.svg", &svg(both));
    assert!(pattern.panels()[0].name() == "sew" && noted(&pattern, "the sewing line"));
    // What is not shown, and names that two shapes have.
    let two = "<defs><rect width=\"900\" height=\"900\"/></defs><rect style=\"display: none\" width=\"955\" height=\"900\"/>\
               <g id=\"a\"><rect width=\"250\" height=\"450\"/><rect x=\"300\" width=\"250\" height=\"450\"/></g><use href=\"#a\"/>";
    let pattern = read("d.svg", &svg(two));
    let names: Vec<&str> = pattern.panels().iter().map(|p| p.name()).collect();
    assert!(names == ["a", "a 2"] && noted(&pattern, "unlink"), "{names:?}");
    refused(
        "d.svg",
        &svg("<path id=\"f\" d=\"M0 0H100V100H0V3\"/>"),
        &["outline \"f\" is open: 3.0 mm", "join the ends"],
    );
    read("d.svg", &svg("<path id=\"f\" d=\"M0 0H100V100H0V0\"/>"));
    // A mark that is almost closed is no outline, for it is small.
    let mark = "<rect width=\"100\" height=\"90\"/><path d=\"M40 40H50V50H40V40.5\"/>";
    assert_eq!(read("d.svg", &svg(mark)).panels().len(), 1);
    refused(
        "d.svg",
        &svg("<path id=\"f\" d=\"M0 0L100 100H0L100 0Z\"/>"),
        &["d.svg:1", "cross or touch"],
    );
    refused("d.svg", &svg("<path d=\"M0 0H5V5Z\"/>"), &["no closed shape of 20 mm"]);
    refused("d.svg", "<svg><g></svg>", &["d.svg:1:", "plain SVG"]);
    refused("d.svg", "<html/>", &["no <svg>"]);
}

/// A band of 300 by 80 mm on a skirt whose waist is two edges, of 200 and of 100 mm.
const BAND: &str = r#"length = "mm"
[panel.band]
grain = 0
fabric = "shell"
rectangle = [300, 80]
[panel.skirt]
grain = 0
start = [0, 0]
outline = [
    { name = "hem", to = [300, 0] },
    { name = "side", to = [300, 400] },
    { name = "long", to = [100, 400] },
    { name = "short", to = [0, 400] },
    { name = "centre", to = [0, 0] },
]
[seam.waist]
sides = [["band.bottom"], ["skirt.short", "skirt.long"]]
"#;

/// Texts of a panel of a drawing: words, middle of the height where they begin, end or are centred,
/// in the panel's frame, in mm, and size of the letters.
fn texts(svg: &str, panel: &str) -> Vec<(String, [f64; 2], f64)> {
    let document = roxmltree::Document::parse(svg).expect("it is XML");
    let group = document.descendants().find(|n| n.attribute("data-panel") == Some(panel));
    let group = group.expect("it is drawn");
    let origin = numbers(group.attribute("data-origin").expect("it has an origin"));
    let texts = group.children().filter(|n| n.has_tag_name("text")).map(|node| {
        let [x, y, size] = ["x", "y", "font-size"]
            .map(|key| numbers(node.attribute(key).expect("it is placed"))[0]);
        let middle = [x - origin[0], origin[1] - (y - 0.35 * size)];
        (node.text().expect("it has words").to_owned(), middle, size)
    });
    texts.collect()
}

/// Numbers of path data.
fn numbers(data: &str) -> Vec<f64> {
    let words = data.replace(['M', 'L'], " ");
    words.split_whitespace().map(|x| x.parse().expect("a number")).collect()
}

#[test]
fn the_name_of_an_edge_stands_behind_its_ticks_with_its_height_in_the_middle() {
    let texts = texts(&read("band.toml", BAND).to_svg(None), "band");
    for (words, middle, inward) in [
        ("A · bottom", [150.0, 0.0], [0.0, 1.0]),
        ("right", [300.0, 40.0], [-1.0, 0.0]),
        ("top", [150.0, 80.0], [0.0, -1.0]),
        ("left", [0.0, 40.0], [1.0, 0.0]),
    ] {
        let found = texts.iter().find(|text| text.0 == words);
        let (_, at, size) = found.unwrap_or_else(|| panic!("{words}: {texts:?}"));
        // Ticks are 5 mm long.
        let off = 5.0 + 0.5 * size;
        let expected = [0, 1].map(|k| middle[k] + off * inward[k]);
        assert!((0..2).all(|k| (at[k] - expected[k]).abs() < 0.02), "{words}: {at:?} {expected:?}");
    }
}

#[test]
fn the_fabric_stands_in_smaller_letters_below_the_name_of_its_panel() {
    let texts = texts(&read("band.toml", BAND).to_svg(None), "band");
    let find = |words: &str| texts.iter().find(|text| text.0 == words).expect("it is written");
    let ((_, name, large), (_, fabric, small)) = (find("band"), find("shell"));
    assert!(small < large && *small > 0.5 * large, "{small} {large}");
    let apart = name[1] - fabric[1];
    assert!(
        name[0] == fabric[0] && apart > 0.5 * (large + small) && apart < 2.0 * large,
        "{apart}"
    );
    assert!(fabric[1] - 0.5 * small > 0.0, "{fabric:?}");
}

#[test]
fn ticks_of_a_seam_stand_at_its_middle_and_where_edges_of_the_other_side_end() {
    let svg = read("band.toml", BAND).to_svg(None);
    let document = roxmltree::Document::parse(&svg).expect("it is XML");
    for (panel, height, inward, expected) in
        [("band", 0.0, 5.0, &[100.0, 150.0][..]), ("skirt", 400.0, -5.0, &[150.0])]
    {
        let group = document.descendants().find(|n| n.attribute("data-panel") == Some(panel));
        let group = group.expect("it is drawn");
        let origin = numbers(group.attribute("data-origin").expect("it has an origin"));
        let ticks = group.children().filter(|n| n.attribute("class") == Some("match"));
        let mut ticks: Vec<Vec<f64>> =
            ticks.map(|node| numbers(node.attribute("d").expect("a path"))).collect();
        ticks.sort_by(|a, b| a[0].total_cmp(&b[0]));
        assert_eq!(ticks.len(), expected.len(), "{panel}: {ticks:?}");
        for (tick, x) in ticks.iter().zip(expected) {
            let ends =
                [x + origin[0], origin[1] - height, x + origin[0], origin[1] - height - inward];
            assert!(tick.iter().zip(ends).all(|(a, b)| (a - b).abs() < 1e-3), "{panel}: {tick:?}");
        }
    }
}
