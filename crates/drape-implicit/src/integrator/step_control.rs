//! Step control: divides a step into sub-steps. The length of a sub-step is the length of the step
//! over a power of two.

use super::formula::grows_gently;
use super::state::{IntegratorState, Span};
use crate::settings::{Integrator, Settings};

/// Progress of the sub-steps within a step.
#[derive(Debug)]
pub(crate) struct StepControl {
    /// Time at the start of the step, in s.
    origin: f64,
    /// Length of the step, in s.
    dt: f64,
    /// Number of halvings from the step to the shortest sub-step allowed.
    max_halvings: u32,
    /// Number of halvings from the step to the next sub-step.
    halvings: u32,
    /// Completed part of the step, in units of the shortest sub-step, and so exact.
    done: u64,
}

impl StepControl {
    /// Starts a step of length `dt`, in s, from `state`. The first sub-step is short enough for a
    /// second-order formula after the previous step.
    pub(crate) fn new(settings: &Settings, state: &IntegratorState, dt: f64) -> Self {
        let max_halvings = settings.max_halvings;
        let halvings = match (&state.previous, settings.integrator) {
            (Some(previous), Integrator::Bdf2) => (0..=max_halvings)
                .find(|&halvings| grows_gently(dt / (1_u64 << halvings) as f64, previous))
                .unwrap_or(max_halvings),
            _ => 0,
        };
        Self { origin: state.time, dt, max_halvings, halvings, done: 0 }
    }

    pub(crate) fn is_finished(&self) -> bool {
        self.done == self.whole()
    }

    /// Returns the next sub-step. It begins at the time `start`, in s. The sub-step is halved until
    /// `condition` holds for its start and end, or the shortest length is reached.
    pub(crate) fn next(&mut self, start: f64, condition: impl Fn(f64, f64) -> bool) -> Span {
        let admissible = (self.halvings..self.max_halvings)
            .find(|&halvings| condition(start, self.time_at(self.done_after(halvings))));
        self.halvings = admissible.unwrap_or(self.max_halvings);
        Span {
            start,
            end: self.time_at(self.done_after(self.halvings)),
            dt: self.dt / (1_u64 << self.halvings) as f64,
        }
    }

    /// Counts the sub-step as completed. The next sub-step may be twice as long if it begins at a
    /// multiple of this length.
    pub(crate) fn accept(&mut self) {
        self.done = self.done_after(self.halvings);
        let aligned = self.max_halvings.saturating_sub(self.done.trailing_zeros());
        self.halvings = aligned.max(self.halvings.saturating_sub(1));
    }

    /// Halves the next sub-step. Returns `false` if the sub-step has the shortest length already.
    pub(crate) fn halve(&mut self) -> bool {
        let possible = self.halvings < self.max_halvings;
        self.halvings += u32::from(possible);
        possible
    }

    /// Returns the length of the step, in units of the shortest sub-step.
    fn whole(&self) -> u64 {
        1_u64 << self.max_halvings
    }

    /// Returns the completed part after a sub-step with `halvings`.
    fn done_after(&self, halvings: u32) -> u64 {
        self.done + (self.whole() >> halvings)
    }

    /// Returns the time at the end of the completed part `done`, in s.
    fn time_at(&self, done: u64) -> f64 {
        let whole = self.whole();
        if done == whole {
            self.origin + self.dt
        } else {
            self.origin + self.dt * (done as f64 / whole as f64)
        }
    }
}
