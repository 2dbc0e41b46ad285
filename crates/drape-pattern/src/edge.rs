//! Edges of outlines: lines, Bézier curves and circular arcs, with their lengths and areas.

mod chords;

use kurbo::{
    CubicBez, Line, ParamCurve, ParamCurveArclen, ParamCurveArea, PathSeg, Point, QuadBez,
};

/// Relative accuracy of lengths along an edge.
const ACCURACY: f64 = 1e-9;

/// Curve of an edge from its start to its end. Points are in the frame of the panel, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Curve {
    /// Straight line.
    Line,
    /// Bézier curve of degree two, with its control point.
    Quadratic([f64; 2]),
    /// Bézier curve of degree three, with its two control points.
    Cubic([[f64; 2]; 2]),
    /// Circular arc.
    Arc {
        /// Angle of the arc, anticlockwise, between −2π and 2π, in rad.
        sweep: f64,
    },
}

/// Edge of an outline.
///
/// ```
/// use drape_pattern::{Curve, Edge};
///
/// // A quarter of a circle of 1 m about the origin.
/// let chord = Edge::line("neckline", [1.0, 0.0], [0.0, 1.0]);
/// let sweep = chord.arc_sweep(1.0, false, true);
/// let arc = chord.curved(Curve::Arc { sweep });
/// assert!((arc.length() - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
/// assert!((arc.at(0.5)[0] - 0.5_f64.sqrt()).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Edge {
    /// Name, or number where the file gives no name.
    pub name: String,
    /// Start point, in m.
    pub start: [f64; 2],
    /// End point, in m.
    pub end: [f64; 2],
    /// Curve from `start` to `end`.
    pub curve: Curve,
    /// Width of the hem along the edge, in m; 0 without a hem.
    pub hem: f64,
    /// Distances of notches from `start`, along the edge, in m.
    pub notches: Vec<f64>,
}

/// Circle that an arc is part of.
struct Circle {
    center: [f64; 2],
    /// Vector from the centre to the start of the edge, in m.
    arm: [f64; 2],
}

impl Edge {
    /// Returns a straight edge `name` from `start` to `end`, in m.
    #[must_use]
    pub fn line(name: impl Into<String>, start: [f64; 2], end: [f64; 2]) -> Self {
        Self { name: name.into(), start, end, curve: Curve::Line, hem: 0.0, notches: Vec::new() }
    }

    /// Returns the edge with `curve` in place of its curve.
    #[must_use]
    pub fn curved(mut self, curve: Curve) -> Self {
        self.curve = curve;
        self
    }

    /// Returns the edge with a hem of `width`, in m.
    #[must_use]
    pub fn hemmed(mut self, width: f64) -> Self {
        self.hem = width;
        self
    }

    /// Returns the angle, in rad, of an arc with `radius`, in m, between the ends of the edge.
    ///
    /// `large` chooses the longer arc, `left` the arc that runs anticlockwise. A radius under half
    /// the distance of the ends counts as half that distance, as in SVG.
    #[must_use]
    pub fn arc_sweep(&self, radius: f64, large: bool, left: bool) -> f64 {
        let half = (0.5 * distance(self.start, self.end) / radius.abs()).min(1.0).asin();
        let angle = if large { 2.0 * (std::f64::consts::PI - half) } else { 2.0 * half };
        if left { angle } else { -angle }
    }

    /// Returns whether all numbers are finite and the angle of an [`Curve::Arc`] is less than a
    /// full turn.
    pub(crate) fn is_finite(&self) -> bool {
        let is_curve_finite = match &self.curve {
            Curve::Line => true,
            Curve::Quadratic(control) => is_finite(control),
            Curve::Cubic(controls) => controls.iter().all(is_finite),
            Curve::Arc { sweep } => sweep.abs() < std::f64::consts::TAU,
        };
        is_finite(&self.start) && is_finite(&self.end) && is_curve_finite
    }

    /// Returns the coordinates of both ends and of the control points, each x before its y.
    pub(crate) fn coordinates(&self) -> impl Iterator<Item = f64> {
        let controls = match self.curve {
            Curve::Quadratic(control) => [control, control],
            Curve::Cubic(controls) => controls,
            Curve::Line | Curve::Arc { .. } => [self.start, self.end],
        };
        [self.start, self.end, controls[0], controls[1]].into_iter().flatten()
    }

