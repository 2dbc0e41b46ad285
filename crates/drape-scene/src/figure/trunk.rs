//! Trunk: the horizontal section of a body without its arms.
//!
//! Arms that hang beside the trunk are lines of their own in a section. Where the surface of an arm is
//! one with the trunk's, the section is parted at the narrowest place between them: along the section's
//! longest diameter, the thickness of the trunk falls towards both ends, and an arm is where it rises
//! once more.

use drape_collide::Triangulation;
use drape_collide::section::{SectionPlane, between, convex_hull, perimeter};

/// Area over the largest of a section from which on a line is a part of the trunk. The other leg has 0.9
/// and more, an arm or a hand 0.2 and less.
const LEG_MIN: f64 = 0.3;

/// Area over the largest of a section from which on a line is an arm, not an eye or a fingertip.
const ARM_MIN: f64 = 0.01;

/// Number of places along a section at which its thickness is measured.
const STATIONS: usize = 160;

/// Largest width of an arm over that of the section.
const ARM_WIDTH_MAX: f64 = 0.3;

/// Thickness between an arm and the trunk over that of the arm, at most: thicker places are no joint.
const JOINT_MAX: f64 = 0.85;

/// Straight piece of a section.
type Piece = [[f64; 2]; 2];

/// Horizontal section of a body, as a tape sees it.
#[derive(Debug, Clone)]
pub(crate) struct Trunk {
    /// Hulls of its parts: one, or one for each leg.
    parts: Vec<Vec<[f64; 2]>>,
    /// Hulls of the arms beside it.
    arms: Vec<Vec<[f64; 2]>>,
}

impl Trunk {
    /// Cuts bodies at a height, in m; none where there is nothing.
    pub(crate) fn at(bodies: &[Triangulation], height: f64) -> Option<Self> {
        let plane = SectionPlane::horizontal(height);
        let lines = bodies.iter().flat_map(|body| plane.pieces(body));
        let mut lines: Vec<(f64, Vec<Piece>)> =
            lines.map(|line| (area(&hull_of(&line)), line)).collect();
        lines.sort_by(|a, b| b.0.total_cmp(&a.0));
        let largest = lines.first()?.0;
        if largest <= 0.0 {
            return None;
        }
        let mut trunk = Self { parts: Vec::new(), arms: Vec::new() };
        let is_single = lines.get(1).is_none_or(|(second, _)| *second < LEG_MIN * largest);
        for (area, line) in &lines {
            if *area >= LEG_MIN * largest {
                let (part, arms) =
                    if is_single { without_arms(line) } else { (hull_of(line), Vec::new()) };
                trunk.parts.push(part);
                trunk.arms.extend(arms);
            } else if *area >= ARM_MIN * largest {
                trunk.arms.push(hull_of(line));
            }
        }
        Some(trunk)
    }

    /// Returns the number of its parts: 1, or that of the legs.
    pub(crate) fn part_count(&self) -> usize {
        self.parts.len()
    }

    /// Returns the length of a tape round it, in m.
    pub(crate) fn girth(&self) -> f64 {
        perimeter(&convex_hull(self.points().collect()))
    }

    /// Returns the corners of its hulls, in m.
    pub(crate) fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        self.parts.iter().flatten().copied()
    }

    /// Returns its middle, in m.
    pub(crate) fn middle(&self) -> [f64; 2] {
        middle(&convex_hull(self.points().collect()))
    }

    /// Returns the middles of its parts, in m.
    pub(crate) fn part_middles(&self) -> impl Iterator<Item = [f64; 2]> {
        self.parts.iter().map(|part| middle(part))
    }

    /// Returns the middles of the arms beside it, in m.
    pub(crate) fn arm_middles(&self) -> impl Iterator<Item = [f64; 2]> {
        self.arms.iter().map(|arm| middle(arm))
    }

    /// Returns its extent in a direction, in m.
    pub(crate) fn depth(&self, across: [f64; 2]) -> f64 {
        let [low, high] = extent(self.points(), across);
        high - low
    }

    /// Returns the direction of its longest diameter, of length 1, and its width over its depth.
    pub(crate) fn longest(&self) -> ([f64; 2], f64) {
        let hull = convex_hull(self.points().collect());
        let along = longest(&hull);
        let [width, depth] =
            [along, [-along[1], along[0]]].map(|axis| extent(hull.iter().copied(), axis));
        (along, (width[1] - width[0]) / (depth[1] - depth[0]))
    }
}

