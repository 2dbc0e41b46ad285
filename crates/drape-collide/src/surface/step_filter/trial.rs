//! Checked trial step of a filter, with the drift of each vertex before the step.

use super::safeguards::Safeguards;
use crate::error::{Error, check_positions};
use crate::surface::broad_phase::{CandidatePairs, largest};
use crate::surface::pair::Pair;
use crate::surface::placement::StepStart;
use crate::vector::{Vector, at, at_or_zero, dot, norm, subtract};

/// Number of pairs in a chunk, which one thread handles at a time. It is constant, so no result
/// depends on the number of threads.
pub(super) const CHUNK: usize = 2048;

/// Drift budget: fraction of the margin by which a vertex may move since detection.
///
/// Two drifts of this size reduce the distance of an unlisted pair by less than the margin. The
/// pair stays above its activation distance by a tenth of the margin. A larger fraction needs fewer
/// detections and leaves less for rounding.
pub(crate) const DRIFT_BUDGET: f64 = 0.45;

/// Fraction of a pair's clearance by which one filtered step may reduce it.
///
/// The remaining tenth keeps the energy finite and the next step from starting frozen.
pub(super) const CLOSED: f64 = 0.9;

/// Smallest clearance at which a pair may still approach, in m. It is a thousandth of a minimum
/// separation of a micrometre.
const SMALLEST: f64 = 1e-9;

/// Smallest clearance in units of the last place of the largest coordinate. Rounding of positions
/// moves two vertices by a few units.
pub(super) const PLACES: f64 = 64.0;

/// Factor that rounds a sum of lengths upwards.
const UPWARDS: f64 = 1.0 + 1e-12;

/// Trial step: flat positions of all vertices, and displacements of leading vertices. Other
/// vertices rest.
#[derive(Clone, Copy)]
pub(super) struct Trial<'a> {
    pub(super) positions: &'a [f64],
    pub(super) displacements: &'a [f64],
    /// Smallest clearance at which pairs may still approach, in m.
    pub(super) smallest: f64,
}

impl Trial<'_> {
    /// Returns the displacements of the vertices of `pair`, in m.
    pub(super) fn displacements(&self, pair: &Pair) -> [Vector; 4] {
        pair.vertices.map(|vertex| at_or_zero(self.displacements, vertex as usize))
    }
}

/// Drift and displacement of each vertex in a trial step.
#[derive(Debug, Default)]
pub(super) struct Drift {
    /// Distance of each vertex from its reference position, in m. Later vertices have not moved.
    moved: Vec<f64>,
    /// Length of each displacement, in m.
    lengths: Vec<f64>,
    /// Displacements less their parts along the trajectories of the pairs, in m.
    off_trajectory: Vec<f64>,
}

impl Drift {
    /// Returns the number of leading vertices with a drift or a displacement: the longer of `moved`
    /// and `lengths`.
    pub(super) fn vertices(&self) -> usize {
        self.moved.len().max(self.lengths.len())
    }