    /// Returns the edge in the opposite direction: from `end` to `start`.
    pub(crate) fn reversed(&self) -> Self {
        let curve = match self.curve {
            Curve::Cubic([first, second]) => Curve::Cubic([second, first]),
            Curve::Arc { sweep } => Curve::Arc { sweep: -sweep },
            curve => curve,
        };
        let length = if self.notches.is_empty() { 0.0 } else { self.length() };
        let notches = self.notches.iter().rev().map(|at| length - at).collect();
        let (start, end) = (self.end, self.start);
        Self { name: self.name.clone(), start, end, curve, hem: self.hem, notches }
    }

    /// Returns the edge with its points mapped by the isometry `map`, a reflection if `reflects`.
    pub(crate) fn mapped(&self, reflects: bool, map: impl Fn([f64; 2]) -> [f64; 2]) -> Self {
        let curve = match self.curve {
            Curve::Line => Curve::Line,
            Curve::Quadratic(control) => Curve::Quadratic(map(control)),
            Curve::Cubic(controls) => Curve::Cubic(controls.map(&map)),
            Curve::Arc { sweep } => Curve::Arc { sweep: if reflects { -sweep } else { sweep } },
        };
        let (start, end) = (map(self.start), map(self.end));
        let (name, notches) = (self.name.clone(), self.notches.clone());
        Self { name, start, end, curve, hem: self.hem, notches }
    }

    /// Returns the parts of the edge between `distances` from its start, in m. The name of a part
    /// is the name of the edge with a number.
    ///
    /// `distances` must lie within the edge, in ascending order.
    pub(crate) fn split(&self, distances: &[f64]) -> Vec<Self> {
        let length = self.length();
        let mut ends = vec![0.0];
        ends.extend(distances);
        ends.push(length);
        ends.windows(2)
            .enumerate()
            .map(|(number, pair)| {
                let name = format!("{} {}", self.name, number + 1);
                self.part(name, [pair[0], pair[1]], length)
            })
            .collect()
    }

    /// Returns the part `name` of the edge between two distances from its start, in m. `length` is
    /// the length of the edge, in m.
    fn part(&self, name: String, [from, to]: [f64; 2], length: f64) -> Self {
        let begin = self.parameter_at(from, length);
        let end = if to < length { self.parameter_at(to, length) } else { 1.0 };
        let curve = match (self.curve, self.segment().subsegment(begin..end)) {
            (Curve::Arc { sweep }, _) => Curve::Arc { sweep: (end - begin) * sweep },
            (_, PathSeg::Line(_)) => Curve::Line,
            (_, PathSeg::Quad(quad)) => Curve::Quadratic([quad.p1.x, quad.p1.y]),
            (_, PathSeg::Cubic(cubic)) => {
                Curve::Cubic([cubic.p1, cubic.p2].map(|control| [control.x, control.y]))
            }
        };

        let notches = self.notches.iter().filter(|at| from < **at && **at <= to);
        Self {
            name,
            start: self.at_parameter(begin),
            end: self.at_parameter(end),
            curve,
            hem: self.hem,
            notches: notches.map(|at| at - from).collect(),
        }
    }

    /// Returns the parameter of the curve at `distance` from the start, in m. `length` is the
    /// length of the edge, in m.
    fn parameter_at(&self, distance: f64, length: f64) -> f64 {
        match self.curve {
            Curve::Line | Curve::Arc { .. } => distance / length,
            _ => self.segment().inv_arclen(distance, ACCURACY * self.size()),
        }
    }

    /// Returns the nearest point of the edge to `point`, as its distance along the edge, and its
    /// distance from `point`, in m. The result is as exact as chords of a thousandth of the edge.
    pub(crate) fn nearest(&self, point: [f64; 2]) -> [f64; 2] {
        const CHORDS: u32 = 1000;
        let length = self.length();
        let points: Vec<[f64; 2]> =
            (0..=CHORDS).map(|k| self.at_parameter(f64::from(k) / f64::from(CHORDS))).collect();

        let (mut along, mut best) = (0.0, [0.0, f64::INFINITY]);
        for pair in points.windows(2) {
            let chord = difference(pair[1], pair[0]);
            let size = distance(pair[0], pair[1]).max(f64::MIN_POSITIVE);
            let arm = difference(point, pair[0]);
            let t = ((arm[0] * chord[0] + arm[1] * chord[1]) / (size * size)).clamp(0.0, 1.0);
            let foot = [pair[0][0] + t * chord[0], pair[0][1] + t * chord[1]];
            let gap = distance(foot, point);
            if gap < best[1] {
                best = [along + t * size, gap];
            }
            along += size;
        }
        [best[0].min(length), best[1]]
    }

