//! Trial step of a filter: checked, with the drift of each vertex before it.

use super::safeguards::Safeguards;
use crate::error::{Error, check_positions};
use crate::surface::broad_phase::{CandidatePairs, largest};
use crate::surface::pair::Pair;
use crate::surface::placement::StepStart;
use crate::vector::{Vector, at, at_or_zero, dot, norm, subtract};

/// Number of pairs of a chunk, for one thread at a time; constant, as all bounds of parallel work.
pub(super) const CHUNK: usize = 2048;

/// Drift budget: fraction of the margin by which a vertex may move since detection.
///
/// Two such drifts take less than the margin off the distance of a pair that was not listed, so it
/// stays above its activation distance by a tenth of the margin. A larger fraction needs fewer
/// detections and leaves less for rounding.
pub(crate) const DRIFT_BUDGET: f64 = 0.45;

/// Fraction of a pair's clearance by which one filtered step may reduce it.
///
/// The tenth that is left keeps the energy finite and the next step from starting frozen.
pub(super) const CLOSED: f64 = 0.9;

/// Smallest clearance at which a pair may still approach, in m; at a micrometre of minimum
/// separation, a thousandth.
const SMALLEST: f64 = 1e-9;

/// Smallest clearance in units of the last place of the largest coordinate: rounding of positions
/// moves two vertices by a few.
pub(super) const PLACES: f64 = 64.0;

/// Factor that rounds a sum of lengths upwards.
const UPWARDS: f64 = 1.0 + 1e-12;

/// Trial step: flat positions of all vertices and displacements of the first ones; the others rest.
#[derive(Clone, Copy)]
pub(super) struct Trial<'a> {
    pub(super) positions: &'a [f64],
    pub(super) displacements: &'a [f64],
    /// Smallest clearance at which pairs may still approach, in m.
    pub(super) smallest: f64,
}

impl Trial<'_> {
    /// Returns the displacements of a pair's vertices, in m.
    pub(super) fn displacements(&self, pair: &Pair) -> [Vector; 4] {
        pair.vertices.map(|vertex| at_or_zero(self.displacements, vertex as usize))
    }
}

/// Drift and displacement of each vertex in a trial step.
#[derive(Debug, Default)]
pub(super) struct Drift {
    /// Distance of each vertex that may have moved from the reference positions of the pairs, in m.
    moved: Vec<f64>,
    /// Length of each displacement, in m.
    lengths: Vec<f64>,
    /// Displacements less their parts along the trajectories of the pairs, in m.
    off_trajectory: Vec<f64>,
}

impl Drift {
    /// Number of the first vertices with a drift or a displacement; the others have none.
    pub(super) fn vertices(&self) -> usize {
        self.moved.len().max(self.lengths.len())
    }

    /// Checks a trial step, and measures drift and displacements; with `common` if all vertices
    /// move by a common fraction of them. Returns the smallest clearance at which pairs may still
    /// approach, in m.
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
        let budget = DRIFT_BUDGET * pairs.margin();
        let reference = pairs.positions();
        let last_places = [pairs.largest_coordinate(start), largest(displacements)].map(last_place);
        // A vertex at its budget has been moved there by this filter, to rounding.
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
        // The coordinates of the end are at most twice the larger of both.
        let largest = 2.0 * last_places[0].max(last_places[1]);
        Ok(SMALLEST.max(PLACES * largest))
    }

    /// Returns the largest fraction of its displacement that keeps a vertex within the drift
    /// budget.
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

    /// Returns whether a pair keeps a tenth of its clearance by the lengths of the displacements
    /// alone, whatever fractions of them are taken.
    pub(super) fn stays_apart(&self, pair: &Pair, step: &Trial<'_>) -> bool {
        let clearance = pair.distance - pair.min_separation - pair.largest_sum(&self.moved);
        clearance > step.smallest && pair.largest_sum(&self.lengths) < 0.9 * CLOSED * clearance
    }
}

/// Returns the largest fraction of a displacement that stays in a ball about the origin, from a
/// point in it.
fn fraction_in_ball(point: Vector, displacement: Vector, radius: f64) -> f64 {
    let (square, along) = (dot(displacement, displacement), dot(point, displacement));
    let room = radius * radius - dot(point, point);
    // The larger root of |point + t displacement|^2 = radius^2, in the form that does not cancel.
    let root = (along * along + square * room.max(0.0)).sqrt();
    let fraction = if along > 0.0 { room / (along + root) } else { (root - along) / square };
    if fraction.is_finite() { fraction.clamp(0.0, 1.0) } else { 0.0 }
}

/// Returns the distance from a number to the next.
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
