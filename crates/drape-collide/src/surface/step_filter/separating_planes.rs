//! Planes that separate the two primitives of a pair, with all rounding bounded.

use crate::surface::distance::{Height, height};
use crate::surface::pair::{Pair, closest, distance};
use crate::vector::{Vector, dot, scale};

/// Bound of the deviation of a computed unit vector's length from 1.
const UNIT: f64 = 8.0 * f64::EPSILON;

/// Plane through the closest points of two primitives. The first primitive lies above it, the
/// second below.
///
/// The plane proves a distance, however it was found. The first primitive is the hull of vertices
/// at heights of at least `low`, the second the hull of vertices at heights of at most `high`. Both
/// bounds include all rounding.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SeparatingPlane {
    /// Unit normal to rounding, zero if the primitives touch.
    pub(crate) normal: Vector,
    /// Heights of the vertices over the first vertex, in m: lower bounds for the first primitive,
    /// upper bounds for the second.
    pub(crate) heights: [f64; 4],
    /// Lowest height of the first primitive, in m.
    pub(crate) low: f64,
    /// Highest height of the second primitive, in m.
    pub(crate) high: f64,
}

impl SeparatingPlane {
    /// Returns the plane of `pair` with its vertices at `points`, in m.
    pub(crate) fn new(pair: &Pair, points: [Vector; 4]) -> SeparatingPlane {
        let closest = closest(pair.kind, points);
        let distance = distance(&closest);
        let normal = if distance > 0.0 { scale(closest.offset, 1.0 / distance) } else { [0.0; 3] };
        let first = pair.first_vertex_count();

        // The error of each height counts against the distance.
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

    /// Returns a lower bound of the clearance: the distance above `min_separation`, in m. The bound
    /// is not above 0 if the plane proves no clearance.
    pub(crate) fn clearance(&self, min_separation: f64) -> f64 {
        let distance = (self.low - self.high) * (1.0 - UNIT - f64::EPSILON);
        distance - min_separation * (1.0 + f64::EPSILON)
    }

    /// Returns whether the heights `low` and `high` are surely `min_separation` apart, all in m.
    pub(crate) fn holds(low: f64, high: f64, min_separation: f64) -> bool {
        (low - high) * (1.0 - UNIT - f64::EPSILON) > min_separation * (1.0 + f64::EPSILON)
    }

    /// Returns for each vertex of `pair` its excess distance from the other primitive over the
    /// nearest vertex, in m.
    pub(crate) fn offsets(&self, pair: &Pair) -> [f64; 4] {
        let first = pair.first_vertex_count();
        std::array::from_fn(|k| {
            if k < first { self.heights[k] - self.low } else { self.high - self.heights[k] }
        })
    }

    /// Returns by how much each vertex of `pair` approaches the other primitive along its
    /// displacement in `displacements`, in m.
    pub(crate) fn approaches(&self, pair: &Pair, displacements: [Vector; 4]) -> [f64; 4] {
        let first = pair.first_vertex_count();
        std::array::from_fn(|k| {
            let speed = dot(self.normal, displacements[k]);
            if k < first { -speed } else { speed }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PairKind;

    #[test]
    fn heights_hold_only_where_all_rounding_leaves_the_separation() {
        let separation = 0.25;
        assert!(!SeparatingPlane::holds(0.0, 0.0, 0.0));
        assert!(!SeparatingPlane::holds(0.5, 0.25, separation));
        // The unit vector and the product may each be off by some last places, the separation by
        // one.
        assert!(!SeparatingPlane::holds(separation * (1.0 + 9.0 * f64::EPSILON), 0.0, separation));
        assert!(SeparatingPlane::holds(separation * (1.0 + 12.0 * f64::EPSILON), 0.0, separation));
    }

    #[test]
    fn the_clearance_is_rounded_down() {
        let plane = |low, high| SeparatingPlane { normal: [0.0; 3], heights: [0.0; 4], low, high };
        assert_eq!(plane(1.0, 0.0).clearance(0.0), 1.0 - UNIT - f64::EPSILON);
        assert_eq!(plane(0.0, 0.0).clearance(1.0), -1.0 - f64::EPSILON);
        let found = plane(0.75, 0.25).clearance(0.125);
        assert!((found - 0.375).abs() < 1e-14 && found < 0.375, "{found}");
    }

    #[test]
    fn offsets_are_distances_from_the_nearest_vertex_of_a_primitive() {
        let plane = SeparatingPlane {
            normal: [0.0, 0.0, 1.0],
            heights: [3.0, 5.0, -2.0, 1.0],
            low: 3.0,
            high: 1.0,
        };
        let pair = |kind| Pair {
            kind,
            features: [0, 1],
            vertices: [0, 1, 2, 3],
            activation_distance: 1.0,
            min_separation: 0.1,
            area: 1.0,
            parallel: 0.0,
            distance: 2.0,
        };
        assert_eq!(plane.offsets(&pair(PairKind::EdgeEdge)), [0.0, 2.0, 3.0, 0.0]);
        let plane = SeparatingPlane { heights: [3.0, 1.0, -2.0, 0.5], ..plane };
        assert_eq!(plane.offsets(&pair(PairKind::VertexFace)), [0.0, 0.0, 3.0, 0.5]);
        let down = [0.0, 0.0, -1.5];
        let approaches = plane.approaches(&pair(PairKind::EdgeEdge), [down; 4]);
        assert_eq!(approaches, [1.5, 1.5, -1.5, -1.5]);
    }
}
