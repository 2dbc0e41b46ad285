//! Closest points of a vertex and a triangle, and of two edges.

use crate::vector::{Vector, add, cross, dot, scale, subtract};

/// Squared sine of an angle above which the direct solution is exact to rounding.
///
/// Below it, for slivers and nearly parallel edges, all candidates are compared. That is three
/// times the work, for few pairs.
const WELL_SHAPED: f64 = 1e-10;

/// Squared sine below which a triangle is a line, and two edges are parallel.
///
/// The cross product is then mostly rounding. Taking such a triangle for a line changes distances
/// by 1e-15 of its length.
const DEGENERATE: f64 = 1e-30;

/// Closest points of two primitives, as weights of their four vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ClosestPoints {
    /// Offset `$p = \sum w_i x_i$` from one closest point to the other, in m.
    pub(crate) offset: Vector,
    /// Weights `$w_i$`. The weights of the primitive to which the offset leads sum to 1, the others
    /// to -1.
    pub(crate) weights: [f64; 4],
    /// Edges along which the closest points slide as the vertices move: weight passes from the
    /// first vertex to the second. Only the first `sliding` entries count.
    pub(crate) slides: [[u8; 2]; 2],
    /// Number of edges along which the closest points slide.
    pub(crate) sliding: usize,
}

impl ClosestPoints {
    /// Returns the squared distance, in m².
    fn square(&self) -> f64 {
        dot(self.offset, self.offset)
    }

    /// Returns the nearer of `self` and `candidate`. A candidate of NaN wins, so NaN is passed on.
    fn nearer(self, candidate: ClosestPoints) -> ClosestPoints {
        if candidate.square() >= self.square() { self } else { candidate }
    }
}

/// Point of a segment.
#[derive(Clone, Copy)]
struct SegmentPoint {
    point: Vector,
    /// Fraction `$t$` of the segment's length.
    fraction: f64,
}

/// Returns the point `$a + t (b - a)$` of a segment nearest to the origin.
fn nearest_to_origin(a: Vector, b: Vector) -> SegmentPoint {
    let along = subtract(b, a);
    let square = dot(along, along);
    let fraction = if square > 0.0 { (-dot(a, along) / square).clamp(0.0, 1.0) } else { 0.0 };
    // The point is computed from the nearer end, so that either end is met exactly.
    let point = if fraction <= 0.5 {
        add(a, scale(along, fraction))
    } else {
        subtract(b, scale(along, 1.0 - fraction))
    };
    SegmentPoint { point, fraction }
}

/// Returns the [`ClosestPoints`] of a vertex and a triangle. The offset leads from the triangle to
/// the vertex.
///
/// The four points are the vertex and the corners. The nearest point lies inside the triangle or on
/// an edge that the vertex is beyond (Voronoi regions, \[Eri05\], §5.1.5). For a sliver all
/// candidates are compared.
pub(crate) fn vertex_face([p, a, b, c]: [Vector; 4]) -> ClosestPoints {
    let corners = [subtract(p, a), subtract(p, b), subtract(p, c)];
    let (ab, ac) = (subtract(b, a), subtract(c, a));
    let normal = cross(ab, ac);
    let square = dot(normal, normal);
    let size = dot(ab, ab) * dot(ac, ac);
    let well_shaped = square > WELL_SHAPED * size;
    let mut best: Option<ClosestPoints> = None;

    // Barycentric coordinates of the foot of the vertex decide which edges it is beyond.
    let mut beyond = [true; 3];
    if square > DEGENERATE * size {
        let areas =
            [1, 2, 0].map(|k: usize| dot(normal, cross(corners[k], corners[(k + 1) % 3])) / square);
        beyond = areas.map(|fraction| !(fraction > 0.0));
        if beyond == [false; 3] {
            let total = areas[0] + areas[1] + areas[2];
            let fractions = areas.map(|fraction| fraction / total);
            let offset =
                subtract(corners[0], add(scale(ab, fractions[1]), scale(ac, fractions[2])));
            best = Some(ClosestPoints {
                offset,
                weights: [1.0, -fractions[0], -fractions[1], -fractions[2]],
                slides: [[1, 2], [1, 3]],
                sliding: 2,
            });
        }
        if !well_shaped {
            beyond = [true; 3];
        }
    }

    // The nearest point of each of these edges is a candidate.
    for (corner, beyond) in beyond.into_iter().enumerate() {
        if beyond {
            let ends = [(corner + 1) % 3, (corner + 2) % 3];
            let SegmentPoint { point: offset, fraction } =
                nearest_to_origin(corners[ends[0]], corners[ends[1]]);
            let mut weights = [1.0, 0.0, 0.0, 0.0];
            weights[1 + ends[0]] = fraction - 1.0;
            weights[1 + ends[1]] = -fraction;
            let is_inside = fraction > 0.0 && fraction < 1.0;
            let slide = [1 + ends[0] as u8, 1 + ends[1] as u8];
            let candidate = ClosestPoints {
                offset,
                weights,
                slides: [slide; 2],
                sliding: usize::from(is_inside),
            };
            best = Some(best.map_or(candidate, |best| best.nearer(candidate)));
        }
    }
    best.unwrap_or(INFINITELY_FAR)
}

