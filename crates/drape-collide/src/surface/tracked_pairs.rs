//! Candidate pairs that are kept valid while the vertices of a surface drift.

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
    /// Distance of each vertex from the reference positions of the pairs, in m. Vertices beyond the
    /// end of the list have not moved.
    pub(crate) drift: Vec<f64>,
}

/// State of tracked pairs, from which a run resumes. Steps that are truncated vertex by vertex
/// depend on all listed pairs, however far apart the primitives are.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct TrackedMemory {
    detection: PastDetection,
    /// Margin of the next detection, in m.
    margin: f64,
}

impl TrackedMemory {
    /// Returns whether this memory fits a surface with `coordinate_count` coordinates and holds
    /// only finite values.
    pub(crate) fn fits(&self, coordinate_count: usize) -> bool {
        self.margin.is_finite()
            && (self.detection.start.is_empty() || self.detection.fits(coordinate_count))
    }
}

impl TrackedPairs {
    /// Returns the state, from which [`restore`](TrackedPairs::restore) resumes.
    pub(crate) fn memory(&self) -> TrackedMemory {
        TrackedMemory { detection: self.pairs().detection(), margin: self.margin.value() }
    }

    /// Restores the state `memory` of the pairs of `surface`.
    pub(crate) fn restore(
        &mut self,
        surface: &Surface,
        memory: &TrackedMemory,
    ) -> Result<(), Error> {
        if memory.detection.start.is_empty() {
            self.detector.clear();
        } else {
            self.detector.repeat(surface, &memory.detection)?;
        }
        self.margin.set(memory.margin);
        Ok(())
    }

    /// Returns tracked pairs without any pair. The lengths `activation_distance` and `edge`, in m,
    /// limit the margin.
    pub(crate) fn new(activation_distance: f64, edge: f64) -> TrackedPairs {
        TrackedPairs {
            detector: Detector::default(),
            margin: AdaptiveMargin::new(activation_distance, edge),
            drift: Vec::new(),
        }
    }

    /// Returns the pairs of the last detection.
    pub(crate) fn pairs(&self) -> &CandidatePairs {
        self.detector.pairs()
    }

    /// Drops all pairs, because their distances have changed.
    pub(crate) fn clear(&mut self) {
        self.detector.clear();
    }

    /// Detects the pairs at `placement` or on the trajectories `sweep` from there, and adapts the
    /// margin.
    pub(crate) fn detect(
        &mut self,
        surface: &Surface,
        placement: &Placement,
        sweep: Sweep<'_>,
    ) -> Result<(), Error> {
        let margin = self.margin.value();
        let pairs = self.detector.detect_placed(surface, placement, sweep, margin)?;
        self.margin.adapt(pairs.as_slice().len(), surface.vertex_count());
        Ok(())
    }

    /// Moves the reference positions along the trajectories to the points nearest to the flat
    /// `positions`, in m.
    pub(crate) fn follow_trajectories(&mut self, positions: &[f64]) {
        self.detector.follow_trajectories(positions);
    }

    /// Measures the drift of each vertex at `placement` and returns the largest, in m. Without a
    /// detection the drift is infinite.
    pub(crate) fn measure_drift(&mut self, placement: &Placement) -> f64 {
        let pairs = self.detector.pairs();
        self.drift.clear();
        if pairs.positions().len() != placement.len() {
            return f64::INFINITY;
        }
        let moved = pairs.step_start(placement).moved;
        self.drift
            .extend((0..moved).map(|vertex| {
                norm(subtract(at(placement, vertex), at(pairs.positions(), vertex)))
            }));
        // A maximum that keeps NaN.
        let mut largest = 0.0;
        for &drift in &self.drift {
            if drift > largest || drift.is_nan() {
                largest = drift;
            }
        }
        largest
    }
}
