use crate::pair::{Pair, closest};
use crate::vector::{Vector, dot, scale};

/// Bound of the relative error of a dot product of differences, in terms of the sum of the sizes.
///
/// The difference, the product and two sums round once each, by half of EPSILON: 2 EPSILON and
/// terms of second order; the rest is for the rounding of the bound itself.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Bound of how far a computed unit vector's length is from 1.
const UNIT: f64 = 8.0 * f64::EPSILON;

/// Height `$n \cdot (x - o)$` of a point over a place along a direction, and a bound of its error.
pub(crate) fn height(normal: Vector, point: Vector, origin: Vector) -> (f64, f64) {
    let terms: Vector = std::array::from_fn(|k| normal[k] * (point[k] - origin[k]));
    let size = terms[0].abs() + terms[1].abs() + terms[2].abs();
    // Products below the normal numbers may lose all their digits.
    (terms[0] + terms[1] + terms[2], ROUNDING * size + f64::MIN_POSITIVE)
}

/// Two primitives seen along the way between their closest points: one above, one below.
///
/// A plane between them proves how far they are apart, by whatever way it was found: the first
/// primitive is the hull of vertices that are all at least at `low`, the second of vertices that
/// are all at most at `high`. Both are bounds with all rounding.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slab {
    /// Of length 1 to rounding; zero if the two touch.
    pub(crate) normal: Vector,
    /// Sure lower bounds of the heights of the first primitive's vertices over the first of them,
    /// and sure upper ones of the second's, in m.
    pub(crate) heights: [f64; 4],
    /// The lowest of the first primitive's.
    pub(crate) low: f64,
    /// The highest of the second's.
    pub(crate) high: f64,
}

impl Slab {
    pub(crate) fn new(pair: &Pair, places: [Vector; 4]) -> Slab {
        let way = closest(pair.kind, places).way;
        let distance = dot(way, way).sqrt();
        let normal = if distance > 0.0 { scale(way, 1.0 / distance) } else { [0.0; 3] };
        let first = pair.first();
        let mut heights = [0.0; 4];
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (k, place) in places.into_iter().enumerate() {
            let (value, error) = height(normal, place, places[0]);
            if k < first {
                heights[k] = value - error;
                low = low.min(heights[k]);
            } else {
                heights[k] = value + error;
                high = high.max(heights[k]);
            }
        }
        Slab { normal, heights, low, high }
    }

    /// A sure lower bound of the distance above the min_separation, in m; not above 0 if there is none.
    pub(crate) fn opening(&self, min_separation: f64) -> f64 {
        let distance = (self.low - self.high) * (1.0 - UNIT - f64::EPSILON);
        distance - min_separation * (1.0 + f64::EPSILON)
    }

    /// Whether a sum of the heights' sides keeps two planes apart by the min_separation.
    pub(crate) fn holds(low: f64, high: f64, min_separation: f64) -> bool {
        (low - high) * (1.0 - UNIT - f64::EPSILON) > min_separation * (1.0 + f64::EPSILON)
    }

    /// Speeds at which the vertices approach the other primitive, for displacements in m.
    pub(crate) fn approaches(&self, pair: &Pair, displacements: [Vector; 4]) -> [f64; 4] {
        let first = pair.first();
        std::array::from_fn(|k| {
            let speed = dot(self.normal, displacements[k]);
            if k < first { -speed } else { speed }
        })
    }
}

/// The planes that one pair's vertices must stay on their sides of.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Planes {
    pub(crate) normal: Vector,
    /// Where heights are counted from.
    pub(crate) origin: Vector,
    /// The first primitive's vertices stay at least this high, in m.
    pub(crate) low: f64,
    /// The second's stay at most this high, in m.
    pub(crate) high: f64,
}

impl Planes {
    /// Of a pair that needs none: nothing is below the one or above the other.
    pub(crate) const NONE: Planes =
        Planes { normal: [0.0; 3], origin: [0.0; 3], low: f64::NEG_INFINITY, high: f64::INFINITY };

    pub(crate) fn is_none(&self) -> bool {
        self.low == f64::NEG_INFINITY
    }

    /// Which of the pair's vertices are surely on their side.
    pub(crate) fn keep(&self, pair: &Pair, places: [Vector; 4]) -> [bool; 4] {
        let first = pair.first();
        std::array::from_fn(|k| {
            let (value, error) = height(self.normal, places[k], self.origin);
            // Written so that NaN fails.
            if k < first { value - error >= self.low } else { value + error <= self.high }
        })
    }
}
