use kurbo::{
    CubicBez, Line, ParamCurve, ParamCurveArclen, ParamCurveArea, PathSeg, Point, QuadBez,
};

/// Share of an edge's length to which lengths along it are found.
const ACCURACY: f64 = 1e-9;

/// How an edge goes from its start to its end. Points are in m, in the panel's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Curve {
    /// Straight.
    Line,
    /// A Bézier curve of degree two, with its control point.
    Quadratic([f64; 2]),
    /// A Bézier curve of degree three, with its two control points.
    Cubic([[f64; 2]; 2]),
    /// A part of a circle.
    Arc {
        /// Angle that it turns through, anticlockwise, between −2π and 2π, in rad.
        sweep: f64,
    },
}

/// One edge of an outline.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge {
    /// Its name, or its number where the file gives it none.
    pub name: String,
    /// Where it begins, in m.
    pub start: [f64; 2],
    /// Where it ends, in m.
    pub end: [f64; 2],
    /// How it goes.
    pub curve: Curve,
    /// Width of the hem along it, in m; 0 without.
    pub hem: f64,
}

/// The circle that an edge follows.
struct Circle {
    center: [f64; 2],
    /// From the centre to the start of the edge.
    arm: [f64; 2],
}

impl Edge {
    /// A straight edge.
    pub fn line(name: impl Into<String>, start: [f64; 2], end: [f64; 2]) -> Self {
        Self { name: name.into(), start, end, curve: Curve::Line, hem: 0.0 }
    }

    /// The same edge as another curve.
    #[must_use]
    pub fn curved(mut self, curve: Curve) -> Self {
        self.curve = curve;
        self
    }

    /// The same edge with a hem, whose width is in m.
    #[must_use]
    pub fn hemmed(mut self, width: f64) -> Self {
        self.hem = width;
        self
    }

    /// The angle that a part of a circle of a radius turns through between two points.
    ///
    /// `large` chooses the longer way round, `left` the one that turns anticlockwise. A radius under half
    /// the distance is taken as half of it, as in SVG.
    #[must_use]
    pub fn sweep(&self, radius: f64, large: bool, left: bool) -> f64 {
        let half = (0.5 * distance(self.start, self.end) / radius.abs()).min(1.0).asin();
        let angle = if large { 2.0 * (std::f64::consts::PI - half) } else { 2.0 * half };
        if left { angle } else { -angle }
    }

    /// Whether all its numbers are finite, and an arc's angle less than a full turn.
    pub(crate) fn is_finite(&self) -> bool {
        let finite = |p: &[f64; 2]| p[0].is_finite() && p[1].is_finite();
        let curve = match &self.curve {
            Curve::Line => true,
            Curve::Quadratic(control) => finite(control),
            Curve::Cubic(controls) => controls.iter().all(finite),
            Curve::Arc { sweep } => sweep.abs() < std::f64::consts::TAU,
        };
        finite(&self.start) && finite(&self.end) && curve
    }

    /// The numbers that place it.
    pub(crate) fn coordinates(&self) -> impl Iterator<Item = f64> {
        let controls = match self.curve {
            Curve::Quadratic(control) => [control, control],
            Curve::Cubic(controls) => controls,
            Curve::Line | Curve::Arc { .. } => [self.start, self.end],
        };
        [self.start, self.end, controls[0], controls[1]].into_iter().flatten()
    }

    /// The same edge run from its end.
    pub(crate) fn reversed(&self) -> Self {
        let curve = match self.curve {
            Curve::Cubic([first, second]) => Curve::Cubic([second, first]),
            Curve::Arc { sweep } => Curve::Arc { sweep: -sweep },
            curve => curve,
        };
        Self { name: self.name.clone(), start: self.end, end: self.start, curve, hem: self.hem }
    }

    /// The edge with its points moved by a map that keeps angles, or turns them round if `mirrors`.
    pub(crate) fn moved(&self, mirrors: bool, map: impl Fn([f64; 2]) -> [f64; 2]) -> Self {
        let curve = match self.curve {
            Curve::Line => Curve::Line,
            Curve::Quadratic(control) => Curve::Quadratic(map(control)),
            Curve::Cubic(controls) => Curve::Cubic(controls.map(&map)),
            Curve::Arc { sweep } => Curve::Arc { sweep: if mirrors { -sweep } else { sweep } },
        };
        let (start, end) = (map(self.start), map(self.end));
        Self { name: self.name.clone(), start, end, curve, hem: self.hem }
    }

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