    /// Returns the circle of an arc with the angle `sweep`, in rad, between the ends of the edge.
    fn circle(&self, sweep: f64) -> Circle {
        // The centre lies on the perpendicular bisector, to the left of an edge that turns left.
        let chord = difference(self.end, self.start);
        let rise = 0.5 / (0.5 * sweep).tan();
        let center = [
            0.5 * (self.start[0] + self.end[0]) - rise * chord[1],
            0.5 * (self.start[1] + self.end[1]) + rise * chord[0],
        ];
        Circle { center, arm: difference(self.start, center) }
    }

    /// Returns the edge as a segment of kurbo. An arc becomes its chord.
    fn segment(&self) -> PathSeg {
        let [start, end] = [self.start, self.end].map(kurbo_point);
        match self.curve {
            Curve::Line | Curve::Arc { .. } => PathSeg::Line(Line::new(start, end)),
            Curve::Quadratic(control) => {
                PathSeg::Quad(QuadBez::new(start, kurbo_point(control), end))
            }
            Curve::Cubic(controls) => {
                let [first, second] = controls.map(kurbo_point);
                PathSeg::Cubic(CubicBez::new(start, first, second, end))
            }
        }
    }

    /// Length along the edge, in m.
    #[must_use]
    pub fn length(&self) -> f64 {
        match self.curve {
            Curve::Line => distance(self.start, self.end),
            Curve::Arc { sweep } if sweep != 0.0 => {
                let [x, y] = self.circle(sweep).arm;
                x.hypot(y) * sweep.abs()
            }
            Curve::Arc { .. } => distance(self.start, self.end),
            _ => self.segment().arclen(ACCURACY * self.size()),
        }
    }

    /// Returns the point at `fraction` of the length, from 0 at the start to 1 at the end, in m.
    #[must_use]
    pub fn at(&self, fraction: f64) -> [f64; 2] {
        match (fraction, self.curve) {
            (..=0.0, _) => self.start,
            (1.0.., _) => self.end,
            (_, Curve::Line | Curve::Arc { .. }) => self.at_parameter(fraction),
            _ => {
                let (segment, accuracy) = (self.segment(), ACCURACY * self.size());
                let length = segment.arclen(accuracy);
                let parameter = segment.inv_arclen(fraction * length, accuracy);
                self.at_parameter(parameter)
            }
        }
    }

    /// Returns the point at parameter `t` of the curve, from 0 at the start to 1 at the end, in m.
    fn at_parameter(&self, t: f64) -> [f64; 2] {
        match self.curve {
            Curve::Arc { sweep } if sweep != 0.0 => {
                let Circle { center, arm } = self.circle(sweep);
                let (sine, cosine) = (t * sweep).sin_cos();
                [
                    center[0] + cosine * arm[0] - sine * arm[1],
                    center[1] + sine * arm[0] + cosine * arm[1],
                ]
            }
            _ => {
                let point = self.segment().eval(t);
                [point.x, point.y]
            }
        }
    }

    /// Returns points on the edge from its start up to, but not including, its end.
    ///
    /// The chords between them deviate from the curve by at most a few thousandths of its size.
    pub(crate) fn polyline(&self) -> Vec<[f64; 2]> {
        let chords = match self.curve {
            Curve::Line => 1,
            _ => 32,
        };
        (0..chords).map(|k| self.at_parameter(f64::from(k) / f64::from(chords))).collect()
    }

