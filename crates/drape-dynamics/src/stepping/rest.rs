//! Detection of rest: the cloth has been slow and balanced for a while.

use drape_scene::Relaxation;

/// Time for which the cloth must stay slow to be at rest, in s.
///
/// A swing stops for a moment at each of its ends. A tenth of a second is longer than this moment,
/// except for a cloth of many metres, and short compared with the seconds that a drape takes.
const REST_TIME: f64 = 0.1;

/// Detector of rest.
#[derive(Debug)]
pub(crate) struct RestDetector {
    /// Criteria of rest, if the scene asks for rest.
    pub(crate) criteria: Option<Relaxation>,
    /// Time for which the cloth has been slow, in ticks of the clock.
    quiet_ticks: usize,
}

/// Motion of the cloth after a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepMotion {
    /// Length of the step, in ticks of the clock.
    pub(crate) ticks: usize,
    /// Largest speed of a particle, in m/s.
    pub(crate) speed_max: f64,
    /// Root-mean-square acceleration of the free particles, over g.
    pub(crate) imbalance: f64,
    /// Whether the step may count as rest: the scene prescribes no further change, and the step was
    /// solved accurately enough.
    pub(crate) counts: bool,
}

impl RestDetector {
    /// Returns a detector of rest by `criteria`. Without criteria the cloth never counts as at
    /// rest.
    pub(crate) fn new(criteria: Option<Relaxation>) -> Self {
        Self { criteria, quiet_ticks: 0 }
    }

    /// Returns the time for which the cloth has been slow, in ticks of the clock.
    pub(crate) fn quiet_ticks(&self) -> usize {
        self.quiet_ticks
    }

    /// Returns a detector of rest by `criteria` for a cloth that has been slow for `quiet_ticks`.
    pub(crate) fn resumed(criteria: Option<Relaxation>, quiet_ticks: usize) -> Self {
        Self { criteria, quiet_ticks }
    }

    /// Updates the detector after `step`.
    pub(crate) fn update(&mut self, step: &StepMotion) {
        let Some(criteria) = self.criteria else { return };
        let slow = step.speed_max <= criteria.speed && step.imbalance <= criteria.residual;
        let quiet = slow && step.counts;
        self.quiet_ticks = if quiet { self.quiet_ticks + step.ticks } else { 0 };
    }

    /// Returns whether the cloth is at rest. `tick` is the length of a tick, in s.
    pub(crate) fn is_at_rest(&self, tick: f64) -> bool {
        self.criteria.is_some() && self.quiet_ticks as f64 * tick >= REST_TIME
    }
}
