//! First contact of two primitives whose vertices move straight.
//!
//! Two proofs of separation take turns, each from the time that the other has reached:
//!
//! - a plane between the closest points. Heights of vertices over a plane of constant normal are
//!   linear in time, so the plane separates until the first two heights meet. This is conservative
//!   advancement \[Mir96\] with the heights in place of a bound of the speeds,
//! - the volume of the four vertices ([`Coplanarity`]). Primitives do not touch while it has one
//!   sign.
//!
//! All rounding counts against a proof, so no contact is missed.

use super::boxes::Window;
use super::coplanarity::Coplanarity;
use crate::surface::{ClosestPoints, PairKind, closest, height};
use crate::vector::{Vector, add, cross, dot, norm, scale, subtract};

/// Distance at which two primitives count as touching, in units of the last place of their largest
/// coordinate. A point on a motion is rounded by two units, and a root by some ten.
const TOUCHING: f64 = 64.0 * f64::EPSILON;

/// Largest number of rounds. Most pairs need one to three. Primitives that slide along each other
/// at some rounding errors' distance could need millions, and count as touching after this number.
const ROUNDS: usize = 10_000;

/// Relative rounding of a time at which two heights meet, with room.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Offset in units of the touching distance from which its direction has three digits.
const DIRECTED: f64 = 1e4;

/// Two primitives with their vertices at the start and at the end of a motion, in m.
#[derive(Debug, Clone, Copy)]
pub(super) struct PairMotion {
    pub(super) kind: PairKind,
    pub(super) start: [Vector; 4],
    pub(super) end: [Vector; 4],
}

/// Range of times in which a contact is searched, and how exactly.
#[derive(Debug, Clone, Copy)]
pub(super) struct Search {
    /// Window outside of which the primitives are surely apart.
    pub(super) window: Window,
    /// Time at which a contact, like every later contact, is of no interest.
    pub(super) limit: f64,
    /// Largest time by which the result may precede the contact.
    pub(super) tolerance: f64,
}

impl PairMotion {
    /// Returns a time before which the primitives surely do not touch, and within the tolerance of
    /// which they do, or `None` if they do not touch before the limit of `search`.
    ///
    /// Two primitives touch if their distance is below [`TOUCHING`].
    pub(super) fn first_contact(&self, search: Search) -> Option<f64> {
        let Search { window, limit, tolerance } = search;
        let touching = self.touching_distance();
        let cubic = Coplanarity::new(self.start, self.end);
        let mut time = window.entry;
        for _ in 0..ROUNDS {
            if time >= limit {
                return None;
            }
            let closest = self.closest(time);
            let distance = norm(closest.offset);
            // A distance of NaN counts as touching.
            if !(distance > touching) {
                return Some(time);
            }

            let by_plane = self.plane_exit(scale(closest.offset, 1.0 / distance), time);
            if by_plane >= window.exit {
                return None;
            }
            let separation = cubic.separation(by_plane, window.exit, tolerance);
            if separation.until >= window.exit {
                return None;
            }

            // A root is a contact if the primitives, and not only their planes, touch there.
            if let Some(root) = separation.root
                && root - separation.until <= tolerance
                && norm(self.closest(root).offset) <= touching
            {
                return (separation.until < limit).then_some(separation.until);
            }
            time = separation.until;
        }
        Some(time)
    }

    /// Returns the distance below which the primitives count as touching, in m.
    fn touching_distance(&self) -> f64 {
        let coordinates = self.start.iter().chain(&self.end).flatten();
        TOUCHING * coordinates.fold(0.0, |largest: f64, coordinate| largest.max(coordinate.abs()))
    }

    /// Returns the positions of the vertices at `time`, in m.
    fn points(&self, time: f64) -> [Vector; 4] {
        std::array::from_fn(|k| add(scale(self.start[k], 1.0 - time), scale(self.end[k], time)))
    }

    /// Returns the [`ClosestPoints`] at `time`.
    fn closest(&self, time: f64) -> ClosestPoints {
        closest(self.kind, self.points(time))
    }

