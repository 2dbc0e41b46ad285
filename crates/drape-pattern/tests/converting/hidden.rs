//! Drawings and drafts that hide paths, that are halves, or are of a size that no garment has.

use drape_input::Document;
use drape_pattern::{Pattern, Request, Unit};

use crate::{noted, read, refused};

/// A pocket of 150 by 200 mm, and what a drawing hides, in a unit of 1 mm.
fn pocket(style: &str, hidden: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
         width=\"1000mm\" viewBox=\"0 0 1000 1000\"><style>{style}</style>{hidden}\
         <g id=\"pocket\"><path id=\"path1\" d=\"M10 10h150v200h-150z\"/></g></svg>"
    )
}

#[test]
fn what_a_drawing_hides_is_no_outline() {
    let base = "d=\"M0 0H600V1100H0Z\"";
    for (style, hidden) in [
        ("", format!("<path id=\"base\" display=\"none\" {base}/>")),
        ("", format!("<path id=\"base\" style=\"visibility:hidden\" {base}/>")),
        ("", format!("<path id=\"base\" opacity=\"0\" {base}/>")),
        ("", format!("<path id=\"base\" fill=\"none\" stroke=\"none\" {base}/>")),
        (".hidden{display:none}", format!("<path id=\"base\" class=\"fabric hidden\" {base}/>")),
        ("#base , .x { visibility : hidden }", format!("<path id=\"base\" {base}/>")),
        (
            "",
            format!(
                "<g inkscape:groupmode=\"layer\" inkscape:label=\"construction\" style=\"display:none\">\
                 <g><path id=\"base\" {base}/></g></g>"
            ),
        ),
        ("", format!("<defs><path id=\"base\" {base}/></defs>")),
        ("", format!("<symbol><g><path id=\"base\" {base}/></g></symbol>")),
    ] {
        let pattern = read("pocket.svg", &pocket(style, &hidden));
        let names: Vec<&str> = pattern.panels().iter().map(|panel| panel.name()).collect();
        assert_eq!(names, ["pocket"], "{hidden}");
        assert!((pattern.panels()[0].area() - 0.03).abs() < 1e-9, "{hidden}");
        let aside = hidden.starts_with("<defs") || hidden.starts_with("<symbol");
        assert!(aside || noted(&pattern, "1 hidden shapes"), "{hidden}: {:?}", pattern.notes());
    }
    // What is shown again within a hidden group.
    let shown = "<g visibility=\"hidden\"><path d=\"M0 0H9V9Z\"/><path id=\"b\" visibility=\"visible\" d=\"M300 0h200v300h-200z\"/></g>";
    assert_eq!(read("pocket.svg", &pocket("", shown)).panels().len(), 2);
}

#[test]
fn what_a_draft_hides_is_no_outline() {
    let path = |size: [f64; 2], more: &str| {
        let [w, h] = size;
        format!(
            "{{\"ops\": [{{\"type\": \"move\", \"to\": [0, 0]}}, {{\"type\": \"line\", \"to\": [{w}, 0]}}, {{\"type\": \
             \"line\", \"to\": [{w}, {h}]}}, {{\"type\": \"line\", \"to\": [0, {h}]}}, {{\"type\": \"close\"}}]{more}}}"
        )
    };
    for hidden in [
        ", \"hidden\": true",
        ", \"render\": false",
        ", \"attributes\": {\"list\": {\"class\": [\"lining hidden\"]}}",
        ", \"attributes\": {\"list\": {\"style\": [\"stroke: red; display: none\"]}}",
    ] {
        let text = format!(
            "{{\"parts\": {{\"pocket\": {{\"paths\": {{\"base\": {}, \"pocket\": {}}}}}, \"other\": {{\"paths\": \
             {{\"seam\": {}}}}}}}}}",
            path([600.0, 1100.0], hidden),
            path([150.0, 200.0], ", \"hidden\": false"),
            path([300.0, 400.0], hidden)
        );
        let pattern = read("draft.json", &text);
        let [pocket] = pattern.panels() else { panic!("{hidden}: {:?}", pattern.panels()) };
        assert!((pocket.area() - 0.03).abs() < 1e-9, "{hidden}");
        assert!(
            noted(&pattern, "part other: all of its paths are hidden"),
            "{:?}",
            pattern.notes()
        );
    }
}

/// A front of 250 by 600 mm whose left side is the fold, with more in the drawing.
fn front(more: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"1000mm\" \
         viewBox=\"0 0 1000 1000\"><g id=\"front\"><path id=\"path9\" d=\"M20 20 L200 20 L270 120 V620 H20 V300 Z\"/>{more}</g></svg>"
    )
}

