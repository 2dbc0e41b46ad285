//! Curves through points: Bézier curves of degree three for the polylines that programs write for
//! them.
//!
//! Between its ends `$p_0$`, `$p_3$` the curve `$(1-t)^3 p_0 + 3t(1-t)^2 p_1 + 3t^2(1-t) p_2 + t^3
//! p_3$` has the control points of the least squares of its distances from the points; their
//! parameters begin as fractions of the length of the chords and are moved to the nearest points of
//! the curve \[Sch90\]. A run that one curve does not fit is halved.

use crate::edge::{Curve, Edge, difference, distance};

/// Largest distance of a point from the curve, in m.
pub(crate) const TOLERANCE: f64 = 5e-5;

/// Largest number of times that the parameters are moved; the gain of a round below which they are
/// not.
const ROUNDS: usize = 100;
const GAIN: f64 = 0.99;

/// Returns edges from the first to the last of some points that pass all of them within the
/// tolerance.
pub(crate) fn fitted(points: &[[f64; 2]]) -> Vec<Edge> {
    let mut edges = Vec::new();
    let mut left = vec![points];
    while let Some(run) = left.pop() {
        match one(run) {
            Some(edge) => edges.push(edge),
            None => {
                let (first, second) = (&run[..=run.len() / 2], &run[run.len() / 2..]);
                left.extend([second, first]);
            }
        }
    }
    edges
}

/// Returns one edge that passes some points, if there is one.
fn one(points: &[[f64; 2]]) -> Option<Edge> {
    let (start, end) = (*points.first()?, *points.last()?);
    let line = Edge::line("", start, end);
    let chord = difference(end, start);
    let size = chord[0].hypot(chord[1]);
    let straight = points.iter().all(|&p| {
        let arm = difference(p, start);
        let (along, off) = (
            (arm[0] * chord[0] + arm[1] * chord[1]) / size,
            (arm[1] * chord[0] - arm[0] * chord[1]) / size,
        );
        off.abs() <= 0.2 * TOLERANCE && (-TOLERANCE..=size + TOLERANCE).contains(&along)
    });
    if points.len() < 3 || straight {
        return Some(line);
    }
    let mut sums = vec![0.0];
    for pair in points.windows(2) {
        sums.push(sums[sums.len() - 1] + distance(pair[0], pair[1]));
    }
    let total = sums[sums.len() - 1];
    let mut parameters: Vec<f64> = sums.iter().map(|sum| sum / total).collect();
    if let [_, middle, _] = points {
        let t = parameters[1];
        let weights = [(1.0 - t) * (1.0 - t), t * t, 2.0 * t * (1.0 - t)];
        let control =
            [0, 1].map(|k| (middle[k] - weights[0] * start[k] - weights[1] * end[k]) / weights[2]);
        return Some(line.curved(Curve::Quadratic(control)));
    }
    let mut last = f64::INFINITY;
    for _ in 0..ROUNDS {
        let controls = controls(points, &parameters)?;
        let all = [start, controls[0], controls[1], end];
        let worst = points.iter().zip(&parameters).map(|(p, t)| distance(*p, at(&all, *t)));
        let worst = worst.fold(0.0, f64::max);
        if worst <= TOLERANCE {
            return Some(line.curved(Curve::Cubic(controls)));
        }
        if !(worst < GAIN * last) {
            return None;
        }
        last = worst;
        for (point, t) in points.iter().zip(&mut parameters) {
            *t = nearer(&all, *point, *t);
        }
    }
    None
}

