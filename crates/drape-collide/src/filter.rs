use crate::error::{Error, check_places};
use crate::guards::Guards;
use crate::pair::Pair;
use crate::pairs::CandidatePairs;
use crate::plane::{Planes, Slab};
use crate::vector::{Vector, add, at, dot, norm, scale, subtract};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

/// CandidatePairs that one thread looks after at a time; a constant, as all bounds of parallel work.
pub(crate) const CHUNK: usize = 2048;

/// Share of the margin that a vertex may move by from where the pairs were detected.
///
/// Two such ways take less than the margin off the distance of a pair that was not listed, so it
/// stays above its activation_distance by a tenth of the margin. More moves farther on one detection and leaves
/// less for rounding.
pub(crate) const BUDGET: f64 = 0.45;

/// Share of a pair's opening that one filtered step may close.
///
/// The tenth that stays keeps the energy finite and the next step from starting frozen.
pub(crate) const CLOSED: f64 = 0.9;

/// Smallest opening at which a pair may still close, in m; at a micrometre of min_separation, a
/// thousandth.
const SMALLEST: f64 = 1e-9;

/// Smallest opening in units of the last place of the largest coordinate: what rounding of
/// positions can move two vertices by is a few.
const PLACES: f64 = 64.0;

/// Rounds of conservative advancement of one pair; most need one or two.
const ROUNDS: usize = 100;

/// Share of the opening below which advancing further is not worth a round.
const WORTH: f64 = 0.02;

/// Rounding of a sum of lengths, upwards.
const UPWARDS: f64 = 1.0 + 1e-12;

/// What kept a step from its full length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepLimit {
    /// Nothing did.
    None,
    /// Two primitives come near each other.
    Contact,
    /// A vertex gets as far from where the pairs were detected as they allow: detect again.
    DriftBudget,
}

/// The share of a step that is proved safe for all vertices together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepFraction {
    /// From 0 to 1.
    pub value: f64,
    /// What kept it below 1.
    pub limit: StepLimit,
}

/// Shortens steps such that no two primitives come nearer than their min_separation.
///
/// Positions and displacements are flat, for all vertices of the surface, bodies included. The
/// answers are proofs for the straight way of each vertex from `x` to `x + dx` as rounded: every
/// listed pair keeps a twentieth of its opening, and every other pair stays beyond its activation_distance as
/// long as no vertex moves farther than 0.45 margins from where the pairs were detected, or from the
/// course along which they were. The filter holds to that; it fails if the positions have gone
/// farther already.
///
/// It keeps its memory between calls.
#[derive(Debug, Default)]
pub struct CcdFilter {
    /// How far each vertex is from where the pairs were detected, in m.
    pub(crate) moved: Vec<f64>,
    /// How far each vertex is to move, in m.
    pub(crate) lengths: Vec<f64>,
    /// What of that leads off the course of the pairs, in m.
    pub(crate) astray: Vec<f64>,
    /// Share of its way that each vertex may go, as bits: those of positive numbers are in order.
    pub(crate) shares: Vec<AtomicU64>,
    pub(crate) planes: Vec<Planes>,
    pub(crate) guards: Guards,
}

/// A step to be filtered: flat positions and displacements of all vertices.
#[derive(Clone, Copy)]
pub(crate) struct Step<'a> {
    pub(crate) positions: &'a [f64],
    pub(crate) displacements: &'a [f64],
    /// The least opening at which pairs may still close, in m.
    pub(crate) smallest: f64,
}

impl Step<'_> {
    /// The vertices' displacements.
    pub(crate) fn ways(&self, pair: &Pair) -> [Vector; 4] {
        pair.vertices.map(|vertex| at(self.displacements, vertex as usize))
    }
}

impl CcdFilter {
    /// The largest share of a step that conservative advancement proves safe for all vertices.
    ///
    /// Keeps the direction of the step. Each listed pair keeps a tenth of its opening.
    ///
    /// # Errors
    ///
    /// If a list has the wrong length, a number is not finite or beyond 1000 km, or the positions
    /// have gone beyond the budget of the pairs.
    pub fn common_fraction(
        &mut self,
        pairs: &CandidatePairs,
        positions: &[f64],
        displacements: &[f64],
    ) -> Result<StepFraction, Error> {
        let step = self.begin(pairs, (positions, displacements), true)?;
        let budget = (0..self.moved.len())
            .map(|vertex| self.budget_share(pairs, &step, vertex))
            .fold(1.0, f64::min);
        // The least of all does not depend on the order; who is late stops early.
        let least = AtomicU64::new(budget.to_bits());
        pairs.as_slice().par_chunks(CHUNK).for_each(|chunk| {
            for pair in chunk {
                if !self.stays_apart(pair, &step) {
                    let limit = f64::from_bits(least.load(Ordering::Relaxed));
                    let share = advance(pair, &step, limit);
                    least.fetch_min(share.to_bits(), Ordering::Relaxed);
                }
            }
        });
        let value = f64::from_bits(least.into_inner());
        let limit = if value < budget {
            StepLimit::Contact
        } else if value < 1.0 {
            StepLimit::DriftBudget
        } else {
            StepLimit::None
        };
        Ok(StepFraction { value, limit })
    }