    /// Checks a trial step from `start`, and measures drift and displacements. With `common`, all
    /// vertices move by a common fraction of their displacements. Returns the smallest clearance at
    /// which `pairs` may still approach, in m.
    pub(super) fn measure(
        &mut self,
        pairs: &CandidatePairs,
        (start, displacements): (StepStart<'_>, &[f64]),
        common: bool,
        safeguards: Safeguards,
    ) -> Result<f64, Error> {
        let StepStart { positions, moved } = start;
        let needed = pairs.positions().len();
        if positions.len() != needed {
            let (what, found) = ("positions", positions.len());
            return Err(Error::WrongLength { what, found, needed });
        }
        if displacements.len() != needed && displacements.len() != 3 * pairs.free {
            let (what, found) = ("displacements", displacements.len());
            return Err(Error::WrongLength { what, found, needed });
        }
        check_positions("vertex", &positions[..3 * moved])?;
        check_positions("the displacement of vertex", displacements)?;

        // A vertex at its budget was moved there by this filter, to rounding.
        let budget = DRIFT_BUDGET * pairs.margin();
        let reference = pairs.positions();
        let last_places = [pairs.largest_coordinate(start), largest(displacements)].map(last_place);
        let most = budget * (1.0 + 1e-9) + 4.0 * last_places[0];

        self.moved.clear();
        self.lengths.clear();
        for vertex in 0..moved {
            let moved = norm(subtract(at(positions, vertex), at(reference, vertex))) * UPWARDS;
            if safeguards.drift_budget && moved > most {
                return Err(Error::DriftBudgetExceeded { vertex, moved, budget });
            }
            self.moved.push(if safeguards.drift_bound { moved } else { 0.0 });
        }
        let lengths = displacements.as_chunks::<3>().0.iter();
        self.lengths.extend(lengths.map(|displacement| norm(*displacement) * UPWARDS));
        pairs.write_off_trajectory(displacements, common, &mut self.off_trajectory);

        // Coordinates at the end of the step are at most twice the larger of both.
        let largest = 2.0 * last_places[0].max(last_places[1]);
        Ok(SMALLEST.max(PLACES * largest))
    }

    /// Returns the largest fraction of its displacement in `step` that keeps `vertex` within the
    /// drift budget of `pairs`.
    pub(super) fn budget_fraction(
        &self,
        pairs: &CandidatePairs,
        step: &Trial<'_>,
        vertex: usize,
    ) -> f64 {
        let budget = DRIFT_BUDGET * pairs.margin();
        let off_trajectory = at_or_zero(&self.off_trajectory, vertex);
        let drift = self.moved.get(vertex).copied().unwrap_or(0.0);
        if drift + norm(off_trajectory) * UPWARDS <= budget {
            return 1.0;
        }
        let moved = subtract(at(step.positions, vertex), at(pairs.positions(), vertex));
        fraction_in_ball(moved, off_trajectory, budget)
    }

    /// Returns whether the lengths of the displacements alone prove that `pair` keeps a tenth of
    /// its clearance, for any fractions of them.
    pub(super) fn stays_apart(&self, pair: &Pair, step: &Trial<'_>) -> bool {
        let clearance = pair.distance - pair.min_separation - pair.largest_sum(&self.moved);
        clearance > step.smallest && pair.largest_sum(&self.lengths) < 0.9 * CLOSED * clearance
    }
}

/// Returns the largest fraction of `displacement` at which `point` stays in a ball of `radius`
/// about the origin. `point` begins in the ball.
fn fraction_in_ball(point: Vector, displacement: Vector, radius: f64) -> f64 {
    let (square, along) = (dot(displacement, displacement), dot(point, displacement));
    let room = radius * radius - dot(point, point);
    // The larger root of |point + t displacement|^2 = radius^2, in the form without cancellation.
    let root = (along * along + square * room.max(0.0)).sqrt();
    let fraction = if along > 0.0 { room / (along + root) } else { (root - along) / square };
    if fraction.is_finite() { fraction.clamp(0.0, 1.0) } else { 0.0 }
}

/// Returns the distance from `number` to the next larger `f64`.
fn last_place(number: f64) -> f64 {
    number.next_up() - number
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fraction_that_stays_in_a_ball_ends_on_it() {
        let point = [0.3, -0.2, 0.1];
        for displacement in [[2.0, 0.5, -1.0], [-2.0, 0.5, -1.0], [0.2, 0.3, 0.0]] {
            let fraction = fraction_in_ball(point, displacement, 0.5);
            let end = norm(std::array::from_fn(|k| point[k] + fraction * displacement[k]));
            assert!(fraction == 1.0 && end < 0.5 || (end - 0.5).abs() < 1e-15, "{fraction}, {end}");
        }
        // The whole room is 2^-40 of the radius, and squares cancel.
        let room = 0.5_f64.powi(40);
        let fraction = fraction_in_ball([1.0 - room, 0.0, 0.0], [0.7, 0.0, 0.0], 1.0);
        assert!((0.7 * fraction / room - 1.0).abs() < 1e-9, "{fraction}");
        assert_eq!(fraction_in_ball([2.0, 0.0, 0.0], [1.0, 0.0, 0.0], 1.0), 0.0);
    }
}
