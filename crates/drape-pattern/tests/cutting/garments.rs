//! Shipped garments, cut at several spacings.

use drape_input::Document;
use drape_pattern::{CutPattern, Cutter, Panel, Pattern, PatternNote, Quality};

use crate::invariants;

pub fn shipped(name: &str) -> Pattern {
    let path = format!("{}/patterns/{name}", env!("CARGO_MANIFEST_DIR"));
    Pattern::read(path).unwrap_or_else(|error| panic!("{error}"))
}

const GARMENTS: [&str; 4] = ["shirt.json", "skirt.json", "trousers.json", "teagan.json"];

/// Cuts a pattern, checks the invariants and the quality, and returns the number of particles with
/// the cut.
pub fn cut(pattern: &Pattern, spacing: f64) -> (usize, CutPattern) {
    let cut = Cutter::new(spacing).cut(pattern).unwrap_or_else(|error| panic!("{error}"));
    invariants::check(pattern, &cut);
    assert!(cut.notes.iter().all(|n| !matches!(n, PatternNote::Thin { .. })), "{:?}", cut.notes);
    for (panel, cut) in pattern.panels().iter().zip(&cut.panels) {
        let quality = Quality::new(panel, cut, spacing);
        let name = panel.name();
        assert!(quality.shortest_edge >= 0.5, "{name} at {spacing}: {quality:?}");
        assert!(quality.longest_edge <= 2.0, "{name} at {spacing}: {quality:?}");
        assert!(quality.smallest_angle.to_degrees() >= 20.0, "{name} at {spacing}: {quality:?}");
        // A chord of h across a circle of radius R cuts off h³/12R.
        let area = 5e-4 * (spacing / 0.01).powi(2).max(1.0);
        assert!(quality.area_error.abs() <= area, "{name} at {spacing}: {quality:?}");
        assert!(quality.deviation <= 0.1 * spacing, "{name} at {spacing}: {quality:?}");
    }
    (cut.particle_count(), cut)
}

#[test]
fn garments_are_cut_well_at_all_spacings() {
    for name in GARMENTS {
        let pattern = shipped(name);
        for spacing in [0.005, 0.01, 0.015] {
            println!("{name} at {spacing}: {} particles", cut(&pattern, spacing).0);
        }
    }
    for name in ["skirt.json", "trousers.json", "teagan.json"] {
        println!("{name} at 0.02: {} particles", cut(&shipped(name), 0.02).0);
    }
}

#[test]
fn an_edge_between_two_seams_that_is_too_short_becomes_one_particle() {
    let (particles, cut) = cut(&shipped("shirt.json"), 0.02);
    let merged = cut.notes.iter().filter_map(|note| match note {
        PatternNote::Merged { panel, edge, length, .. } => {
            assert!((length - 0.0075).abs() < 1e-4, "{note}");
            Some(format!("{panel}.{edge}"))
        }
        _ => None,
    });
    let mut merged: Vec<String> = merged.collect();
    // They are mirror images, and rounding says which is shorter.
    merged.sort();
    assert_eq!(merged, ["left_sleeve_b.2", "right_sleeve_b.3"]);
    assert!(cut.notes.iter().any(|note| note.to_string().contains("its ends are one particle")));
    assert!(particles > 1000, "{particles}");
}

#[test]
fn a_short_pair_of_edges_between_free_ones_is_sewn_at_one_particle() {
    // Two squares that are sewn along edges of 0.9 mm, and in another seam along a whole side.
    let corner = |name: &str| {
        format!(
            "[panel.{name}]\ngrain = 0\nstart = [0, 0]\noutline = [\n\
             {{ name = \"hem\", to = [200, 0] }}, {{ name = \"side\", to = [200, 200] }},\n\
             {{ name = \"slit\", to = [199.1, 200] }}, {{ name = \"top\", to = [0, 200] }},\n\
             {{ name = \"fold\", to = [0, 0] }},\n]\n"
        )
    };
    let text = format!(
        "length = \"mm\"\n{}{}[seam.tack]\nsides = [[\"a.slit\"], [\"b.slit\"]]\nreversed = true\n\
         [seam.fold]\nsides = [[\"a.fold\"], [\"b.fold\"]]\nreversed = true\n",
        corner("a"),
        corner("b")
    );
    let pattern = Pattern::parse(&Document::new("tack.toml", text)).expect("it is sound");
    let cut = Cutter::new(0.02).cut(&pattern).expect("it can be cut");
    let number = pattern.seams().iter().position(|seam| seam.name == "tack").expect("it is there");
    let tack = &cut.seams[number];
    assert_eq!(tack.pairs.len(), 1);
    let places = tack.pairs[0].map(|id| cut.panels[id.panel].positions[id.node as usize]);
    assert_eq!(places[0], places[1]);
    assert!(places[0][0] > 0.199 && (places[0][1] - 0.2).abs() < 1e-12, "{places:?}");
}

