//! Closest points of a vertex and a triangle, and of two edges.

use crate::vector::{Vector, add, cross, dot, scale, subtract};

/// Squared sine of an angle above which the direct solution is exact to rounding.
///
/// Below it, of a sliver or of nearly parallel edges, all candidates are compared: three times the
/// work, for few pairs.
const WELL_SHAPED: f64 = 1e-10;

/// Squared sine below which a triangle is a line, and two edges are parallel.
///
/// The cross product is then mostly rounding. What a line leaves out of a triangle is 1e-15 of its
/// length.
const DEGENERATE: f64 = 1e-30;

/// Closest points of two primitives, as weights of their four vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Closest {
    /// Offset `$p = \sum w_i x_i$` from one closest point to the other, in m.
    pub(crate) offset: Vector,
    /// Weights `$w_i$`: those of the primitive to which the offset leads sum to 1, the others to
    /// -1.
    pub(crate) weights: [f64; 4],
    /// Edges along which the closest points slide as the vertices move: weight passes from the
    /// first vertex to the second. Only `sliding` of them count.
    pub(crate) slides: [[u8; 2]; 2],
    /// Number of edges along which the closest points slide.
    pub(crate) sliding: usize,
}

impl Closest {
    fn square(&self) -> f64 {
        dot(self.offset, self.offset)
    }

    fn nearer(self, other: Closest) -> Closest {
        // NaN is passed on.
        if other.square() >= self.square() { self } else { other }
    }
}

/// Point of a segment.
#[derive(Clone, Copy)]
struct OnSegment {
    point: Vector,
    /// Fraction `$t$` of the segment.
    fraction: f64,
}

/// Returns the point `$a + t (b - a)$` of a segment nearest to the origin.
fn to_segment(a: Vector, b: Vector) -> OnSegment {
    let along = subtract(b, a);
    let square = dot(along, along);
    let fraction = if square > 0.0 { (-dot(a, along) / square).clamp(0.0, 1.0) } else { 0.0 };
    // From the nearer end, so that the far end is met exactly.
    let point = if fraction <= 0.5 {
        add(a, scale(along, fraction))
    } else {
        subtract(b, scale(along, 1.0 - fraction))
    };
    OnSegment { point, fraction }
}

