//! Outlines of any shape, and what is refused.

use drape_pattern::{
    Curve, Cutter, Edge, EdgeId, Error, MAX_EASE, Mistake, Panel, Pattern, PatternNote, Quality,
    Seam,
};
use proptest::prelude::*;

use crate::invariants;

/// An edge of an outline by its numbers: its curve, and the positions of its control points as
/// fractions.
type Shape = (u8, [f64; 4]);

fn outline(corners: &[[f64; 2]], shapes: &[Shape]) -> Vec<Edge> {
    let n = corners.len();
    let edge = |k: usize| {
        let (start, end) = (corners[k], corners[(k + 1) % n]);
        let (kind, [a, b, c, d]) = shapes[k % shapes.len()];
        let chord = [end[0] - start[0], end[1] - start[1]];
        let control = |x: f64, y: f64| {
            [start[0] + x * chord[0] - y * chord[1], start[1] + x * chord[1] + y * chord[0]]
        };
        let curve = match kind {
            0 => Curve::Quadratic(control(a, b - 0.5)),
            1 => Curve::Cubic([control(a, b - 0.5), control(c, d - 0.5)]),
            2 => Curve::Arc { sweep: 4.0 * (a - 0.5) },
            _ => Curve::Line,
        };
        Edge::line(k.to_string(), start, end).curved(curve)
    };
    (0..n).map(edge).collect()
}

fn shapes() -> impl Strategy<Value = Vec<Shape>> {
    prop::collection::vec((0..8_u8, prop::array::uniform4(0.0..1.0)), 1..8)
}

/// Cuts a sound pattern at a spacing that is a fraction of its size.
fn cut(panels: Vec<Panel>, seams: Vec<Seam>, spacing: f64) -> bool {
    let Ok(pattern) = Pattern::new(panels, seams) else { return false };
    let cut = match Cutter::new(spacing).cut(&pattern) {
        Ok(cut) => cut,
        // Every mistake but this one is the outline's.
        Err(Error::Pattern(all)) if all.iter().all(|m| !matches!(m, Mistake::Rim { .. })) => {
            return false;
        }
        Err(error) => panic!("{error}"),
    };
    invariants::check(&pattern, &cut);
    true
}

/// Radius of a circle, in m.
const RADIUS: f64 = 0.1;

#[test]
fn the_quality_of_a_disc_is_that_of_its_polygon() {
    let half = |name: &str, x: f64| {
        let arc = Curve::Arc { sweep: std::f64::consts::PI };
        Edge::line(name, [x, 0.0], [-x, 0.0]).curved(arc)
    };
    let disc = Panel::new("disc", vec![half("upper", RADIUS), half("lower", -RADIUS)]);
    let pattern = Pattern::new(vec![disc.expect("it is sound")], vec![]).expect("it is sound");
    let cut = Cutter::new(0.01).cut(&pattern).expect("it can be cut");
    invariants::check(&pattern, &cut);
    let quality = Quality::new(&pattern.panels()[0], &cut.panels[0], 0.01);
    let n = cut.panels[0].outline.len() as f64;
    assert_eq!(n, 62.0, "twice the rounded half circle of 31.4 spacings");
    let angle = std::f64::consts::TAU / n;
    let area_error = 0.5 * n * angle.sin() / std::f64::consts::PI - 1.0;
    assert!((quality.area_error - area_error).abs() < 1e-9, "{} {area_error}", quality.area_error);
    let sagitta = RADIUS * (1.0 - (0.5 * angle).cos());
    assert!((quality.deviation / sagitta - 1.0).abs() < 1e-9, "{} {sagitta}", quality.deviation);
    assert!(
        quality.shortest_edge >= 0.6 && quality.smallest_angle.to_degrees() > 22.0,
        "{quality:?}"
    );
}

#[test]
fn a_digitised_outline_of_many_short_edges_is_cut_like_a_smooth_one() {
    let n = 5000;
    let corner = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / n as f64;
        [RADIUS * angle.cos(), RADIUS * angle.sin()]
    };
    let corners: Vec<[f64; 2]> = (0..n).map(corner).collect();
    let panel = Panel::new("disc", outline(&corners, &[(7, [0.0; 4])])).expect("it is sound");
    let pattern = Pattern::new(vec![panel], vec![]).expect("it is sound");
    let cut = Cutter::new(0.01).cut(&pattern).expect("its corners are smooth");
    invariants::check(&pattern, &cut);
    let quality = Quality::new(&pattern.panels()[0], &cut.panels[0], 0.01);
    assert!(
        quality.shortest_edge >= 0.6 && quality.smallest_angle.to_degrees() > 22.0,
        "{quality:?}"
    );
    let n = cut.panels[0].outline.len();
    assert!((62..=64).contains(&n), "{n} nodes on 62.8 spacings");
    assert!(
        matches!(cut.notes[0], PatternNote::Dissolved { ends: 4990..5000, .. }),
        "{:?}",
        cut.notes
    );
}

