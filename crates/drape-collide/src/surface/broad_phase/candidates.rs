//! Candidate pairs of a detection.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::sweep::{Sweep, nearest_fraction};
use crate::surface::pair::Pair;
use crate::surface::placement::{Placement, StepStart};

/// Sorted list of the pairs that come near each other at some positions or on trajectories from
/// there.
///
/// As long as no vertex is farther than half of the margin from its trajectory, no other pair is
/// within its activation distance.
#[derive(Debug, Clone, Default)]
pub struct CandidatePairs {
    list: Vec<Pair>,
    /// Reference positions: the points of the trajectories that were followed last, in m.
    positions: Vec<f64>,
    pub(crate) margin: f64,
    pub(crate) free: usize,
    /// Revision of the bodies' positions; none while they move.
    revision: Option<u64>,
    /// Largest coordinate of the bodies' reference positions, in m.
    largest_of_bodies: f64,
    /// Start of the trajectories, in m; empty if there are none.
    start: Vec<f64>,
    /// Displacements along the trajectories, in m; empty if there are none, those of the free vertices
    /// alone if bodies rest.
    displacements: Vec<f64>,
    /// Whether all vertices move by a common fraction of their displacements.
    common: bool,
}

/// Positions, trajectories and margin of a detection.
pub(crate) struct Detection<'a> {
    pub(crate) positions: &'a [f64],
    /// Revision of the bodies' positions; none while they move.
    pub(crate) revision: Option<u64>,
    pub(crate) sweep: Sweep<'a>,
    pub(crate) margin: f64,
}

/// Detection of candidate pairs, from which it can be made again: its positions, its trajectories and
/// how far these were followed.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct PastDetection {
    /// Positions of the detection, in m; empty if there is none.
    pub(crate) start: Vec<f64>,
    /// Displacements along the trajectories, in m; empty if there are none.
    pub(crate) displacements: Vec<f64>,
    /// Whether all vertices move by a common fraction of their displacements.
    common: bool,
    /// Reference positions, in m.
    reference: Vec<f64>,
    pub(crate) margin: f64,
}

impl PastDetection {
    /// Trajectories.
    pub(crate) fn sweep(&self) -> Sweep<'_> {
        match (self.displacements.is_empty(), self.common) {
            (true, _) => Sweep::Still,
            (false, true) => Sweep::Common(&self.displacements),
            (false, false) => Sweep::Individual(&self.displacements),
        }
    }

    /// Returns whether lists have the length of flat positions, and numbers are finite.
    pub(crate) fn is_of(&self, numbers: usize) -> bool {
        let Self { start, displacements, reference, .. } = self;
        let finite = |list: &Vec<f64>| list.iter().all(|x| x.is_finite());
        let fits = |list: &Vec<f64>| list.len() == numbers && finite(list);
        let length = displacements.len();
        let swept = length <= numbers && length.is_multiple_of(3) && finite(displacements);
        fits(start) && fits(reference) && swept && self.margin > 0.0 && self.margin.is_finite()
    }
}

impl CandidatePairs {
    /// Returns the detection of the pairs.
    pub(crate) fn detection(&self) -> PastDetection {
        let start = if self.start.is_empty() { &self.positions } else { &self.start };
        PastDetection {
            start: start.clone(),
            displacements: self.displacements.clone(),
            common: self.common,
            reference: self.positions.clone(),
            margin: self.margin,
        }
    }

    /// Moves the reference positions to where they were when a detection was told.
    pub(crate) fn follow_to(&mut self, past: &PastDetection) {
        self.positions.clone_from(&past.reference);
        self.common = past.common;
    }

    /// Pairs, sorted by kind and features.
    #[must_use]
    pub fn as_slice(&self) -> &[Pair] {
        &self.list
    }

    /// Flat reference positions, in m: those of the detection or, of pairs along trajectories, the
    /// points of these that were followed last.
    #[must_use]
    pub fn positions(&self) -> &[f64] {
        &self.positions
    }

