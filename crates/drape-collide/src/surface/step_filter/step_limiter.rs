//! Limit of a trial step: detection along its trajectories, then the step filter.

use super::ccd_filter::CcdFilter;
use super::trial::DRIFT_BUDGET;
use crate::error::Error;
use crate::surface::broad_phase::Sweep;
use crate::surface::contact_surface::Surface;
use crate::surface::placement::Placement;
use crate::surface::tracked_pairs::TrackedPairs;
use crate::vector::{at, norm, scale};

/// Largest displacement of a step over the length of an edge if all vertices move by a common
/// fraction: the list of pairs of larger ones costs more than two steps.
const LARGEST_COMMON: f64 = 4.0;

/// The same if each vertex moves by a fraction of its own.
const LARGEST_INDIVIDUAL: f64 = 0.5;

/// Fraction of a step below which it is truncated vertex by vertex instead. A common fraction keeps
/// a direction of descent, but one near pair then stops all vertices.
const LOCKED: f64 = 0.2;

/// Trial step of a solver, of the free vertices and of the bodies.
#[derive(Debug)]
pub struct SurfaceStep<'a> {
    /// Positions of the free vertices at its start, in m.
    pub start: &'a [f64],
    /// Displacements of the free vertices, in m.
    pub displacements: &'a mut [f64],
    /// Free vertices whose motion is prescribed, as that of the bodies.
    pub held: &'a [usize],
    /// Obstacle time: fraction of the bodies' motion in the open step at its start, 0 to 1.
    pub obstacle_time: f64,
    /// Fraction of the bodies' motion in the trial step.
    pub obstacle_advance: &'a mut f64,
}

/// Filter of steps with the positions and displacements of all vertices.
#[derive(Debug)]
pub(crate) struct StepLimiter {
    pub(crate) filter: CcdFilter,
    /// Largest displacements of a step, in m: with a common fraction and with individual ones.
    largest: [f64; 2],
    /// Positions of all vertices at the start of the step, in m.
    pub(crate) positions: Placement,
    /// Displacements of all vertices, or of the free ones where bodies rest, in m; limited in place.
    pub(crate) displacements: Vec<f64>,
    /// Displacements before the limit, in m.
    whole: Vec<f64>,
    /// Displacements less their parts along the trajectories of the pairs, in m.
    off_trajectory: Vec<f64>,
}

impl StepLimiter {
    /// Limiter of surfaces with an activation distance and edges of a length, in m.
    pub(crate) fn new(activation_distance: f64, edge: f64) -> StepLimiter {
        let largest = [LARGEST_COMMON, LARGEST_INDIVIDUAL];
        StepLimiter {
            filter: CcdFilter::default(),
            largest: largest.map(|edges| (edges * edge).max(activation_distance)),
            positions: Placement::default(),
            displacements: Vec::new(),
            whole: Vec::new(),
            off_trajectory: Vec::new(),
        }
    }

    /// Limits the displacements. Returns the fraction of theirs by which bodies and held vertices
    /// move; none if all displacements are whole.
    pub(crate) fn limit(
        &mut self,
        surface: &Surface,
        tracked: &mut TrackedPairs,
        held: &[usize],
    ) -> Result<Option<f64>, Error> {
        self.whole.clone_from(&self.displacements);
        let shortened = self.detect(surface, tracked, true)?;
        let Self { filter, positions, displacements, .. } = self;
        let pairs = tracked.pairs();
        let start = pairs.step_start(positions);
        let fraction = filter.common_fraction_from(pairs, start, displacements)?.value;
        if fraction >= 1.0 {
            return Ok((shortened < 1.0).then_some(shortened));
        }
        if fraction >= LOCKED {
            displacements.iter_mut().for_each(|component| *component *= fraction);
            return Ok(Some(shortened * fraction));
        }
        displacements.copy_from_slice(&self.whole);
        self.detect(surface, tracked, false)?;
        let Self { filter, positions, displacements, whole, .. } = self;
        let pairs = tracked.pairs();
        filter.truncate_from(pairs, pairs.step_start(positions), displacements)?;
        let free = surface.free_count();
        let fraction_of = |vertex: usize| {
            let [after, before] = [norm(at(displacements, vertex)), norm(at(whole, vertex))];
            if before > 0.0 { after / before } else { 1.0 }
        };
        let bodies = free..displacements.len() / 3;
        let prescribed = held.iter().copied().chain(bodies);
        let fraction = prescribed.map(fraction_of).fold(1.0, f64::min);
        // A smaller fraction of a safe displacement is safe too.
        let prescribed = held.iter().flat_map(|vertex| 3 * vertex..3 * vertex + 3);
        for k in prescribed.chain(3 * free..displacements.len()) {
            displacements[k] = fraction * whole[k];
        }
        Ok(Some(fraction))
    }

    /// Detects the pairs on the trajectories of all vertices, unless those at hand include them.
    /// Shortens displacements that are too large for that, by a common fraction or each by its own;
    /// returns the common fraction.
    fn detect(
        &mut self,
        surface: &Surface,
        tracked: &mut TrackedPairs,
        common: bool,
    ) -> Result<f64, Error> {
        let (positions, displacements) = (&self.positions, &mut self.displacements);
        let longest = largest_norm(displacements);
        let most = self.largest[usize::from(!common)];
        let fraction = if longest > most { most / longest } else { 1.0 };
        for displacement in displacements.as_chunks_mut::<3>().0 {
            let fraction = if common { fraction } else { (most / norm(*displacement)).min(1.0) };
            *displacement = scale(*displacement, fraction);
        }
        tracked.follow_trajectories(positions);
        tracked.pairs().write_off_trajectory(displacements, common, &mut self.off_trajectory);
        let longest = largest_norm(&self.off_trajectory);
        // NaN detects anew.
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
        Ok(fraction)
    }
}

/// Returns the largest length of some flat vectors.
fn largest_norm(vectors: &[f64]) -> f64 {
    vectors.as_chunks::<3>().0.iter().map(|vector| norm(*vector)).fold(0.0, f64::max)
}
