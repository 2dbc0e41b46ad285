//! Fraction of a step that is safe for all vertices, by conservative advancement.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use super::separating_planes::SeparatingPlane;
use super::trial::{CHUNK, CLOSED, PLACES, Trial};
use crate::surface::pair::Pair;
use crate::vector::{add, scale};

/// Largest number of rounds of advancement of a pair; most need one or two.
const ROUNDS: usize = 100;

/// Fraction of the clearance to keep below which another round is not worthwhile.
const WORTHWHILE: f64 = 0.02;

/// Limit that a step meets first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepLimit {
    /// None: the step is whole.
    None,
    /// Two primitives that come near each other.
    Contact,
    /// The drift budget of a vertex: detect again.
    DriftBudget,
}

/// Fraction of a step that is proved safe for all vertices together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepFraction {
    /// Fraction, 0 to 1.
    pub value: f64,
    /// Limit that keeps it below 1.
    pub limit: StepLimit,
}

/// Returns the largest fraction of a trial step, up to `budget`, at which every pair is safe;
/// `stays_apart` excludes pairs that need no test.
pub(super) fn common_fraction(
    pairs: &[Pair],
    step: &Trial<'_>,
    budget: f64,
    stays_apart: impl Fn(&Pair) -> bool + Sync,
) -> StepFraction {
    // The least of all does not depend on the order; later pairs stop early.
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
        StepLimit::Contact
    } else if value < 1.0 {
        StepLimit::DriftBudget
    } else {
        StepLimit::None
    };
    StepFraction { value, limit }
}

/// Returns a fraction of a step up to which a pair surely keeps a tenth of its clearance, at most a
/// limit.
///
/// Conservative advancement \[Mir96\] along the normal of the closest points: over the rest of the
/// step the heights of the vertices over a plane change by no more than they approach.
fn advance(pair: &Pair, step: &Trial<'_>, limit: f64) -> f64 {
    let (points, displacements) = (pair.points(step.positions), step.displacements(pair));
    // The end of the step is rounded, and so are the speeds below.
    let rounding = 4.0 * step.smallest / PLACES;
    let (mut fraction, mut kept) = (0.0, f64::NAN);
    for _ in 0..ROUNDS {
        let now = std::array::from_fn(|k| add(points[k], scale(displacements[k], fraction)));
        let plane = SeparatingPlane::new(pair, now);
        let clearance = plane.clearance(pair.min_separation);
        let approaches = plane.approaches(pair, displacements);
        let (first, second) = approaches.split_at(pair.first_vertices());
        let fastest = |list: &[f64]| list.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let speed = fastest(first) + fastest(second);
        if fraction == 0.0 {
            kept = (1.0 - CLOSED) * clearance;
            // NaN freezes the pair.
            if !(clearance > step.smallest) {
                let rests = displacements == [[0.0; 3]; 4];
                let parts = plane.low > plane.high && speed < -rounding;
                return if rests || parts { limit } else { 0.0 };
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