    /// Returns tangent vectors at the start and at the end. Their lengths have no meaning.
    pub(crate) fn tangents(&self) -> [[f64; 2]; 2] {
        if let Curve::Arc { sweep } = self.curve
            && sweep != 0.0
        {
            let chord = difference(self.end, self.start);
            let (sine, cosine) = (0.5 * sweep).sin_cos();
            return [-1.0, 1.0].map(|sense| {
                let sine = sense * sine;
                [cosine * chord[0] - sine * chord[1], sine * chord[0] + cosine * chord[1]]
            });
        }
        // Towards the first control point that differs from the end.
        let controls = match self.curve {
            Curve::Quadratic(control) => [control, control],
            Curve::Cubic(controls) => controls,
            Curve::Line | Curve::Arc { .. } => [self.end, self.start],
        };
        let near = 1e-9 * self.size();
        let start = direction(self.start, [controls[0], controls[1], self.end], near);
        let end = direction(self.end, [controls[1], controls[0], self.start], near);
        [start, end.map(|x| -x)]
    }

    /// Returns the signed area between the edge and the origin, positive if it runs anticlockwise,
    /// in m².
    pub(crate) fn area(&self) -> f64 {
        let bulge = match self.curve {
            Curve::Arc { sweep } if sweep != 0.0 => {
                let [x, y] = self.circle(sweep).arm;
                0.5 * (x * x + y * y) * (sweep - sweep.sin())
            }
            _ => 0.0,
        };
        self.segment().signed_area() + bulge
    }

    /// Returns the largest distance of a coordinate from the start, in m: a scale for tolerances.
    fn size(&self) -> f64 {
        let (x, y) = (self.start[0], self.start[1]);
        let offsets =
            self.coordinates().enumerate().map(|(k, c)| (c - if k % 2 == 0 { x } else { y }).abs());
        offsets.fold(f64::MIN_POSITIVE, f64::max)
    }
}

/// Returns whether both coordinates of `point` are finite.
fn is_finite(point: &[f64; 2]) -> bool {
    point[0].is_finite() && point[1].is_finite()
}

/// Returns the vector from `from` to the first of `points` that is farther away than `near`, in m;
/// to the last one if all are near.
fn direction(from: [f64; 2], points: [[f64; 2]; 3], near: f64) -> [f64; 2] {
    let target = points.into_iter().find(|&p| distance(p, from) > near);
    difference(target.unwrap_or(points[2]), from)
}

/// Returns the cross product of the vectors `a` and `b`.
pub(crate) fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Returns the dot product of the vectors `a` and `b`.
pub(crate) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Returns the angle by which the direction `from` must be turned to become the direction `to`, in
/// rad, positive if anticlockwise.
pub(crate) fn turning_angle(from: [f64; 2], to: [f64; 2]) -> f64 {
    cross(from, to).atan2(dot(from, to))
}

/// Returns the low and the high corner of the bounding box of the ends and control points of
/// `edges`.
pub(crate) fn control_box<'e>(edges: impl IntoIterator<Item = &'e Edge>) -> [[f64; 2]; 2] {
    let (mut low, mut high) = ([f64::MAX; 2], [f64::MIN; 2]);
    for edge in edges {
        for (k, coordinate) in edge.coordinates().enumerate() {
            low[k % 2] = low[k % 2].min(coordinate);
            high[k % 2] = high[k % 2].max(coordinate);
        }
    }
    [low, high]
}

/// Returns the larger side of the bounding box of the ends and control points of `edges`; 0 if
/// there are no edges.
pub(crate) fn control_extent<'e>(edges: impl IntoIterator<Item = &'e Edge>) -> f64 {
    let mut edges = edges.into_iter().peekable();
    if edges.peek().is_none() {
        return 0.0;
    }
    let [low, high] = control_box(edges);
    (high[0] - low[0]).max(high[1] - low[1])
}

/// Returns a point as kurbo represents it.
fn kurbo_point([x, y]: [f64; 2]) -> Point {
    Point::new(x, y)
}

