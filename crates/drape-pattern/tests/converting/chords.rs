//! Outlines of DXF that are chords of curves, and notches that are slits of a cut line.

use drape_pattern::{Curve, Edge, Pattern};

use crate::dxf_text::{block, file, point, polyline, text};
use crate::{noted, read, refused};

/// Returns the largest distance of a pattern's first panel from the middles of chords, in mm. The
/// panel has its low corner at the origin.
fn from_middles(pattern: &Pattern, points: &[[f64; 2]], unit: f64) -> f64 {
    let low = [0, 1].map(|k| points.iter().map(|p| p[k]).fold(f64::MAX, f64::min));
    let outline: Vec<[f64; 2]> = pattern.panels()[0]
        .outline()
        .iter()
        .flat_map(|edge| (0..400).map(|k| edge.at(f64::from(k) / 400.0)))
        .collect();
    let off = |p: [f64; 2]| {
        let sides = outline.iter().zip(outline.iter().cycle().skip(1));
        let apart = sides.map(|(a, b)| {
            let (chord, arm) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
            let square = (chord[0] * chord[0] + chord[1] * chord[1]).max(1e-30);
            let t = ((arm[0] * chord[0] + arm[1] * chord[1]) / square).clamp(0.0, 1.0);
            (arm[0] - t * chord[0]).hypot(arm[1] - t * chord[1])
        });
        apart.fold(f64::MAX, f64::min)
    };
    let chords = points.iter().zip(points.iter().cycle().skip(1));
    let middles = chords.map(|(a, b)| [0, 1].map(|k| 1e-3 * unit * (0.5 * (a[k] + b[k]) - low[k])));
    1e3 * middles.map(off).fold(0.0, f64::max)
}

/// A sleeve whose cap has fine chords at its top and coarse ones at its ends, whose sides are
/// straight over 300 mm, and whose hem is an arc of few points. Divided by the length of a unit in
/// mm.
fn sleeve(unit: f64) -> Vec<[f64; 2]> {
    let edge = |a, b, curve| Edge::line("", a, b).curved(curve);
    let cap = edge([380.0, 300.0], [0.0, 300.0], Curve::Cubic([[250.0, 320.0], [230.0, 520.0]]));
    let hem = edge([40.0, 0.0], [340.0, 0.0], Curve::Quadratic([190.0, -40.0]));
    let mut points: Vec<[f64; 2]> = (0..=6).map(|k| hem.at(f64::from(k) / 6.0)).collect();
    points.extend((0..=30).map(|k| {
        // Closer together in the middle.
        let s = 2.0 * f64::from(k) / 30.0 - 1.0;
        cap.at(0.5 + 0.5 * s * s * s)
    }));
    points.iter().map(|p| p.map(|x| x / unit)).collect()
}

#[test]
fn outlines_stay_within_the_tolerance_of_the_file_of_their_chords() {
    for (unit, word) in [(1.0, "METRIC"), (25.4, "ENGLISH")] {
        let points = sleeve(unit);
        for (tolerance, said) in [
            (0.2, String::new()),
            (0.152, text(1, &format!("Tolerance: {}", 0.152 / unit))),
            (0.5, text(1, &format!("CURVE TOLERANCE: {}", 0.5 / unit))),
            (0.03, text(1, &format!("Curve Tolerance: {}", 0.03 / unit).replace('.', ","))),
            // A tolerance of a seam, and one that is none.
            (0.2, text(1, "Tolerance: 25")),
            (0.2, text(1, "Tolerance: coarse")),
        ] {
            let words = text(1, &format!("Units: {word}")) + &said;
            let body = text(1, "Piece Name: SLEEVE") + &polyline(1, &points, true);
            let pattern = read("sleeve.dxf", &file("", &block("A", &body), &words));
            let off = from_middles(&pattern, &points, unit);
            // A chord of the 400 of an edge cuts off less than a micrometre.
            assert!(off < tolerance + 1e-3, "{word}, {tolerance} mm: {off} mm");
            assert!(noted(&pattern, "mm of the chords"), "{:?}", pattern.notes());
            // The ends of the sides are points of the outline: they stay straight.
            let straight = pattern.panels()[0].outline().iter();
            let longest = straight.filter(|e| e.curve == Curve::Line).map(Edge::length);
            assert!(longest.fold(0.0, f64::max) > 0.299, "{:?}", pattern.panels()[0].outline());
        }
    }
}

