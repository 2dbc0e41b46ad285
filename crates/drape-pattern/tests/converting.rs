//! Patterns of others become the project's own, and drawings, and come back.

use drape_input::Document;
use drape_pattern::{Curve, Edge, Note, Paper, Pattern, Request, Unit};
use proptest::prelude::*;

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
                "--unit mm",
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
        &["d.svg:2: panel bodice is 0.0040 m", "--unit"],
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
    let two = "<defs><rect width=\"90\" height=\"90\"/></defs><rect style=\"display: none\" width=\"95\" height=\"90\"/>\
               <g id=\"a\"><rect width=\"50\" height=\"90\"/><rect x=\"60\" width=\"50\" height=\"90\"/></g><use href=\"#a\"/>";
    let pattern = read("d.svg", &svg(two));
    let names: Vec<&str> = pattern.panels().iter().map(|p| p.name()).collect();
    assert!(names == ["a", "a 2"] && noted(&pattern, "unlink"), "{names:?}");
    refused(
        "d.svg",
        &svg("<path id=\"f\" d=\"M0 0H100V100H0V3\"/>"),
        &["outline \"f\" is open: 3.0 mm", "join the ends"],
    );
    read("d.svg", &svg("<path id=\"f\" d=\"M0 0H100V100H0V0\"/>"));
    refused(
        "d.svg",
        &svg("<path id=\"f\" d=\"M0 0L100 100H0L100 0Z\"/>"),
        &["d.svg:1", "cross or touch"],
    );
    refused("d.svg", &svg("<path d=\"M0 0H5V5Z\"/>"), &["no closed shape of 20 mm"]);
    refused("d.svg", "<svg><g></svg>", &["d.svg:1:", "plain SVG"]);
    refused("d.svg", "<html/>", &["no <svg>"]);
}

/// A block of DXF.
fn block(name: &str, body: &str) -> String {
    format!("0\nBLOCK\n8\n1\n2\n{name}\n70\n0\n10\n0.0\n20\n0.0\n{body}0\nENDBLK\n8\n1\n")
}

fn file(header: &str, blocks: &str, entities: &str) -> String {
    format!(
        "0\nSECTION\n2\nHEADER\n{header}0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n\
         {entities}0\nENDSEC\n0\nEOF\n"
    )
}

fn text(layer: u32, words: &str) -> String {
    format!("0\nTEXT\n8\n{layer}\n10\n0.0\n20\n0.0\n40\n1.0\n1\n{words}\n")
}

fn point(layer: u32, [x, y]: [f64; 2]) -> String {
    format!("0\nPOINT\n8\n{layer}\n10\n{x}\n20\n{y}\n")
}

fn line(layer: u32, a: [f64; 2], b: [f64; 2]) -> String {
    format!("0\nLINE\n8\n{layer}\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n", a[0], a[1], b[0], b[1])
}

fn polyline(layer: u32, points: &[[f64; 2]], closed: bool) -> String {
    let vertex = |p: &[f64; 2]| format!("0\nVERTEX\n8\n{layer}\n10\n{}\n20\n{}\n", p[0], p[1]);
    let all: String = points.iter().map(vertex).collect();
    format!(
        "0\nPOLYLINE\n8\n{layer}\n66\n1\n70\n{}\n{all}0\nSEQEND\n8\n{layer}\n",
        u8::from(closed)
    )
}

/// A front of 240 by 600 mm: hem, side, curved armhole in chords, centre.
fn front(scale: f64) -> (Vec<[f64; 2]>, Vec<[f64; 2]>) {
    let corners = [[0.0, 0.0], [240.0, 0.0], [240.0, 400.0], [180.0, 600.0], [0.0, 600.0]];
    let hole = Edge::line("", corners[2], corners[3])
        .curved(Curve::Cubic([[190.0, 400.0], [170.0, 500.0]]));
    let mut points = vec![corners[0], corners[1]];
    points.extend((0..=40).map(|k| hole.at(f64::from(k) / 40.0)));
    points.push(corners[4]);
    let scaled = |all: &[[f64; 2]]| all.iter().map(|p| p.map(|x| x * scale)).collect();
    (scaled(&points), scaled(&corners))
}

