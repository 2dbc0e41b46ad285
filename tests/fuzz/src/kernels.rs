//! Kernels of contact against rational numbers.

use drape::collide::{Gap, Pair, PairKind, segment_meets_triangle};
use drape::verify::triangles_intersect;
use num_traits::ToPrimitive;

use crate::rational::{self, Exact, exact};
use crate::shapes::Source;

/// Bound of the error of a distance over the largest coordinate.
const ROUNDING: f64 = 1e-14;

/// Compares the exact tests of crossings, of the program and of its verification.
pub fn crossing(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let scale = [1.0, 1e-3, 1e3, 2_f64.powi(-40)][source.below(4) as usize];
    let points: [_; 6] = source.points().map(|point| point.map(|x| scale * x));
    let places = points.map(exact);
    let meets = |edge: [usize; 2], corners: [usize; 3]| {
        let own = segment_meets_triangle(edge.map(|k| points[k]), corners.map(|k| points[k]));
        let (ends, corners) = (edge.map(|k| &places[k]), corners.map(|k| &places[k]));
        let true_one = rational::segment_meets_triangle(ends, corners);
        assert_eq!(own, true_one, "the segment {edge:?} and a triangle of {points:?}");
        own
    };
    let edges = [[0, 1], [1, 2], [2, 0]];
    let of_first = edges.map(|edge| meets(edge, [3, 4, 5]));
    let of_second = edges.map(|[a, b]| meets([a + 3, b + 3], [0, 1, 2]));
    let [a, b, c, d, e, f] = points;
    let [p, q, r, s, t, u] = &places;
    // The verification is asked about triangles with an area only.
    if rational::has_area([p, q, r]) && rational::has_area([s, t, u]) {
        assert_eq!(
            triangles_intersect([a, b, c], [d, e, f]),
            of_first.into_iter().chain(of_second).any(|met| met),
            "the triangles of {points:?}"
        );
    }
}

/// Compares the distance of a pair.
pub fn distance(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let scale = source.power(-4.0, 3.0);
    let points: [_; 4] = source.points().map(|point| point.map(|x| scale * x));
    let places: [Exact; 4] = points.map(exact);
    for kind in [PairKind::VertexFace, PairKind::EdgeEdge] {
        let pair = Pair {
            kind,
            features: [0, 1],
            vertices: [0, 1, 2, 3],
            activation_distance: 10.0 * scale,
            min_separation: 1e-9,
            area: 1.0,
            parallel: 0.0,
            distance: 0.0,
        };
        let own = pair.distance_at(points.as_flattened()).expect("four points");
        let square = rational::square_distance(&places, pair.first_vertex_count());
        let right = square.to_f64().expect("a number").sqrt();
        let miss = (own - right).abs();
        assert!(miss <= ROUNDING * scale, "{kind:?} of {points:?}: {own}, not {right}");
        if right > 1e-6 * scale {
            let gap = Gap::new(&pair, points.as_flattened()).expect("four points");
            assert!((gap.distance() - right).abs() <= ROUNDING * scale, "{kind:?} of {points:?}");
        }
    }
}
