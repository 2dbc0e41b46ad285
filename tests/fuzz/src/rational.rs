//! Exact geometry by rational numbers: distances, crossings, and proofs about motions.
//!
//! Nothing here knows how the program finds closest points, planes or orientations.

use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// Point with floating coordinates.
pub type Point = [f64; 3];

/// Point with exact coordinates.
pub type Exact = [BigRational; 3];

/// Largest number of parts of a motion in a proof.
const PARTS_MAX: usize = 1000;

fn number(value: f64) -> BigRational {
    BigRational::from_float(value).expect("it is finite")
}

pub fn exact(point: Point) -> Exact {
    point.map(number)
}

fn subtract(a: &Exact, b: &Exact) -> Exact {
    std::array::from_fn(|k| &a[k] - &b[k])
}

fn dot(a: &Exact, b: &Exact) -> BigRational {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn cross(a: &Exact, b: &Exact) -> Exact {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        &a[i] * &b[j] - &a[j] * &b[i]
    })
}

/// Returns the point at a fraction of the way.
fn between(a: &Exact, b: &Exact, fraction: &BigRational) -> Exact {
    std::array::from_fn(|k| &a[k] + fraction * (&b[k] - &a[k]))
}

/// Returns the displacement to a point from the closest one of a segment.
fn from_segment(point: &Exact, [a, b]: [&Exact; 2]) -> Exact {
    let along = subtract(b, a);
    let square = dot(&along, &along);
    let mut fraction = BigRational::zero();
    if !square.is_zero() {
        fraction = dot(&subtract(point, a), &along) / square;
        fraction = fraction.max(BigRational::zero()).min(BigRational::one());
    }
    subtract(point, &between(a, b, &fraction))
}

/// Returns the shortest of some displacements.
fn shortest(all: impl IntoIterator<Item = Exact>) -> Exact {
    let squares = all.into_iter().map(|own| (dot(&own, &own), own));
    squares.min_by(|a, b| a.0.cmp(&b.0)).expect("there is one").1
}

/// Returns the displacement to a point from the closest one of a triangle.
fn from_triangle(point: &Exact, [a, b, c]: [&Exact; 3]) -> Exact {
    let normal = cross(&subtract(b, a), &subtract(c, a));
    let square = dot(&normal, &normal);
    if !square.is_zero() {
        let inside = [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| {
            let side = cross(&subtract(to, from), &subtract(point, from));
            !dot(&side, &normal).is_negative()
        });
        if inside {
            let height = dot(&subtract(point, a), &normal) / square;
            return normal.map(|component| component * &height);
        }
    }
    shortest([[a, b], [b, c], [c, a]].map(|edge| from_segment(point, edge)))
}

/// Returns the displacement to the closest point of a segment from that of another.
fn between_segments([p, q]: [&Exact; 2], [a, b]: [&Exact; 2]) -> Exact {
    let (u, v, w) = (subtract(q, p), subtract(b, a), subtract(p, a));
    let (uu, uv, vv) = (dot(&u, &u), dot(&u, &v), dot(&v, &v));
    let (uw, vw) = (dot(&u, &w), dot(&v, &w));
    let square = &uu * &vv - &uv * &uv;
    if !square.is_zero() {
        let first = (&uv * &vw - &vv * &uw) / &square;
        let second = (&uu * &vw - &uv * &uw) / &square;
        let within = |x: &BigRational| !x.is_negative() && *x <= BigRational::one();
        if within(&first) && within(&second) {
            return subtract(&between(p, q, &first), &between(a, b, &second));
        }
    }
    let back = |own: Exact| own.map(|component| -component);
    shortest([
        from_segment(p, [a, b]),
        from_segment(q, [a, b]),
        back(from_segment(a, [p, q])),
        back(from_segment(b, [p, q])),
    ])
}

/// Returns the displacement to the closest point of the first of a point and a triangle, or of two
/// segments, from that of the second.
fn displacement(points: &[Exact; 4], first: usize) -> Exact {
    let [a, b, c, d] = points;
    match first {
        1 => from_triangle(a, [b, c, d]),
        _ => between_segments([a, b], [c, d]),
    }
}

/// Returns the square of the distance of a point and a triangle, or of two segments.
pub fn square_distance(points: &[Exact; 4], first: usize) -> BigRational {
    let own = displacement(points, first);
    dot(&own, &own)
}

/// Returns whether a triangle has an area.
pub fn has_area([a, b, c]: [&Exact; 3]) -> bool {
    !cross(&subtract(b, a), &subtract(c, a)).iter().all(Zero::is_zero)
}

