//! Distances of points, segments and triangles by plain formulas.
//!
//! Each is the distance of two points that lie on the two figures, so but for rounding it is never less
//! than the true one. `verdict` calls it for pairs that do not intersect.

use crate::triangle::{EDGES, Triangle, joined};

type Point = [f64; 3];

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns the point at a fraction of the segment from `a` to `b`.
fn interpolate(a: Point, b: Point, fraction: f64) -> Point {
    [0, 1, 2].map(|axis| a[axis] + fraction * (b[axis] - a[axis]))
}

/// Closest points of two figures, with the square of their distance in m².
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Closest {
    pub(crate) squared: f64,
    pub(crate) points: [Point; 2],
}

impl Closest {
    const NONE: Closest = Closest { squared: f64::INFINITY, points: [[f64::NAN; 3]; 2] };

    fn of(a: Point, b: Point) -> Closest {
        let difference = minus(a, b);
        Closest { squared: dot(difference, difference), points: [a, b] }
    }

    fn or(self, other: Closest) -> Closest {
        if other.squared < self.squared { other } else { self }
    }

    /// Distance of the two points, in m.
    pub(crate) fn distance(&self) -> f64 {
        self.squared.sqrt()
    }
}

/// Returns the closest points of a point and a segment: the foot of the perpendicular, or an end.
pub(crate) fn point_segment(point: Point, [a, b]: [Point; 2]) -> Closest {
    let along = minus(b, a);
    let fraction = (dot(minus(point, a), along) / dot(along, along)).clamp(0.0, 1.0);
    let fraction = if fraction.is_nan() { 0.0 } else { fraction };
    Closest::of(point, interpolate(a, b, fraction))
}

/// Returns the closest points of a point and a triangle: the foot of the perpendicular where it lies
/// inside, or a point of an edge.
fn point_triangle(point: Point, [a, b, c]: [Point; 3]) -> Closest {
    let mut closest = Closest::NONE;
    for edge in [[a, b], [b, c], [c, a]] {
        closest = closest.or(point_segment(point, edge));
    }
    // The normal equations of |a + u (b - a) + v (c - a) - point|².
    let (e, f, g) = (minus(b, a), minus(c, a), minus(point, a));
    let (ee, ef, ff, eg, fg) = (dot(e, e), dot(e, f), dot(f, f), dot(e, g), dot(f, g));
    let determinant = ee * ff - ef * ef;
    let (u, v) = ((ff * eg - ef * fg) / determinant, (ee * fg - ef * eg) / determinant);
    // Written so that NaN is outside.
    if u >= 0.0 && v >= 0.0 && u + v <= 1.0 {
        let foot = [0, 1, 2].map(|axis| a[axis] + u * e[axis] + v * f[axis]);
        closest = closest.or(Closest::of(point, foot));
    }
    closest
}

