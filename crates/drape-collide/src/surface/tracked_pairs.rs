//! Candidate pairs that are kept up to date while the vertices of a surface drift.

use serde::{Deserialize, Serialize};

use super::broad_phase::{AdaptiveMargin, CandidatePairs, PastDetection, Sweep};
use super::contact_surface::Surface;
use super::detector::Detector;
use super::placement::Placement;
use crate::error::Error;
use crate::vector::{at, norm, subtract};

/// Candidate pairs, and the drift of each vertex since their detection.
#[derive(Debug)]
pub(crate) struct TrackedPairs {
    detector: Detector,
    margin: AdaptiveMargin,
    /// Distance of each vertex from the reference positions of the pairs, in m; of the first ones if
    /// the others have not moved.
    pub(crate) drift: Vec<f64>,
}

/// State of tracked pairs, from which they are made again. Steps that are truncated vertex by vertex
/// depend on the pairs at hand, however far these are.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct TrackedMemory {
    detection: PastDetection,
    /// Margin of the next detection, in m.
    margin: f64,
}

impl TrackedMemory {
    /// Returns whether it is that of flat positions of a length, and numbers are finite.
    pub(crate) fn is_of(&self, numbers: usize) -> bool {
        self.margin.is_finite()
            && (self.detection.start.is_empty() || self.detection.is_of(numbers))
    }
}

impl TrackedPairs {
    /// Returns the state.
    pub(crate) fn memory(&self) -> TrackedMemory {
        TrackedMemory { detection: self.pairs().detection(), margin: self.margin.value() }
    }

    /// Returns to an earlier state.
    pub(crate) fn restore(
        &mut self,
        surface: &Surface,
        memory: &TrackedMemory,
    ) -> Result<(), Error> {
        match memory.detection.start.is_empty() {
            true => self.detector.clear(),
            false => self.detector.repeat(surface, &memory.detection)?,
        }
        self.margin.set(memory.margin);
        Ok(())
    }

    /// No pairs yet, of surfaces with an activation distance and edges of a length, in m.
    pub(crate) fn new(activation_distance: f64, edge: f64) -> TrackedPairs {
        TrackedPairs {
            detector: Detector::default(),
            margin: AdaptiveMargin::new(activation_distance, edge),
            drift: Vec::new(),
        }
    }

    /// Pairs of the last detection.
    pub(crate) fn pairs(&self) -> &CandidatePairs {
        self.detector.pairs()
    }

    /// Drops the pairs, whose distances have changed.
    pub(crate) fn clear(&mut self) {
        self.detector.clear();
    }

    /// Detects the pairs at a placement or on trajectories from there, and adapts the margin.
    pub(crate) fn detect(
        &mut self,
        surface: &Surface,
        placement: &Placement,
        sweep: Sweep<'_>,
    ) -> Result<(), Error> {
        let margin = self.margin.value();
        let found = self.detector.detect_placed(surface, placement, sweep, margin)?;
        self.margin.adapt(found.as_slice().len(), surface.vertex_count());
        Ok(())
    }

    /// Moves the reference positions along the trajectories to where these come nearest to flat
    /// positions.
    pub(crate) fn follow_trajectories(&mut self, positions: &[f64]) {
        self.detector.follow_trajectories(positions);
    }

    /// Measures the drift of each vertex and returns the largest, in m; infinite without a
    /// detection.
    pub(crate) fn measure_drift(&mut self, placement: &Placement) -> f64 {
        let pairs = self.detector.pairs();
        self.drift.clear();
        if pairs.positions().len() != placement.len() {
            return f64::INFINITY;
        }
        let drift = |vertex| norm(subtract(at(placement, vertex), at(pairs.positions(), vertex)));
        self.drift.extend((0..pairs.step_start(placement).moved).map(drift));
        // A maximum that passes NaN on.
        let larger = |most: f64, drift: f64| drift > most || drift.is_nan();
        self.drift.iter().fold(0.0, |most, &drift| if larger(most, drift) { drift } else { most })
    }
}