    fn segment(&self) -> PathSeg {
        let point = |p: [f64; 2]| Point::new(p[0], p[1]);
        let (start, end) = (point(self.start), point(self.end));
        match self.curve {
            Curve::Line | Curve::Arc { .. } => PathSeg::Line(Line::new(start, end)),
            Curve::Quadratic(control) => PathSeg::Quad(QuadBez::new(start, point(control), end)),
            Curve::Cubic([first, second]) => {
                PathSeg::Cubic(CubicBez::new(start, point(first), point(second), end))
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
            _ => self.segment().arclen(ACCURACY * self.reach()),
        }
    }

    /// The point at a share of the length, from 0 at the start to 1 at the end, in m.
    #[must_use]
    pub fn at(&self, share: f64) -> [f64; 2] {
        match (share, self.curve) {
            (..=0.0, _) => self.start,
            (1.0.., _) => self.end,
            (_, Curve::Line | Curve::Arc { .. }) => self.at_parameter(share),
            _ => {
                let (segment, accuracy) = (self.segment(), ACCURACY * self.reach());
                let length = segment.arclen(accuracy);
                let parameter = segment.inv_arclen(share * length, accuracy);
                self.at_parameter(parameter)
            }
        }
    }

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

    /// Points on the edge from its start to its end without it, so close that the chords between them are
    /// within a few thousandths of the edge's extent of the curve.
    pub(crate) fn polyline(&self) -> Vec<[f64; 2]> {
        let chords = match self.curve {
            Curve::Line => 1,
            _ => 32,
        };
        (0..chords).map(|k| self.at_parameter(f64::from(k) / f64::from(chords))).collect()
    }

    /// The directions in which the edge begins and ends, of any length.
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
        // Towards the first point that is not the end itself.
        let controls = match self.curve {
            Curve::Quadratic(control) => [control, control],
            Curve::Cubic(controls) => controls,
            Curve::Line | Curve::Arc { .. } => [self.end, self.start],
        };
        let near = 1e-9 * self.reach();
        let towards = |from: [f64; 2], points: [[f64; 2]; 3]| {
            let point = points.into_iter().find(|&p| distance(p, from) > near);
            difference(point.unwrap_or(points[2]), from)
        };
        let start = towards(self.start, [controls[0], controls[1], self.end]);
        let end = towards(self.end, [controls[1], controls[0], self.start]);
        [start, end.map(|x| -x)]
    }

    /// Area between the edge and the origin, positive if run anticlockwise, in m².
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

    /// A length of the order of the edge's own.
    fn reach(&self) -> f64 {
        let all = self.coordinates();
        let (x, y) = (self.start[0], self.start[1]);
        let far = all.enumerate().map(|(k, c)| (c - if k % 2 == 0 { x } else { y }).abs());
        far.fold(f64::MIN_POSITIVE, f64::max)
    }
}

pub(crate) fn difference(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

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

    /// Length and area of the chords between many points, Richardson's way to the limit.
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
        let quarter = edge(Curve::Arc { sweep: edge(Curve::Line).sweep(1.0, false, true) });
        assert!((quarter.length() - FRAC_PI_2).abs() < 1e-12);
        assert!((quarter.area() - PI / 4.0).abs() < 1e-12);
        let [x, y] = quarter.at(1.0 / 3.0);
        assert!((x - (PI / 6.0).cos()).abs() < 1e-12 && (y - 0.5).abs() < 1e-12);
        let [start, end] = quarter.tangents();
        assert!(start[0].abs() < 1e-12 && start[1] > 0.0 && end[1].abs() < 1e-12 && end[0] < 0.0);
    }

    #[test]
    fn equal_shares_are_equal_lengths() {
        // Its radius of curvature is nowhere under 0.1, so a chord is 1e-5 shorter than its arc at most.
        let cubic = edge(Curve::Cubic([[1.4, 0.6], [0.6, 1.4]]));
        let points: Vec<_> = (0..=1000).map(|k| cubic.at(f64::from(k) / 1000.0)).collect();
        let chords: Vec<f64> = points.windows(2).map(|p| distance(p[0], p[1])).collect();
        let expected = cubic.length() / 1000.0;
        let worst = chords.iter().map(|c| (c / expected - 1.0).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-5, "{worst}");
    }
}