/// Returns the control points of the least squares.
fn controls(points: &[[f64; 2]], parameters: &[f64]) -> Option<[[f64; 2]; 2]> {
    let (start, end) = (points[0], points[points.len() - 1]);
    let (mut aa, mut ab, mut bb) = (0.0, 0.0, 0.0);
    let (mut right_a, mut right_b) = ([0.0; 2], [0.0; 2]);
    for (point, &t) in points.iter().zip(parameters) {
        let s = 1.0 - t;
        let (a, b) = (3.0 * t * s * s, 3.0 * t * t * s);
        aa += a * a;
        ab += a * b;
        bb += b * b;
        for k in 0..2 {
            let rest = point[k] - s * s * s * start[k] - t * t * t * end[k];
            right_a[k] += a * rest;
            right_b[k] += b * rest;
        }
    }
    let determinant = aa * bb - ab * ab;
    if !(determinant > 1e-9 * aa * bb) {
        return None;
    }
    let first = [0, 1].map(|k| (right_a[k] * bb - right_b[k] * ab) / determinant);
    let second = [0, 1].map(|k| (right_b[k] * aa - right_a[k] * ab) / determinant);
    Some([first, second])
}

/// Returns the point of a curve at a parameter.
fn at(all: &[[f64; 2]; 4], t: f64) -> [f64; 2] {
    let s = 1.0 - t;
    let weights = [s * s * s, 3.0 * t * s * s, 3.0 * t * t * s, t * t * t];
    [0, 1].map(|k| (0..4).map(|n| weights[n] * all[n][k]).sum())
}

/// Returns a parameter whose point is nearer to a point: a step of Newton's method.
fn nearer(all: &[[f64; 2]; 4], point: [f64; 2], t: f64) -> f64 {
    let s = 1.0 - t;
    let arm = difference(at(all, t), point);
    let leg = |n: usize| difference(all[n + 1], all[n]);
    let first =
        [0, 1].map(|k| 3.0 * (s * s * leg(0)[k] + 2.0 * s * t * leg(1)[k] + t * t * leg(2)[k]));
    let second = [0, 1].map(|k| 6.0 * (s * (leg(1)[k] - leg(0)[k]) + t * (leg(2)[k] - leg(1)[k])));
    let slope = first[0] * first[0] + first[1] * first[1] + arm[0] * second[0] + arm[1] * second[1];
    let step = (arm[0] * first[0] + arm[1] * first[1]) / slope;
    if step.is_finite() && slope > 0.0 { (t - step).clamp(0.0, 1.0) } else { t }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_on_a_curve_give_few_curves_that_pass_them() {
        let curve =
            Edge::line("", [0.0, 0.0], [0.3, 0.1]).curved(Curve::Cubic([[0.1, 0.2], [0.2, -0.1]]));
        for count in [3, 4, 5, 9, 60, 400] {
            let points: Vec<_> =
                (0..count).map(|k| curve.at(f64::from(k) / f64::from(count - 1))).collect();
            let edges = fitted(&points);
            assert!(edges.len() <= 2, "{count} points: {}", edges.len());
            for p in &points {
                let off = edges.iter().map(|e| e.nearest(*p)[1]).fold(f64::MAX, f64::min);
                assert!(off < 1.1 * TOLERANCE, "{count} points: {off} m");
            }
            if count >= 60 {
                let length: f64 = edges.iter().map(Edge::length).sum();
                assert!((length - curve.length()).abs() < 1e-4, "{length} m");
            }
        }
        let line: Vec<_> = (0..50).map(|k| [0.01 * f64::from(k), 0.02 * f64::from(k)]).collect();
        assert_eq!(fitted(&line).len(), 1);
        assert_eq!(fitted(&line)[0].curve, Curve::Line);
    }

    #[test]
    fn the_curve_through_three_points_passes_the_middle_one_at_its_share_of_the_chords() {
        // The second chord is three times as long as the first.
        let points = [[0.3, 0.1], [0.36, 0.18], [0.66, 0.18]];
        let edges = fitted(&points);
        let [edge] = &edges[..] else { panic!("{edges:?}") };
        let Curve::Quadratic(control) = edge.curve else { panic!("{edge:?}") };
        assert_eq!([edge.start, edge.end], [points[0], points[2]]);
        let between = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| 0.75 * a[k] + 0.25 * b[k]);
        let middle = between(between(edge.start, control), between(control, edge.end));
        assert!(distance(middle, points[1]) < 1e-12, "{middle:?}");
    }
}
