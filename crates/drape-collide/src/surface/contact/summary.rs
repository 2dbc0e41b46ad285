//! Summary of the active pairs: their number and smallest distances.

use super::active_pairs::ActivePair;
use crate::surface::pair::Pair;

/// Number and smallest distances of active pairs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceSummary {
    /// Number of pairs within their activation distance.
    pub touching: usize,
    /// Smallest distance of a pair, in m; infinite if none is active.
    pub min_distance: f64,
    /// Smallest ratio of a distance and the minimum separation of its pair.
    pub min_ratio: f64,
}

/// Pair with its distance at the positions of the last evaluation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairDistance<'a> {
    /// Pair of primitives.
    pub pair: &'a Pair,
    /// Distance of its primitives, in m.
    pub distance: f64,
}

impl<'a> PairDistance<'a> {
    /// Distance of an active pair.
    pub(super) fn of(active: &'a ActivePair) -> PairDistance<'a> {
        PairDistance { pair: &active.pair, distance: active.gap.distance() }
    }

    /// Ratio of the distance and the minimum separation.
    pub(super) fn ratio(&self) -> f64 {
        self.distance / self.pair.min_separation
    }
}

impl SurfaceSummary {
    /// Summary of active pairs.
    pub(super) fn new<'a>(active: impl Iterator<Item = &'a ActivePair>) -> SurfaceSummary {
        let mut summary =
            SurfaceSummary { touching: 0, min_distance: f64::INFINITY, min_ratio: f64::INFINITY };
        for pair in active.map(PairDistance::of) {
            summary.touching += 1;
            summary.min_distance = summary.min_distance.min(pair.distance);
            summary.min_ratio = summary.min_ratio.min(pair.ratio());
        }
        summary
    }
}
