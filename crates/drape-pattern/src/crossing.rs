use robust::{Coord, orient2d};

/// The sign of the area of the triangle `a b c`, exactly.
pub(crate) fn orientation(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let coord = |p: [f64; 2]| Coord { x: p[0], y: p[1] };
    orient2d(coord(a), coord(b), coord(c))
}

fn within(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> bool {
    (0..2).all(|k| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k]))
}

/// Whether two segments have a point in common.
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

/// Two sides of a closed polygon that meet elsewhere than at a common corner, by the numbers of their first
/// corners, or a side and its successor that runs back over it. Exact; all coordinates are finite.
pub(crate) fn crossing(polygon: &[[f64; 2]]) -> Option<[usize; 2]> {
    let n = polygon.len();
    let side = |k: usize| [polygon[k], polygon[(k + 1) % n]];
    let low = |k: usize| side(k)[0][0].min(side(k)[1][0]);
    let high = |k: usize| side(k)[0][0].max(side(k)[1][0]);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| low(a).total_cmp(&low(b)).then(a.cmp(&b)));
    // Sides that a sweep from left to right still meets.
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

/// Whether the side after side `k` runs back over it.
fn folds_back(polygon: &[[f64; 2]], k: usize) -> bool {
    let n = polygon.len();
    let (a, b, c) = (polygon[k], polygon[(k + 1) % n], polygon[(k + 2) % n]);
    let forward = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]);
    n < 3 || a == b || b == c || (orientation(a, b, c) == 0.0 && forward < 0.0)
}

#[cfg(test)]
mod tests {
    use super::crossing;

    #[test]
    fn what_crosses_or_touches_is_found_and_what_does_not_is_not() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        assert_eq!(crossing(&square), None);
        let bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(crossing(&bow), Some([0, 2]));
        let spike = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(crossing(&spike).is_some());
        let pinched = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(crossing(&pinched).is_some(), "a corner on another");
        let straight = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
        assert_eq!(crossing(&straight), None);
        let line = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.0]];
        assert!(crossing(&line).is_some());
    }
}
