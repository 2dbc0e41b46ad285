//! Distances of points, segments and triangles by plain formulas.
//!
//! Each distance is the distance of two points on the two figures. Except for rounding it is
//! therefore never less than the true distance. `verdict` computes distances of pairs that do not
//! intersect.

use crate::triangle::{EDGES, Triangle, joined};

type Point = [f64; 3];

/// Returns `a` less `b`.
fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Returns the scalar product of `a` and `b`.
fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns the point at `fraction` of the segment from `a` to `b`.
fn interpolate(a: Point, b: Point, fraction: f64) -> Point {
    [0, 1, 2].map(|axis| a[axis] + fraction * (b[axis] - a[axis]))
}

/// Closest points of two figures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ClosestPoints {
    /// Square of the distance of the two points, in m².
    squared_distance: f64,
    /// Point of the first figure and point of the second figure, in m.
    pub(crate) points: [Point; 2],
}

impl ClosestPoints {
    /// Placeholder that is farther apart than any two points.
    const NONE: ClosestPoints =
        ClosestPoints { squared_distance: f64::INFINITY, points: [[f64::NAN; 3]; 2] };

    /// Returns the points `a` and `b`.
    fn new(a: Point, b: Point) -> ClosestPoints {
        let difference = minus(a, b);
        ClosestPoints { squared_distance: dot(difference, difference), points: [a, b] }
    }

    /// Returns the closer of `self` and `other`, and `self` if both are equally close.
    fn min(self, other: ClosestPoints) -> ClosestPoints {
        if other.squared_distance < self.squared_distance { other } else { self }
    }

    /// Returns the points in the opposite order.
    fn swapped(self) -> ClosestPoints {
        ClosestPoints { points: [self.points[1], self.points[0]], ..self }
    }

    /// Returns the distance of the two points, in m.
    pub(crate) fn distance(&self) -> f64 {
        self.squared_distance.sqrt()
    }
}

/// Returns `point` and the closest point of the segment from `a` to `b`: the foot of the
/// perpendicular, or an end.
pub(crate) fn point_segment(point: Point, [a, b]: [Point; 2]) -> ClosestPoints {
    let along = minus(b, a);
    let fraction = (dot(minus(point, a), along) / dot(along, along)).clamp(0.0, 1.0);
    let fraction = if fraction.is_nan() { 0.0 } else { fraction };
    ClosestPoints::new(point, interpolate(a, b, fraction))
}

/// Returns `point` and the closest point of the triangle with the corners `a`, `b` and `c`: the
/// foot of the perpendicular if it lies inside, or a point of an edge.
fn point_triangle(point: Point, [a, b, c]: [Point; 3]) -> ClosestPoints {
    let mut closest = ClosestPoints::NONE;
    for edge in [[a, b], [b, c], [c, a]] {
        closest = closest.min(point_segment(point, edge));
    }

    // The foot a + u (b - a) + v (c - a) solves the normal equations of its distance from the
    // point.
    let (e, f, g) = (minus(b, a), minus(c, a), minus(point, a));
    let (ee, ef, ff, eg, fg) = (dot(e, e), dot(e, f), dot(f, f), dot(e, g), dot(f, g));
    let determinant = ee * ff - ef * ef;
    let (u, v) = ((ff * eg - ef * fg) / determinant, (ee * fg - ef * eg) / determinant);

    // The comparison is written so that NaN is outside.
    if u >= 0.0 && v >= 0.0 && u + v <= 1.0 {
        let foot = [0, 1, 2].map(|axis| a[axis] + u * e[axis] + v * f[axis]);
        closest = closest.min(ClosestPoints::new(point, foot));
    }
    closest
}

/// Returns the closest points of the segments from `a` to `b` and from `c` to `d`.
///
/// They are the closest points of the two lines if both lie inside the segments. Otherwise one of
/// them is an end of a segment.
fn segment_segment([a, b]: [Point; 2], [c, d]: [Point; 2]) -> ClosestPoints {
    let mut closest = point_segment(a, [c, d]).min(point_segment(b, [c, d]));
    closest = closest.min(point_segment(c, [a, b]).swapped());
    closest = closest.min(point_segment(d, [a, b]).swapped());
    let (e, f, g) = (minus(b, a), minus(d, c), minus(c, a));
    let (ee, ef, ff, eg, fg) = (dot(e, e), dot(e, f), dot(f, f), dot(e, g), dot(f, g));
    let determinant = ee * ff - ef * ef;
    let (s, t) = ((eg * ff - fg * ef) / determinant, (eg * ef - fg * ee) / determinant);
    if [s, t].iter().all(|fraction| (0.0..=1.0).contains(fraction)) {
        closest = closest.min(ClosestPoints::new(interpolate(a, b, s), interpolate(c, d, t)));
    }
    closest
}

/// Returns the shortest distance by which `segment` would have to move to leave `triangle`, which
/// it intersects, in m: until one of its ends is in the face, or until it lies across a side.
pub(crate) fn penetration(segment: [Point; 2], triangle: [Point; 3]) -> f64 {
    let [a, b, c] = triangle;
    let ends = segment.map(|end| point_triangle(end, triangle));
    let sides = [[a, b], [b, c], [c, a]].map(|side| segment_segment(segment, side));
    let ways = ends.into_iter().chain(sides);
    ways.fold(ClosestPoints::NONE, ClosestPoints::min).distance()
}

/// Returns the closest points of the triangles `first` and `second` on features that are not
/// joined.
///
/// Corners are compared with triangles, and edges with edges. If the triangles are neither joined
/// nor intersect, the result is the distance of the triangles.
pub(crate) fn triangle_distance(first: Triangle, second: Triangle) -> ClosestPoints {
    let mut closest = ClosestPoints::NONE;
    for k in 0..3 {
        if !joined(&first.vertices[k..=k], &second.vertices) {
            closest = closest.min(point_triangle(first.corners[k], second.corners));
        }
        if !joined(&second.vertices[k..=k], &first.vertices) {
            closest = closest.min(point_triangle(second.corners[k], first.corners));
        }
    }

    for edge in EDGES {
        for opposite in EDGES {
            let edge_vertices = edge.map(|k| first.vertices[k]);
            let opposite_vertices = opposite.map(|k| second.vertices[k]);
            if !joined(&edge_vertices, &opposite_vertices) {
                let edge_ends = edge.map(|k| first.corners[k]);
                let opposite_ends = opposite.map(|k| second.corners[k]);
                closest = closest.min(segment_segment(edge_ends, opposite_ends));
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
    fn the_distance_agrees_with_the_closest_of_many_points() {
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
            // Points of a grid on both triangles, then of finer and finer grids around the closest
            // points.
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
        // Two edges whose lines are closest just below the far corners: (1, 0, 0) along their
        // common normal.
        let expected = 0.1 / (0.01_f64 + 1.0 + 0.0025).sqrt();
        assert!((folded.distance() - expected).abs() < 1e-12, "{}", folded.distance());
    }
}
