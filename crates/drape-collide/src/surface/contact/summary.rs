//! Summary of the active pairs: their number and smallest distances.

use super::active_pairs::ActivePair;
use crate::surface::pair::Pair;

/// Number and smallest distances of active pairs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceSummary {
    /// Number of pairs within their activation distance.
    pub touching: usize,
    /// Smallest distance of a pair, in m, infinite if none is active.
    pub min_distance: f64,
    /// Smallest ratio of a pair's distance to its minimum separation.
    pub min_ratio: f64,
}

/// Pair with its distance at the positions of the last evaluation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairDistance<'a> {
    /// Pair of primitives.
    pub pair: &'a Pair,
    /// Distance between the two primitives, in m.
    pub distance: f64,
}

impl<'a> PairDistance<'a> {
    /// Returns an active pair with its distance, as a [`PairDistance`].
    pub(super) fn new(active: &'a ActivePair) -> PairDistance<'a> {
        PairDistance { pair: &active.pair, distance: active.gap.distance() }
    }

    /// Returns the ratio of `distance` to the minimum separation of the pair.
    pub(super) fn ratio(&self) -> f64 {
        self.distance / self.pair.min_separation
    }
}

impl SurfaceSummary {
    /// Returns the summary of `active` pairs.
    pub(super) fn new<'a>(active: impl Iterator<Item = &'a ActivePair>) -> SurfaceSummary {
        let mut summary =
            SurfaceSummary { touching: 0, min_distance: f64::INFINITY, min_ratio: f64::INFINITY };
        for pair in active.map(PairDistance::new) {
            summary.touching += 1;
            summary.min_distance = summary.min_distance.min(pair.distance);
            summary.min_ratio = summary.min_ratio.min(pair.ratio());
        }
        summary
    }
}
