//! Grain line of a panel: a line along the warp, clear of the outline.

use crate::edge::{cross, difference, distance};
use crate::polygon::{contains, range};

/// Ratio of the length of the line to the room for it.
const SHARE: f64 = 0.8;

/// Largest half length of the line, in mm.
const LONGEST: f64 = 120.0;

/// Grain line in a polygon, in mm.
pub(crate) struct GrainLine {
    /// Middle of the line, a point far from the sides of the polygon.
    pub(crate) middle: [f64; 2],
    /// Distance of `middle` from the nearest side of the polygon.
    pub(crate) clearance: f64,
    /// Ends of the line. The warp points from the first end to the second.
    pub(crate) ends: [[f64; 2]; 2],
}

impl GrainLine {
    /// Returns the grain line in `polygon` with the direction `along`, a unit vector.
    pub(crate) fn new(polygon: &[[f64; 2]], along: [f64; 2]) -> Self {
        let (middle, clearance) = inner_point(polygon);
        // The line ends clear of the outline.
        let room = [-1.0, 1.0].map(|s| ray(polygon, middle, along.map(|x| s * x)));
        let half = (SHARE * room[0].min(room[1])).min(LONGEST);
        let ends =
            [-1.0, 1.0].map(|s| [middle[0] + s * half * along[0], middle[1] + s * half * along[1]]);
        Self { middle, clearance, ends }
    }
}

/// Returns a point of `polygon` far from its sides, and its distance from the nearest side.
fn inner_point(polygon: &[[f64; 2]]) -> ([f64; 2], f64) {
    const STEPS: u32 = 24;
    let [[left, right], [top, bottom]] = [0, 1].map(|axis| range(polygon.iter().map(|p| p[axis])));
    let grid = (0..STEPS * STEPS).map(|k| {
        let [x, y] = [k % STEPS, k / STEPS].map(|k| (f64::from(k) + 0.5) / f64::from(STEPS));
        [left + x * (right - left), top + y * (bottom - top)]
    });
    let inside = grid.filter(|&p| contains(polygon, p));
    let clear = inside.map(|p| (p, clearance(polygon, p)));
    let middle = [0.5 * (left + right), 0.5 * (top + bottom)];
    clear.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((middle, 0.0))
}

/// Returns the sides of `polygon`.
fn sides(polygon: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
    polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1))
}

/// Returns the distance of `p` from the nearest side of `polygon`.
fn clearance(polygon: &[[f64; 2]], p: [f64; 2]) -> f64 {
    let distances = sides(polygon).map(|(a, b)| {
        let (side, arm) = (difference(b, a), difference(p, a));
        let square = side[0] * side[0] + side[1] * side[1];
        let t =
            ((arm[0] * side[0] + arm[1] * side[1]) / square.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        distance(p, [a[0] + t * side[0], a[1] + t * side[1]])
    });
    distances.fold(f64::MAX, f64::min)
}

/// Returns the distance from `p` in the direction `along` to the first side of `polygon`; 0 if
/// there is none.
fn ray(polygon: &[[f64; 2]], p: [f64; 2], along: [f64; 2]) -> f64 {
    let crossed = sides(polygon).filter_map(|(a, b)| {
        let (side, arm) = (difference(b, a), difference(a, p));
        let det = cross(along, side);
        let (t, s) = (cross(arm, side) / det, cross(arm, along) / det);
        (t > 0.0 && (0.0..=1.0).contains(&s)).then_some(t)
    });
    let first = crossed.fold(f64::MAX, f64::min);
    if first < f64::MAX { first } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangle with sides of 300, 400 and 500 mm; the circle in it has a radius of 100 mm.
    const TRIANGLE: [[f64; 2]; 3] = [[50.0, 20.0], [450.0, 20.0], [50.0, 320.0]];

    #[test]
    fn the_inner_point_is_near_the_centre_of_the_largest_circle_inside() {
        let (point, clear) = inner_point(&TRIANGLE);
        // The points that are tried are up to 17 mm apart.
        assert!(distance(point, [150.0, 120.0]) < 17.0, "{point:?}");
        assert!(clear > 85.0 && clear <= 100.0, "{clear}");
        let rectangle = [[50.0, 20.0], [450.0, 20.0], [450.0, 120.0], [50.0, 120.0]];
        let (point, clear) = inner_point(&rectangle);
        assert!((point[1] - 70.0).abs() < 5.0 && clear > 45.0 && clear <= 50.0, "{point:?}");
    }

    #[test]
    fn the_clearance_of_a_point_is_its_distance_from_the_nearest_side_or_corner() {
        for (point, expected) in [
            ([150.0, 120.0], 100.0),
            ([57.0, 120.0], 7.0),
            ([150.0, 23.0], 3.0),
            // 3x + 4y = 1200 from the right angle, at (180, 140) and at (240, 95).
            ([230.0, 160.0], 20.0),
            ([290.0, 115.0], 20.0),
            ([20.0, -20.0], 50.0),
        ] {
            let measured = clearance(&TRIANGLE, point);
            assert!((measured - expected).abs() < 1e-9, "{point:?}: {measured}");
        }
    }
}
