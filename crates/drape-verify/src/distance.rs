//! Distances by plain formulas: each is that of two points which lie on the two, so never less than the true one
//! but for rounding.

type Place = [f64; 3];

fn minus(a: Place, b: Place) -> Place {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The point of a line through two at a part of the way.
fn between(a: Place, b: Place, part: f64) -> Place {
    [0, 1, 2].map(|axis| a[axis] + part * (b[axis] - a[axis]))
}

/// A pair of points, with the square of their distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Nearest {
    pub(crate) squared: f64,
    pub(crate) points: [Place; 2],
}

impl Nearest {
    const NONE: Nearest = Nearest { squared: f64::INFINITY, points: [[f64::NAN; 3]; 2] };

    fn of(a: Place, b: Place) -> Nearest {
        let way = minus(a, b);
        Nearest { squared: dot(way, way), points: [a, b] }
    }

    fn or(self, other: Nearest) -> Nearest {
        if other.squared < self.squared { other } else { self }
    }

    /// In m.
    pub(crate) fn distance(&self) -> f64 {
        self.squared.sqrt()
    }
}

/// A point and a segment: the foot of the perpendicular, or an end.
fn point_segment(point: Place, [a, b]: [Place; 2]) -> Nearest {
    let along = minus(b, a);
    let part = (dot(minus(point, a), along) / dot(along, along)).clamp(0.0, 1.0);
    let part = if part.is_nan() { 0.0 } else { part };
    Nearest::of(point, between(a, b, part))
}

/// A point and a triangle: the foot of the perpendicular where it is inside, or a point of a side.
fn point_triangle(point: Place, [a, b, c]: [Place; 3]) -> Nearest {
    let mut nearest = Nearest::NONE;
    for side in [[a, b], [b, c], [c, a]] {
        nearest = nearest.or(point_segment(point, side));
    }
    // The normal equations of |a + u (b - a) + v (c - a) - point|².
    let (e, f, g) = (minus(b, a), minus(c, a), minus(point, a));
    let (ee, ef, ff, eg, fg) = (dot(e, e), dot(e, f), dot(f, f), dot(e, g), dot(f, g));
    let determinant = ee * ff - ef * ef;
    let (u, v) = ((ff * eg - ef * fg) / determinant, (ee * fg - ef * eg) / determinant);
    // Written so that NaN is outside.
    if u >= 0.0 && v >= 0.0 && u + v <= 1.0 {
        let foot = [0, 1, 2].map(|axis| a[axis] + u * e[axis] + v * f[axis]);
        nearest = nearest.or(Nearest::of(point, foot));
    }
    nearest
}

/// Two segments: where their lines are nearest if both points are inside, or an end and a point of the other.
fn segment_segment([a, b]: [Place; 2], [c, d]: [Place; 2]) -> Nearest {
    let swapped =
        |nearest: Nearest| Nearest { points: [nearest.points[1], nearest.points[0]], ..nearest };
    let mut nearest = point_segment(a, [c, d]).or(point_segment(b, [c, d]));
    nearest = nearest.or(swapped(point_segment(c, [a, b])));
    nearest = nearest.or(swapped(point_segment(d, [a, b])));
    let (e, f, g) = (minus(b, a), minus(d, c), minus(c, a));
    let (ee, ef, ff, eg, fg) = (dot(e, e), dot(e, f), dot(f, f), dot(e, g), dot(f, g));
    let determinant = ee * ff - ef * ef;
    let (s, t) = ((eg * ff - fg * ef) / determinant, (eg * ef - fg * ee) / determinant);
    let inside = |part: f64| (0.0..=1.0).contains(&part);
    if inside(s) && inside(t) {
        nearest = nearest.or(Nearest::of(between(a, b, s), between(c, d, t)));
    }
    nearest
}

/// A vertex as what is sewn to it has it too.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Vertex {
    pub(crate) number: u32,
    /// The numbers of the two vertices between which it lies, if it is sewn there.
    pub(crate) between: Option<[u32; 2]>,
}

/// The places of a triangle's corners, in m, and its vertices.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Figure {
    pub(crate) corners: [Place; 3],
    pub(crate) vertices: [Vertex; 3],
}

/// The sides of a triangle, by the numbers of its corners.
pub(crate) const SIDES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// Whether corners, sides or triangles are joined: they share a vertex, or a vertex of one lies on a side of the other.
pub(crate) fn joined(one: &[Vertex], other: &[Vertex]) -> bool {
    let has = |all: &[Vertex], number: u32| all.iter().any(|vertex| vertex.number == number);
    let on = |vertex: &Vertex, all: &[Vertex]| {
        has(all, vertex.number) || vertex.between.is_some_and(|[a, b]| has(all, a) && has(all, b))
    };
    one.iter().any(|vertex| on(vertex, other)) || other.iter().any(|vertex| on(vertex, one))
}

/// The nearest points of all corners and sides of one triangle with the other and its sides to which they are not joined.
///
/// For triangles that are not joined and do not meet it is their distance.
pub(crate) fn triangles_apart(one: Figure, other: Figure) -> Nearest {
    let Figure { corners: first, vertices: own } = one;
    let Figure { corners: second, vertices: others } = other;
    let mut nearest = Nearest::NONE;
    for k in 0..3 {
        if !joined(&own[k..=k], &others) {
            nearest = nearest.or(point_triangle(first[k], second));
        }
        if !joined(&others[k..=k], &own) {
            nearest = nearest.or(point_triangle(second[k], first));
        }
    }
    for side in SIDES {
        for other in SIDES {
            if !joined(&side.map(|k| own[k]), &other.map(|k| others[k])) {
                let segments = (side.map(|k| first[k]), other.map(|k| second[k]));
                nearest = nearest.or(segment_segment(segments.0, segments.1));
            }
        }
    }
    nearest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(corners: [Place; 3], numbers: [u32; 3]) -> Figure {
        Figure { corners, vertices: numbers.map(|number| Vertex { number, between: None }) }
    }

    #[test]
    fn the_distance_is_that_of_the_nearest_of_many_points() {
        let mut state = 3_u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as f64 / (1_u64 << 31) as f64
        };
        let mut worst = 0.0_f64;
        for _ in 0..200 {
            let mut triangle = |x: f64| [(); 3].map(|()| [x + random(), random(), random()]);
            let (first, second) = (triangle(0.0), triangle(1.2));
            let found =
                triangles_apart(figure(first, [0, 1, 2]), figure(second, [3, 4, 5])).distance();
            // Points of a grid on both, then of ever finer grids about the nearest.
            let at = |t: &[Place; 3], [u, v]: [f64; 2]| {
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
                        let way = minus(at(&first, [u, v]), at(&second, [s, t]));
                        if dot(way, way).sqrt() < best.1 {
                            best = ([[u, v], [s, t]], dot(way, way).sqrt());
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
    fn what_shares_a_vertex_counts_by_the_rest() {
        // A square folded along its diagonal, so that the far corners are 0.1 apart.
        let (a, b) = ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
        let folded = triangles_apart(
            figure([a, b, [0.5, 0.0, 1.0]], [0, 1, 2]),
            figure([b, a, [0.5, 0.1, 1.0]], [1, 0, 3]),
        );
        // Two sides whose lines are nearest just below the far corners: (1, 0, 0) along their common normal.
        let expected = 0.1 / (0.01_f64 + 1.0 + 0.0025).sqrt();
        assert!((folded.distance() - expected).abs() < 1e-12, "{}", folded.distance());
    }
}
