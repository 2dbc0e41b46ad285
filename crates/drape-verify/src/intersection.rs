//! Exact intersection tests of triangles.
//!
//! All decisions are signs of determinants of the corners, evaluated exactly (\[She97\], through the
//! crate `robust`). `verdict` calls the tests for each pair from the grid.

use robust::{Coord, Coord3D, orient2d, orient3d};

type Point = [f64; 3];
type Corners = [Point; 3];

/// Returns the sign of `$\det(b - a, c - a, d - a)$`: positive where `d` lies above the triangle.
fn volume([a, b, c]: Corners, d: Point) -> i8 {
    let coordinate = |[x, y, z]: Point| Coord3D { x, y, z };
    // The predicate of the crate has the opposite sign.
    sign(-orient3d(coordinate(a), coordinate(b), coordinate(c), coordinate(d)))
}

fn sign(value: f64) -> i8 {
    i8::from(value > 0.0) - i8::from(value < 0.0)
}

/// Returns the projection of a point along a coordinate axis.
fn project(point: Point, axis: usize) -> [f64; 2] {
    [point[(axis + 1) % 3], point[(axis + 2) % 3]]
}

/// Returns the sign of the area of a triangle in the plane: positive if it runs anticlockwise.
fn area(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> i8 {
    let coordinate = |[x, y]: [f64; 2]| Coord { x, y };
    sign(orient2d(coordinate(a), coordinate(b), coordinate(c)))
}

/// Returns a coordinate axis along which the projection of a triangle has an area; `None` if the
/// triangle is degenerate.
fn projection_axis([a, b, c]: Corners) -> Option<usize> {
    (0..3).find(|&axis| area(project(a, axis), project(b, axis), project(c, axis)) != 0)
}

/// Returns whether a triangle has an area.
pub(crate) fn has_area(triangle: Corners) -> bool {
    projection_axis(triangle).is_some()
}

/// Returns whether two triangles, given by their corners, have a point in common.
///
/// The test is that of Guigue and Devillers \[GD03\], evaluated exactly: touching counts, and the last
/// bit of a coordinate decides. The triangles must have an area.
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
    let of_first = first.map(|corner| volume(second, corner));
    if of_first.iter().all(|&side| side > 0) || of_first.iter().all(|&side| side < 0) {
        return false;
    }
    let of_second = second.map(|corner| volume(first, corner));
    if of_second.iter().all(|&side| side > 0) || of_second.iter().all(|&side| side < 0) {
        return false;
    }
    let (Some(first), Some(second)) = (Apex::of(first, of_first), Apex::of(second, of_second))
    else {
        return coplanar_intersect(&first, &second);
    };
    let [p, q, r] = if second.below { reversed(first.corners) } else { first.corners };
    let [s, t, u] = if first.below { reversed(second.corners) } else { second.corners };
    // Each triangle cuts an interval out of the line in which the planes meet; the intervals overlap.
    volume([q, s, p], t) <= 0 && volume([p, s, r], u) <= 0
}

/// Triangle that begins with the corner that is alone on its side of a plane.
struct Apex {
    corners: Corners,
    /// Whether that corner lies below the plane.
    below: bool,
}

impl Apex {
    /// Returns the triangle by the sides of the plane on which its corners lie; `None` if it lies in
    /// the plane.
    fn of([p, q, r]: Corners, [a, b, c]: [i8; 3]) -> Option<Apex> {
        let orders = [([p, q, r], [a, b, c]), ([q, r, p], [b, c, a]), ([r, p, q], [c, a, b])];
        let above = orders.iter().find(|(_, [a, b, c])| a > b && a > c);
        let below = || orders.iter().find(|(_, [a, b, c])| a < b && a < c);
        let apex = |below| move |order: &(Corners, [i8; 3])| Apex { corners: order.0, below };
        above.map(apex(false)).or_else(|| below().map(apex(true)))
    }
}

fn reversed([p, q, r]: Corners) -> Corners {
    [p, r, q]
}

