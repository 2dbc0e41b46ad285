//! Curves through points: cubic Bézier curves in place of the polylines that programs write for
//! curves.
//!
//! Between its ends `$p_0$`, `$p_3$` the curve `$(1-t)^3 p_0 + 3t(1-t)^2 p_1 + 3t^2(1-t) p_2 + t^3
//! p_3$` has control points that minimise the sum of squares of its distances from the points. The
//! parameters of the points begin as fractions of the length of the chords, and are moved to the
//! nearest points of the curve \[Sch90\]. A run that one curve does not fit is halved.
//!
//! A curve fits if it passes the points, and if it stays near the chords between them. A program
//! writes more points where a curve bends more, so that its chords are within a tolerance of it. A
//! curve would bulge between points that are far apart. A chord that is much longer than its
//! neighbours is a straight part, and a sharp turn is a corner.

use crate::edge::{Curve, Edge, difference, distance, distance_from_segment, turning_angle};

/// Largest distance of a point from the curve, in m.
pub(crate) const TOLERANCE: f64 = 5e-5;

/// Largest distance of a curve from the chords between its points if the file states none, in m.
pub(crate) const CHORDS: f64 = 2e-4;

/// Ratio of the length of a chord to the lengths of its neighbours above which it is a straight
/// part. Points that follow one tolerance are at most twice as far apart as their neighbours,
/// except where the curvature jumps.
const LONG: f64 = 3.0;

/// Angle between two chords above which their point is a corner, in rad: 20°.
pub(crate) const TURN: f64 = 0.35;

/// Largest number of times that the parameters are moved.
const ROUNDS: usize = 100;

/// Ratio of the errors after and before a round above which no further round is tried.
const GAIN: f64 = 0.99;

/// Number of Newton steps towards the point of a curve nearest to the middle of a chord.
const STEPS: usize = 4;

/// Edges in place of the chords between points, with their largest distances from both, in m.
#[derive(Debug, Default)]
pub(crate) struct Fit {
    pub(crate) edges: Vec<Edge>,
    /// Largest distance from the points.
    pub(crate) from_points: f64,
    /// Largest distance from the chords.
    pub(crate) from_chords: f64,
}

/// Edge in place of some chords, with its largest distances from points and chords, in m.
struct Piece {
    edge: Edge,
    from_points: f64,
    from_chords: f64,
}

/// Reason why one edge does not fit some points.
enum Misfit {
    /// The edge leaves the points.
    Points,
    /// The edge leaves the chord with this number, from 0, more than other chords.
    Chord(usize),
}

/// Returns edges from the first to the last of `points` that pass all of them, and leave the chords
/// between them by no more than `tolerance`, in m.
pub(crate) fn fitted(points: &[[f64; 2]], tolerance: f64) -> Fit {
    let mut fit = Fit::default();
    for part in parts(points) {
        // If one chord bulges, taking it out needs fewer edges. If a curve is too long, halving
        // does.
        let trials = [true, false].map(|takes_out| pieces(part, tolerance, takes_out));
        let fewer = trials.into_iter().min_by_key(Vec::len).unwrap_or_default();
        for piece in fewer {
            fit.from_points = fit.from_points.max(piece.from_points);
            fit.from_chords = fit.from_chords.max(piece.from_chords);
            fit.edges.push(piece.edge);
        }
    }
    fit
}

/// Returns the edges for the chords of `part`, within `tolerance`, in m. A run whose edge leaves a
/// chord is divided at the chord if `takes_out`. Any other run that does not fit is halved.
fn pieces(part: &[[f64; 2]], tolerance: f64, takes_out: bool) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut runs = vec![part];
    while let Some(run) = runs.pop() {
        match piece(run, tolerance) {
            Ok(piece) => pieces.push(piece),
            Err(Misfit::Chord(k)) if takes_out => {
                let three = [&run[k + 1..], &run[k..=k + 1], &run[..=k]];
                runs.extend(three.into_iter().filter(|run| run.len() > 1));
            }
            Err(_) => {
                let (first, second) = (&run[..=run.len() / 2], &run[run.len() / 2..]);
                runs.extend([second, first]);
            }
        }
    }
    pieces
}

/// Returns the parts of `points` between corners and straight parts. Each begins at the last point
/// of the part before it.
fn parts(points: &[[f64; 2]]) -> Vec<&[[f64; 2]]> {
    let chords: Vec<[f64; 2]> =
        points.windows(2).map(|pair| difference(pair[1], pair[0])).collect();
    let lengths: Vec<f64> = points.windows(2).map(|pair| distance(pair[0], pair[1])).collect();

    let mut parts = Vec::new();
    let mut start = 0;
    for k in 1..lengths.len() {
        let is_corner = turning_angle(chords[k - 1], chords[k]).abs() > TURN;
        if is_corner || is_long(&lengths, k - 1) || is_long(&lengths, k) {
            parts.push(&points[start..=k]);
            start = k;
        }
    }
    parts.push(&points[start..]);
    parts
}

