//! Exact test of a segment and a triangle.

use robust::{Coord, Coord3D, orient2d, orient3d};

use crate::surface::distance::{Height, height};
use crate::vector::{Vector, cross, subtract};

/// Returns a number whose sign is exactly that of the side of a plane through three points.
fn side(a: Vector, b: Vector, c: Vector, d: Vector) -> f64 {
    let coordinate = |[x, y, z]: Vector| Coord3D { x, y, z };
    orient3d(coordinate(a), coordinate(b), coordinate(c), coordinate(d))
}

/// Returns whether a segment and a triangle have a point in common, exactly.
///
/// Either may be degenerate to a shorter segment or a point. Coordinates are finite, in m.
#[must_use]
pub fn segment_meets_triangle([p, q]: [Vector; 2], [a, b, c]: [Vector; 3]) -> bool {
    if surely_apart([p, q], [a, b, c]) {
        return false;
    }
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

/// Returns whether one of a few planes separates the two, with all rounding.
///
/// The exact tests take long for points in one plane, such as neighbours in a flat sheet.
fn surely_apart(segment: [Vector; 2], triangle: [Vector; 3]) -> bool {
    let [a, b, c] = triangle;
    let sides = [subtract(b, a), subtract(c, b), subtract(a, c)];
    let normal = cross(sides[0], sides[1]);
    let parts = |direction: Vector| {
        let range = |points: &[Vector]| {
            points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &point| {
                let Height { value, error } = height(direction, point, a);
                (low.min(value - error), high.max(value + error))
            })
        };
        let (of_segment, of_triangle) = (range(&segment), range(&triangle));
        of_segment.0 > of_triangle.1 || of_segment.1 < of_triangle.0
    };
    let along = subtract(segment[1], segment[0]);
    let lines = [sides[0], sides[1], sides[2], along];
    parts(normal) || lines.into_iter().any(|line| parts(cross(normal, line)))
}

/// Returns the same for a segment in the plane of the triangle, or for a degenerate triangle.
fn meets_in_plane(segment: [Vector; 2], triangle: [Vector; 3]) -> bool {
    // Along an axis along which the triangle has an area, the plane is projected one to one.
    for axis in 0..3 {
        let [a, b, c] = triangle.map(|corner| along(corner, axis));
        if orient2d(a, b, c) != 0.0 {
            return meets_flat(segment.map(|end| along(end, axis)), [a, b, c]);
        }
    }
    let [a, b, c] = triangle;
    [[a, b], [b, c], [c, a]].into_iter().any(|edge| segments_meet(segment, edge))
}

/// Returns the projection of a point along an axis.
fn along(point: Vector, axis: usize) -> Coord<f64> {
    Coord { x: point[(axis + 1) % 3], y: point[(axis + 2) % 3] }
}

/// Returns whether a segment meets a triangle with an area, in two dimensions.
fn meets_flat([p, q]: [Coord<f64>; 2], [a, b, c]: [Coord<f64>; 3]) -> bool {
    let inside = |point: Coord<f64>| {
        let turns = [orient2d(a, b, point), orient2d(b, c, point), orient2d(c, a, point)];
        turns.iter().all(|&turn| turn >= 0.0) || turns.iter().all(|&turn| turn <= 0.0)
    };
    inside(p) || [[a, b], [b, c], [c, a]].into_iter().any(|edge| meet_flat([p, q], edge))
}

/// Returns whether two segments meet, in two dimensions.
fn meet_flat([p, q]: [Coord<f64>; 2], [a, b]: [Coord<f64>; 2]) -> bool {
    let opposite =
        |one: f64, other: f64| !((one > 0.0 && other > 0.0) || (one < 0.0 && other < 0.0));
    let of_first = [orient2d(p, q, a), orient2d(p, q, b)];
    let of_second = [orient2d(a, b, p), orient2d(a, b, q)];
    let overlap = |p: f64, q: f64, a: f64, b: f64| p.min(q) <= a.max(b) && a.min(b) <= p.max(q);
    // The boxes decide for segments on one line only.
    opposite(of_first[0], of_first[1])
        && opposite(of_second[0], of_second[1])
        && overlap(p.x, q.x, a.x, b.x)
        && overlap(p.y, q.y, a.y, b.y)
}

/// Returns whether two segments in space meet.
fn segments_meet([p, q]: [Vector; 2], [a, b]: [Vector; 2]) -> bool {
    if side(p, q, a, b) != 0.0 {
        return false;
    }
    // Along an axis along which three of the ends have an area, their plane is projected one to
    // one; if there is none, all lie on one line, which each axis not across it projects likewise.
    let axes = [0, 1, 2];
    let meet = |axis| meet_flat([along(p, axis), along(q, axis)], [along(a, axis), along(b, axis)]);
    let spans = |&axis: &usize| {
        let [p, q, a, b] = [p, q, a, b].map(|end| along(end, axis));
        orient2d(p, q, a) != 0.0
            || orient2d(p, q, b) != 0.0
            || orient2d(a, b, p) != 0.0
            || orient2d(a, b, q) != 0.0
    };
    match axes.iter().find(|axis| spans(axis)) {
        Some(&axis) => meet(axis),
        None => axes.into_iter().all(meet),
    }
}
