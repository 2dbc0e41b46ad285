//! Continuous collision detection of a step, for all vertices together or for each vertex.

use super::common_fraction::{StepFraction, common_fraction};
use super::safeguards::Safeguards;
use super::trial::{Drift, Trial};
use super::truncation::{Truncation, Truncator, WholeStep};
use crate::error::Error;
use crate::surface::broad_phase::CandidatePairs;
use crate::surface::placement::StepStart;

/// Filter that limits steps such that no two primitives come below their minimum separation.
///
/// Positions and displacements are flat, for all vertices of the surface including bodies. Where
/// bodies rest, displacements of the free vertices suffice. The results are proofs for vertices
/// that all move at the same time, straight from `x` to `x + dx` as rounded. Every listed pair
/// keeps a twentieth of its clearance. Every other pair stays beyond its activation distance as
/// long as no vertex drifts farther than 0.45 margins from the reference positions of the pairs or
/// from the trajectories along which they were detected. The filter limits the drift, and fails if
/// the positions have drifted farther already.
///
/// The filter keeps its memory between calls.
#[derive(Debug, Default)]
pub struct CcdFilter {
    drift: Drift,
    truncator: Truncator,
    /// Displacements before a truncation, in m.
    whole: Vec<f64>,
    pub(crate) safeguards: Safeguards,
}

impl CcdFilter {
    /// Returns a fraction of a step that conservative advancement proves safe for all vertices
    /// together. The step leads from `positions` along `displacements`, in m.
    ///
    /// The fraction is for the step of a solver, and is less than the time of impact: each listed
    /// pair keeps a tenth of its clearance above its minimum separation, the proof stops up to a
    /// fiftieth of this tenth earlier, and no vertex drifts beyond the budget of the pairs. Two
    /// triangles that close a clearance of 1 mm by 2 mm stop at 0.45 instead of 0.5.
    /// [`earliest_impact`](crate::earliest_impact) finds the time of impact, with its pair. A common
    /// fraction keeps the direction of the step.
    ///
    /// # Errors
    ///
    /// A list has the wrong length; a number is not finite or beyond 1000 km; or the positions have
    /// drifted beyond the budget of the pairs.
    pub fn common_fraction(
        &mut self,
        pairs: &CandidatePairs,
        positions: &[f64],
        displacements: &[f64],
    ) -> Result<StepFraction, Error> {
        self.common_fraction_from(pairs, StepStart::new(positions), displacements)
    }

    /// Like [`common_fraction`](CcdFilter::common_fraction), from a `start` at which only some
    /// vertices may have moved.
    pub(crate) fn common_fraction_from(
        &mut self,
        pairs: &CandidatePairs,
        start: StepStart<'_>,
        displacements: &[f64],
    ) -> Result<StepFraction, Error> {
        let smallest = self.drift.measure(pairs, (start, displacements), true, self.safeguards)?;
        let step = Trial { positions: start.positions, displacements, smallest };
        let (drift, safeguards) = (&self.drift, self.safeguards);
        let mut budget: f64 = 1.0;
        if safeguards.drift_budget {
            for vertex in 0..drift.vertices() {
                budget = budget.min(drift.budget_fraction(pairs, &step, vertex));
            }
        }
        let stays_apart = |pair: &_| drift.stays_apart(pair, &step);
        Ok(common_fraction(pairs.as_slice(), &step, budget, stays_apart))
    }

    /// Truncates the displacement of each vertex in `displacements` by as much as its pairs need.
    ///
    /// As in \[Che26\], two primitives that approach each other divide their room by their speeds.
    /// Here the plane between them moves: a primitive that follows another may go as far as the
    /// other and their room, so layers that fall together keep their displacements. Fractions are
    /// limited again until no pair takes more than its room. The direction of the step changes only
    /// near other primitives. The vertices of bodies move by a common fraction.
    ///
    /// # Errors
    ///
    /// As for [`common_fraction`](CcdFilter::common_fraction).
    pub fn truncate(
        &mut self,
        pairs: &CandidatePairs,
        positions: &[f64],
        displacements: &mut [f64],
    ) -> Result<Truncation, Error> {
        self.truncate_from(pairs, StepStart::new(positions), displacements, &[])
    }

    /// Like [`truncate`](CcdFilter::truncate), from a `start` at which only some vertices may have
    /// moved. Vertices of one group move by a common fraction; see [`WholeStep::groups`].
    pub(crate) fn truncate_from(
        &mut self,
        pairs: &CandidatePairs,
        start: StepStart<'_>,
        displacements: &mut [f64],
        groups: &[u32],
    ) -> Result<Truncation, Error> {
        let smallest = self.drift.measure(pairs, (start, displacements), false, self.safeguards)?;
        let Self { drift, truncator, whole, safeguards } = self;
        whole.clear();
        whole.extend_from_slice(displacements);
        let trial = Trial { positions: start.positions, displacements: whole, smallest };
        let step = WholeStep { pairs, trial, drift, groups, safeguards: *safeguards };
        Ok(truncator.truncate(step, displacements))
    }
}