    /// Returns the time until which a plane with the unit `normal`, from the second primitive to
    /// the first, surely separates them, beginning at `time`. It is `time` if nothing is proved.
    fn plane_exit(&self, normal: Vector, time: f64) -> f64 {
        let first = self.kind.first_vertex_count();
        let mut exit = f64::INFINITY;
        for i in 0..first {
            for j in first..4 {
                let [start, end] = [&self.start, &self.end].map(|points| {
                    let height = height(normal, points[i], points[j]);
                    height.value - height.error
                });
                // The lower bound of the height of vertex `i` over vertex `j` is linear in time.
                let root = start / (start - end);
                if end > 0.0 {
                    if !(start > 0.0 || root * (1.0 + ROUNDING) < time) {
                        return time;
                    }
                } else if start > 0.0 {
                    exit = exit.min(root * (1.0 - ROUNDING));
                } else {
                    return time;
                }
            }
        }
        exit.max(time)
    }

    /// Returns the unit normal of a contact at `time`, from the second primitive to the first, or
    /// zero if neither positions nor motion have a direction.
    pub(super) fn contact_normal(&self, time: f64) -> Vector {
        let points = self.points(time);
        let closest = closest(self.kind, points);
        let ClosestPoints { offset, weights, slides, sliding } = closest;
        let touching = self.touching_distance();
        let velocities: [Vector; 4] = std::array::from_fn(|k| subtract(self.end[k], self.start[k]));
        let weighted = |vectors: [Vector; 4]| {
            let parts = vectors.into_iter().zip(weights);
            parts.fold([0.0; 3], |sum, (vector, weight)| add(sum, scale(vector, weight)))
        };
        let velocity = weighted(velocities);
        let [e, f] =
            slides.map(|[from, to]: [u8; 2]| subtract(points[to as usize], points[from as usize]));

        // Closest points inside a triangle or inside two edges: the normal is across both slides.
        let across = cross(e, f);
        if sliding == 2 && norm(across) > 0.0 {
            let normal = scale(across, 1.0 / norm(across));
            let over = dot(offset, normal);
            let side = if over.abs() > touching { over } else { -dot(velocity, normal) };
            return if side < 0.0 { scale(normal, -1.0) } else { normal };
        }

        // Elsewhere the offset has the direction of the approach, less its part along the slide.
        let distance = norm(offset);
        let approach = if sliding == 1 {
            subtract(velocity, scale(e, dot(velocity, e) / dot(e, e)))
        } else {
            velocity
        };
        let direction = if distance <= DIRECTED * touching && norm(approach) > 0.0 {
            scale(approach, -1.0)
        } else {
            offset
        };
        let length = norm(direction);
        if length > 0.0 { scale(direction, 1.0 / length) } else { [0.0; 3] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHOLE: Search =
        Search { window: Window { entry: 0.0, exit: 1.0 }, limit: f64::INFINITY, tolerance: 1e-6 };

    #[test]
    fn primitives_in_one_plane_meet_by_their_planes_alone() {
        // A vertex in the plane of a triangle comes from its side, 1 m away at 4 m a step.
        let triangle = [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]];
        let [a, b, c] = triangle;
        let motion = PairMotion {
            kind: PairKind::VertexFace,
            start: [[1.0, 0.2, 0.0], a, b, c],
            end: [[-3.0, 0.2, 0.0], a, b, c],
        };
        let time = motion.first_contact(WHOLE).expect("a contact");
        assert!((0.25 - 1e-6..=0.25).contains(&time), "{time}");
        assert_eq!(motion.contact_normal(time), [1.0, 0.0, 0.0]);
    }

    #[test]
    fn an_edge_that_passes_beside_another_is_apart() {
        let motion = |gap: f64| PairMotion {
            kind: PairKind::EdgeEdge,
            start: [
                [-1.0, 0.0, 1.0],
                [1.0, 0.0, 1.0],
                [1.0 + gap, -1.0, 0.0],
                [1.0 + gap, 1.0, 0.0],
            ],
            end: [
                [-1.0, 0.0, -1.0],
                [1.0, 0.0, -1.0],
                [1.0 + gap, -1.0, 0.0],
                [1.0 + gap, 1.0, 0.0],
            ],
        };
        for gap in [1e-12, 1e-9, 1e-3] {
            assert_eq!(motion(gap).first_contact(WHOLE), None, "{gap}");
            let time = motion(-gap).first_contact(WHOLE).expect("a contact");
            assert!((0.5 - 1e-6..=0.5).contains(&time), "{gap}: {time}");
        }
    }
}