#[test]
fn pieces_of_dxf_are_read_as_three_programs_write_them() {
    // Polylines and marked corners, in mm, as Gerber's programs do.
    let (points, corners) = front(1.0);
    let mut body = text(1, "Piece Name: FRONT") + &text(1, "Size: M") + &text(1, "Material: SHELL");
    body += &polyline(1, &points, true);
    body += &corners.iter().map(|p| point(2, *p)).collect::<String>();
    body += &(point(4, [240.0, 150.0])
        + &line(7, [60.0, 100.0], [60.0, 500.0])
        + &point(13, [90.0, 90.0]));
    let metric = file("", &block("FRONT-M", &body), &text(1, "Units: METRIC"));
    // Lines apart, in inches, in any order and sense, without marked corners, as Optitex's may.
    let (points, _) = front(1.0 / 25.4);
    let mut body = text(1, "PIECE NAME: FRONT");
    for k in (0..points.len()).rev() {
        let (a, b) = (points[k], points[(k + 1) % points.len()]);
        body += &if k % 2 == 0 { line(1, a, b) } else { line(1, b, a) };
    }
    body += &line(7, [60.0 / 25.4, 4.0], [60.0 / 25.4, 20.0]);
    let inches = file("", &block("1", &body), &text(1, "UNITS: ENGLISH"));
    // A cut line of layer 1 round a sewing line of layer 14, unit in the header, Windows line ends,
    // as Lectra's.
    let (points, corners) = front(1.0);
    let wide = [[-10.0, -10.0], [250.0, -10.0], [250.0, 610.0], [-10.0, 610.0]];
    let mut body =
        text(1, "Piece Name: FRONT") + &polyline(1, &wide, true) + &polyline(14, &points, true);
    body += &(corners.iter().map(|p| point(2, *p)).collect::<String>()
        + &polyline(7, &[[60.0, 500.0], [60.0, 100.0]], false));
    let header = "9\n$INSUNITS\n70\n4\n";
    let both = file(header, &block("FRONT", &body), "").replace('\n', "\r\n");

    for (name, text) in [("gerber.dxf", &metric), ("optitex.dxf", &inches), ("lectra.dxf", &both)] {
        let pattern = read(name, text);
        let [panel] = pattern.panels() else { panic!("{name}: one panel") };
        assert_eq!(panel.name(), "FRONT");
        let edges = panel.outline().len();
        assert!((5..=6).contains(&edges), "{name}: {:?}", panel.outline());
        assert!(panel.grain().abs() < 1e-9, "{name}");
        let cubics = panel.outline().iter().filter(|e| matches!(e.curve, Curve::Cubic(_))).count();
        assert_eq!(cubics, edges - 4, "{name}");
        for p in &points {
            let near = panel
                .outline()
                .iter()
                .flat_map(|e| (0..=2000).map(|k| e.at(f64::from(k) / 2000.0)));
            let off = near
                .map(|q| (q[0] - 1e-3 * p[0]).hypot(q[1] - 1e-3 * p[1]))
                .fold(f64::MAX, f64::min);
            assert!(off < 2e-4, "{name}: {p:?} is {off} m off");
        }
        let again = read("again.toml", &pattern.to_toml(""));
        assert!(apart(&pattern, &again) < 1e-6, "{name}");
    }
    let gerber = read("gerber.dxf", &metric);
    for words in [
        "Units: METRIC",
        "the cut line, layer 1",
        "material: SHELL",
        "1 drill holes on layer 13",
        "no seams",
    ] {
        assert!(noted(&gerber, words), "{words}: {:?}", gerber.notes());
    }
    let notches: Vec<f64> =
        gerber.panels()[0].outline().iter().flat_map(|e| e.notches.clone()).collect();
    assert!(notches.len() == 1 && (notches[0] - 0.15).abs() < 1e-6, "{notches:?}");
    let lectra = read("lectra.dxf", &both);
    assert!(
        noted(&lectra, "10.0 mm outside") && noted(&lectra, "$INSUNITS 4"),
        "{:?}",
        lectra.notes()
    );
}