#[test]
fn a_slit_in_a_cut_line_is_a_notch() {
    let words = text(1, "Units: METRIC");
    // A slit along the right side, one of 0.8 mm at the bottom, a tooth at the top; the point of a
    // hood is no notch, and a mark beside a slit is the same notch.
    let points = [
        [0.0, 0.0],
        [120.0, 0.0],
        [120.0, 5.0],
        [120.8, 5.0],
        [120.8, 0.0],
        [300.0, 0.0],
        [300.0, 200.0],
        [294.0, 200.0],
        [300.0, 200.0],
        [300.0, 400.0],
        [203.0, 400.0],
        [200.0, 395.0],
        [197.0, 400.0],
        [150.0, 400.0],
        [146.0, 440.0],
        [142.0, 400.0],
        [0.0, 400.0],
    ];
    let body =
        text(1, "Piece Name: HOOD") + &polyline(1, &points, true) + &point(4, [300.0, 201.0]);
    let pattern = read("hood.dxf", &file("", &block("A", &body), &words));
    let [panel] = pattern.panels() else { panic!("one panel") };
    assert!((panel.area() - (0.12 + 0.5 * 0.008 * 0.04)).abs() < 1e-9, "{} m²", panel.area());
    let places = panel.outline().iter().flat_map(|edge| {
        edge.notches
            .iter()
            .map(|along| edge.at(along / edge.length()).map(|x| (1e4 * x).round() / 10.0))
    });
    let mut places: Vec<[f64; 2]> = places.collect();
    places.sort_by(|a, b| a[0].total_cmp(&b[0]));
    assert_eq!(places, [[120.4, 0.0], [200.0, 400.0], [300.0, 201.0]]);
    assert!(
        noted(&pattern, "panel HOOD: 3 slits of its line are notches"),
        "{:?}",
        pattern.notes()
    );
    let again = read("again.toml", &pattern.to_toml(""));
    assert_eq!(again.panels()[0].outline().iter().map(|edge| edge.notches.len()).sum::<usize>(), 3);
}

#[test]
fn a_cutter_s_step_back_is_no_crossing() {
    // The line steps back by less than a tenth of a millimetre where two parts of it meet.
    let points =
        [[0.0, 0.0], [200.0, 0.0], [200.0, 300.0], [90.0, 300.0], [90.07, 299.97], [0.0, 300.0]];
    let body = polyline(1, &points, true);
    let pattern = read("a.dxf", &file("", &block("A", &body), &text(1, "Units: METRIC")));
    assert!((pattern.panels()[0].area() - 0.06).abs() < 1e-5);
    assert!(pattern.panels()[0].outline().len() <= 5, "{:?}", pattern.panels()[0].outline());
}

#[test]
fn a_file_in_centimetres_that_says_metric_is_questioned() {
    let piece = |name: &str, [w, h]: [f64; 2]| {
        let points = [[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]];
        block(name, &(text(1, &format!("Piece Name: {name}")) + &polyline(1, &points, true)))
    };
    let shirt = |words: &str| {
        let pieces = [("FRONT", [52.0, 73.0]), ("BACK", [54.0, 72.0]), ("POCKET", [12.0, 14.0])];
        let pieces: String = pieces.iter().map(|(name, size)| piece(name, *size)).collect();
        file("", &pieces, &text(1, words))
    };
    refused(
        "shirt.dxf",
        &shirt("UNITS: METRIC"),
        &[
            "panel FRONT is 52 × 73 mm",
            "1 cm, the panel is 520 × 730 mm",
            "unit = \"cm\" in the [from]",
        ],
    );
    let right = read("shirt.dxf", &shirt("UNITS: CM"));
    assert!((right.panels()[0].area() - 0.52 * 0.73).abs() < 1e-9);
    // A tab of 15 mm beside a front is no doubt, and a veil of 3.2 m none either.
    let mixed = piece("FRONT", [520.0, 730.0])
        + &piece("TAB", [15.0, 12.0])
        + &piece("VEIL", [3200.0, 1500.0]);
    assert_eq!(read("mixed.dxf", &file("", &mixed, &text(1, "UNITS: METRIC"))).panels().len(), 3);
}