/// Returns whether the chord `k` of chords with `lengths` is much longer than its neighbours.
fn is_long(lengths: &[f64], k: usize) -> bool {
    let neighbours = [k.checked_sub(1), Some(k + 1)].into_iter().flatten();
    let mut beside = neighbours.filter_map(|k| lengths.get(k)).peekable();
    beside.peek().is_some() && beside.all(|length| lengths[k] > LONG * length)
}

/// Returns one edge that passes `points`, two or more, and stays within `tolerance`, in m, of the
/// chords between them.
fn piece(points: &[[f64; 2]], tolerance: f64) -> Result<Piece, Misfit> {
    let (start, end) = (points[0], points[points.len() - 1]);
    if points.len() < 3 {
        return Ok(Piece { edge: Edge::line("", start, end), from_points: 0.0, from_chords: 0.0 });
    }
    if let Some(piece) = straight_piece(points) {
        return Ok(piece);
    }

    // The parameters begin as fractions of the length of the polyline.
    let mut sums = vec![0.0];
    for pair in points.windows(2) {
        sums.push(sums[sums.len() - 1] + distance(pair[0], pair[1]));
    }
    let total = sums[sums.len() - 1];
    let parameters: Vec<f64> = sums.iter().map(|sum| sum / total).collect();
    match points {
        [_, middle, _] => quadratic_piece([start, *middle, end], &parameters, tolerance),
        _ => cubic_piece(points, parameters, tolerance),
    }
}

/// Returns the straight edge from the first to the last of `points`, if they lie on it.
fn straight_piece(points: &[[f64; 2]]) -> Option<Piece> {
    let (start, end) = (points[0], points[points.len() - 1]);
    let chord = difference(end, start);
    let size = chord[0].hypot(chord[1]);
    let mut most: f64 = 0.0;
    for p in points {
        let arm = difference(*p, start);
        let gap = ((arm[1] * chord[0] - arm[0] * chord[1]) / size).abs();
        let along = (arm[0] * chord[0] + arm[1] * chord[1]) / size;
        if !(gap <= 0.2 * TOLERANCE && (-TOLERANCE..=size + TOLERANCE).contains(&along)) {
            return None;
        }
        most = most.max(gap);
    }
    Some(Piece { edge: Edge::line("", start, end), from_points: most, from_chords: most })
}

/// Returns the quadratic curve that passes through the three `points` at the curve parameters
/// `parameters`, if it stays within `tolerance`, in m, of the chords between the points.
fn quadratic_piece(
    points: [[f64; 2]; 3],
    parameters: &[f64],
    tolerance: f64,
) -> Result<Piece, Misfit> {
    let [start, middle, end] = points;
    let t = parameters[1];
    let weights = [(1.0 - t) * (1.0 - t), t * t, 2.0 * t * (1.0 - t)];
    let control =
        [0, 1].map(|k| (middle[k] - weights[0] * start[k] - weights[1] * end[k]) / weights[2]);

    // The distances are measured on the cubic curve that is equal to it.
    let [first, second] =
        [start, end].map(|p| [0, 1].map(|k| p[k] + 2.0 / 3.0 * (control[k] - p[k])));
    let from_chords = within_chords(&[start, first, second, end], &points, parameters, tolerance)?;
    let edge = Edge::line("", start, end).curved(Curve::Quadratic(control));
    Ok(Piece { edge, from_points: 0.0, from_chords })
}

/// Returns the cubic curve that passes `points` within [`TOLERANCE`] and stays within `tolerance`,
/// in m, of the chords. `parameters` are first values of the parameters of the points.
fn cubic_piece(
    points: &[[f64; 2]],
    mut parameters: Vec<f64>,
    tolerance: f64,
) -> Result<Piece, Misfit> {
    let (start, end) = (points[0], points[points.len() - 1]);
    let mut last = f64::INFINITY;
    for _ in 0..ROUNDS {
        let controls = controls(points, &parameters).ok_or(Misfit::Points)?;
        let curve = [start, controls[0], controls[1], end];
        let distances = points.iter().zip(&parameters).map(|(p, t)| distance(*p, at(&curve, *t)));
        let from_points = distances.fold(0.0, f64::max);
        if from_points <= TOLERANCE.min(tolerance) {
            let edge = Edge::line("", start, end).curved(Curve::Cubic(controls));
            let from_chords = within_chords(&curve, points, &parameters, tolerance)?;
            return Ok(Piece { edge, from_points, from_chords });
        }
        if !(from_points < GAIN * last) {
            return Err(Misfit::Points);
        }

        last = from_points;
        for (point, t) in points.iter().zip(&mut parameters) {
            *t = nearer(&curve, *point, *t);
        }
    }
    Err(Misfit::Points)
}