#[test]
fn what_a_dxf_does_not_say_is_asked_for() {
    let square =
        |side: f64| polyline(1, &[[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]], true);
    let unknown = file("", &block("A", &square(12.0)), "");
    refused(
        "a.dxf",
        &unknown,
        &["does not say its unit", "\"A\"", "12 mm", "120 mm", "305 mm", "--unit mm"],
    );
    let sizes: String = ["S", "M", "L"]
        .iter()
        .map(|size| {
            block(
                &format!("A-{size}"),
                &(text(1, "Piece Name: A") + &text(1, &format!("Size: {size}")) + &square(200.0)),
            )
        })
        .collect();
    let metric = text(1, "Units: METRIC");
    refused("a.dxf", &file("", &sizes, &metric), &["several sizes: L, M, S", "--size L"]);
    let sample = read("a.dxf", &file("", &sizes, &(metric.clone() + &text(1, "Sample Size: M"))));
    assert!(sample.panels().len() == 1 && noted(&sample, "it is the sample size"));
    let folder = std::env::temp_dir().join(format!("drape-size-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("a.dxf");
    std::fs::write(&path, file("", &sizes, &metric)).expect("it is written");
    let sized =
        |size: &str| Pattern::read_as(&Request { size: Some(size.into()), ..Request::new(&path) });
    assert_eq!(sized("L").expect("it is one of them").panels().len(), 1);
    let said = sized("XL").expect_err("it is none").to_string();
    assert!(said.contains("no size \"XL\"") && said.contains("help"), "{said}");
    std::fs::write(&path, &unknown).expect("it is written");
    let asked = Request { unit: Unit::parse("in"), ..Request::new(&path) };
    let pattern = Pattern::read_as(&asked).expect("the unit is known");
    assert!((pattern.panels()[0].area() - (12.0 * 0.0254_f64).powi(2)).abs() < 1e-9);
    std::fs::remove_dir_all(&folder).expect("it is removed");

    let metric = |body: &str| file("", &block("A", body), &text(1, "Units: METRIC"));
    let half = polyline(1, &[[0.0, 0.0], [100.0, 0.0], [100.0, 300.0], [0.0, 300.0]], true)
        + &line(6, [0.0, 0.0], [0.0, 300.0]);
    let whole = read("a.dxf", &metric(&half));
    assert!((whole.panels()[0].area() - 0.06).abs() < 1e-9 && noted(&whole, "cut on the fold"));
    let open = polyline(1, &[[0.0, 0.0], [100.0, 0.0], [100.0, 300.0], [0.0, 300.0]], false);
    refused(
        "a.dxf",
        &metric(&open),
        &["a.dxf:12: piece A: its outline is open, by 300 mm", "close the piece"],
    );
    refused("a.dxf", &metric(&square(5.0)), &["0.0050 m", "lengths were taken in mm", "--unit"]);
    refused(
        "a.dxf",
        &metric(&square(200.0)).replace("\n200\n", "\nnan\n"),
        &["\"nan\" of group", "120.5"],
    );
    refused("a.dxf", &metric(&square(200.0)).replace("\n200\n", "\n1e300\n"), &["\"1e300\""]);
    refused(
        "a.dxf",
        &metric(&square(200.0)).replace("\n8\n1\n", "\n8\nCUT\n"),
        &["no line is on layer 1", "CUT"],
    );
    refused("a.dxf", "AutoCAD Binary DXF\r\n", &["binary DXF", "ASCII"]);
    refused("a.dxf", "hello\nworld\n", &["a.dxf:1", "\"hello\" is no group code"]);
    refused("a.dxf", "", &["no lines"]);
    let bow = polyline(1, &[[0.0, 0.0], [200.0, 200.0], [200.0, 0.0], [0.0, 200.0]], true);
    refused("a.dxf", &metric(&bow), &["cross or touch"]);
    let round: Vec<[f64; 2]> = (0..90)
        .map(|k| {
            let a = f64::from(k) / 90.0 * std::f64::consts::TAU;
            [100.0 * a.cos(), 100.0 * a.sin()]
        })
        .collect();
    let disc = read("a.dxf", &metric(&polyline(1, &round, true)));
    assert!(
        (disc.panels()[0].area() - 0.0314).abs() < 1e-4 && disc.panels()[0].outline().len() <= 8
    );
}

/// A file that adds to the draft of the T-shirt, in its folder.
fn added(text: &str) -> Result<Pattern, String> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/patterns");
    let text = format!("length = \"mm\"\n[from]\nfile = \"teagan.json\"\n{text}");
    Pattern::parse(&Document::new(format!("{folder}/teagan-sewn.toml"), text))
        .map_err(|all| all.to_string())
}

#[test]
fn a_file_beside_a_draft_sews_it() {
    let text = r#"
[panel."teagan.front"]
grain = 45
fabric = "jersey"
origin = [0, 900, 200]
hems = { cbHem-hem = 20 }
[panel."teagan.sleeve"]
split = { hemRight-bicepsRight = [20] }
shift = [5, 0]
origin = [300, 1200, 0]
[panel.sleeve_l]
copy_of = "teagan.sleeve"
mirrored = true
[seam.side]
sides = [["teagan.front.hem-armhole"], ["teagan.back.hem-armhole mirrored"]]
max_ease = 1.05
allowance = 10
[seam.under]
sides = [["sleeve_l.hemRight-bicepsRight 2"], ["teagan.sleeve.hemRight-bicepsRight 2"]]
reversed = true
"#;
    let pattern = added(text).expect("it is right");
    let names: Vec<&str> = pattern.panels().iter().map(|p| p.name()).collect();
    assert_eq!(names, ["teagan.back", "teagan.front", "teagan.sleeve", "sleeve_l"]);
    let [_, front, sleeve, left] = pattern.panels() else { panic!("four panels") };
    assert!((front.grain().to_degrees() - 45.0).abs() < 1e-9 && front.fabric() == Some("jersey"));
    assert!((front.outline()[0].hem - 0.02).abs() < 1e-12);
    assert!((sleeve.area() - left.area()).abs() < 1e-12);
    let places =
        [sleeve, left].map(|panel| panel.placement().expect("it has one").point([0.0, 0.1]));
    assert!((places[0][0] + places[1][0]).abs() < 1e-12, "{places:?}");
    assert_eq!(pattern.seams().len(), 2);
    assert!(!noted(&pattern, "no seams") && noted(&pattern, "unfolded"));
    // A file that states its unit or has no sizes is not asked for them; and left out is left out.
    let less = added("[panel.\"teagan.sleeve\"]\nomit = true\n").expect("it is right");
    assert_eq!(less.panels().len(), 2);
    let said = |text: &str| added(text).expect_err("it is wrong");
    for (text, words) in [
        (
            "[panel.\"teagan.frnt\"]\ngrain = 3\n",
            vec!["no such panel", "\"teagan.front\"", "teagan-sewn.toml:4"],
        ),
        (
            "[seam.a]\nsides = [[\"teagan.front.hem-armhol\"], [\"teagan.back.hem-armhole\"]]\n",
            vec!["no edge", "teagan.front.hem-armhole"],
        ),
        ("[panel.\"teagan.front\"]\nhems = { x = 3 }\n", vec!["no edge \"x\"", "its edges are"]),
        (
            "[panel.\"teagan.front\"]\nsplit = { cbHem-hem = [900] }\n",
            vec!["is [900.0]", "between 0 and 296.77"],
        ),
        (
            "[panel.x]\ncopy_of = \"teagan.slevee\"\n",
            vec!["no panel \"teagan.slevee\"", "\"teagan.sleeve\""],
        ),
        ("[panel.x]\nmirrored = true\nrectangle = [100, 100]\n", vec!["belongs to copy_of"]),
        (
            "[panel.x]\ncopy_of = \"teagan.back\"\nrectangle = [100, 100]\n",
            vec!["the panel has a shape"],
        ),
        ("[panel.\"teagan.front\"]\nshift = [nan, 0]\n", vec!["shift"]),
    ] {
        let said = said(text);
        assert!(words.iter().all(|word| said.contains(word)), "{words:?} are not in: {said}");
    }
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/patterns");
    let other = |text: &str| {
        let all = Pattern::parse(&Document::new(
            format!("{folder}/x.toml"),
            format!("length = \"mm\"\n{text}"),
        ));
        all.expect_err("it is wrong").to_string()
    };
    assert!(other("[from]\nfile = \"taegan.json\"\n").contains("there is no file"));
    assert!(other("[from]\nfile = \"x.toml\"\n").contains("other formats"));
    assert!(other("[from]\nfile = \"teagan.json\"\nunit = \"ell\"\n").contains("a unit is \"mm\""));
    assert!(
        other("[from]\nfile = \"teagan.json\"\nunit = \"mm\"\n").contains("leave the unit out")
    );
    assert!(other("[from]\nfile = \"teagan.json\"\nsize = \"M\"\n").contains("leave the size out"));
}

#[test]
fn a_seam_takes_the_place_of_that_of_its_name() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/patterns");
    let read = |text: &str| {
        let text = format!("length = \"mm\"\n[from]\nfile = \"skirt.json\"\n{text}");
        Pattern::parse(&Document::new(format!("{folder}/x.toml"), text))
            .map_err(|all| all.to_string())
    };
    let plain = read("").expect("it is right");
    let name = |id: drape_pattern::EdgeId| {
        let panel = &plain.panels()[id.panel];
        format!("{}.{}", panel.name(), panel.outline()[id.edge].name)
    };
    let first = &plain.seams()[0];
    let (a, b) = (name(first.sides[0][0]), name(first.sides[1][0]));
    let sides = format!("sides = [[\"{a}\"], [\"{b}\"]]\nmax_ease = 1.5\nallowance = 12\n");
    let replaced = read(&format!("[seam.{}]\n{sides}", first.name)).expect("it is right");
    assert_eq!(replaced.seams().len(), plain.seams().len());
    let again = replaced.seams().iter().find(|s| s.name == first.name).expect("it is there");
    assert!(again.max_ease == 1.5 && (again.allowance - 0.012).abs() < 1e-12);
    let said = read(&format!("[seam.mine]\n{sides}")).expect_err("it is sewn twice");
    assert!(
        said.contains("is sewn twice") && said.contains(&format!("[seam.{}]", first.name)),
        "{said}"
    );
    let less =
        read(&format!("[panel.{}]\nomit = true\n", plain.panels()[0].name())).expect("it is right");
    assert!(
        less.notes().iter().any(|n| matches!(n, Note::SeamsLeftOut { seams } if !seams.is_empty()))
    );
}

