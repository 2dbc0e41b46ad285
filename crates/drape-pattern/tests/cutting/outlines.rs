use drape_pattern::{Curve, Cutter, Edge, EdgeId, Error, Mistake, Panel, Pattern, Stitch};
use proptest::prelude::*;

use crate::invariants;

/// An edge of an outline by its numbers: which curve, and shares for its control points.
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

/// Cuts what is sound, at a spacing of a share of its size.
fn cut(panels: Vec<Panel>, stitches: Vec<Stitch>, spacing: f64) -> bool {
    let Ok(pattern) = Pattern::new(panels, stitches) else { return false };
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

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    /// Points round a centre, joined by curves: most are sound and are cut.
    #[test]
    fn what_is_cut_of_a_star_satisfies_the_invariants(
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

    /// Two panels with all edges sewn in one chain, one of other lengths: counts match on both sides.
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
        let stitch = Stitch { name: "s".into(), sides: [first, second], reversed, max_ease: 1.5 };
        cut(panels, vec![stitch], 1.0 / across);
    }
}
