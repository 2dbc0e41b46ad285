//! Saved state of the integration in time, on which its next steps depend.

use drape_implicit::{IntegratorState, System};
use serde::{Deserialize, Serialize};

use super::Stepping;
use super::accuracy::{Accuracy, relaxation_scheme};
use super::scheme::Scheme;
use super::step_control::{SavedControl, StepControl};
use crate::sewing::reduction::Reduction;
use crate::world::World;

/// State of the integration in time, on which its next steps depend.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct SavedStepping {
    integrator: IntegratorState,
    accuracy: Accuracy,
    control: SavedControl,
    /// Latest end of the run, in s.
    pub(crate) end: f64,
    /// Largest number of ticks of a step.
    ticks_max: usize,
    /// Current time, in ticks.
    ticks: usize,
}

impl SavedStepping {
    /// Returns the time, in ticks.
    pub(crate) fn ticks(&self) -> usize {
        self.ticks
    }
}

impl Stepping {
    /// Returns the state on which the next steps depend.
    pub(crate) fn saved(&self) -> SavedStepping {
        SavedStepping {
            integrator: self.state.clone(),
            accuracy: self.accuracy,
            control: self.control.saved(),
            end: self.clock.end,
            ticks_max: self.clock.ticks_max,
            ticks: self.ticks,
        }
    }

    /// Restores the state `saved` for `world`, whose state has been restored.
    ///
    /// # Errors
    /// Returns a description of the part that does not fit.
    pub(crate) fn resume(&mut self, world: &mut World, saved: SavedStepping) -> Result<(), String> {
        let SavedStepping { integrator, accuracy, control, end, ticks_max, ticks } = saved;
        let particles =
            self.reduction.as_ref().map_or(world.particle_count(), Reduction::particle_count);
        integrator.check(particles).map_err(|error| error.to_string())?;
        let mut clock = self.clock;
        (clock.end, clock.ticks_max) = (end, ticks_max);
        if !(end > 0.0 && end.is_finite()) || ticks_max == 0 || ticks > clock.end_ticks() {
            return Err("its clock is wrong".into());
        }

        let scheme = match &self.scheme {
            Scheme::Implicit(settings) if world.relaxes() => relaxation_scheme(settings, accuracy),
            scheme => scheme.clone(),
        };
        self.control = StepControl::resumed(clock, self.scheme.order(), control);
        (self.clock, self.ticks, self.accuracy, self.state) = (clock, ticks, accuracy, integrator);
        self.set_up(world, &scheme).map_err(|error| error.to_string())
    }

    /// Extends the run by `seconds` beyond its end.
    pub(crate) fn extend(&mut self, seconds: f64) {
        self.clock.end += seconds;
        let saved = self.control.saved();
        self.control = StepControl::resumed(self.clock, self.scheme.order(), saved);
    }
}