#[test]
fn a_part_on_the_fold_is_unfolded_as_its_text_says_or_called_a_half() {
    let half = 0.25 * 0.6 - 0.5 * 0.07 * 0.1;
    for more in [
        // As FreeSewing draws it: the line 15 mm inside, with its ends on the fold.
        "<path id=\"fs-1\" class=\"note\" d=\"M20 60 L35 60 L35 560 L20 560\"/><text><textPath xlink:href=\"#fs-1\">\
         <tspan>Cut on fold</tspan></textPath></text>",
        // Along the edge, turned.
        "<text transform=\"translate(30 400) rotate(-90)\">PLACE ON FOLD</text>",
        "<text x=\"30\" y=\"400\" transform=\"rotate(90 30 400)\">Im <tspan>Stoffbruch</tspan> zuschneiden</text>",
        "<line id=\"cut-on-fold\" x1=\"22\" y1=\"100\" x2=\"22\" y2=\"500\"/>",
    ] {
        let pattern = read("front.svg", &front(more));
        let area = pattern.panels()[0].area();
        assert!((area - 2.0 * half).abs() < 1e-9, "{area} m²: {more}");
        assert!(noted(&pattern, "was unfolded along edge"), "{more}: {:?}", pattern.notes());
    }
    // Across the panel, no edge is near: the text alone is repeated.
    let pattern = read("front.svg", &front("<text x=\"100\" y=\"300\">cut 1 on fold</text>"));
    assert!((pattern.panels()[0].area() - half).abs() < 1e-9);
    assert!(
        noted(&pattern, "front is one half, as its text \"cut 1 on fold\" says"),
        "{:?}",
        pattern.notes()
    );
    // A text of another panel, and one that is not shown.
    for more in [
        "<text x=\"600\" y=\"300\">cut on fold</text>",
        "<text display=\"none\" transform=\"translate(30 400) rotate(-90)\">cut on fold</text>",
        "<text transform=\"translate(30 400) rotate(-90)\">fold line of the hem</text>",
    ] {
        let pattern = read("front.svg", &front(more));
        let said = pattern.notes().iter().any(|note| note.to_string().contains("half"));
        assert!(!said && (pattern.panels()[0].area() - half).abs() < 1e-9, "{more}");
    }
    // A draft says it along a path, or at a point.
    let draft = |more: &str| {
        format!(
            "{{\"parts\": {{\"front\": {{\"paths\": {{\"seam\": {{\"ops\": [{{\"type\": \"move\", \"to\": [0, 0]}}, \
             {{\"type\": \"line\", \"to\": [250, 0]}}, {{\"type\": \"line\", \"to\": [250, 600]}}, {{\"type\": \"line\", \
             \"to\": [0, 600]}}, {{\"type\": \"close\"}}]}}{more}}}}}}}}}"
        )
    };
    let along = ", \"fold\": {\"ops\": [{\"type\": \"move\", \"to\": [0, 20]}, {\"type\": \"line\", \"to\": [15, 20]}, \
                 {\"type\": \"line\", \"to\": [0, 580]}], \"attributes\": {\"list\": {\"data-text\": \
                 [\"plugin-annotations:cutOnFoldAndGrainline\"]}}}";
    assert!((read("a.json", &draft(along)).panels()[0].area() - 0.3).abs() < 1e-9);
    let beside = along.replace("[0, 20]", "[90, 20]");
    let pattern = read("a.json", &draft(&beside));
    assert!(
        noted(&pattern, "front is one half") && (pattern.panels()[0].area() - 0.15).abs() < 1e-9
    );
}

#[test]
fn pixels_of_inkscape_are_ninety_to_the_inch_before_version_0_92() {
    for (version, per_inch) in [
        ("0.48.4 r9939", 90.0),
        ("0.91 r13725", 90.0),
        ("0.92.1 r", 96.0),
        ("1.2.2", 96.0),
        ("0.9", 90.0),
    ] {
        for size in [
            "width=\"3543\" height=\"3543\"",
            "width=\"100%\"",
            "width=\"1000mm\" height=\"1000mm\"",
        ] {
            let text = format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
                 inkscape:version=\"{version}\" {size}><path d=\"M0 0h900v1800h-900z\"/></svg>"
            );
            let pattern = read("old.svg", &text);
            let area = 900.0 * 1800.0 * (0.0254_f64 / per_inch).powi(2);
            assert!((pattern.panels()[0].area() / area - 1.0).abs() < 1e-9, "{version}: {size}");
            assert!(noted(&pattern, &format!("{per_inch} to the inch")), "{:?}", pattern.notes());
        }
    }
}