/// Returns the vector `a - b`.
pub(crate) fn difference(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// Returns the distance of `point` from the segment from `from` to `to`, in m.
pub(crate) fn distance_from_segment(point: [f64; 2], [from, to]: [[f64; 2]; 2]) -> f64 {
    let (chord, arm) = (difference(to, from), difference(point, from));
    let square = (chord[0] * chord[0] + chord[1] * chord[1]).max(f64::MIN_POSITIVE);
    let t = ((arm[0] * chord[0] + arm[1] * chord[1]) / square).clamp(0.0, 1.0);
    distance(point, [from[0] + t * chord[0], from[1] + t * chord[1]])
}

/// Returns the distance between `a` and `b`.
pub(crate) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn edge(curve: Curve) -> Edge {
        Edge::line("e", [1.0, 0.0], [0.0, 1.0]).curved(curve)
    }

    /// Length and area of the chords between many points, extrapolated to the limit (Richardson).
    fn by_chords(edge: &Edge) -> (f64, f64) {
        let sums = |n: u32| {
            let points: Vec<_> =
                (0..=n).map(|k| edge.at_parameter(f64::from(k) / f64::from(n))).collect();
            let length: f64 = points.windows(2).map(|p| distance(p[0], p[1])).sum();
            let area: f64 =
                points.windows(2).map(|p| 0.5 * (p[0][0] * p[1][1] - p[1][0] * p[0][1])).sum();
            (length, area)
        };
        let (coarse, fine) = (sums(1000), sums(2000));
        (fine.0 + (fine.0 - coarse.0) / 3.0, fine.1 + (fine.1 - coarse.1) / 3.0)
    }

    #[test]
    fn lengths_and_areas_are_those_of_fine_chords() {
        let curves = [
            Curve::Line,
            Curve::Quadratic([1.3, 1.1]),
            Curve::Cubic([[1.5, 0.2], [0.4, -0.3]]),
            Curve::Arc { sweep: FRAC_PI_2 },
            Curve::Arc { sweep: -5.0 },
            Curve::Arc { sweep: 1e-9 },
        ];
        for curve in curves {
            let edge = edge(curve);
            let (length, area) = by_chords(&edge);
            assert!((edge.length() - length).abs() < 1e-8, "{curve:?}: {} {length}", edge.length());
            assert!((edge.area() - area).abs() < 1e-8, "{curve:?}: {} {area}", edge.area());
            let middle = edge.at(0.5);
            assert!((edge.reversed().at(0.5)[0] - middle[0]).abs() < 1e-8, "{curve:?}");
            assert!((edge.reversed().area() + edge.area()).abs() < 1e-12, "{curve:?}");
        }
    }

    #[test]
    fn a_quarter_of_the_unit_circle() {
        let quarter = edge(Curve::Arc { sweep: edge(Curve::Line).arc_sweep(1.0, false, true) });
        assert!((quarter.length() - FRAC_PI_2).abs() < 1e-12);
        assert!((quarter.area() - PI / 4.0).abs() < 1e-12);
        let [x, y] = quarter.at(1.0 / 3.0);
        assert!((x - (PI / 6.0).cos()).abs() < 1e-12 && (y - 0.5).abs() < 1e-12);
        let [start, end] = quarter.tangents();
        assert!(start[0].abs() < 1e-12 && start[1] > 0.0 && end[1].abs() < 1e-12 && end[0] < 0.0);
    }

    #[test]
    fn equal_fractions_are_equal_lengths() {
        // Its radius of curvature is nowhere under 0.1, so a chord is 1e-5 shorter than its arc at
        // most.
        let cubic = edge(Curve::Cubic([[1.4, 0.6], [0.6, 1.4]]));
        let points: Vec<_> = (0..=1000).map(|k| cubic.at(f64::from(k) / 1000.0)).collect();
        let chords: Vec<f64> = points.windows(2).map(|p| distance(p[0], p[1])).collect();
        let expected = cubic.length() / 1000.0;
        let worst = chords.iter().map(|c| (c / expected - 1.0).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-5, "{worst}");
    }

    #[test]
    fn parts_of_edges_of_any_size_end_at_the_distances_asked_for() {
        for size in [1e-6, 1e-3, 1.0, 1e3] {
            let scaled = |p: [f64; 2]| p.map(|x| size * x);
            for curve in [
                Curve::Line,
                Curve::Quadratic([1.3, 1.1]),
                Curve::Cubic([[1.5, 0.2], [0.4, -0.3]]),
                Curve::Arc { sweep: -5.0 },
            ] {
                let edge = edge(curve).mapped(false, scaled);
                let length = edge.length();
                let parts = edge.split(&[0.2 * length, 0.7 * length]);
                for (part, share) in parts.iter().zip([0.2, 0.5, 0.3]) {
                    let off = part.length() / (share * length) - 1.0;
                    assert!(off.abs() < 1e-7, "{curve:?} of {size} m: {off}");
                }
                assert!(parts.len() == 3 && distance(parts[2].end, edge.end) < 1e-12 * size);
            }
        }
    }
}