/// Returns whether a segment and a triangle have a point in common.
pub(crate) fn segment_intersects([from, to]: [Point; 2], triangle: Corners) -> bool {
    let [a, b, c] = triangle;
    match (volume(triangle, from), volume(triangle, to)) {
        (0, 0) => coplanar_intersect(&[from, to], &triangle),
        (one, other) if one == other => false,
        _ => {
            // The line crosses the plane once, and there it passes all edges in the same sense.
            let past = [[a, b], [b, c], [c, a]].map(|[a, b]| volume([from, to, a], b));
            past.iter().all(|&side| side >= 0) || past.iter().all(|&side| side <= 0)
        }
    }
}

/// Returns whether two triangles with a common edge lie on each other, given by the edge and the two
/// corners that are not on it. Triangles without an area count as lying on each other.
pub(crate) fn folded_flat([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    if volume([a, b, c], d) != 0 {
        return false;
    }
    let Some(axis) = projection_axis([a, b, c]) else { return true };
    let side = |apex| area(project(a, axis), project(b, axis), project(apex, axis));
    side(c) == side(d)
}

/// Returns whether a triangle or a segment and a triangle in one plane have a point in common.
///
/// Two convex figures are disjoint if and only if an edge of one has the other strictly beyond it.
fn coplanar_intersect(first: &[Point], second: &Corners) -> bool {
    // A degenerate triangle counts as intersecting whatever may lie in its plane: it is reported anyway.
    let Some(axis) = projection_axis(*second) else { return true };
    let flat = |figure: &[Point]| figure.iter().map(|&point| project(point, axis)).collect();
    let (first, second): (Vec<[f64; 2]>, Vec<[f64; 2]>) = (flat(first), flat(second));
    !separated(&first, &second) && !separated(&second, &first)
}

/// Returns whether an edge of a figure has all of another strictly beyond it.
fn separated(figure: &[[f64; 2]], other: &[[f64; 2]]) -> bool {
    let edges = figure.len();
    (0..edges).any(|k| {
        let (a, b) = (figure[k], figure[(k + 1) % edges]);
        // The side of the line on which the figure itself lies; a segment lies on neither.
        let own = if edges == 3 { area(a, b, figure[(k + 2) % 3]) } else { 0 };
        let beyond = other.iter().map(|&point| area(a, b, point));
        let beyond: Vec<i8> = beyond.collect();
        let strictly = |side: i8| own != side && beyond.iter().all(|&beyond| beyond == side);
        strictly(1) || strictly(-1)
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

    /// Returns whether two triangles, or a segment and a triangle, with integer coordinates intersect, by
    /// the separating axis theorem: they are disjoint if and only if their projections on one of these
    /// axes are.
    fn intersect_by_axes(first: &[Integers], second: &[Integers]) -> bool {
        let edges = |figure: &[Integers]| -> Vec<Integers> {
            (0..figure.len()).map(|k| minus(figure[(k + 1) % figure.len()], figure[k])).collect()
        };
        let (own, others) = (edges(first), edges(second));
        let normal = cross(others[0], others[1]);
        let mut axes = vec![normal];
        if first.len() == 3 {
            let normal = cross(own[0], own[1]);
            axes.push(normal);
            axes.extend(own.iter().map(|&edge| cross(normal, edge)));
        }
        axes.extend(others.iter().chain(&own).map(|&edge| cross(normal, edge)));
        axes.extend(own.iter().flat_map(|&a| others.iter().map(move |&b| cross(a, b))));
        let projection = |figure: &[Integers], axis: Integers| {
            let along = figure.iter().map(|p| p[0] * axis[0] + p[1] * axis[1] + p[2] * axis[2]);
            (along.clone().min().unwrap(), along.max().unwrap())
        };
        !axes.into_iter().any(|axis| {
            let (a, b) = (projection(first, axis), projection(second, axis));
            a.1 < b.0 || b.1 < a.0
        })
    }

    /// Random integers below a bound, the same in every run.
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
                flat += usize::from(a.iter().all(|&corner| volume(b, corner) == 0));
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
