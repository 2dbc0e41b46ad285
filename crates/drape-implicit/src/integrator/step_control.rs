//! Step control: divides a step into sub-steps of its length over powers of two.

use super::formula::grows_gently;
use super::state::{IntegratorState, Span};
use crate::settings::{Integrator, Settings};

/// Progress within a step that is made in sub-steps.
#[derive(Debug)]
pub(crate) struct StepControl {
    /// Time at the start of the step and its length, in s.
    origin: f64,
    dt: f64,
    /// Halvings of the shortest sub-step allowed.
    max_halvings: u32,
    /// Halvings of the next sub-step.
    halvings: u32,
    /// Part of the step that is done, in units of the shortest sub-step, and so exact.
    done: u64,
}

impl StepControl {
    /// Starts a step of length `dt`. The first sub-step is short enough for the formula of second
    /// order after the last one.
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

    /// Next sub-step, halved until the condition holds for its start and end, or to the shortest
    /// one.
    pub(crate) fn next(&mut self, start: f64, condition: impl Fn(f64, f64) -> bool) -> Span {
        let holds = |&halvings: &u32| condition(start, self.time_at(self.done_after(halvings)));
        let found = (self.halvings..self.max_halvings).find(holds);
        self.halvings = found.unwrap_or(self.max_halvings);
        Span {
            start,
            end: self.time_at(self.done_after(self.halvings)),
            dt: self.dt / (1_u64 << self.halvings) as f64,
        }
    }

    /// Counts the sub-step as done. The next one may be twice as long if it then begins on a
    /// multiple of its length.
    pub(crate) fn accept(&mut self) {
        self.done = self.done_after(self.halvings);
        let aligned = self.max_halvings.saturating_sub(self.done.trailing_zeros());
        self.halvings = aligned.max(self.halvings.saturating_sub(1));
    }

    /// Halves the sub-step. Returns false if it is the shortest allowed.
    pub(crate) fn halve(&mut self) -> bool {
        let possible = self.halvings < self.max_halvings;
        self.halvings += u32::from(possible);
        possible
    }

    fn whole(&self) -> u64 {
        1_u64 << self.max_halvings
    }

    /// Part that is done after a sub-step of given halvings.
    fn done_after(&self, halvings: u32) -> u64 {
        self.done + (self.whole() >> halvings)
    }

    /// Time when a part is done, in s.
    fn time_at(&self, done: u64) -> f64 {
        let whole = self.whole();
        if done == whole {
            self.origin + self.dt
        } else {
            self.origin + self.dt * (done as f64 / whole as f64)
        }
    }
}