/// Returns the closest points of two segments: those of their lines if both lie inside, or an end and
/// a point of the other segment.
fn segment_segment([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Closest {
    let swapped =
        |closest: Closest| Closest { points: [closest.points[1], closest.points[0]], ..closest };
    let mut closest = point_segment(a, [c, d]).or(point_segment(b, [c, d]));
    closest = closest.or(swapped(point_segment(c, [a, b])));
    closest = closest.or(swapped(point_segment(d, [a, b])));
    let (e, f, g) = (minus(b, a), minus(d, c), minus(c, a));
    let (ee, ef, ff, eg, fg) = (dot(e, e), dot(e, f), dot(f, f), dot(e, g), dot(f, g));
    let determinant = ee * ff - ef * ef;
    let (s, t) = ((eg * ff - fg * ef) / determinant, (eg * ef - fg * ee) / determinant);
    let inside = |fraction: f64| (0.0..=1.0).contains(&fraction);
    if inside(s) && inside(t) {
        closest = closest.or(Closest::of(interpolate(a, b, s), interpolate(c, d, t)));
    }
    closest
}

/// Returns the closest points of the corners and edges of each triangle with the features of the other
/// to which they are not joined.
///
/// For triangles that are neither joined nor intersect this is their distance.
pub(crate) fn triangle_distance(one: Triangle, other: Triangle) -> Closest {
    let Triangle { corners: first, vertices: own } = one;
    let Triangle { corners: second, vertices: others } = other;
    let mut closest = Closest::NONE;
    for k in 0..3 {
        if !joined(&own[k..=k], &others) {
            closest = closest.or(point_triangle(first[k], second));
        }
        if !joined(&others[k..=k], &own) {
            closest = closest.or(point_triangle(second[k], first));
        }
    }
    for edge in EDGES {
        for other in EDGES {
            if !joined(&edge.map(|k| own[k]), &other.map(|k| others[k])) {
                let segments = (edge.map(|k| first[k]), other.map(|k| second[k]));
                closest = closest.or(segment_segment(segments.0, segments.1));
            }
        }
    }
    closest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::triangle::Vertex;

    fn triangle(corners: [Point; 3], numbers: [u32; 3]) -> Triangle {
        Triangle { corners, vertices: numbers.map(|number| Vertex { number, between: None }) }
    }

    #[test]
    fn the_distance_is_that_of_the_closest_of_many_points() {
        let mut state = 3_u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as f64 / (1_u64 << 31) as f64
        };
        let mut worst = 0.0_f64;
        for _ in 0..200 {
            let mut corners = |x: f64| [(); 3].map(|()| [x + random(), random(), random()]);
            let (first, second) = (corners(0.0), corners(1.2));
            let found = triangle_distance(triangle(first, [0, 1, 2]), triangle(second, [3, 4, 5]))
                .distance();
            // Points of a grid on both, then of ever finer grids about the closest.
            let at = |t: &[Point; 3], [u, v]: [f64; 2]| {
                [0, 1, 2].map(|k| t[0][k] + u * (t[1][k] - t[0][k]) + v * (t[2][k] - t[0][k]))
            };
            let mut best = ([[0.3; 2]; 2], f64::INFINITY);
            let mut size = 0.5;
            while size > 1e-9 {
                let about = best.0;
                for code in 0..625 {
                    let step = |k: u32| size * ((code / 5_i32.pow(k)) % 5 - 2) as f64 * 0.5;
                    let [u, v] = [about[0][0] + step(0), about[0][1] + step(1)];
                    let [s, t] = [about[1][0] + step(2), about[1][1] + step(3)];
                    let inside = |a: f64, b: f64| a >= 0.0 && b >= 0.0 && a + b <= 1.0;
                    if inside(u, v) && inside(s, t) {
                        let apart = minus(at(&first, [u, v]), at(&second, [s, t]));
                        if dot(apart, apart).sqrt() < best.1 {
                            best = ([[u, v], [s, t]], dot(apart, apart).sqrt());
                        }
                    }
                }
                size *= 0.8;
            }
            assert!(found <= best.1 + 1e-12, "{found} is more than {}", best.1);
            worst = worst.max(best.1 - found);
        }
        assert!(worst < 1e-3, "the search comes within {worst:e} of it");
    }

    #[test]
    fn triangles_that_share_an_edge_are_as_far_apart_as_their_free_features() {
        // A square folded along its diagonal, so that the far corners are 0.1 apart.
        let (a, b) = ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
        let folded = triangle_distance(
            triangle([a, b, [0.5, 0.0, 1.0]], [0, 1, 2]),
            triangle([b, a, [0.5, 0.1, 1.0]], [1, 0, 3]),
        );
        // Two edges whose lines are closest just below the far corners: (1, 0, 0) along their common normal.
        let expected = 0.1 / (0.01_f64 + 1.0 + 0.0025).sqrt();
        assert!((folded.distance() - expected).abs() < 1e-12, "{}", folded.distance());
    }
}
