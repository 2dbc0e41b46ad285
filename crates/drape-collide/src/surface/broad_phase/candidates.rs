//! Candidate pairs of a detection.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::sweep::{Sweep, nearest_fraction};
use crate::surface::pair::Pair;
use crate::surface::placement::{Placement, StepStart};

/// Sorted list of the pairs that come near each other at given positions or on trajectories from
/// there.
///
/// As long as no vertex is farther than half of the margin from its trajectory, no other pair is
/// within its activation distance.
#[derive(Debug, Clone, Default)]
pub struct CandidatePairs {
    list: Vec<Pair>,
    /// Reference positions, in m: of trajectories, the points that were followed last.
    positions: Vec<f64>,
    pub(crate) margin: f64,
    pub(crate) free: usize,
    /// Revision of the bodies' positions, `None` while bodies move.
    revision: Option<u64>,
    /// Largest coordinate of the bodies' reference positions, in m.
    largest_of_bodies: f64,
    /// Start of the trajectories, in m, empty without trajectories.
    start: Vec<f64>,
    /// Displacements along the trajectories, in m, empty without trajectories. Where bodies rest,
    /// only free vertices have displacements.
    displacements: Vec<f64>,
    /// Whether all vertices move by a common fraction of their displacements.
    common: bool,
}

/// Positions, trajectories and margin of a detection.
pub(crate) struct Detection<'a> {
    pub(crate) positions: &'a [f64],
    /// Revision of the bodies' positions, `None` while bodies move.
    pub(crate) revision: Option<u64>,
    pub(crate) sweep: Sweep<'a>,
    pub(crate) margin: f64,
}

/// Record of a detection, from which it can be repeated: its positions, its trajectories and how
/// far these were followed.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct PastDetection {
    /// Positions of the detection, in m, empty without a detection.
    pub(crate) start: Vec<f64>,
    /// Displacements along the trajectories, in m, empty without trajectories.
    pub(crate) displacements: Vec<f64>,
    /// Whether all vertices move by a common fraction of their displacements.
    common: bool,
    /// Reference positions, in m.
    reference: Vec<f64>,
    pub(crate) margin: f64,
}

impl PastDetection {
    /// Returns the trajectories as a [`Sweep`].
    pub(crate) fn sweep(&self) -> Sweep<'_> {
        if self.displacements.is_empty() {
            Sweep::Still
        } else if self.common {
            Sweep::Common(&self.displacements)
        } else {
            Sweep::Individual(&self.displacements)
        }
    }

    /// Returns whether the lists fit flat positions with `coordinate_count` coordinates and hold
    /// only finite values.
    pub(crate) fn fits(&self, coordinate_count: usize) -> bool {
        let Self { start, displacements, reference, .. } = self;
        let lengths_fit = start.len() == coordinate_count
            && reference.len() == coordinate_count
            && displacements.len() <= coordinate_count
            && displacements.len().is_multiple_of(3);
        let mut values = start.iter().chain(reference).chain(displacements);
        lengths_fit && values.all(|x| x.is_finite()) && self.margin > 0.0 && self.margin.is_finite()
    }
}

impl CandidatePairs {
    /// Returns the record of the detection that found these pairs, as a [`PastDetection`].
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

    /// Restores the reference positions stored in `past`.
    pub(crate) fn restore_reference(&mut self, past: &PastDetection) {
        self.positions.clone_from(&past.reference);
        self.common = past.common;
    }

    /// Returns the pairs, sorted by [`Pair::key`].
    #[must_use]
    pub fn as_slice(&self) -> &[Pair] {
        &self.list
    }

    /// Returns the flat reference positions, in m. They are the positions of the detection or,
    /// along trajectories, the points that [`Detector::follow_trajectories`] reached last.
    ///
    /// [`Detector::follow_trajectories`]: crate::Detector::follow_trajectories
    #[must_use]
    pub fn positions(&self) -> &[f64] {
        &self.positions
    }

    /// Returns the margin: the distance beyond the activation distance up to which pairs are
    /// listed, in m.
    #[must_use]
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// Replaces the pairs by the `lists` of a `detection` with `free` free vertices.
    pub(crate) fn replace<'a>(
        &mut self,
        lists: impl Iterator<Item = &'a [Pair]>,
        detection: &Detection<'_>,
        free: usize,
    ) {
        self.clear();
        lists.for_each(|pairs| self.list.extend_from_slice(pairs));
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

    /// Moves the reference positions along the trajectories to the points nearest to the flat
    /// `positions`, in m.
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

    /// Writes `displacements` less their parts along the trajectories to `off_trajectory`, in m.
    /// `displacements` begin near the reference positions. With `common`, all vertices move by a
    /// common fraction of them.
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
            // What remains of the trajectory.
            let ahead = |k: usize| self.start[k] + self.displacements[k] - self.positions[k];
            let fraction = nearest_fraction(part.clone().map(|k| [ahead(k), displacements[k]]));
            for k in part {
                off_trajectory[k] -= fraction * ahead(k);
            }
        }
    }

    /// Returns whether the [`Sweep`] of the detection moved bodies.
    pub(crate) fn have_moving_bodies(&self) -> bool {
        self.displacements.len() > 3 * self.free
    }

    /// Returns the start of a step at `placement`. If the bodies of `placement` have the revision
    /// of the pairs, only free vertices may differ from their reference positions.
    pub(crate) fn step_start<'a>(&self, placement: &'a Placement) -> StepStart<'a> {
        if self.revision.is_some() && self.revision == placement.revision() {
            StepStart { positions: placement, moved: self.free }
        } else {
            StepStart::new(placement)
        }
    }

    /// Returns the largest magnitude of a coordinate at `start`, in m.
    pub(crate) fn largest_coordinate(&self, start: StepStart<'_>) -> f64 {
        let StepStart { positions, moved } = start;
        let unmoved = if 3 * moved < positions.len() { self.largest_of_bodies } else { 0.0 };
        largest(&positions[..3 * moved]).max(unmoved)
    }

    /// Returns the ranges of `displacements` that move by a common fraction.
    fn parts(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let count = self.displacements.len();
        let length = if self.common { count.max(1) } else { 3 };
        (0..count).step_by(length).map(move |first| first..first + length)
    }
}

/// Returns the largest magnitude in `list`, or 0 for an empty list.
pub(crate) fn largest(list: &[f64]) -> f64 {
    list.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()))
}
