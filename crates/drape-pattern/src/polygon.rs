//! Exact tests of closed polygons: orientation and self-intersection.
//!
//! `panel` tests outlines with it, `cut` the sampled ones.

use robust::{Coord, orient2d};

/// Returns a number with the sign of the area of the triangle `a b c`, exactly.
pub(crate) fn orientation(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let coord = |p: [f64; 2]| Coord { x: p[0], y: p[1] };
    orient2d(coord(a), coord(b), coord(c))
}

/// Returns whether a point on the line through two points lies between them.
fn within(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> bool {
    (0..2).all(|k| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k]))
}

/// Returns whether two segments have a point in common.
fn meet(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> bool {
    let (a0, a1) = (orientation(b[0], b[1], a[0]), orientation(b[0], b[1], a[1]));
    let (b0, b1) = (orientation(a[0], a[1], b[0]), orientation(a[0], a[1], b[1]));
    let apart = |u: f64, v: f64| (u > 0.0 && v < 0.0) || (u < 0.0 && v > 0.0);
    (apart(a0, a1) && apart(b0, b1))
        || (a0 == 0.0 && within(b[0], b[1], a[0]))
        || (a1 == 0.0 && within(b[0], b[1], a[1]))
        || (b0 == 0.0 && within(a[0], a[1], b[0]))
        || (b1 == 0.0 && within(a[0], a[1], b[1]))
}

/// Returns a side of one closed polygon and a side of another that have a point in common, by the
/// numbers of their first corners; `None` if the polygons are apart.
pub(crate) fn meeting(one: &[[f64; 2]], other: &[[f64; 2]]) -> Option<[usize; 2]> {
    let side = |polygon: &[[f64; 2]], k: usize| [polygon[k], polygon[(k + 1) % polygon.len()]];
    let all = (0..other.len()).flat_map(|b| (0..one.len()).map(move |a| [a, b]));
    let mut all = all.filter(|&[a, b]| {
        let (p, q) = (side(one, a), side(other, b));
        (0..2).all(|k| {
            p[0][k].min(p[1][k]) <= q[0][k].max(q[1][k])
                && q[0][k].min(q[1][k]) <= p[0][k].max(p[1][k])
        })
    });
    all.find(|&[a, b]| meet(side(one, a), side(other, b)))
}

/// Returns the approximate point where two segments meet.
pub(crate) fn meeting_point(one: [[f64; 2]; 2], other: [[f64; 2]; 2]) -> [f64; 2] {
    let direction = |[from, to]: [[f64; 2]; 2]| [to[0] - from[0], to[1] - from[1]];
    let (u, v, w) = (direction(one), direction(other), direction([one[0], other[0]]));
    let t = (w[0] * v[1] - w[1] * v[0]) / (u[0] * v[1] - u[1] * v[0]);
    if (0.0..=1.0).contains(&t) { [0, 1].map(|k| one[0][k] + t * u[k]) } else { other[0] }
}

/// Returns whether a point lies in a closed polygon.
pub(crate) fn contains(polygon: &[[f64; 2]], p: [f64; 2]) -> bool {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let crosses = |(a, b): &(&[f64; 2], &[f64; 2])| {
        (a[1] > p[1]) != (b[1] > p[1])
            && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    };
    sides.filter(crosses).count() % 2 == 1
}

/// Returns two sides of a closed polygon that intersect, by the numbers of their first corners;
/// `None` if the polygon is simple.
///
/// Two sides intersect if they meet elsewhere than at a common corner, or if one runs back over the
/// side before it. The test is exact; all coordinates must be finite.
pub(crate) fn self_intersection(polygon: &[[f64; 2]]) -> Option<[usize; 2]> {
    let n = polygon.len();
    let side = |k: usize| [polygon[k], polygon[(k + 1) % n]];
    let low = |k: usize| side(k)[0][0].min(side(k)[1][0]);
    let high = |k: usize| side(k)[0][0].max(side(k)[1][0]);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| low(a).total_cmp(&low(b)).then(a.cmp(&b)));
    // Sides that a sweep line from left to right still meets.
    let mut open: Vec<usize> = Vec::new();
    for &k in &order {
        open.retain(|&other| high(other) >= low(k));
        for &other in &open {
            let (first, second) = (k.min(other), k.max(other));
            let next = second == first + 1 || (first == 0 && second == n - 1);
            let met = if next {
                folds_back(polygon, if second == first + 1 { first } else { second })
            } else {
                meet(side(first), side(second))
            };
            if met {
                return Some([first, second]);
            }
        }
        open.push(k);
    }
    None
}

/// Returns whether the side after side `k` runs back over it.
fn folds_back(polygon: &[[f64; 2]], k: usize) -> bool {
    let n = polygon.len();
    let (a, b, c) = (polygon[k], polygon[(k + 1) % n], polygon[(k + 2) % n]);
    let forward = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]);
    n < 3 || a == b || b == c || (orientation(a, b, c) == 0.0 && forward < 0.0)
}

#[cfg(test)]
mod tests {
    use super::self_intersection;

    #[test]
    fn sides_that_cross_or_touch_are_found_and_others_are_not() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        assert_eq!(self_intersection(&square), None);
        let hourglass = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(self_intersection(&hourglass), Some([0, 2]));
        let spike = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(self_intersection(&spike).is_some());
        let pinched = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(self_intersection(&pinched).is_some(), "a corner on another");
        let straight = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
        assert_eq!(self_intersection(&straight), None);
        let line = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.0]];
        assert!(self_intersection(&line).is_some());
    }
}