/// Returns the largest distance between a cubic curve and the chords of `points`, in m, if it is
/// within `limit`. `curve` has the ends and control points, and passes `points` at `parameters`.
///
/// Both the distance of the middle of a chord from the curve and distances of the curve from the
/// chord count.
fn within_chords(
    curve: &[[f64; 2]; 4],
    points: &[[f64; 2]],
    parameters: &[f64],
    limit: f64,
) -> Result<f64, Misfit> {
    let (mut most, mut worst) = (0.0_f64, 0);
    for (k, (pair, t)) in points.windows(2).zip(parameters.windows(2)).enumerate() {
        let middle = [0, 1].map(|k| 0.5 * (pair[0][k] + pair[1][k]));
        let mut nearest = 0.5 * (t[0] + t[1]);
        (0..STEPS).for_each(|_| nearest = nearer(curve, middle, nearest));
        let beside = [0.25, 0.5, 0.75].map(|part| {
            let point = at(curve, t[0] + part * (t[1] - t[0]));
            distance_from_segment(point, [pair[0], pair[1]])
        });
        let gap = beside.into_iter().fold(distance(middle, at(curve, nearest)), f64::max);
        if gap > most {
            (most, worst) = (gap, k);
        }
    }
    if most <= limit { Ok(most) } else { Err(Misfit::Chord(worst)) }
}

