//! Planes that separate the two primitives of a pair, with all rounding.

use crate::surface::distance::{Height, height};
use crate::surface::pair::{Pair, closest, distance};
use crate::vector::{Vector, dot, scale};

/// Bound of the deviation of a computed unit vector's length from 1.
const UNIT: f64 = 8.0 * f64::EPSILON;

/// Plane through the closest points of two primitives: one above, one below.
///
/// It proves their distance, however it was found: the first primitive is the hull of vertices that
/// are all at least at `low`, the second of vertices that are all at most at `high`. Both are
/// bounds with all rounding.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SeparatingPlane {
    /// Unit normal to rounding; zero if the two touch.
    pub(crate) normal: Vector,
    /// Lower bounds of the heights of the first primitive's vertices over the first of them, and
    /// upper bounds of those of the second's, in m.
    pub(crate) heights: [f64; 4],
    /// Lowest of the first primitive's heights, in m.
    pub(crate) low: f64,
    /// Highest of the second's heights, in m.
    pub(crate) high: f64,
}

impl SeparatingPlane {
    /// Plane of a pair at the positions of its vertices.
    pub(crate) fn new(pair: &Pair, points: [Vector; 4]) -> SeparatingPlane {
        let closest = closest(pair.kind, points);
        let distance = distance(&closest);
        let normal = if distance > 0.0 { scale(closest.offset, 1.0 / distance) } else { [0.0; 3] };
        let first = pair.first_vertices();
        let mut heights = [0.0; 4];
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (k, point) in points.into_iter().enumerate() {
            let Height { value, error } = height(normal, point, points[0]);
            if k < first {
                heights[k] = value - error;
                low = low.min(heights[k]);
            } else {
                heights[k] = value + error;
                high = high.max(heights[k]);
            }
        }
        SeparatingPlane { normal, heights, low, high }
    }

    /// Returns a lower bound of the clearance, the distance above the minimum separation, in m; not
    /// above 0 if the plane proves none.
    pub(crate) fn clearance(&self, min_separation: f64) -> f64 {
        let distance = (self.low - self.high) * (1.0 - UNIT - f64::EPSILON);
        distance - min_separation * (1.0 + f64::EPSILON)
    }

    /// Returns whether two heights are surely apart by the minimum separation.
    pub(crate) fn holds(low: f64, high: f64, min_separation: f64) -> bool {
        (low - high) * (1.0 - UNIT - f64::EPSILON) > min_separation * (1.0 + f64::EPSILON)
    }

    /// Returns by how much each vertex is farther from the other primitive than the nearest, in m.
    pub(crate) fn offsets(&self, pair: &Pair) -> [f64; 4] {
        let first = pair.first_vertices();
        std::array::from_fn(|k| {
            if k < first { self.heights[k] - self.low } else { self.high - self.heights[k] }
        })
    }

    /// Returns by how much each vertex approaches the other primitive for displacements, in m.
    pub(crate) fn approaches(&self, pair: &Pair, displacements: [Vector; 4]) -> [f64; 4] {
        let first = pair.first_vertices();
        std::array::from_fn(|k| {
            let speed = dot(self.normal, displacements[k]);
            if k < first { -speed } else { speed }
        })
    }
}