proptest! {
    /// No drawing and no DXF panics, whatever was cut out of or put into a good one.
    #[test]
    fn damaged_drawings_are_answered(
        svg in any::<bool>(),
        (from, length) in (0.0..1.0_f64, 0..40_usize),
        put in prop::sample::select(vec!["", "<", "\"", "1e308", "-1", "nan", "\n0\n", "A1 1 0 0 1 5 5", "M", "z", "1e-300", "scale(0)"]),
    ) {
        let (points, corners) = front(1.0);
        let mut body = text(1, "Piece Name: FRONT") + &polyline(1, &points, true) + &line(6, [0.0, 0.0], [0.0, 600.0]);
        body += &corners.iter().map(|p| point(2, *p)).collect::<String>();
        let (name, text) = match svg {
            true => ("d.svg", read("own.toml", OWN).to_svg(None)),
            false => ("d.dxf", file("", &block("A", &body), &text(1, "Units: METRIC"))),
        };
        let start = (from * text.len() as f64) as usize;
        let end = (start + length).min(text.len());
        prop_assume!(text.is_char_boundary(start) && text.is_char_boundary(end));
        let text = format!("{}{put}{}", &text[..start], &text[end..]);
        if let Ok(pattern) = Pattern::parse(&Document::new(name, text)) {
            let again = Pattern::parse(&Document::new("again.toml", pattern.to_toml("")));
            prop_assert!(again.is_ok(), "{again:?}");
            let _ = pattern.to_svg(None);
        }
    }
}