/// Returns the [`ClosestPoints`] of two edges. The offset leads from the second edge to the first.
///
/// The four points are the ends of the first edge and of the second. Fractions are clamped
/// (\[Eri05\], §5.1.9). For nearly parallel edges all candidates are compared.
pub(crate) fn edge_edge([p0, p1, q0, q1]: [Vector; 4]) -> ClosestPoints {
    let (first, second, gap) = (subtract(p1, p0), subtract(q1, q0), subtract(p0, q0));
    let [aa, bb] = [dot(first, first), dot(second, second)];
    let normal = cross(first, second);
    let square = dot(normal, normal);

    // The closest points of the two lines, clamped to the edges.
    if square > WELL_SHAPED * aa * bb {
        let [ab, ag, bg] = [dot(first, second), dot(first, gap), dot(second, gap)];
        // Lagrange's identity gives b·a b·g - a·g b·b without its cancellation.
        let mut s = (dot(normal, cross(second, gap)) / square).clamp(0.0, 1.0);
        let mut t = (ab * s + bg) / bb;
        if t < 0.0 {
            (s, t) = ((-ag / aa).clamp(0.0, 1.0), 0.0);
        } else if t > 1.0 {
            (s, t) = (((ab - ag) / aa).clamp(0.0, 1.0), 1.0);
        }
        return inside_edges([first, second, gap], [s, t]);
    }

    // Nearly parallel edges: inner points, if they are resolved, compete with the four ends.
    let mut best = INFINITELY_FAR;
    if square > DEGENERATE * aa * bb {
        let s = dot(normal, cross(second, gap)) / square;
        let t = dot(normal, cross(first, gap)) / square;
        if s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0 {
            best = inside_edges([first, second, gap], [s, t]);
        }
    }
    let ends = [gap, subtract(p1, q0), subtract(p0, q1), subtract(p1, q1)];
    for (k, [from, to]) in [[0, 2], [1, 3]].into_iter().enumerate() {
        // End k of the first edge against the second edge. The offsets lead to end k.
        let SegmentPoint { point: offset, fraction: t } = nearest_to_origin(ends[from], ends[to]);
        let weights = [1.0 - k as f64, k as f64, t - 1.0, -t];
        best = best.nearer(at_end(offset, weights, [2, 3], t));
    }
    for (k, [from, to]) in [[0, 1], [2, 3]].into_iter().enumerate() {
        let SegmentPoint { point: offset, fraction: s } = nearest_to_origin(ends[from], ends[to]);
        let weights = [1.0 - s, s, k as f64 - 1.0, -(k as f64)];
        best = best.nearer(at_end(offset, weights, [0, 1], s));
    }
    best
}

/// Returns the points at the fractions `s` and `t` of two edges, as [`ClosestPoints`].
fn inside_edges([first, second, gap]: [Vector; 3], [s, t]: [f64; 2]) -> ClosestPoints {
    let offset = add(gap, subtract(scale(first, s), scale(second, t)));
    let (first_inside, second_inside) = (s > 0.0 && s < 1.0, t > 0.0 && t < 1.0);
    ClosestPoints {
        offset,
        weights: [1.0 - s, s, t - 1.0, -t],
        slides: if first_inside { [[0, 1], [2, 3]] } else { [[2, 3]; 2] },
        sliding: usize::from(first_inside) + usize::from(second_inside),
    }
}

/// Returns an end of one edge with the point at `fraction` of the other, as [`ClosestPoints`].
fn at_end(offset: Vector, weights: [f64; 4], slide: [u8; 2], fraction: f64) -> ClosestPoints {
    let sliding = usize::from(fraction > 0.0 && fraction < 1.0);
    ClosestPoints { offset, weights, slides: [slide; 2], sliding }
}

/// Points at an infinite distance, farther apart than any candidate.
const INFINITELY_FAR: ClosestPoints = ClosestPoints {
    offset: [f64::INFINITY; 3],
    weights: [0.0; 4],
    slides: [[0; 2]; 2],
    sliding: 0,
};