    /// Checks a step, and measures how far the vertices are from their detection and how far they
    /// are to move, all the same share of their ways or each its own.
    pub(crate) fn begin<'a>(
        &mut self,
        pairs: &CandidatePairs,
        (positions, displacements): (&'a [f64], &'a [f64]),
        together: bool,
    ) -> Result<Step<'a>, Error> {
        let needed = pairs.positions().len();
        for (what, found) in
            [("positions", positions.len()), ("displacements", displacements.len())]
        {
            if found != needed {
                return Err(Error::WrongLength { what, found, needed });
            }
        }
        check_places("vertex", positions)?;
        check_places("the displacement of vertex", displacements)?;
        let budget = BUDGET * pairs.margin();
        let detected = pairs.positions();
        let last_places = [last_place(positions), last_place(displacements)];
        // A vertex on its budget has been moved there by this filter, to rounding.
        let most = budget * (1.0 + 1e-9) + 4.0 * last_places[0];
        self.moved.clear();
        self.lengths.clear();
        for vertex in 0..needed / 3 {
            let moved = norm(subtract(at(positions, vertex), at(detected, vertex))) * UPWARDS;
            if self.guards.budget && moved > most {
                return Err(Error::DriftBudgetExceeded { vertex, moved, budget });
            }
            self.moved.push(moved);
            self.lengths.push(norm(at(displacements, vertex)) * UPWARDS);
        }
        pairs.astray(displacements, together, &mut self.astray);
        // The coordinates of the end are at most twice the larger of both.
        let largest = 2.0 * last_places[0].max(last_places[1]);
        let smallest = SMALLEST.max(PLACES * largest);
        Ok(Step { positions, displacements, smallest })
    }

    /// Largest share of its way that keeps a vertex within the budget.
    pub(crate) fn budget_share(
        &self,
        pairs: &CandidatePairs,
        step: &Step<'_>,
        vertex: usize,
    ) -> f64 {
        let budget = BUDGET * pairs.margin();
        let astray = at(&self.astray, vertex);
        if !self.guards.budget || self.moved[vertex] + norm(astray) * UPWARDS <= budget {
            return 1.0;
        }
        let gone = subtract(at(step.positions, vertex), at(pairs.positions(), vertex));
        share_of_ball(gone, astray, budget)
    }

    /// Whether a pair keeps a tenth of its opening by the lengths of the ways alone, however they
    /// are shortened.
    pub(crate) fn stays_apart(&self, pair: &Pair, step: &Step<'_>) -> bool {
        let opening = pair.distance - pair.min_separation - pair.most(&self.moved);
        opening > step.smallest && pair.most(&self.lengths) < 0.9 * CLOSED * opening
    }
}

/// Largest share of a way that stays in a ball about the origin, from a place in it.
fn share_of_ball(place: Vector, way: Vector, radius: f64) -> f64 {
    let (square, along) = (dot(way, way), dot(place, way));
    let room = radius * radius - dot(place, place);
    // The larger root of |place + t way|^2 = radius^2, in the form that does not cancel.
    let root = (along * along + square * room.max(0.0)).sqrt();
    let share = if along > 0.0 { room / (along + root) } else { (root - along) / square };
    if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }
}

/// Distance from the largest number of a list to the next.
fn last_place(list: &[f64]) -> f64 {
    let largest = list.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    largest.next_up() - largest
}

/// Share of a step up to which a pair surely keeps a tenth of its opening; no need to know more
/// than that it reaches a limit.
///
/// Conservative advancement (Mirtich 1996) along the way between the closest points: over the rest
/// of the step the heights of the vertices over the planes change by no more than they approach.
/// Where it stops it has proved as much as it answers.
fn advance(pair: &Pair, step: &Step<'_>, limit: f64) -> f64 {
    let (places, ways) = (pair.places(step.positions), step.ways(pair));
    // Where the step ends is rounded, and so are the speeds below.
    let slop = 4.0 * step.smallest / PLACES;
    let (mut share, mut kept) = (0.0, f64::NAN);
    for _ in 0..ROUNDS {
        let now = std::array::from_fn(|k| add(places[k], scale(ways[k], share)));
        let slab = Slab::new(pair, now);
        let opening = slab.opening(pair.min_separation);
        let approaches = slab.approaches(pair, ways);
        let (first, second) = approaches.split_at(pair.first());
        let fastest = |list: &[f64]| list.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let speed = fastest(first) + fastest(second);
        if share == 0.0 {
            kept = (1.0 - CLOSED) * opening;
            // Written so that NaN freezes.
            if !(opening > step.smallest) {
                let rests = ways == [[0.0; 3]; 4];
                let parts = slab.low > slab.high && speed < -slop;
                return if rests || parts { limit } else { 0.0 };
            }
        }
        if speed <= 0.0 {
            return limit;
        }
        let room = opening - slop - kept;
        if !(room > WORTH * kept) {
            return share;
        }
        share += room / speed * (1.0 - 1e-9);
        if share >= limit {
            return limit;
        }
    }
    share
}