/// Returns whether a segment and a triangle have a point in common.
pub fn segment_meets_triangle([p, q]: [&Exact; 2], triangle: [&Exact; 3]) -> bool {
    let [a, b, c] = triangle;
    let normal = cross(&subtract(b, a), &subtract(c, a));
    let [over_p, over_q] = [p, q].map(|end| dot(&subtract(end, a), &normal));
    if (over_p.is_positive() && over_q.is_negative())
        || (over_p.is_negative() && over_q.is_positive())
    {
        let place = between(p, q, &(&over_p / (&over_p - &over_q)));
        return from_triangle(&place, triangle).iter().all(Zero::is_zero);
    }
    [p, q].into_iter().any(|end| from_triangle(end, triangle).iter().all(Zero::is_zero))
        || [[a, b], [b, c], [c, a]]
            .into_iter()
            .any(|edge| between_segments([p, q], edge).iter().all(Zero::is_zero))
}

/// Result of a proof.
#[derive(Debug, PartialEq)]
pub enum Proof {
    /// The distance is kept all the way.
    SavedRun,
    /// It is not: the fraction of the way at which it is seen.
    Broken(f64),
    /// The motion has more parts than are tried.
    Open,
}

/// Proves that a point and a triangle, or two segments, that move straight keep more than a
/// distance.
///
/// The heights of moving points over a plane change evenly: a plane that parts the two at the start
/// and at the end of a part of the way parts them on all of it. Other parts are halved.
pub fn keeps(start: &[Exact; 4], end: &[Exact; 4], (first, distance): (usize, f64)) -> Proof {
    let least = number(distance) * number(distance);
    let place = |fraction: &BigRational| -> [Exact; 4] {
        std::array::from_fn(|k| between(&start[k], &end[k], fraction))
    };
    let is_parted = |points: &[Exact; 4], normal: &Exact| {
        let heights = points.each_ref().map(|point| dot(point, normal));
        let low = heights[..first].iter().min().expect("a height");
        let high = heights[first..].iter().max().expect("a height");
        let room = low - high;
        room.is_positive() && &room * &room > &least * dot(normal, normal)
    };
    let mut parts = vec![[BigRational::zero(), BigRational::one()]];
    let mut tried = 0;
    while let Some([from, to]) = parts.pop() {
        tried += 1;
        if tried > PARTS_MAX {
            return Proof::Open;
        }
        let middle = (&from + &to) / number(2.0);
        let points = place(&middle);
        let normal = displacement(&points, first);
        let square = dot(&normal, &normal);
        if square <= least {
            return Proof::Broken(middle.to_f64().unwrap_or(f64::NAN));
        }
        // Any direction proves: that of the nearest floating numbers has the fewest digits.
        let largest = normal.iter().map(Signed::abs).max().expect("a component");
        let rounded =
            normal.map(|component| number((component / &largest).to_f64().unwrap_or(0.0)));
        if [&from, &to].into_iter().any(|at| !is_parted(&place(at), &rounded)) {
            parts.push([middle.clone(), to]);
            parts.push([from, middle]);
        }
    }
    Proof::SavedRun
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(places: [Point; 4]) -> [Exact; 4] {
        places.map(exact)
    }

    #[test]
    fn distances_are_those_of_a_box() {
        let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        for (point, square) in
            [([0.25, 0.25, 2.0], 4.0), ([-3.0, -4.0, 0.0], 25.0), ([1.0, 1.0, 0.0], 0.5)]
        {
            let [a, b, c] = triangle;
            assert_eq!(square_distance(&points([point, a, b, c]), 1), number(square));
        }
        let crossed = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 3.0], [0.0, 1.0, 3.0]];
        assert_eq!(square_distance(&points(crossed), 2), number(9.0));
    }

    #[test]
    fn what_passes_through_is_seen_and_what_passes_by_is_proved() {
        let [a, b, c] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let moved = |from: Point, to: Point, distance: f64| {
            keeps(&points([from, a, b, c]), &points([to, a, b, c]), (1, distance))
        };
        let through = moved([0.2, 0.2, 1.0], [0.2, 0.2, -0.9], 1e-6);
        assert!(matches!(through, Proof::Broken(_)), "{through:?}");
        assert_eq!(moved([2.0, 2.0, 1.0], [2.0, 2.0, -1.0], 1.0), Proof::SavedRun);
        // In the plane of the triangle, past its corner.
        assert_eq!(moved([1.5, -1.0, 0.0], [1.5, 1.0, 0.0], 0.49), Proof::SavedRun);
        assert!(matches!(moved([1.5, -1.0, 0.0], [1.5, 1.0, 0.0], 0.5), Proof::Broken(_)));
    }
}
