//! Exact tests of closed polygons: orientation and self-intersection.
//!
//! `panel` tests outlines with it, `cut` the sampled ones.

use robust::{Coord, orient2d};

/// Returns a number whose sign is exactly the sign of the area of the triangle `a b c`.
pub(crate) fn orientation(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let [a, b, c] = [a, b, c].map(|[x, y]| Coord { x, y });
    orient2d(a, b, c)
}

/// Returns the smallest and the largest of `values`.
pub(crate) fn range(values: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    [values.clone().fold(f64::MAX, f64::min), values.fold(f64::MIN, f64::max)]
}

/// Returns whether `p`, a point on the line through `a` and `b`, lies between them.
fn within(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> bool {
    (0..2).all(|k| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k]))
}

/// Returns whether the segments `a` and `b` have a point in common.
fn meet(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> bool {
    let (a0, a1) = (orientation(b[0], b[1], a[0]), orientation(b[0], b[1], a[1]));
    let (b0, b1) = (orientation(a[0], a[1], b[0]), orientation(a[0], a[1], b[1]));
    (opposite_signs(a0, a1) && opposite_signs(b0, b1))
        || (a0 == 0.0 && within(b[0], b[1], a[0]))
        || (a1 == 0.0 && within(b[0], b[1], a[1]))
        || (b0 == 0.0 && within(a[0], a[1], b[0]))
        || (b1 == 0.0 && within(a[0], a[1], b[1]))
}

/// Returns whether one of `u` and `v` is positive and the other negative.
fn opposite_signs(u: f64, v: f64) -> bool {
    (u > 0.0 && v < 0.0) || (u < 0.0 && v > 0.0)
}

/// Returns the side of the closed polygon `polygon` that begins at corner `k`.
fn side(polygon: &[[f64; 2]], k: usize) -> [[f64; 2]; 2] {
    [polygon[k], polygon[(k + 1) % polygon.len()]]
}

/// Returns a side of the closed polygon `a` and a side of the closed polygon `b` that have a point
/// in common, by the numbers of their first corners; `None` if the polygons are apart.
pub(crate) fn meeting(a: &[[f64; 2]], b: &[[f64; 2]]) -> Option<[usize; 2]> {
    let mut pairs = (0..b.len()).flat_map(|l| (0..a.len()).map(move |k| [k, l]));
    pairs.find(|&[k, l]| {
        let (p, q) = (side(a, k), side(b, l));
        // The exact test is costly, the test of the bounding boxes is not.
        let boxes_overlap = (0..2).all(|axis| {
            p[0][axis].min(p[1][axis]) <= q[0][axis].max(q[1][axis])
                && q[0][axis].min(q[1][axis]) <= p[0][axis].max(p[1][axis])
        });
        boxes_overlap && meet(p, q)
    })
}

/// Returns the approximate point where the segments `a` and `b` meet.
pub(crate) fn meeting_point(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> [f64; 2] {
    let [u, v, w] = [a, b, [a[0], b[0]]].map(|[from, to]| [to[0] - from[0], to[1] - from[1]]);
    let t = (w[0] * v[1] - w[1] * v[0]) / (u[0] * v[1] - u[1] * v[0]);
    if (0.0..=1.0).contains(&t) { [0, 1].map(|k| a[0][k] + t * u[k]) } else { b[0] }
}

/// Returns whether the point `p` lies in the closed polygon `polygon`.
pub(crate) fn contains(polygon: &[[f64; 2]], p: [f64; 2]) -> bool {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    // A ray from the point to the right crosses the border an odd number of times.
    let crossings = sides.filter(|(a, b)| {
        (a[1] > p[1]) != (b[1] > p[1])
            && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    });
    crossings.count() % 2 == 1
}

/// Returns two sides of the closed polygon `polygon` that intersect, by the numbers of their first
/// corners; `None` if the polygon is simple.
///
/// Two sides intersect if they meet elsewhere than at a common corner, or if one runs back over the
/// side before it. The test is exact. All coordinates must be finite.
pub(crate) fn self_intersection(polygon: &[[f64; 2]]) -> Option<[usize; 2]> {
    let n = polygon.len();
    let spans: Vec<[f64; 2]> = (0..n)
        .map(|k| side(polygon, k).map(|[x, _]| x))
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| spans[a][0].total_cmp(&spans[b][0]).then(a.cmp(&b)));

    // A sweep line moves from left to right. Only sides that it meets together can intersect.
    // Sides that a sweep line from left to right still meets.
    let mut open: Vec<usize> = Vec::new();
    for &k in &order {
        open.retain(|&candidate| spans[candidate][1] >= spans[k][0]);
        for &candidate in &open {
            let (first, second) = (k.min(candidate), k.max(candidate));
            let is_next = second == first + 1 || (first == 0 && second == n - 1);
            let intersect = if is_next {
                folds_back(polygon, if second == first + 1 { first } else { second })
            } else {
                meet(side(polygon, first), side(polygon, second))
            };
            if intersect {
                return Some([first, second]);
            }
        }
        open.push(k);
    }
    None
}

/// Returns whether the side of `polygon` after side `k` runs back over side `k`.
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