fn hull_of(line: &[Piece]) -> Vec<[f64; 2]> {
    convex_hull(line.iter().flatten().copied().collect())
}

/// Returns the area of a convex polygon, in m².
fn area(hull: &[[f64; 2]]) -> f64 {
    let next = hull.iter().cycle().skip(1);
    hull.iter().zip(next).map(|([a, b], [c, d])| 0.5 * (a * d - b * c)).sum::<f64>().abs()
}

/// Returns the middle of the box round a polygon.
fn middle(hull: &[[f64; 2]]) -> [f64; 2] {
    [[1.0, 0.0], [0.0, 1.0]]
        .map(|axis| extent(hull.iter().copied(), axis).iter().sum::<f64>() / 2.0)
}

/// Returns the least and the largest place of points along an axis.
fn extent(points: impl Iterator<Item = [f64; 2]>, axis: [f64; 2]) -> [f64; 2] {
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    points.map(|point| along(point, axis)).fold(none, |[low, high], x| [low.min(x), high.max(x)])
}

/// Returns the place of a point along an axis.
pub(super) fn along([x, y]: [f64; 2], axis: [f64; 2]) -> f64 {
    x * axis[0] + y * axis[1]
}

/// Returns the direction of the longest diameter of a polygon.
fn longest(hull: &[[f64; 2]]) -> [f64; 2] {
    let pairs = hull.iter().enumerate().flat_map(|(k, a)| hull[..k].iter().map(move |b| (a, b)));
    let lengths =
        pairs.map(|(a, b)| ((a[0] - b[0]).hypot(a[1] - b[1]), [a[0] - b[0], a[1] - b[1]]));
    let (length, way) = lengths.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((1.0, [1.0, 0.0]));
    way.map(|x| x / length)
}

/// Returns the hull of a line without the arms that are one with it, and the hulls of these arms.
fn without_arms(line: &[Piece]) -> (Vec<[f64; 2]>, Vec<Vec<[f64; 2]>>) {
    let hull = hull_of(line);
    let axis = longest(&hull);
    let [low, high] = extent(hull.iter().copied(), axis);
    let station = |k: usize| low + (high - low) * (k as f64 + 0.5) / STATIONS as f64;
    let thickness: Vec<f64> = (0..STATIONS).map(|k| thickness(line, axis, station(k))).collect();
    let reversed: Vec<f64> = thickness.iter().rev().copied().collect();
    let first = joint(&thickness).map(station);
    let last = joint(&reversed).map(|k| station(STATIONS - 1 - k));
    let within = |[from, to]: [f64; 2]| {
        let clipped = line.iter().filter_map(|piece| clip(*piece, axis, [from, to]));
        convex_hull(clipped.flatten().collect())
    };
    let ends = [first.unwrap_or(f64::NEG_INFINITY), last.unwrap_or(f64::INFINITY)];
    let arms = [
        first.map(|at| within([f64::NEG_INFINITY, at])),
        last.map(|at| within([at, f64::INFINITY])),
    ];
    (within(ends), arms.into_iter().flatten().collect())
}

/// Returns the thickness of a line across an axis at a place.
fn thickness(line: &[Piece], axis: [f64; 2], at: f64) -> f64 {
    let across = [-axis[1], axis[0]];
    let crossing = |piece: &Piece| {
        let [a, b] = piece.map(|end| along(end, axis) - at);
        ((a < 0.0) != (b < 0.0)).then(|| between(piece[0], piece[1], a / (a - b)))
    };
    let [low, high] = extent(line.iter().filter_map(crossing), across);
    (high - low).max(0.0)
}

