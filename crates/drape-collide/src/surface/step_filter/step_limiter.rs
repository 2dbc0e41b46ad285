//! Limiter of trial steps: detection along the trajectories of a step, then the step filter.

use super::ccd_filter::CcdFilter;
use super::trial::DRIFT_BUDGET;
use crate::error::Error;
use crate::surface::broad_phase::Sweep;
use crate::surface::contact_surface::Surface;
use crate::surface::placement::Placement;
use crate::surface::tracked_pairs::TrackedPairs;
use crate::vector::{norm, scale};

/// Largest displacement over an edge's length when all vertices have a common fraction. The list of
/// pairs of a larger step would cost more than two steps.
const LARGEST_COMMON: f64 = 4.0;

/// Largest displacement over an edge's length when every vertex has its individual fraction (see
/// [`LARGEST_COMMON`]).
const LARGEST_INDIVIDUAL: f64 = 0.5;

/// Common fraction of a step below which the step is truncated vertex by vertex instead.
///
/// A common fraction keeps a direction of descent, but one near pair then stops all vertices. With
/// 0.6, 0.35, 0.2, 0.1 and 0.05, the first 0.12 s of twenty sheets took 67, 59, 58, 54 and 51 s.
const LOCKED: f64 = 0.05;

/// Trial step of a solver, of the free vertices and of the bodies.
#[derive(Debug)]
pub struct SurfaceTrial<'a> {
    /// Positions of the free vertices at the start of the step, flat, in m.
    pub start: &'a [f64],
    /// Displacements of the free vertices, flat, in m. They are shortened in place.
    pub displacements: &'a mut [f64],
    /// Numbers of the free vertices whose motion is prescribed, from 0: of vertices, not of
    /// coordinates. They move by the fraction of the bodies.
    pub held: &'a [usize],
    /// Obstacle time at the start of the step: fraction of the bodies' motion in the open step, 0
    /// to 1.
    pub obstacle_time: f64,
    /// Fraction of the bodies' motion during the trial step. It is shortened in place.
    pub obstacle_advance: &'a mut f64,
}

/// Filter of steps with the positions and displacements of all vertices.
#[derive(Debug)]
pub(crate) struct StepLimiter {
    pub(crate) filter: CcdFilter,
    /// Largest displacements of a step, in m: with a common fraction and with individual fractions.
    largest: [f64; 2],
    /// Positions of all vertices at the start of the step, in m.
    pub(crate) positions: Placement,
    /// Displacements of all vertices or, where bodies rest, of the free vertices, in m. The limiter
    /// shortens them.
    pub(crate) displacements: Vec<f64>,
    /// Displacements before the limit, in m.
    whole: Vec<f64>,
    /// Group of each free vertex that moves by a common fraction.
    groups: Vec<u32>,
    /// Whether the motion of each group is prescribed.
    is_prescribed: Vec<bool>,
    /// Remaining fraction of the displacements in each group.
    fractions: Vec<f64>,
    /// Displacements less their parts along the trajectories of the pairs, in m.
    off_trajectory: Vec<f64>,
}

impl StepLimiter {
    /// Returns the limiter of surfaces with the lengths `activation_distance` and `edge`, in m.
    pub(crate) fn new(activation_distance: f64, edge: f64) -> StepLimiter {
        let largest = [LARGEST_COMMON, LARGEST_INDIVIDUAL];
        StepLimiter {
            filter: CcdFilter::default(),
            largest: largest.map(|edges| (edges * edge).max(activation_distance)),
            positions: Placement::default(),
            displacements: Vec::new(),
            whole: Vec::new(),
            groups: Vec::new(),
            is_prescribed: Vec::new(),
            fractions: Vec::new(),
            off_trajectory: Vec::new(),
        }
    }