    /// Margin: distance beyond the activation distance up to which pairs were detected, in m.
    #[must_use]
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// Replaces the pairs by those of another detection.
    pub(crate) fn replace<'a>(
        &mut self,
        found: impl Iterator<Item = &'a [Pair]>,
        detection: &Detection<'_>,
        free: usize,
    ) {
        self.clear();
        found.for_each(|pairs| self.list.extend_from_slice(pairs));
        self.positions.extend_from_slice(detection.positions);
        if let Some(displacements) = detection.sweep.displacements()
            && !displacements.is_empty()
        {
            self.start.extend_from_slice(detection.positions);
            self.displacements.extend_from_slice(displacements);
        }
        self.common = matches!(detection.sweep, Sweep::Common(_));
        (self.margin, self.free, self.revision) = (detection.margin, free, detection.revision);
        self.largest_of_bodies = largest(&detection.positions[3 * free..]);
    }

    /// Drops all pairs and positions, and keeps the memory.
    pub(crate) fn clear(&mut self) {
        let Self { list, positions, margin, free, start, displacements, common, revision, .. } =
            self;
        list.clear();
        *revision = None;
        [positions, start, displacements].into_iter().for_each(Vec::clear);
        (*margin, *free, *common) = (0.0, 0, false);
    }

    /// Moves the reference positions along the trajectories to where these come nearest to flat
    /// positions.
    pub(crate) fn follow_trajectories(&mut self, positions: &[f64]) {
        let count = self.displacements.len();
        if count == 0 || positions.len() < count {
            return;
        }
        for part in self.parts() {
            let start = &self.start[part.clone()];
            let displacement = &self.displacements[part.clone()];
            let offset = positions[part.clone()].iter().zip(start).map(|(x, start)| x - start);
            let fraction = nearest_fraction(displacement.iter().zip(offset).map(|(d, o)| [*d, o]));
            let along = start.iter().zip(displacement);
            for (position, (start, displacement)) in self.positions[part].iter_mut().zip(along) {
                *position = start + fraction * displacement;
            }
        }
    }

    /// Writes displacements from near the reference positions less their parts along the
    /// trajectories, in m; with `common` if all vertices move by a common fraction of them.
    pub(crate) fn write_off_trajectory(
        &self,
        displacements: &[f64],
        common: bool,
        off_trajectory: &mut Vec<f64>,
    ) {
        off_trajectory.clear();
        off_trajectory.extend_from_slice(displacements);
        if self.displacements.len() > displacements.len() || (self.common && !common) {
            return;
        }
        for part in self.parts() {
            // Rest of the trajectory.
            let ahead = |k: usize| self.start[k] + self.displacements[k] - self.positions[k];
            let fraction = nearest_fraction(part.clone().map(|k| [ahead(k), displacements[k]]));
            for k in part {
                off_trajectory[k] -= fraction * ahead(k);
            }
        }
    }

    /// Returns whether the pairs were detected on trajectories of bodies.
    pub(crate) fn have_moving_bodies(&self) -> bool {
        self.displacements.len() > 3 * self.free
    }

    /// Returns the start of a step from a placement. Only free vertices may differ from the reference
    /// positions if the bodies' positions have the same revision.
    pub(crate) fn step_start<'a>(&self, placement: &'a Placement) -> StepStart<'a> {
        match self.revision.is_some() && self.revision == placement.revision() {
            true => StepStart { positions: placement, moved: self.free },
            false => StepStart::new(placement),
        }
    }

    /// Returns the largest coordinate at the start of a step, in m.
    pub(crate) fn largest_coordinate(&self, start: StepStart<'_>) -> f64 {
        let StepStart { positions, moved } = start;
        let others = if 3 * moved < positions.len() { self.largest_of_bodies } else { 0.0 };
        largest(&positions[..3 * moved]).max(others)
    }

    /// Ranges of components that move by a common fraction of their displacements.
    fn parts(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let count = self.displacements.len();
        let part = if self.common { count.max(1) } else { 3 };
        (0..count).step_by(part).map(move |first| first..first + part)
    }
}

/// Returns the largest magnitude of some numbers.
pub(crate) fn largest(list: &[f64]) -> f64 {
    list.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()))
}