#[test]
fn sizes_that_no_garment_has_are_questioned_and_long_panels_are_not() {
    // A shirt that is drawn in cm, in a file that says mm.
    let shirt = |scale: f64| {
        let panel = |name: &str, x: f64, w: f64, h: f64| {
            let [x, w, h] = [x, w, h].map(|side| scale * side);
            format!("<path id=\"{name}\" d=\"M{x} 0h{w}v{h}h-{w}z\"/>")
        };
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1000mm\" viewBox=\"0 0 1000 1000\">{}{}</svg>",
            panel("front", 0.0, 55.0, 73.0),
            panel("sleeve", 60.0, 40.0, 21.0)
        )
    };
    refused(
        "shirt.svg",
        &shirt(1.0),
        &[
            "panel front is 55 × 73 mm",
            "1 cm, the panel is 550 × 730 mm",
            "unit = \"cm\" in the [from]",
        ],
    );
    let folder = std::env::temp_dir().join(format!("drape-sizes-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("shirt.svg");
    std::fs::write(&path, shirt(1.0)).expect("it is written");
    for (unit, height, remark) in [("cm", 0.73, false), ("mm", 0.073, true)] {
        let request = Request { unit: Unit::parse(unit), ..Request::new(&path) };
        let pattern = Pattern::read_as(&request).expect("the unit is asked for");
        let [front, _] = pattern.panels() else { panic!("two panels") };
        assert!((front.area() - height * height * 55.0 / 73.0).abs() < 1e-9);
        assert_eq!(noted(&pattern, "no garment has this size"), remark, "{unit}");
    }
    // By way of a pattern, the remedy is an edit of the pattern.
    let text = "length = \"mm\"\n[from]\nfile = \"shirt.svg\"\n";
    let pattern = folder.join("shirt.toml");
    std::fs::write(&pattern, text).expect("it is written");
    let mistakes = Pattern::parse(&Document::new(&pattern, text)).expect_err("it is asked");
    let mended = drape_input::apply_edits(text, &mistakes.0[0].edits).expect("it fits");
    assert_eq!(mended, format!("{text}unit = \"cm\"\n"));
    let read_again = Pattern::parse(&Document::new(&pattern, mended)).expect("the unit is known");
    assert!((read_again.panels()[0].area() - 0.55 * 0.73).abs() < 1e-9);
    std::fs::remove_dir_all(&folder).expect("it is removed");

    let own = |unit: &str, size: &str| {
        format!("length = \"{unit}\"\n[panel.a]\ngrain = 0\nrectangle = {size}\n")
    };
    for (size, area) in [
        ("[1200, 3001]", 3.6012),
        ("[1200, 9000]", 10.8),
        ("[20000, 90]", 1.8),
        ("[3200, 3200]", 10.24),
    ] {
        let pattern = read("sari.toml", &own("mm", size));
        assert!(
            (pattern.panels()[0].area() - area).abs() < 1e-9 && pattern.notes().is_empty(),
            "{size}"
        );
    }
    refused(
        "a.toml",
        &own("m", "[60, 80]"),
        &["panel a is 60.00 × 80.00 m", "did you mean length = \"cm\"?"],
    );
    refused(
        "a.toml",
        &own("mm", "[60000, 80]"),
        &["panel a is 60000 × 80 mm", "is the unit right?"],
    );
    assert!(noted(
        &read("a.toml", &own("mm", "[50, 70]")),
        "if a unit of the file is 1 cm, the panel is 500 × 700 mm"
    ));
}

#[test]
fn a_notch_at_the_end_of_an_edge_is_read_again() {
    // Lengths with many digits, and notches at both ends of each edge and beyond them by rounding.
    for turned in 0..24 {
        let angle = f64::from(turned) * 0.2618 + 0.0137;
        let corner =
            |r: f64, a: f64| format!("[{}, {}]", r * (angle + a).cos(), r * (angle + a).sin());
        let length =
            |r: f64, a: f64, s: f64, b: f64| (r * r + s * s - 2.0 * r * s * (b - a).cos()).sqrt();
        let edge = |r: f64, a: f64, s: f64, b: f64| {
            let end = length(r, a, s, b);
            format!("{{ to = {}, notches = [0, {}, {end}] }}", corner(s, b), 0.3 * end)
        };
        let text = format!(
            "length = \"cm\"\n[panel.a]\ngrain = 0\nstart = {}\noutline = [{}, {}, {}]\n",
            corner(30.12345678, 0.0),
            edge(30.12345678, 0.0, 41.98765432, 2.1),
            edge(41.98765432, 2.1, 33.33333333, 4.0),
            edge(33.33333333, 4.0, 30.12345678, 0.0),
        );
        let pattern = read("a.toml", &text);
        let again = read("again.toml", &pattern.to_toml(""));
        let notches = |pattern: &Pattern| -> Vec<f64> {
            pattern.panels()[0].outline().iter().flat_map(|edge| edge.notches.clone()).collect()
        };
        let (one, other) = (notches(&pattern), notches(&again));
        assert!(
            one.len() == 9 && one.iter().zip(&other).all(|(a, b)| (a - b).abs() < 1e-6),
            "{one:?} {other:?}"
        );
        read("again.svg", &pattern.to_svg(None));
    }
    let beyond = "length = \"cm\"\n[panel.a]\ngrain = 0\nstart = [0, 0]\noutline = [{ to = [30, 0], notches = [30.001] }, \
                  { to = [0, 30] }, { to = [0, 0] }]\n";
    refused("a.toml", beyond, &["notches", "from 0 to 300 mm"]);
}