/// Returns where an arm ends, by the thicknesses from the end at which it may be.
fn joint(thickness: &[f64]) -> Option<usize> {
    let count = (ARM_WIDTH_MAX * thickness.len() as f64) as usize;
    let least = (1..count).filter(|&k| {
        let arm = thickness[..k].iter().copied().fold(0.0, f64::max);
        let trunk = thickness[k..].iter().copied().fold(0.0, f64::max);
        thickness[k] <= JOINT_MAX * arm && trunk >= arm
    });
    least.min_by(|&a, &b| thickness[a].total_cmp(&thickness[b]))
}

/// Returns the piece between two places along an axis, if there is something of it.
fn clip(piece: Piece, axis: [f64; 2], [from, to]: [f64; 2]) -> Option<Piece> {
    let [a, b] = piece.map(|end| along(end, axis));
    if a.max(b) < from || a.min(b) > to {
        return None;
    }
    let end = |place: f64, point: [f64; 2]| {
        let kept = place.clamp(from, to);
        if kept == place { point } else { between(piece[0], piece[1], (kept - a) / (b - a)) }
    };
    Some([end(a, piece[0]), end(b, piece[1])])
}

#[cfg(test)]
mod tests {
    use super::super::test_bodies::{column, ellipse_perimeter};
    use super::*;

    #[test]
    fn arms_beside_a_trunk_are_left_out() {
        let [trunk, left, right] = [
            column([0.0, 0.0], [0.17, 0.11], [0.0, 1.0]),
            column([0.22, 0.0], [0.04, 0.04], [0.0, 1.0]),
            column([-0.22, 0.0], [0.04, 0.04], [0.0, 1.0]),
        ];
        let alone = Trunk::at(std::slice::from_ref(&trunk), 0.5).expect("a section");
        let exact = ellipse_perimeter([0.17, 0.11]);
        assert!((alone.girth() / exact - 1.0).abs() < 1e-3, "{} for {exact}", alone.girth());
        let beside = Trunk::at(&[left, trunk, right], 0.5).expect("a section");
        assert_eq!(beside.girth(), alone.girth());
        assert_eq!((beside.part_count(), beside.arm_middles().count()), (1, 2));
        let mut places: Vec<f64> = beside.arm_middles().map(|[x, _]| x).collect();
        places.sort_by(f64::total_cmp);
        assert!((places[0] + 0.22).abs() < 1e-9 && (places[1] - 0.22).abs() < 1e-9, "{places:?}");
    }

    /// Outline of a trunk of a width and a depth with arms of a radius whose middles are apart, as one line,
    /// turned by an angle.
    fn fused([width, depth]: [f64; 2], (radius, place): (f64, f64), turn: f64) -> Vec<Piece> {
        let outer = |x: f64| {
            let trunk = depth * (1.0 - (x / width).powi(2)).max(0.0).sqrt();
            let arm = (radius.powi(2) - (x.abs() - place).powi(2)).max(0.0).sqrt();
            trunk.max(arm)
        };
        let end = place + radius;
        let at = |k: usize, sign: f64| {
            let x = end * ((k as f64 / 2000.0) * std::f64::consts::PI).cos();
            let (sin, cos) = f64::sin_cos(turn);
            let z = sign * outer(x);
            [1.0 + cos * x - sin * z, 2.0 + sin * x + cos * z]
        };
        let points: Vec<[f64; 2]> =
            (0..2000).map(|k| at(k, 1.0)).chain((1..=2000).rev().map(|k| at(k, -1.0))).collect();
        points.iter().zip(points.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]).collect()
    }

    #[test]
    fn arms_whose_surface_is_one_with_the_trunks_are_parted_from_it() {
        let exact = ellipse_perimeter([0.17, 0.11]);
        for turn in [0.0, 0.6, 2.0] {
            for place in [0.19, 0.2, 0.205] {
                let line = fused([0.17, 0.11], (0.042, place), turn);
                let (part, arms) = without_arms(&line);
                let girth = perimeter(&part);
                assert_eq!(arms.len(), 2, "{turn} {place}");
                assert!((girth / exact - 1.0).abs() < 0.02, "{girth} for {exact}: {turn} {place}");
            }
            // A trunk without arms keeps all of its width.
            let (part, arms) = without_arms(&fused([0.17, 0.11], (0.0, 0.17), turn));
            assert!(arms.is_empty() && (perimeter(&part) / exact - 1.0).abs() < 1e-4);
        }
    }
}
