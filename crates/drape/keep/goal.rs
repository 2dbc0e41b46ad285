//! Goal of a run: a time, or rest.

use crate::dynamics::{PhaseName, Simulation, Step};
use crate::scene::Relaxation;

/// Goal of a run, by which it is known how much of it is done.
#[derive(Debug, Clone)]
pub struct Goal {
    /// Time of the end at the latest, in ticks.
    ticks: usize,
    rest: Option<Relaxation>,
    phase: PhaseName,
    /// Largest distance from rest in the phase: speed or imbalance over what counts as rest.
    farthest: f64,
}

impl Goal {
    /// Returns the goal of a simulation.
    #[must_use]
    pub fn new(simulation: &Simulation) -> Self {
        Self {
            ticks: simulation.ticks_to_do(),
            rest: simulation.rest_criteria(),
            phase: PhaseName::Simulate,
            farthest: 1.0,
        }
    }

    /// Returns what counts as rest, where the scene asks for it.
    #[must_use]
    pub fn rest(&self) -> Option<Relaxation> {
        self.rest
    }

    /// Returns the speed or the imbalance after a step over what counts as rest, the larger one.
    fn distance(&self, step: &Step) -> Option<f64> {
        let Relaxation { speed, residual, .. } = self.rest?;
        Some((step.speed_max / speed).max(step.imbalance / residual))
    }

    /// Returns how much of the phase is done, 0 to 1: of the time, or, on the way to rest, of the
    /// decades between the largest distance from rest and rest.
    pub fn done(&mut self, step: &Step, ticks: usize) -> f64 {
        if step.phase != self.phase {
            (self.phase, self.farthest) = (step.phase, 1.0);
        }
        match self.distance(step) {
            Some(distance) if step.phase == PhaseName::Relax => {
                self.farthest = self.farthest.max(distance);
                1.0 - distance.max(1.0).ln() / self.farthest.ln().max(f64::MIN_POSITIVE)
            }
            _ => ticks as f64 / self.ticks as f64,
        }
    }
}
