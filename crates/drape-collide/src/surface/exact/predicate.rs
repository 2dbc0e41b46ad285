//! Exact test of a segment and a triangle.

use robust::{Coord, Coord3D, orient2d, orient3d};

use crate::surface::distance::{Height, height};
use crate::vector::{Vector, cross, subtract};

/// Returns a number whose sign is exactly the side of `d` from the plane through `a`, `b` and `c`.
fn side(a: Vector, b: Vector, c: Vector, d: Vector) -> f64 {
    let [a, b, c, d] = [a, b, c, d].map(|[x, y, z]| Coord3D { x, y, z });
    orient3d(a, b, c, d)
}

/// Returns whether a segment with the ends `p` and `q` and a triangle with the corners `a`, `b` and
/// `c` have a common point, by an exact test.
///
/// The segment may be a single point, and the triangle may be a segment or a point. Coordinates are
/// finite, in m.
#[must_use]
pub fn segment_meets_triangle([p, q]: [Vector; 2], [a, b, c]: [Vector; 3]) -> bool {
    if surely_apart([p, q], [a, b, c]) {
        return false;
    }

    // If both ends are on one side of the plane, nothing meets.
    let (over_p, over_q) = (side(a, b, c, p), side(a, b, c, q));
    if over_p == 0.0 && over_q == 0.0 {
        return meets_in_plane([p, q], [a, b, c]);
    }
    if (over_p > 0.0 && over_q > 0.0) || (over_p < 0.0 && over_q < 0.0) {
        return false;
    }

    // The line crosses the plane once, and passes all sides of the triangle in the same sense.
    let turns = [side(p, q, a, b), side(p, q, b, c), side(p, q, c, a)];
    turns.iter().all(|&turn| turn >= 0.0) || turns.iter().all(|&turn| turn <= 0.0)
}

/// Returns whether one of a few planes surely separates `segment` and `triangle`, rounding
/// included.
///
/// The exact tests take long for points in one plane, such as neighbours in a flat sheet. This test
/// settles most of them.
fn surely_apart(segment: [Vector; 2], triangle: [Vector; 3]) -> bool {
    let [a, b, c] = triangle;
    let sides = [subtract(b, a), subtract(c, b), subtract(a, c)];
    let normal = cross(sides[0], sides[1]);
    let along = subtract(segment[1], segment[0]);
    separates(normal, segment, triangle)
        || [sides[0], sides[1], sides[2], along]
            .into_iter()
            .any(|line| separates(cross(normal, line), segment, triangle))
}

/// Returns whether the heights of `segment` and `triangle` along `direction` surely do not overlap.
fn separates(direction: Vector, segment: [Vector; 2], triangle: [Vector; 3]) -> bool {
    let origin = triangle[0];
    let (segment_low, segment_high) = height_range(direction, &segment, origin);
    let (triangle_low, triangle_high) = height_range(direction, &triangle, origin);
    segment_low > triangle_high || segment_high < triangle_low
}

/// Returns bounds of the lowest and the highest of `points` along `direction`, over `origin`.
fn height_range(direction: Vector, points: &[Vector], origin: Vector) -> (f64, f64) {
    points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &point| {
        let Height { value, error } = height(direction, point, origin);
        (low.min(value - error), high.max(value + error))
    })
}

/// Returns whether `segment` in the plane of `triangle` meets it. The triangle may be degenerate.
fn meets_in_plane(segment: [Vector; 2], triangle: [Vector; 3]) -> bool {
    // Along an axis along which the triangle has an area, its plane is projected one to one.
    for axis in 0..3 {
        let [a, b, c] = triangle.map(|corner| along(corner, axis));
        if orient2d(a, b, c) != 0.0 {
            return meets_flat(segment.map(|end| along(end, axis)), [a, b, c]);
        }
    }
    let [a, b, c] = triangle;
    [[a, b], [b, c], [c, a]].into_iter().any(|edge| segments_meet(segment, edge))
}

/// Returns the projection of `point` along `axis`.
fn along(point: Vector, axis: usize) -> Coord<f64> {
    Coord { x: point[(axis + 1) % 3], y: point[(axis + 2) % 3] }
}

/// Returns whether a segment with the ends `p` and `q` meets a triangle with an area, in two
/// dimensions.
fn meets_flat([p, q]: [Coord<f64>; 2], [a, b, c]: [Coord<f64>; 3]) -> bool {
    let turns = [orient2d(a, b, p), orient2d(b, c, p), orient2d(c, a, p)];
    let starts_inside =
        turns.iter().all(|&turn| turn >= 0.0) || turns.iter().all(|&turn| turn <= 0.0);
    starts_inside || [[a, b], [b, c], [c, a]].into_iter().any(|edge| meet_flat([p, q], edge))
}

/// Returns whether two segments, from `p` to `q` and from `a` to `b`, meet in two dimensions.
fn meet_flat([p, q]: [Coord<f64>; 2], [a, b]: [Coord<f64>; 2]) -> bool {
    // The ranges of the coordinates decide only for segments on one line.
    !on_one_side(orient2d(p, q, a), orient2d(p, q, b))
        && !on_one_side(orient2d(a, b, p), orient2d(a, b, q))
        && ranges_overlap([p.x, q.x], [a.x, b.x])
        && ranges_overlap([p.y, q.y], [a.y, b.y])
}

/// Returns whether `first` and `second` are both positive or both negative.
fn on_one_side(first: f64, second: f64) -> bool {
    (first > 0.0 && second > 0.0) || (first < 0.0 && second < 0.0)
}

/// Returns whether the ranges between `p` and `q` and between `a` and `b` overlap.
fn ranges_overlap([p, q]: [f64; 2], [a, b]: [f64; 2]) -> bool {
    p.min(q) <= a.max(b) && a.min(b) <= p.max(q)
}

/// Returns whether two segments in space, from `p` to `q` and from `a` to `b`, meet.
fn segments_meet([p, q]: [Vector; 2], [a, b]: [Vector; 2]) -> bool {
    if side(p, q, a, b) != 0.0 {
        return false;
    }
    // Along an axis along which three of the ends span an area, the common plane is projected one
    // to one. Without such an axis all ends lie on one line, and each axis not across the line
    // projects it one to one.
    let mut projections = (0..3).map(|axis| [p, q, a, b].map(|end| along(end, axis)));
    let spanning = projections.clone().find(|&[p, q, a, b]| {
        orient2d(p, q, a) != 0.0
            || orient2d(p, q, b) != 0.0
            || orient2d(a, b, p) != 0.0
            || orient2d(a, b, q) != 0.0
    });
    match spanning {
        Some([p, q, a, b]) => meet_flat([p, q], [a, b]),
        None => projections.all(|[p, q, a, b]| meet_flat([p, q], [a, b])),
    }
}
