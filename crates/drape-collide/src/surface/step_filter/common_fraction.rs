//! Fraction of a step that is safe for all vertices, by conservative advancement.

use std::sync::atomic::{AtomicU64, Ordering};

use super::separating_planes::SeparatingPlane;
use super::trial::{CHUNK, CLOSED, PLACES, Trial};
use crate::surface::pair::Pair;
use crate::threads::*;
use crate::vector::{add, scale};

/// Largest number of rounds of advancement for a pair. Most pairs need one or two.
const ROUNDS: usize = 100;

/// Room over the kept clearance below which another round is not worthwhile.
const WORTHWHILE: f64 = 0.02;

/// What limits the common fraction of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FractionLimit {
    /// No limit: the step is whole.
    None,
    /// Two primitives that come near each other.
    Contact,
    /// The drift budget of a vertex. The caller must detect pairs again.
    DriftBudget,
}

/// Fraction of a step that is proved safe for all vertices together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepFraction {
    /// Fraction, 0 to 1.
    pub value: f64,
    /// Limit that keeps the fraction below 1.
    pub limit: FractionLimit,
}

/// Returns the largest fraction of the trial `step`, up to `budget`, at which all `pairs` are safe.
/// `stays_apart` tells which pairs need no test.
pub(super) fn common_fraction(
    pairs: &[Pair],
    step: &Trial<'_>,
    budget: f64,
    stays_apart: impl Fn(&Pair) -> bool + Sync,
) -> StepFraction {
    // The minimum does not depend on the order of pairs. Later pairs stop early.
    let least = AtomicU64::new(budget.to_bits());
    pairs.par_chunks(CHUNK).for_each(|chunk| {
        for pair in chunk {
            if !stays_apart(pair) {
                let limit = f64::from_bits(least.load(Ordering::Relaxed));
                let fraction = advance(pair, step, limit);
                least.fetch_min(fraction.to_bits(), Ordering::Relaxed);
            }
        }
    });
    let value = f64::from_bits(least.into_inner());
    let limit = if value < budget {
        FractionLimit::Contact
    } else if value < 1.0 {
        FractionLimit::DriftBudget
    } else {
        FractionLimit::None
    };
    StepFraction { value, limit }
}

/// Returns a fraction of `step` up to which `pair` surely keeps a tenth of its clearance, at most
/// `limit`.
///
/// The method is conservative advancement \[Mir96\] along the normal of the closest points. Over
/// the rest of the step, heights over a plane change by no more than the vertices approach.
fn advance(pair: &Pair, step: &Trial<'_>, limit: f64) -> f64 {
    let (points, displacements) = (pair.points(step.positions), step.displacements(pair));
    // The end of the step is rounded, and so are the speeds.
    let rounding = 4.0 * step.smallest / PLACES;
    let (mut fraction, mut kept) = (0.0, f64::NAN);
    for _ in 0..ROUNDS {
        let now = std::array::from_fn(|k| add(points[k], scale(displacements[k], fraction)));
        let plane = SeparatingPlane::new(pair, now);
        let clearance = plane.clearance(pair.min_separation);
        let approaches = plane.approaches(pair, displacements);
        let (first, second) = approaches.split_at(pair.first_vertex_count());
        let [first, second] =
            [first, second].map(|list| list.iter().copied().fold(f64::NEG_INFINITY, f64::max));
        let speed = first + second;

        if fraction == 0.0 {
            kept = (1.0 - CLOSED) * clearance;
            // A clearance of NaN freezes the pair.
            if !(clearance > step.smallest) {
                let rests = displacements == [[0.0; 3]; 4];
                let separates = plane.low > plane.high && speed < -rounding;
                return if rests || separates { limit } else { 0.0 };
            }
        }

        if speed <= 0.0 {
            return limit;
        }
        let room = clearance - rounding - kept;
        if !(room > WORTHWHILE * kept) {
            return fraction;
        }
        fraction += room / speed * (1.0 - 1e-9);
        if fraction >= limit {
            return limit;
        }
    }
    fraction
}
