//! Exact intersection tests of triangles.
//!
//! Every decision is the sign of a determinant of corners. The crate `robust` evaluates the sign
//! exactly \[She97\]. `verdict` calls the tests for each pair from the grid.

use robust::{Coord, Coord3D, orient2d, orient3d};

type Point = [f64; 3];
type Corners = [Point; 3];

/// Returns the sign of `$\det(b - a, c - a, d - a)$`, which is positive if `d` lies above the
/// triangle with the corners `a`, `b` and `c`.
fn volume_sign([a, b, c]: Corners, d: Point) -> i8 {
    let [a, b, c, d] = [a, b, c, d].map(|[x, y, z]| Coord3D { x, y, z });
    // `orient3d` has the opposite sign.
    sign(-orient3d(a, b, c, d))
}

/// Returns 1 for a positive `value`, -1 for a negative `value`, and 0 otherwise.
fn sign(value: f64) -> i8 {
    i8::from(value > 0.0) - i8::from(value < 0.0)
}

/// Returns the projection of `point` along the coordinate axis `axis`.
fn project(point: Point, axis: usize) -> [f64; 2] {
    [point[(axis + 1) % 3], point[(axis + 2) % 3]]
}

/// Returns the sign of the area of the plane triangle with the corners `a`, `b` and `c`, which is
/// positive if the corners run anticlockwise.
fn area_sign(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> i8 {
    let [a, b, c] = [a, b, c].map(|[x, y]| Coord { x, y });
    sign(orient2d(a, b, c))
}

/// Returns a coordinate axis along which the projection of the triangle with the corners `a`, `b`
/// and `c` has an area, or `None` if the triangle is degenerate.
fn projection_axis([a, b, c]: Corners) -> Option<usize> {
    (0..3).find(|&axis| area_sign(project(a, axis), project(b, axis), project(c, axis)) != 0)
}

/// Returns whether `triangle` has an area.
pub(crate) fn has_area(triangle: Corners) -> bool {
    projection_axis(triangle).is_some()
}

/// Returns whether the triangles with the corners `first` and `second` have a point in common.
///
/// The test is due to Guigue and Devillers \[GD03\] and is evaluated exactly: triangles that touch
/// have a point in common, and the last bit of a coordinate decides. The triangles must have an
/// area.
///
/// ```
/// use drape_verify::triangles_intersect;
///
/// let floor = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
/// let at = |height: f64| [[0.2, height, 0.2], [0.3, 1.0, 0.2], [0.2, 1.0, 0.3]];
/// assert!(triangles_intersect(floor, at(0.0)));
/// assert!(!triangles_intersect(floor, at(f64::MIN_POSITIVE)));
/// ```
#[must_use]
pub fn triangles_intersect(first: [[f64; 3]; 3], second: [[f64; 3]; 3]) -> bool {
    // A triangle that lies strictly on one side of the plane of the other does not intersect it.
    let first_sides = first.map(|corner| volume_sign(second, corner));
    if first_sides.iter().all(|&side| side > 0) || first_sides.iter().all(|&side| side < 0) {
        return false;
    }
    let second_sides = second.map(|corner| volume_sign(first, corner));
    if second_sides.iter().all(|&side| side > 0) || second_sides.iter().all(|&side| side < 0) {
        return false;
    }

    let first_turned = TurnedTriangle::new(first, first_sides);
    let second_turned = TurnedTriangle::new(second, second_sides);
    let (Some(first_turned), Some(second_turned)) = (first_turned, second_turned) else {
        return coplanar_intersect(&first, &second);
    };
    let [p, q, r] = first_turned.seen_from(&second_turned);
    let [s, t, u] = second_turned.seen_from(&first_turned);

    // Each triangle cuts an interval out of the line in which the planes meet. The triangles
    // intersect if the intervals overlap.
    volume_sign([q, s, p], t) <= 0 && volume_sign([p, s, r], u) <= 0
}

/// Triangle whose corners are turned so that the first corner is alone on its side of a plane.
struct TurnedTriangle {
    corners: Corners,
    /// Whether the first corner lies below the plane.
    below: bool,
}

impl TurnedTriangle {
    /// Turns the triangle with the corners `p`, `q` and `r`, which lie on the sides `a`, `b` and
    /// `c` of a plane. Returns `None` if the triangle lies in the plane.
    fn new([p, q, r]: Corners, [a, b, c]: [i8; 3]) -> Option<TurnedTriangle> {
        let turns = [([p, q, r], [a, b, c]), ([q, r, p], [b, c, a]), ([r, p, q], [c, a, b])];
        if let Some(&(corners, _)) = turns.iter().find(|(_, [a, b, c])| a > b && a > c) {
            return Some(TurnedTriangle { corners, below: false });
        }
        let &(corners, _) = turns.iter().find(|(_, [a, b, c])| a < b && a < c)?;
        Some(TurnedTriangle { corners, below: true })
    }

    /// Returns the corners, in reversed order if the first corner of `other` lies below the plane
    /// of `self`.
    fn seen_from(&self, other: &TurnedTriangle) -> Corners {
        if other.below { reversed(self.corners) } else { self.corners }
    }
}

/// Returns the corners in the order that gives the triangle the opposite orientation.
fn reversed([p, q, r]: Corners) -> Corners {
    [p, r, q]
}

/// Returns whether the segment between `start` and `end` and `triangle` have a point in common.
pub(crate) fn segment_intersects([start, end]: [Point; 2], triangle: Corners) -> bool {
    let [a, b, c] = triangle;
    match (volume_sign(triangle, start), volume_sign(triangle, end)) {
        (0, 0) => coplanar_intersect(&[start, end], &triangle),
        (start_side, end_side) if start_side == end_side => false,
        _ => {
            // The line crosses the plane inside the triangle if it passes all edges on one side.
            let sides = [[a, b], [b, c], [c, a]].map(|[a, b]| volume_sign([start, end, a], b));
            sides.iter().all(|&side| side >= 0) || sides.iter().all(|&side| side <= 0)
        }
    }
}

/// Returns whether two triangles with the common edge `a` to `b` lie on each other. Their other
/// corners are `c` and `d`. Triangles without an area count as lying on each other.
pub(crate) fn folded_flat([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    if volume_sign([a, b, c], d) != 0 {
        return false;
    }
    let Some(axis) = projection_axis([a, b, c]) else { return true };
    let [a, b, c, d] = [a, b, c, d].map(|point| project(point, axis));
    area_sign(a, b, c) == area_sign(a, b, d)
}

/// Returns whether `first`, a triangle or a segment, and the triangle `second` have a point in
/// common. Both lie in one plane.
///
/// Two convex figures are disjoint if and only if one of them lies strictly beyond an edge of the
/// other.
fn coplanar_intersect(first: &[Point], second: &Corners) -> bool {
    // A degenerate triangle counts as intersecting every figure in its plane. It is reported
    // anyway.
    let Some(axis) = projection_axis(*second) else { return true };
    let first: Vec<[f64; 2]> = first.iter().map(|&point| project(point, axis)).collect();
    let second = second.map(|point| project(point, axis));
    !separates(&first, &second) && !separates(&second, &first)
}

/// Returns whether all of `other` lies strictly beyond an edge of `figure`.
fn separates(figure: &[[f64; 2]], other: &[[f64; 2]]) -> bool {
    let edges = figure.len();
    (0..edges).any(|k| {
        let (a, b) = (figure[k], figure[(k + 1) % edges]);
        // The side of the edge on which a triangle lies. A segment lies on neither side.
        let inner_side = if edges == 3 { area_sign(a, b, figure[(k + 2) % 3]) } else { 0 };
        let sides: Vec<i8> = other.iter().map(|&point| area_sign(a, b, point)).collect();
        [1, -1].iter().any(|side| inner_side != *side && sides.iter().all(|other| other == side))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    type Integers = [i64; 3];

    fn minus(a: Integers, b: Integers) -> Integers {
        [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
    }

    fn cross(a: Integers, b: Integers) -> Integers {
        [0, 1, 2].map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            a[i] * b[j] - a[j] * b[i]
        })
    }

    /// Returns whether the triangle or segment `first` and the triangle `second` intersect, by the
    /// separating axis theorem. They are disjoint if and only if their projections on one of the
    /// axes are disjoint.
    fn intersect_by_axes(first: &[Integers], second: &[Integers]) -> bool {
        let edges = |figure: &[Integers]| -> Vec<Integers> {
            (0..figure.len()).map(|k| minus(figure[(k + 1) % figure.len()], figure[k])).collect()
        };
        let (first_edges, second_edges) = (edges(first), edges(second));
        let normal = cross(second_edges[0], second_edges[1]);
        let mut axes = vec![normal];
        if first.len() == 3 {
            let normal = cross(first_edges[0], first_edges[1]);
            axes.push(normal);
            axes.extend(first_edges.iter().map(|&edge| cross(normal, edge)));
        }
        axes.extend(second_edges.iter().chain(&first_edges).map(|&edge| cross(normal, edge)));
        for &a in &first_edges {
            axes.extend(second_edges.iter().map(|&b| cross(a, b)));
        }
        let projection = |figure: &[Integers], axis: Integers| {
            let along = figure.iter().map(|p| p[0] * axis[0] + p[1] * axis[1] + p[2] * axis[2]);
            (along.clone().min().unwrap(), along.max().unwrap())
        };
        !axes.into_iter().any(|axis| {
            let (a, b) = (projection(first, axis), projection(second, axis));
            a.1 < b.0 || b.1 < a.0
        })
    }

    /// Generator of random integers, the same in every run.
    struct Dice(u64);

    impl Dice {
        fn roll(&mut self, below: i64) -> i64 {
            self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((self.0 >> 33) % below as u64) as i64
        }

        fn triangle(&mut self, below: [i64; 3]) -> [Integers; 3] {
            loop {
                let corners = [(); 3].map(|()| below.map(|below| self.roll(below)));
                let [a, b, c] = corners;
                if cross(minus(b, a), minus(c, a)) != [0; 3] {
                    return corners;
                }
            }
        }
    }

    #[test]
    fn triangles_on_a_lattice_intersect_as_the_separating_axes_say() {
        let mut dice = Dice(7);
        // Small lattices have many that touch, share corners or lie in one plane.
        for (below, count) in
            [([2; 3], 20_000), ([3; 3], 50_000), ([4, 4, 1], 30_000), ([9; 3], 50_000)]
        {
            let (mut meeting, mut flat) = (0, 0);
            for _ in 0..count {
                let (first, second) = (dice.triangle(below), dice.triangle(below));
                let expected = intersect_by_axes(&first, &second);
                // Exact in binary, so that both tests see the same triangles.
                let real = |whole: [Integers; 3]| whole.map(|p| p.map(|x| 0.125 * x as f64 - 1.0));
                let (a, b) = (real(first), real(second));
                assert_eq!(triangles_intersect(a, b), expected, "{first:?} {second:?}");
                assert_eq!(triangles_intersect(b, a), expected, "{second:?} {first:?}");
                assert_eq!(triangles_intersect(reversed(a), b), expected, "{first:?} {second:?}");
                let segment = [first[0], first[1]];
                let expected_of_segment = intersect_by_axes(&segment, &second);
                assert_eq!(
                    segment_intersects([a[0], a[1]], b),
                    expected_of_segment,
                    "{segment:?} {second:?}"
                );
                meeting += usize::from(expected);
                flat += usize::from(a.iter().all(|&corner| volume_sign(b, corner) == 0));
            }
            assert!(
                meeting > count / 20 && meeting < count,
                "{below:?}: {meeting} of {count} meet"
            );
            assert!(below[2] > 4 || flat > 100, "{below:?}: {flat} in one plane");
        }
    }

    #[test]
    fn the_last_bit_decides() {
        let floor = [[0.1, 0.1, 0.1], [0.7, 0.1, 0.1], [0.1, 0.1, 0.7]];
        let over = 0.1_f64.next_up();
        let above = [[0.2, over, 0.2], [0.3, 0.5, 0.2], [0.2, 0.4, 0.3]];
        let on = [[0.2, 0.1, 0.2], [0.3, 0.5, 0.2], [0.2, 0.4, 0.3]];
        assert!(!triangles_intersect(floor, above) && triangles_intersect(floor, on));
    }
}