/// Returns the closest points of a vertex and a triangle; the offset leads from the triangle.
///
/// The four points are the vertex and the corners. The nearest point lies inside the triangle or on
/// an edge that the vertex is beyond (Voronoi regions, \[Eri05\], §5.1.5); for a sliver all are
/// compared.
pub(crate) fn vertex_face([p, a, b, c]: [Vector; 4]) -> Closest {
    let corners = [subtract(p, a), subtract(p, b), subtract(p, c)];
    let (ab, ac) = (subtract(b, a), subtract(c, a));
    let normal = cross(ab, ac);
    let square = dot(normal, normal);
    let size = dot(ab, ab) * dot(ac, ac);
    let well_shaped = square > WELL_SHAPED * size;
    let mut best: Option<Closest> = None;
    let mut beyond = [true; 3];
    if square > DEGENERATE * size {
        let fractions =
            [1, 2, 0].map(|k: usize| dot(normal, cross(corners[k], corners[(k + 1) % 3])) / square);
        beyond = fractions.map(|fraction| !(fraction > 0.0));
        if beyond == [false; 3] {
            let total = fractions[0] + fractions[1] + fractions[2];
            let fractions = fractions.map(|fraction| fraction / total);
            let offset =
                subtract(corners[0], add(scale(ab, fractions[1]), scale(ac, fractions[2])));
            best = Some(Closest {
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
    for (corner, beyond) in beyond.into_iter().enumerate() {
        if beyond {
            let ends = [(corner + 1) % 3, (corner + 2) % 3];
            let OnSegment { point: offset, fraction } =
                to_segment(corners[ends[0]], corners[ends[1]]);
            let mut weights = [1.0, 0.0, 0.0, 0.0];
            weights[1 + ends[0]] = fraction - 1.0;
            weights[1 + ends[1]] = -fraction;
            let inside = fraction > 0.0 && fraction < 1.0;
            let slide = [1 + ends[0] as u8, 1 + ends[1] as u8];
            let candidate =
                Closest { offset, weights, slides: [slide; 2], sliding: usize::from(inside) };
            best = Some(best.map_or(candidate, |best| best.nearer(candidate)));
        }
    }
    best.unwrap_or(NONE)
}

/// Returns the closest points of two edges; the offset leads from the second to the first.
///
/// The four points are the ends of the first and of the second. Fractions are clamped (\[Eri05\],
/// §5.1.9); of nearly parallel edges all candidates are compared.
pub(crate) fn edge_edge([p0, p1, q0, q1]: [Vector; 4]) -> Closest {
    let (along, other, gap) = (subtract(p1, p0), subtract(q1, q0), subtract(p0, q0));
    let [aa, bb] = [dot(along, along), dot(other, other)];
    let normal = cross(along, other);
    let square = dot(normal, normal);
    if square > WELL_SHAPED * aa * bb {
        let [ab, ag, bg] = [dot(along, other), dot(along, gap), dot(other, gap)];
        // Lagrange's identity: b·a b·g - a·g b·b, without its cancellation.
        let mut s = (dot(normal, cross(other, gap)) / square).clamp(0.0, 1.0);
        let mut t = (ab * s + bg) / bb;
        if t < 0.0 {
            (s, t) = ((-ag / aa).clamp(0.0, 1.0), 0.0);
        } else if t > 1.0 {
            (s, t) = (((ab - ag) / aa).clamp(0.0, 1.0), 1.0);
        }
        return on_edges([along, other, gap], [s, t]);
    }
    let mut best = NONE;
    if square > DEGENERATE * aa * bb {
        let s = dot(normal, cross(other, gap)) / square;
        let t = dot(normal, cross(along, gap)) / square;
        if s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0 {
            best = on_edges([along, other, gap], [s, t]);
        }
    }
    let ends = [gap, subtract(p1, q0), subtract(p0, q1), subtract(p1, q1)];
    for (k, [from, to]) in [[0, 2], [1, 3]].into_iter().enumerate() {
        // The end k of the first edge against the second, whose offsets from it are negative.
        let OnSegment { point: offset, fraction: t } = to_segment(ends[from], ends[to]);
        let weights = [1.0 - k as f64, k as f64, t - 1.0, -t];
        best = best.nearer(on_one(offset, weights, [2, 3], t));
    }
    for (k, [from, to]) in [[0, 1], [2, 3]].into_iter().enumerate() {
        let OnSegment { point: offset, fraction: s } = to_segment(ends[from], ends[to]);
        let weights = [1.0 - s, s, k as f64 - 1.0, -(k as f64)];
        best = best.nearer(on_one(offset, weights, [0, 1], s));
    }
    best
}

/// Returns the points at given fractions of two edges.
fn on_edges([along, other, gap]: [Vector; 3], [s, t]: [f64; 2]) -> Closest {
    let offset = add(gap, subtract(scale(along, s), scale(other, t)));
    let (inside, other_inside) = (s > 0.0 && s < 1.0, t > 0.0 && t < 1.0);
    Closest {
        offset,
        weights: [1.0 - s, s, t - 1.0, -t],
        slides: if inside { [[0, 1], [2, 3]] } else { [[2, 3]; 2] },
        sliding: usize::from(inside) + usize::from(other_inside),
    }
}

/// Returns an end of an edge, and a point of the other edge at a fraction of it.
fn on_one(offset: Vector, weights: [f64; 4], slide: [u8; 2], fraction: f64) -> Closest {
    let sliding = usize::from(fraction > 0.0 && fraction < 1.0);
    Closest { offset, weights, slides: [slide; 2], sliding }
}

/// Points farther apart than any.
const NONE: Closest =
    Closest { offset: [f64::INFINITY; 3], weights: [0.0; 4], slides: [[0; 2]; 2], sliding: 0 };