#[test]
fn the_grain_may_run_at_any_angle() {
    for name in GARMENTS {
        let pattern = shipped(name);
        for degrees in [17.0_f64, 45.0, 90.0] {
            let turned = |panel: &Panel| {
                let angle = panel.grain() + degrees.to_radians();
                panel.clone().with_grain(angle).expect("it is finite")
            };
            let panels = pattern.panels().iter().map(turned).collect();
            let turned = Pattern::new(panels, pattern.seams().to_vec()).expect("it is sound");
            for spacing in [0.005, 0.01, 0.015] {
                cut(&turned, spacing);
            }
        }
    }
}

#[test]
fn cutting_again_gives_the_same_bits() {
    let pattern = shipped("shirt.json");
    let [one, two] = [0, 1].map(|_| Cutter::default().cut(&pattern).expect("it can be cut"));
    assert!(one == two);
}

#[test]
fn clockwise_panels_lie_where_the_file_puts_them_and_face_outwards() {
    let pattern = shipped("shirt.json");
    let panel = |name: &str| {
        let all = pattern.panels();
        all.iter().find(|p| p.name() == name).expect("it is there").clone()
    };
    let back = panel("left_btorso");
    let placement = back.placement().expect("it has a place");
    // Edge 4 begins where edge 3 ends, at (17.289, 43.410) cm in the file, at z = −20 cm.
    let point = placement.point(back.outline()[4].start);
    let expected = [0.17289, 0.9466 + 0.4341, -0.2];
    assert!(point.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5), "{point:?}");
    let right_side = placement.rotation.map(|row| row[2]);
    assert!((right_side[2] + 1.0).abs() < 1e-12, "{right_side:?}");
    let front = panel("left_ftorso");
    let right_side = front.placement().expect("it has a place").rotation.map(|row| row[2]);
    assert!((right_side[2] - 1.0).abs() < 1e-12, "{right_side:?}");
    // Sewn right side on right side, no seam is twisted.
    for name in GARMENTS {
        let twisted =
            shipped(name).notes().iter().filter(|n| n.to_string().contains("wrong sense")).count();
        assert_eq!(twisted, 0, "{name}");
    }
}

/// A pattern of the scenes.
fn of_the_scenes(name: &str) -> Pattern {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/patterns/");
    Pattern::read(format!("{folder}{name}.toml")).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_garments_of_the_scenes_are_cut_without_a_note() {
    for (name, spacings) in [
        ("skirt", &[0.005, 0.01, 0.02][..]),
        ("tshirt", &[0.005, 0.01, 0.02]),
        ("trousers", &[0.005, 0.01, 0.02]),
        ("gather", &[0.005, 0.01, 0.02]),
        ("seam-strip", &[0.005, 0.01]),
    ] {
        let pattern = of_the_scenes(name);
        assert_eq!(pattern.notes(), [], "{name}");
        for &spacing in spacings {
            let (particles, cut) = cut(&pattern, spacing);
            assert_eq!(cut.notes, [], "{name} at {spacing}");
            println!("{name} at {spacing}: {particles} particles");
        }
    }
}

#[test]
fn seams_of_the_scenes_start_close_and_apart() {
    for (name, farthest) in [("skirt", 0.1), ("tshirt", 0.24), ("trousers", 0.13)] {
        let pattern = of_the_scenes(name);
        let (_, cut) = cut(&pattern, 0.01);
        let place = |id: drape_pattern::NodeId| {
            let placement = pattern.panels()[id.panel].placement().expect("it has a place");
            placement.point(cut.panels[id.panel].positions[id.node as usize])
        };
        let gap = |pair: &[drape_pattern::NodeId; 2]| {
            let [p, q] = pair.map(place);
            (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt()
        };
        let gaps: Vec<f64> = cut.seams.iter().flat_map(|seam| &seam.pairs).map(gap).collect();
        let [least, most] =
            gaps.iter().fold([f64::MAX, 0.0_f64], |[a, b], g| [a.min(*g), b.max(*g)]);
        assert!(least > 0.01 && most < farthest, "{name}: {least} to {most} m");
    }
}

#[test]
fn left_and_right_of_the_scenes_are_mirror_images() {
    for (name, pairs) in [("skirt", 2), ("tshirt", 1), ("trousers", 2)] {
        let pattern = of_the_scenes(name);
        let find = |name: &str| pattern.panels().iter().find(|p| p.name() == name);
        let mut found = 0;
        for left in pattern.panels() {
            let Some(stem) = left.name().strip_suffix("_l") else { continue };
            let right = find(&format!("{stem}_r")).expect("it has a right one");
            assert_eq!(left.outline().len(), right.outline().len());
            for edge in left.outline() {
                let other =
                    right.outline().iter().find(|e| e.name == edge.name).expect("it is there");
                for fraction in [0.0, 0.25, 0.5, 0.9] {
                    let [p, q] = [
                        left.placement().expect("a place").point(edge.at(fraction)),
                        right.placement().expect("a place").point(other.at(1.0 - fraction)),
                    ];
                    let error = (p[0] + q[0]).hypot(p[1] - q[1]).hypot(p[2] - q[2]);
                    assert!(error < 1e-8, "{name}: {} {}: {p:?} {q:?}", left.name(), edge.name);
                }
            }
            found += 1;
        }
        assert_eq!(found, pairs, "{name}");
    }
}
