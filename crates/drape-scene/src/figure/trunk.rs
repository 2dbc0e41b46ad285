//! Trunk: the horizontal section of a body without its arms.
//!
//! Arms that hang beside the trunk are separate lines in a section. If the surface of an arm and
//! the surface of the trunk are one, the section is cut at the narrowest place between arm and
//! trunk. Along the longest diameter of the section, the thickness of the trunk falls towards both
//! ends. An arm is where the thickness rises again.

use drape_collide::Triangulation;
use drape_collide::section::{SectionPlane, between, convex_hull, perimeter};

/// Least area of a part of the trunk over the largest area in the section. The other leg has 0.9
/// and more, an arm or a hand 0.2 and less.
const LEG_MIN: f64 = 0.3;

/// Least area of an arm over the largest area in the section. An eye or a fingertip has less.
const ARM_MIN: f64 = 0.01;

/// Number of places along a section at which its thickness is measured.
const STATIONS: usize = 160;

/// Largest width of an arm over the width of the section.
const ARM_WIDTH_MAX: f64 = 0.3;

/// Largest thickness of the joint between an arm and the trunk, over the thickness of the arm.
const JOINT_MAX: f64 = 0.85;

/// Straight piece of a section.
type Piece = [[f64; 2]; 2];

/// Horizontal section of a body, as a tape sees it.
#[derive(Debug, Clone)]
pub(crate) struct Trunk {
    /// Hulls of the parts: one for the trunk, or one for each leg.
    parts: Vec<Vec<[f64; 2]>>,
    /// Hulls of the arms beside the trunk.
    arms: Vec<Vec<[f64; 2]>>,
}

impl Trunk {
    /// Returns the section of `bodies` at `height`, in m, or `None` if there is no body.
    pub(crate) fn at(bodies: &[Triangulation], height: f64) -> Option<Self> {
        let plane = SectionPlane::horizontal(height);
        let lines = bodies.iter().flat_map(|body| plane.pieces(body).unwrap_or_default());
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

    /// Returns the number of parts: 1 for a trunk, or the number of legs.
    pub(crate) fn part_count(&self) -> usize {
        self.parts.len()
    }

    /// Returns the length of a tape round the trunk, in m.
    pub(crate) fn girth(&self) -> f64 {
        perimeter(&convex_hull(self.points().collect()))
    }

    /// Returns the corners of the hulls of the parts, in m.
    pub(crate) fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        self.parts.iter().flatten().copied()
    }

    /// Returns the middle of the trunk, in m.
    pub(crate) fn middle(&self) -> [f64; 2] {
        middle(&convex_hull(self.points().collect()))
    }

    /// Returns the middles of the parts, in m.
    pub(crate) fn part_middles(&self) -> impl Iterator<Item = [f64; 2]> {
        self.parts.iter().map(|part| middle(part))
    }

    /// Returns the middles of the arms, in m.
    pub(crate) fn arm_middles(&self) -> impl Iterator<Item = [f64; 2]> {
        self.arms.iter().map(|arm| middle(arm))
    }

    /// Returns the extent of the trunk in the direction `across`, in m.
    pub(crate) fn depth(&self, across: [f64; 2]) -> f64 {
        let [low, high] = extent(self.points(), across);
        high - low
    }

    /// Returns the unit vector along the longest diameter of the trunk, and the ratio of its
    /// extents along and across this vector.
    pub(crate) fn longest(&self) -> ([f64; 2], f64) {
        let hull = convex_hull(self.points().collect());
        let along = longest(&hull);
        let [width, depth] =
            [along, [-along[1], along[0]]].map(|axis| extent(hull.iter().copied(), axis));
        (along, (width[1] - width[0]) / (depth[1] - depth[0]))
    }
}

/// Returns the convex hull of the pieces of `line`.
fn hull_of(line: &[Piece]) -> Vec<[f64; 2]> {
    convex_hull(line.iter().flatten().copied().collect())
}

/// Returns the area of the convex polygon `hull`, in m².
fn area(hull: &[[f64; 2]]) -> f64 {
    let next = hull.iter().cycle().skip(1);
    hull.iter().zip(next).map(|([a, b], [c, d])| 0.5 * (a * d - b * c)).sum::<f64>().abs()
}

/// Returns the middle of the box round the polygon `hull`.
fn middle(hull: &[[f64; 2]]) -> [f64; 2] {
    [[1.0, 0.0], [0.0, 1.0]]
        .map(|axis| extent(hull.iter().copied(), axis).iter().sum::<f64>() / 2.0)
}

/// Returns the least and the largest coordinate of `points` along `axis`.
fn extent(points: impl Iterator<Item = [f64; 2]>, axis: [f64; 2]) -> [f64; 2] {
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    points.map(|point| along(point, axis)).fold(none, |[low, high], x| [low.min(x), high.max(x)])
}

/// Returns the coordinate of the point (`x`, `y`) along `axis`.
pub(super) fn along([x, y]: [f64; 2], axis: [f64; 2]) -> f64 {
    x * axis[0] + y * axis[1]
}

/// Returns the unit vector along the longest diameter of the polygon `hull`.
fn longest(hull: &[[f64; 2]]) -> [f64; 2] {
    let pairs = hull.iter().enumerate().flat_map(|(k, a)| hull[..k].iter().map(move |b| (a, b)));
    let lengths =
        pairs.map(|(a, b)| ((a[0] - b[0]).hypot(a[1] - b[1]), [a[0] - b[0], a[1] - b[1]]));
    let (length, diameter) =
        lengths.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((1.0, [1.0, 0.0]));
    diameter.map(|x| x / length)
}

/// Returns the hull of `line` without the arms whose surface is one with the trunk, and the hulls
/// of these arms.
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

/// Returns the thickness of `line` across `axis` at the coordinate `at` along `axis`, in m.
fn thickness(line: &[Piece], axis: [f64; 2], at: f64) -> f64 {
    let across = [-axis[1], axis[0]];
    let crossing = |piece: &Piece| {
        let [a, b] = piece.map(|end| along(end, axis) - at);
        ((a < 0.0) != (b < 0.0)).then(|| between(piece[0], piece[1], a / (a - b)))
    };
    let [low, high] = extent(line.iter().filter_map(crossing), across);
    (high - low).max(0.0)
}

/// Returns the station at which an arm ends. `thickness` begins at the end of the section at which
/// the arm may be.
fn joint(thickness: &[f64]) -> Option<usize> {
    let count = (ARM_WIDTH_MAX * thickness.len() as f64) as usize;
    let least = (1..count).filter(|&k| {
        let arm = thickness[..k].iter().copied().fold(0.0, f64::max);
        let trunk = thickness[k..].iter().copied().fold(0.0, f64::max);
        thickness[k] <= JOINT_MAX * arm && trunk >= arm
    });
    least.min_by(|&a, &b| thickness[a].total_cmp(&thickness[b]))
}

/// Returns the part of `piece` between the coordinates `from` and `to` along `axis`, or `None` if
/// `piece` lies outside.
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

    /// Returns the outline, as one line, of a trunk of half axes `width` and `depth` with arms of
    /// `radius` at `place` on both sides, turned by `turn`.
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