/// Returns the two inner control points of the cubic curve from the first to the last of `points`
/// with the least squares of distances at `parameters`; `None` if the points do not determine them.
fn controls(points: &[[f64; 2]], parameters: &[f64]) -> Option<[[f64; 2]; 2]> {
    let (start, end) = (points[0], points[points.len() - 1]);
    // Normal equations: `a` and `b` are the weights of the two control points.
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

/// Returns the point at parameter `t` of the cubic curve with the points `curve`.
fn at(curve: &[[f64; 2]; 4], t: f64) -> [f64; 2] {
    let s = 1.0 - t;
    let weights = [s * s * s, 3.0 * t * s * s, 3.0 * t * t * s, t * t * t];
    [0, 1].map(|k| (0..4).map(|n| weights[n] * curve[n][k]).sum())
}

/// Returns a parameter whose point of `curve` is nearer to `point` than the point at `t`: a step of
/// Newton's method.
fn nearer(curve: &[[f64; 2]; 4], point: [f64; 2], t: f64) -> f64 {
    let s = 1.0 - t;
    let arm = difference(at(curve, t), point);
    let legs = [0, 1, 2].map(|n| difference(curve[n + 1], curve[n]));
    let first =
        [0, 1].map(|k| 3.0 * (s * s * legs[0][k] + 2.0 * s * t * legs[1][k] + t * t * legs[2][k]));
    let second =
        [0, 1].map(|k| 6.0 * (s * (legs[1][k] - legs[0][k]) + t * (legs[2][k] - legs[1][k])));
    let slope = first[0] * first[0] + first[1] * first[1] + arm[0] * second[0] + arm[1] * second[1];
    let step = (arm[0] * first[0] + arm[1] * first[1]) / slope;
    if step.is_finite() && slope > 0.0 { (t - step).clamp(0.0, 1.0) } else { t }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest distance of the edges from the middles of the chords between points, in m, measured
    /// at a thousand points of each edge.
    fn from_middles(fit: &Fit, points: &[[f64; 2]]) -> f64 {
        let off = |pair: &[[f64; 2]]| {
            let middle = [0, 1].map(|k| 0.5 * (pair[0][k] + pair[1][k]));
            fit.edges.iter().map(|edge| edge.nearest(middle)[1]).fold(f64::MAX, f64::min)
        };
        points.windows(2).map(off).fold(0.0, f64::max)
    }

    #[test]
    fn points_on_a_curve_give_few_curves_that_pass_them() {
        let curve =
            Edge::line("", [0.0, 0.0], [0.3, 0.1]).curved(Curve::Cubic([[0.1, 0.2], [0.2, -0.1]]));
        for count in [30, 60, 400] {
            let points: Vec<_> =
                (0..count).map(|k| curve.at(f64::from(k) / f64::from(count - 1))).collect();
            let fit = fitted(&points, 1e-3);
            assert!(fit.edges.len() <= 2, "{count} points: {}", fit.edges.len());
            for p in &points {
                let off = fit.edges.iter().map(|e| e.nearest(*p)[1]).fold(f64::MAX, f64::min);
                assert!(off < 1.1 * TOLERANCE, "{count} points: {off} m");
            }
            let length: f64 = fit.edges.iter().map(Edge::length).sum();
            assert!((length - curve.length()).abs() < 1e-4, "{length} m");
        }
        let line: Vec<_> = (0..50).map(|k| [0.01 * f64::from(k), 0.02 * f64::from(k)]).collect();
        let edges = fitted(&line, CHORDS).edges;
        assert_eq!(edges.len(), 1);
        assert_eq!(edges[0].curve, Curve::Line);
    }

    #[test]
    fn the_curve_through_three_points_passes_the_middle_one_at_its_share_of_the_chords() {
        // The second chord is two and a half times as long as the first.
        let points = [[0.3, 0.1], [0.36, 0.11], [0.511, 0.12]];
        let edges = fitted(&points, 1e-2).edges;
        let [edge] = &edges[..] else { panic!("{edges:?}") };
        let Curve::Quadratic(control) = edge.curve else { panic!("{edge:?}") };
        assert_eq!([edge.start, edge.end], [points[0], points[2]]);
        let [first, second] = [0, 1].map(|k| distance(points[k], points[k + 1]));
        let t = first / (first + second);
        let between = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| (1.0 - t) * a[k] + t * b[k]);
        let middle = between(between(edge.start, control), between(control, edge.end));
        assert!(distance(middle, points[1]) < 1e-12, "{middle:?}");
    }

    #[test]
    fn a_curve_stays_within_the_tolerance_of_its_chords() {
        // Quarters of circles of 30, 100 and 400 mm, whose sagitta is near or above the tolerance.
        for (radius, count) in [(0.03, 8), (0.1, 9), (0.1, 40), (0.4, 12), (0.4, 60)] {
            let points: Vec<[f64; 2]> = (0..=count)
                .map(|k| std::f64::consts::FRAC_PI_2 * f64::from(k) / f64::from(count))
                .map(|angle| [radius * angle.cos(), radius * angle.sin()])
                .collect();
            let chord = distance(points[0], points[1]);
            let sagitta = chord * chord / (8.0 * radius);
            for tolerance in [5e-5, 1.52e-4, 2e-4, 1e-3] {
                let fit = fitted(&points, tolerance);
                let off = from_middles(&fit, &points);
                assert!(off <= 1.001 * tolerance, "{radius} m, {count} chords: {off} m");
                assert!(off <= fit.from_chords + 1e-6, "{off} m and {} m", fit.from_chords);
                // Where the circle itself stays within the tolerance a few curves are enough; else
                // the chords are left.
                let edges = fit.edges.len();
                let right = match sagitta / tolerance {
                    ..0.8 => edges <= 4,
                    1.1.. => edges == count as usize,
                    _ => true,
                };
                assert!(right, "{radius} m, {count} chords, sagitta {sagitta} m: {edges} edges");
            }
        }
    }

    #[test]
    fn a_long_chord_beside_short_ones_is_straight_and_a_sharp_turn_is_a_corner() {
        // A straight part of 200 mm that goes over into an arc of 50 mm with chords of 4 mm.
        let mut points = vec![[-0.2, -0.05]];
        points.extend((0..=20).map(|k| {
            let angle = 0.08 * f64::from(k) - std::f64::consts::FRAC_PI_2;
            [0.05 * angle.cos(), 0.05 * angle.sin()]
        }));
        for points in [points.clone(), points.iter().rev().copied().collect()] {
            let fit = fitted(&points, 2e-4);
            let long = fit.edges.iter().find(|edge| edge.length() > 0.19).expect("it is there");
            assert!((long.length() - 0.2).abs() < 1e-12 && long.curve == Curve::Line, "{long:?}");
            assert!(from_middles(&fit, &points) <= 2e-4, "{}", from_middles(&fit, &points));
            assert!(fit.edges.len() <= 3, "{:?}", fit.edges);
        }
        let turn = [[0.0, 0.0], [0.01, 0.001], [0.02, 0.0], [0.018, 0.01], [0.02, 0.02]];
        let edges = fitted(&turn, 1e-3).edges;
        assert_eq!(edges[0].end, [0.02, 0.0], "{edges:?}");
    }
}