#[test]
fn spacings_that_are_none_and_too_small_are_refused() {
    let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]];
    let panel = Panel::new("sail", outline(&corners, &[(7, [0.0; 4])])).expect("it is sound");
    let pattern = Pattern::new(vec![panel], vec![]).expect("it is sound");
    for spacing in [f64::NAN, 0.0, -0.01, f64::INFINITY] {
        let said = Cutter::new(spacing).cut(&pattern).expect_err("it is none").to_string();
        assert!(said.contains("the spacing is"), "{said}");
    }
    for spacing in [1e-5, 5e-4] {
        let error = Cutter::new(spacing).cut(&pattern).expect_err("it is too small");
        // The grid that would hold the sail.
        let grid = (2.0 / spacing).powi(2);
        let Error::Pattern(all) = &error else { panic!("{error}") };
        assert!(
            matches!(&all[..], [Mistake::TooMany { nodes, .. }] if (nodes / grid - 1.0).abs() < 2e-3),
            "{all:?}"
        );
        let said = error.to_string();
        assert!(
            said.contains("panel sail would have") && said.contains("larger spacing"),
            "{said}"
        );
    }
    assert!(
        Cutter::new(5.0)
            .cut(&pattern)
            .expect_err("no cells")
            .to_string()
            .contains("half the spacing")
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    /// Points round a centre, joined by curves: most are sound and are cut.
    #[test]
    fn a_cut_star_satisfies_the_invariants(
        radii in prop::collection::vec(0.2..1.0_f64, 3..14),
        shapes in shapes(),
        grain in -4.0..4.0_f64,
        across in 3.0..40.0_f64,
    ) {
        let n = radii.len();
        let corner = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / n as f64;
            [0.5 * radii[k] * angle.cos(), 0.5 * radii[k] * angle.sin()]
        };
        let corners: Vec<[f64; 2]> = (0..n).map(corner).collect();
        if let Ok(panel) = Panel::new("star", outline(&corners, &shapes)) {
            cut(vec![panel.with_grain(grain).expect("finite")], vec![], 1.0 / across);
        }
    }

    /// Points anywhere, of any size, not always numbers: an answer, never a panic.
    #[test]
    fn no_outline_panics(
        corners in prop::collection::vec(prop::array::uniform2(-1.0..1.0_f64), 0..9),
        shapes in shapes(),
        exponent in -200.0..200.0_f64,
        huge in any::<bool>(),
        odd in prop::option::of((0..9_usize, prop::num::f64::ANY)),
        across in 0.1..40.0_f64,
    ) {
        let scale = if huge { 10.0_f64.powf(exponent) } else { 1.0 };
        let mut corners: Vec<[f64; 2]> = corners.iter().map(|p| p.map(|x| x * scale)).collect();
        if let Some((k, value)) = odd && k < corners.len() {
            corners[k][k % 2] = value;
        }
        if let Ok(panel) = Panel::new("any", outline(&corners, &shapes)) {
            cut(vec![panel], vec![], scale / across);
        }
    }

    /// Two panels with all edges sewn in one chain, one of other lengths: counts match on both
    /// sides.
    #[test]
    fn chains_of_other_edges_are_sewn_node_to_node(
        radii in prop::collection::vec(0.6..1.0_f64, 3..10),
        others in prop::collection::vec(0.6..1.0_f64, 3..10),
        edges in (1..4_usize, 1..4_usize),
        reversed in any::<bool>(),
        across in 3.0..40.0_f64,
    ) {
        let panel = |name: &str, radii: &[f64]| {
            let corner = |k: usize| {
                let angle = std::f64::consts::TAU * k as f64 / radii.len() as f64;
                [0.5 * radii[k] * angle.cos(), 0.5 * radii[k] * angle.sin()]
            };
            let corners: Vec<[f64; 2]> = (0..radii.len()).map(corner).collect();
            Panel::new(name, outline(&corners, &[(7, [0.0; 4])])).expect("a star is sound")
        };
        let panels = vec![panel("a", &radii), panel("b", &others)];
        let first = (0..edges.0.min(radii.len())).map(|edge| EdgeId { panel: 0, edge }).collect();
        let along: Vec<EdgeId> =
            (0..edges.1.min(others.len())).map(|edge| EdgeId { panel: 1, edge }).collect();
        let second = if reversed { along } else { along.into_iter().rev().collect() };
        let seam = Seam { name: "s".into(), sides: [first, second], reversed, max_ease: MAX_EASE, angle: 0.0, allowance: 0.0 };
        cut(panels, vec![seam], 1.0 / across);
    }

    /// Two discs of arcs of any lengths, sewn along two seams: all corners are smooth, and short
    /// pieces are joined with their neighbours on both sides of the seams at once.
    #[test]
    fn smooth_corners_of_seams_are_removed_on_both_sides_at_once(
        parts in (prop::collection::vec(0.01..1.0_f64, 4..30), prop::collection::vec(0.01..1.0_f64, 4..30)),
        cuts in prop::array::uniform4(0.1..0.9_f64),
        reversed in any::<bool>(),
        ease in 0.5..2.0_f64,
        across in 4.0..60.0_f64,
    ) {
        let disc = |name: &str, parts: &[f64], radius: f64| {
            let whole: f64 = parts.iter().sum();
            let mut angles = vec![0.0];
            parts.iter().for_each(|p| angles.push(angles[angles.len() - 1] + p / whole));
            let at = |share: f64| {
                let (sine, cosine) = (std::f64::consts::TAU * share).sin_cos();
                [radius * cosine, radius * sine]
            };
            let n = parts.len();
            let arc = |k: usize| {
                let sweep = std::f64::consts::TAU * (angles[k + 1] - angles[k]);
                let end = at(if k + 1 == n { 0.0 } else { angles[k + 1] });
                Edge::line(k.to_string(), at(angles[k]), end).curved(Curve::Arc { sweep })
            };
            let panel = Panel::new(name, (0..n).map(arc).collect()).expect("a disc is sound");
            (panel, move |edges: std::ops::Range<usize>| angles[edges.end] - angles[edges.start])
        };
        // From the first edge to one cut, and on to the next.
        let places = |n: usize, [a, b]: [f64; 2]| {
            let first = 1 + (a * (n - 2) as f64) as usize;
            [first, first + 1 + (b * (n - 1 - first) as f64) as usize]
        };
        let [a, b] = places(parts.0.len(), [cuts[0], cuts[1]]);
        let [c, d] = places(parts.1.len(), [cuts[2], cuts[3]]);
        let (one, share) = disc("one", &parts.0, 0.2);
        let (_, other) = disc("two", &parts.1, 1.0);
        let radius = 0.2 * ease * share(0..a) / other(0..c);
        let (two, _) = disc("two", &parts.1, radius.clamp(0.05, 1.0));
        let seam = |name: &str, first: std::ops::Range<usize>, second: std::ops::Range<usize>| {
            let ids = |panel, edges: std::ops::Range<usize>| edges.map(move |edge| EdgeId { panel, edge });
            let along: Vec<EdgeId> = ids(1, second).collect();
            let second = if reversed { along } else { along.into_iter().rev().collect() };
            Seam { name: name.into(), sides: [ids(0, first).collect(), second], reversed, max_ease: MAX_EASE, angle: 0.0, allowance: 0.0 }
        };
        // Against the outline of the second disc the second seam does not go on where the first
        // ends.
        let seams = vec![seam("first", 0..a, 0..c), seam("second", a..b, c..d)];
        if let Ok(pattern) = Pattern::new(vec![one, two], seams)
            && let Ok(cut) = Cutter::new(0.4 / across).cut(&pattern)
        {
            invariants::check(&pattern, &cut);
            for seam in &cut.seams {
                for (side, forward) in [(0, true), (1, reversed)] {
                    let n = cut.panels[side].outline.len();
                    let nodes: Vec<usize> = seam.side(side).map(|id| id.node as usize).collect();
                    for two in nodes.windows(2) {
                        let [from, to] = if forward { [two[0], two[1]] } else { [two[1], two[0]] };
                        prop_assert_eq!((to + n - from) % n, 1);
                    }
                }
            }
        }
    }
}