    /// Limits the displacements. Returns the fraction by which bodies and `held` vertices move, or
    /// `None` if all displacements remain whole.
    pub(crate) fn limit(
        &mut self,
        surface: &Surface,
        tracked: &mut TrackedPairs,
        held: &[usize],
    ) -> Result<Option<f64>, Error> {
        self.whole.clone_from(&self.displacements);
        // A common fraction keeps the direction of the step.
        let common_part = self.shorten_together();
        self.detect(surface, tracked, true)?;
        let Self { filter, positions, displacements, .. } = self;
        let pairs = tracked.pairs();
        let start = pairs.step_start(positions);
        let fraction = filter.common_fraction_from(pairs, start, displacements)?.value;
        if fraction >= 1.0 {
            return Ok((common_part < 1.0).then_some(common_part));
        }
        if fraction >= LOCKED {
            displacements.iter_mut().for_each(|component| *component *= fraction);
            return Ok(Some(common_part * fraction));
        }

        // Too little of the step would be left, so each vertex gets its fraction.
        displacements.copy_from_slice(&self.whole);
        self.group_vertices(surface, held);
        let body_part = self.shorten_by_group();
        self.detect(surface, tracked, false)?;
        let Self { filter, positions, displacements, groups, .. } = self;
        let pairs = tracked.pairs();
        let start = pairs.step_start(positions);
        let truncation = filter.truncate_from(pairs, start, displacements, groups)?;
        Ok(Some(body_part * truncation.body_fraction))
    }

    /// Groups the free vertices that move by a common fraction: vertices that closed seams join or
    /// tie, and vertices whose motion is prescribed (`held`), which move with the bodies.
    fn group_vertices(&mut self, surface: &Surface, held: &[usize]) {
        let free = surface.free_count();
        let Self { groups, is_prescribed, .. } = self;
        groups.clear();
        groups.extend((0..free as u32).map(|vertex| surface.moving_class(vertex)));
        is_prescribed.clear();
        is_prescribed.resize(free, false);
        held.iter().for_each(|&vertex| is_prescribed[groups[vertex] as usize] = true);
        for group in groups.iter_mut().filter(|group| is_prescribed[**group as usize]) {
            *group = free as u32;
        }
    }

    /// Shortens all displacements by a common fraction if the largest exceeds the first entry of
    /// `largest`. Returns the fraction.
    fn shorten_together(&mut self) -> f64 {
        let (longest, most) = (largest_norm(&self.displacements), self.largest[0]);
        let fraction = if longest > most { most / longest } else { 1.0 };
        self.displacements.iter_mut().for_each(|component| *component *= fraction);
        fraction
    }

    /// Shortens the displacements of each group whose largest exceeds the second entry of
    /// `largest`. Returns the remaining fraction of bodies and held vertices.
    fn shorten_by_group(&mut self) -> f64 {
        let Self { groups, fractions, displacements, .. } = self;
        let (free, most) = (groups.len(), self.largest[1]);
        fractions.clear();
        fractions.resize(free + 1, 1.0);
        let displacements = displacements.as_chunks_mut::<3>().0;
        for (vertex, displacement) in displacements.iter().enumerate() {
            let fraction = &mut fractions[group_of(groups, vertex)];
            *fraction = fraction.min(most / norm(*displacement));
        }
        for (vertex, displacement) in displacements.iter_mut().enumerate() {
            *displacement = scale(*displacement, fractions[group_of(groups, vertex)]);
        }
        fractions[free]
    }

    /// Detects the pairs on the trajectories of all vertices, unless the listed pairs cover them.
    /// With `common`, all vertices move by a common fraction.
    fn detect(
        &mut self,
        surface: &Surface,
        tracked: &mut TrackedPairs,
        common: bool,
    ) -> Result<(), Error> {
        let (positions, displacements) = (&self.positions, &self.displacements);
        tracked.follow_trajectories(positions);
        tracked.pairs().write_off_trajectory(displacements, common, &mut self.off_trajectory);
        let longest = largest_norm(&self.off_trajectory);
        // A drift of NaN is not covered, so pairs are detected anew.
        let budget = DRIFT_BUDGET * tracked.pairs().margin();
        let covered = tracked.measure_drift(positions) + longest <= budget;
        if !covered && self.filter.safeguards.swept_detection {
            // Bodies at rest have no displacements.
            let displacements = match positions.revision() {
                Some(_) => &displacements[..3 * surface.free_count()],
                None => &displacements[..],
            };
            let sweep = if common {
                Sweep::Common(displacements)
            } else {
                Sweep::Individual(displacements)
            };
            tracked.detect(surface, positions, sweep)?;
        }
        Ok(())
    }
}

/// Returns the group of `vertex`. Vertices of bodies, beyond the end of `groups`, form the last
/// group.
fn group_of(groups: &[u32], vertex: usize) -> usize {
    groups.get(vertex).map_or(groups.len(), |&group| group as usize)
}

/// Returns the largest length among flat `vectors`.
fn largest_norm(vectors: &[f64]) -> f64 {
    vectors.as_chunks::<3>().0.iter().map(|vector| norm(*vector)).fold(0.0, f64::max)
}
