//! Whether triangles meet, exactly: all decisions are signs of determinants of their corners (Shewchuk 1997, through
//! the crate `robust`). Triangles must have an area.

use robust::{Coord, Coord3D, orient2d, orient3d};

type Place = [f64; 3];
type Triangle = [Place; 3];

/// Sign of the volume of the box of `b - a`, `c - a` and `d - a`: above 0 where `d` is over the triangle.
fn volume([a, b, c]: Triangle, d: Place) -> i8 {
    let coordinate = |[x, y, z]: Place| Coord3D { x, y, z };
    // The predicate has the other sign.
    sign(-orient3d(coordinate(a), coordinate(b), coordinate(c), coordinate(d)))
}

fn sign(value: f64) -> i8 {
    i8::from(value > 0.0) - i8::from(value < 0.0)
}

/// A place as seen along an axis.
fn seen(place: Place, axis: usize) -> [f64; 2] {
    [place[(axis + 1) % 3], place[(axis + 2) % 3]]
}

/// Sign of the area of a triangle in two dimensions: above 0 if it runs anticlockwise.
fn area(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> i8 {
    let coordinate = |[x, y]: [f64; 2]| Coord { x, y };
    sign(orient2d(coordinate(a), coordinate(b), coordinate(c)))
}

/// An axis along which a triangle is seen with an area; none if it has no area.
fn broadside([a, b, c]: Triangle) -> Option<usize> {
    (0..3).find(|&axis| area(seen(a, axis), seen(b, axis), seen(c, axis)) != 0)
}

/// Whether a triangle has an area.
pub(crate) fn has_area(triangle: Triangle) -> bool {
    broadside(triangle).is_some()
}

/// Whether two triangles have a point in common: the test of Guigue & Devillers (2003, "Fast and Robust
/// Triangle–Triangle Overlap Test Using Orientation Predicates", J. Graphics Tools 8(1)).
pub(crate) fn triangles_meet(first: Triangle, second: Triangle) -> bool {
    let of_first = first.map(|corner| volume(second, corner));
    if of_first.iter().all(|&side| side > 0) || of_first.iter().all(|&side| side < 0) {
        return false;
    }
    let of_second = second.map(|corner| volume(first, corner));
    if of_second.iter().all(|&side| side > 0) || of_second.iter().all(|&side| side < 0) {
        return false;
    }
    let (Some((first, turn_second)), Some((second, turn_first))) =
        (lead(first, of_first), lead(second, of_second))
    else {
        return meet_in_plane(&first, &second);
    };
    let [p, q, r] = if turn_first { turned(first) } else { first };
    let [s, t, u] = if turn_second { turned(second) } else { second };
    // Each triangle cuts an interval out of the line of the two planes; they overlap.
    volume([q, s, p], t) <= 0 && volume([p, s, r], u) <= 0
}

/// The triangle with the corner in front that is alone on its side of a plane, by the sides of all; and whether that
/// side is the lower one. None if the triangle lies in the plane.
fn lead([p, q, r]: Triangle, [a, b, c]: [i8; 3]) -> Option<(Triangle, bool)> {
    let orders = [([p, q, r], [a, b, c]), ([q, r, p], [b, c, a]), ([r, p, q], [c, a, b])];
    let above = orders.iter().find(|(_, [a, b, c])| a > b && a > c);
    let below = || orders.iter().find(|(_, [a, b, c])| a < b && a < c);
    above.map(|(order, _)| (*order, false)).or_else(|| below().map(|(order, _)| (*order, true)))
}

fn turned([p, q, r]: Triangle) -> Triangle {
    [p, r, q]
}

/// Whether a segment and a triangle have a point in common.
pub(crate) fn segment_meets([from, to]: [Place; 2], triangle: Triangle) -> bool {
    let [a, b, c] = triangle;
    match (volume(triangle, from), volume(triangle, to)) {
        (0, 0) => meet_in_plane(&[from, to], &triangle),
        (one, other) if one == other => false,
        _ => {
            // The line goes through the plane once, and there past all sides in the same sense.
            let past = [[a, b], [b, c], [c, a]].map(|[a, b]| volume([from, to, a], b));
            past.iter().all(|&side| side >= 0) || past.iter().all(|&side| side <= 0)
        }
    }
}

/// The same of a triangle, or a segment, and a triangle in one plane. Two convex figures are apart if and only if a
/// side of one has the other strictly beyond it.
fn meet_in_plane(first: &[Place], second: &Triangle) -> bool {
    // A triangle without an area meets whatever may be in its plane: it is reported for itself.
    let Some(axis) = broadside(*second) else { return true };
    let flat = |figure: &[Place]| figure.iter().map(|&place| seen(place, axis)).collect();
    let (first, second): (Vec<[f64; 2]>, Vec<[f64; 2]>) = (flat(first), flat(second));
    !parted(&first, &second) && !parted(&second, &first)
}

/// Whether a side of a figure has all of another strictly beyond it.
fn parted(figure: &[[f64; 2]], other: &[[f64; 2]]) -> bool {
    let sides = figure.len();
    (0..sides).any(|k| {
        let (a, b) = (figure[k], figure[(k + 1) % sides]);
        // The figure's own side of the line; a segment has none.
        let own = if sides == 3 { area(a, b, figure[(k + 2) % 3]) } else { 0 };
        let beyond = other.iter().map(|&place| area(a, b, place));
        let beyond: Vec<i8> = beyond.collect();
        let strictly = |side: i8| own != side && beyond.iter().all(|&beyond| beyond == side);
        strictly(1) || strictly(-1)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    type Whole = [i64; 3];

    fn minus(a: Whole, b: Whole) -> Whole {
        [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
    }

    fn cross(a: Whole, b: Whole) -> Whole {
        [0, 1, 2].map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            a[i] * b[j] - a[j] * b[i]
        })
    }

    /// Whether two triangles, or a segment and a triangle, with whole coordinates have a point in common, by another
    /// theorem: they are apart if and only if their shadows are on one of these axes.
    fn meet_by_axes(first: &[Whole], second: &[Whole]) -> bool {
        let sides = |figure: &[Whole]| -> Vec<Whole> {
            (0..figure.len()).map(|k| minus(figure[(k + 1) % figure.len()], figure[k])).collect()
        };
        let (own, others) = (sides(first), sides(second));
        let normal = cross(others[0], others[1]);
        let mut axes = vec![normal];
        if first.len() == 3 {
            let normal = cross(own[0], own[1]);
            axes.push(normal);
            axes.extend(own.iter().map(|&side| cross(normal, side)));
        }
        axes.extend(others.iter().chain(&own).map(|&side| cross(normal, side)));
        axes.extend(own.iter().flat_map(|&a| others.iter().map(move |&b| cross(a, b))));
        let shadow = |figure: &[Whole], axis: Whole| {
            let along = figure.iter().map(|p| p[0] * axis[0] + p[1] * axis[1] + p[2] * axis[2]);
            (along.clone().min().unwrap(), along.max().unwrap())
        };
        !axes.into_iter().any(|axis| {
            let (a, b) = (shadow(first, axis), shadow(second, axis));
            a.1 < b.0 || b.1 < a.0
        })
    }

    /// Whole numbers below a bound, the same in every run.
    struct Dice(u64);

    impl Dice {
        fn roll(&mut self, below: i64) -> i64 {
            self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((self.0 >> 33) % below as u64) as i64
        }

        fn triangle(&mut self, below: [i64; 3]) -> [Whole; 3] {
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
    fn triangles_on_a_lattice_meet_as_the_separating_axes_say() {
        let mut dice = Dice(7);
        // Small lattices have many that touch, share corners or lie in one plane.
        for (below, count) in
            [([2; 3], 20_000), ([3; 3], 50_000), ([4, 4, 1], 30_000), ([9; 3], 50_000)]
        {
            let (mut meeting, mut flat) = (0, 0);
            for _ in 0..count {
                let (first, second) = (dice.triangle(below), dice.triangle(below));
                let expected = meet_by_axes(&first, &second);
                // Exact in binary, so that the two questions are the same.
                let real = |whole: [Whole; 3]| whole.map(|p| p.map(|x| 0.125 * x as f64 - 1.0));
                let (a, b) = (real(first), real(second));
                assert_eq!(triangles_meet(a, b), expected, "{first:?} {second:?}");
                assert_eq!(triangles_meet(b, a), expected, "{second:?} {first:?}");
                assert_eq!(triangles_meet(turned(a), b), expected, "{first:?} {second:?}");
                let segment = [first[0], first[1]];
                let expected_of_segment = meet_by_axes(&segment, &second);
                assert_eq!(
                    segment_meets([a[0], a[1]], b),
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
        assert!(!triangles_meet(floor, above) && triangles_meet(floor, on));
    }
}
