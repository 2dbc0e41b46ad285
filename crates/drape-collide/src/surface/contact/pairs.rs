//! Active pairs as a caller sees them: their number, their distances and the closest pair.

use super::active_pairs::{ActivePair, ActivePairs};
use crate::error::Error;
use crate::surface::pair::Pair;

/// Pairs within their activation distances at the positions of a detection.
///
/// [`SurfaceContact::detect`](super::SurfaceContact::detect) returns the pairs at given positions.
#[derive(Debug, Clone, Copy)]
pub struct SurfacePairs<'a> {
    active: &'a ActivePairs,
}

/// Number and smallest distances of active pairs.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct SurfaceSummary {
    /// Number of pairs within their activation distance.
    pub touching: usize,
    /// Smallest distance of a pair, in m, infinite if none is active.
    pub min_distance: f64,
    /// Smallest ratio of a pair's distance to its minimum separation.
    pub min_ratio: f64,
}

/// Pair with its distance at the positions of a detection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairDistance<'a> {
    /// Pair of primitives.
    pub pair: &'a Pair,
    /// Distance between the two primitives, in m.
    pub distance: f64,
}

impl<'a> SurfacePairs<'a> {
    /// Returns the pairs of `active`.
    pub(super) fn new(active: &'a ActivePairs) -> SurfacePairs<'a> {
        SurfacePairs { active }
    }

    /// Returns the number and the smallest distances of the pairs, as a [`SurfaceSummary`].
    #[must_use]
    pub fn summary(self) -> SurfaceSummary {
        SurfaceSummary::new(self.active.iter())
    }

    /// Returns a [`PairDistance`] for each pair.
    pub fn iter(self) -> impl Iterator<Item = PairDistance<'a>> {
        self.active.iter().map(PairDistance::new)
    }

    /// Returns the pair with the smallest ratio of distance to minimum separation, as a
    /// [`PairDistance`].
    #[must_use]
    pub fn closest(self) -> Option<PairDistance<'a>> {
        self.iter().min_by(|a, b| a.ratio().total_cmp(&b.ratio()))
    }

    /// Returns a [`PairDistance`] for each pair below its minimum separation.
    pub fn below_min_separation(self) -> impl Iterator<Item = PairDistance<'a>> {
        self.iter().filter(|PairDistance { pair, distance }| !(*distance >= pair.min_separation))
    }

    /// Returns the [`Error`] of the detection, if it failed. Forces at its positions are NaN.
    #[must_use]
    pub fn failure(self) -> Option<&'a Error> {
        self.active.failure.as_ref()
    }
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
