//! DXF as pattern makers' programs write it.

use drape_input::Document;
use drape_pattern::{Curve, Edge, Pattern, Request, Unit};
use proptest::prelude::*;

use crate::dxf_text::{block, file, line, point, polyline, text};
use crate::{OWN, apart, noted, read, refused};

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
        &[
            "does not say its unit",
            "\"A\"",
            "12 mm",
            "120 mm",
            "305 mm",
            "unit = \"mm\" (or cm, in)",
        ],
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
    refused("a.dxf", &file("", &sizes, &metric), &["several sizes: L, M, S", "size = \"L\""]);
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
    refused(
        "a.dxf",
        &metric(&square(5.0)),
        &["panel A is 5.0 × 5.0 mm", "unit = \"m\" in the [from]", "\"mm\" if the size is meant"],
    );
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

#[test]
fn lines_and_an_arc_of_dxf_make_an_outline() {
    // A tab of 200 by 100 mm whose end is half a disc, from 270 to 90 degrees about its centre.
    let arc = "0\nARC\n8\n1\n10\n200\n20\n50\n40\n50\n50\n270\n51\n90\n";
    let body = line(1, [0.0, 0.0], [200.0, 0.0])
        + arc
        + &line(1, [200.0, 100.0], [0.0, 100.0])
        + &line(1, [0.0, 100.0], [0.0, 0.0]);
    let tab = read("a.dxf", &file("", &block("TAB", &body), &text(1, "Units: METRIC")));
    let [panel] = tab.panels() else { panic!("one panel") };
    let area = 0.02 + 0.5 * std::f64::consts::PI * 0.05 * 0.05;
    assert!((panel.area() - area).abs() < 1e-7, "{}", panel.area());
    let round: Vec<&Edge> =
        panel.outline().iter().filter(|e| matches!(e.curve, Curve::Arc { .. })).collect();
    let [round] = round[..] else { panic!("{:?}", panel.outline()) };
    assert!((round.length() - 0.05 * std::f64::consts::PI).abs() < 1e-6, "{round:?}");
    let far = round.at(0.5);
    assert!((far[0] - 0.25).abs() < 1e-6 && (far[1] - 0.05).abs() < 1e-6, "{far:?}");
    assert_eq!(panel.outline().len(), 4);
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
