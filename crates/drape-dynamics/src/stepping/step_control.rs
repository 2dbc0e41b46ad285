//! Step control: lengths of the steps, by an estimate of their error or, in relaxation, by
//! displacements.

use drape_scene::{Clock, Relaxation};
use serde::{Deserialize, Serialize};

/// Fraction of the length that the error estimate would allow which is taken: estimates lag by a
/// step, and a step that fails is made twice.
const CAUTION: f64 = 0.9;

/// Largest factor by which a rejected step is shortened at once: a large estimate is a poor one.
const SHORTEST_CUT: usize = 8;

/// Largest factor by which a step of relaxation is longer or shorter than the one before it.
const CHANGE: f64 = 2.0;

/// Lengths of the steps, in ticks of the clock.
#[derive(Debug, Clone)]
pub(crate) struct StepControl {
    clock: Clock,
    relaxation: Option<Relaxation>,
    /// Order of accuracy of the integrator.
    order: f64,
    /// Ticks of the next step, if neither a frame nor the end cuts it short.
    wanted: usize,
    /// Ticks that the error of the last step would allow the next one.
    exact: usize,
}

/// State of a step control between two steps.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct SavedControl {
    relaxation: Option<Relaxation>,
    wanted: usize,
    exact: usize,
}

impl StepControl {
    /// Returns what is remembered between two steps.
    pub(crate) fn saved(&self) -> SavedControl {
        let Self { relaxation, wanted, exact, .. } = *self;
        SavedControl { relaxation, wanted, exact }
    }

    /// Control that goes on from what was remembered.
    pub(crate) fn resumed(clock: Clock, order: f64, saved: SavedControl) -> Self {
        let SavedControl { relaxation, wanted, exact } = saved;
        let wanted = wanted.clamp(1, clock.ticks_max.max(1));
        Self { clock, relaxation, order, wanted, exact }
    }

    /// Control that begins with the first step of the clock.
    pub(crate) fn new(clock: Clock, relaxation: Option<Relaxation>, order: f64) -> Self {
        Self { clock, relaxation, order, wanted: clock.ticks_per_step, exact: usize::MAX }
    }

    /// Error that a step may make, in m, if steps have one: those of quasi-static relaxation do not
    /// follow the motion in time.
    pub(crate) fn error(&self) -> Option<f64> {
        self.clock.error.filter(|_| self.relaxation.is_none_or(|own| own.inertia))
    }

    /// Ticks of the next step, which does not go past a frame or the end.
    ///
    /// A step of quasi-static relaxation goes past frames: cutting it short would cost one more.
    pub(crate) fn next(&self, now: usize) -> usize {
        let Clock { ticks_per_frame, .. } = self.clock;
        let left = self.clock.ticks_to_do().saturating_sub(now).max(1);
        let quasi_static = self.relaxation.is_some_and(|own| !own.inertia);
        let to_frame = if quasi_static { left } else { ticks_per_frame - now % ticks_per_frame };
        self.wanted.min(to_frame).min(left)
    }

    /// Adapts to a step of so many ticks in which no particle moved farther than a distance, in m.
    pub(crate) fn adapt_to_displacement(&mut self, ticks: usize, moved: f64) {
        let Some(relaxation) = self.relaxation else { return };
        // At constant speed the displacement grows with the length of the step, from rest with its
        // square.
        let change = relaxation.stride / moved;
        let change = if relaxation.inertia { change } else { change.sqrt() };
        let wanted = ticks as f64 * change.clamp(1.0 / CHANGE, CHANGE);
        self.wanted = (wanted as usize).min(self.exact).clamp(1, self.clock.ticks_max);
    }

    /// Adapts to the error of a step of so many ticks from a time, in m, and returns whether the
    /// step may stand.
    ///
    /// Lengths are ticks times powers of two, each begun at a multiple of itself, so that they
    /// rarely change: the formula of second order is at its best with even steps.
    pub(crate) fn adapt_to_error(&mut self, now: usize, ticks: usize, error: f64) -> bool {
        let Some(limit) = self.error() else { return true };
        let fitting = CAUTION * (limit / error).powf(1.0 / (self.order + 1.0));
        if error > limit && ticks > 1 {
            let floor = ticks.div_ceil(SHORTEST_CUT);
            let wanted = (ticks as f64 * fitting) as usize;
            self.wanted = power_of_two(wanted.clamp(floor, ticks - 1));
            return false;
        }
        self.exact = (ticks as f64 * fitting) as usize;
        let next = now + ticks;
        let longer = 2 * self.wanted;
        // A step that was cut short for a frame tells nothing of longer ones.
        let whole = ticks == self.wanted;
        let grows = whole && fitting >= 2.0 && longer <= self.clock.ticks_max;
        if grows && next.is_multiple_of(longer) {
            self.wanted = longer;
        }
        true
    }
}

/// The largest power of two that is not above a positive number.
fn power_of_two(number: usize) -> usize {
    1 << number.max(1).ilog2()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clock(error: Option<f64>) -> Clock {
        let (step, end, ramp) = (0.004, 1.0, 0.0);
        let (ticks_per_step, ticks_max, ticks_per_frame) = (4, 16, 48);
        Clock { step, ticks_per_step, ticks_max, error, end, ramp, ticks_per_frame }
    }

    /// Steps until the end under an error of `rate · dt³`, and the largest error that stood.
    fn steps(rate: f64, limit: f64) -> (Vec<usize>, f64) {
        let mut control = StepControl::new(clock(Some(limit)), None, 2.0);
        let (mut now, mut taken, mut largest) = (0, Vec::new(), 0.0_f64);
        while now < 1000 {
            let ticks = control.next(now);
            let error = rate * (ticks as f64 * 0.001).powi(3);
            if control.adapt_to_error(now, ticks, error) {
                now += ticks;
                taken.push(ticks);
                largest = largest.max(error);
            }
        }
        assert_eq!(now, 1000, "the end is met exactly");
        (taken, largest)
    }

    #[test]
    fn steps_are_as_long_as_their_error_allows() {
        for (rate, expected) in [(0.0, 16), (1e5, 8), (8e5, 4), (6.4e6, 2), (1e10, 1)] {
            // At 8 ticks the first error is 5.1e-2.
            let (taken, largest) = steps(rate, 0.075);
            let usual = taken.iter().filter(|ticks| **ticks == expected).count();
            assert!(4 * usual > 3 * taken.len(), "{rate:e}: {taken:?}");
            assert!(largest <= 0.075 || expected == 1, "{rate:e}: an error of {largest} stood");
        }
    }

    #[test]
    fn without_an_error_steps_are_even_and_meet_every_frame() {
        let control = StepControl::new(clock(None), None, 2.0);
        let mut now = 0;
        while now < 1000 {
            let ticks = control.next(now);
            assert_eq!(ticks, 4);
            now += ticks;
        }
    }

    #[test]
    fn steps_to_rest_with_inertia_keep_to_strides_and_errors() {
        let relaxation = Relaxation { speed: 1e-3, residual: 1e-3, stride: 1.0, inertia: true };
        let mut control = StepControl::new(clock(Some(0.075)), Some(relaxation), 2.0);
        let mut ticks = control.next(0);
        for _ in 0..10 {
            // An error of 0.1 at 4 ticks, and no displacement that counts.
            let error = 0.1 * (ticks as f64 / 4.0).powi(3);
            if control.adapt_to_error(0, ticks, error) {
                assert!(error <= 0.075, "an error of {error} stood");
                control.adapt_to_displacement(ticks, 1e-9);
            }
            ticks = control.next(0);
        }
        assert_eq!(ticks, 3, "3 ticks have an error of 0.042, and 4 one of 0.1");
        let calm = Relaxation { inertia: false, ..relaxation };
        assert_eq!(StepControl::new(clock(Some(0.075)), Some(calm), 2.0).error(), None);
    }

    #[test]
    fn strides_keep_their_length() {
        let relaxation = Relaxation { speed: 1e-3, residual: 1e-3, stride: 0.01, inertia: false };
        let mut control = StepControl::new(clock(None), Some(relaxation), 1.0);
        let mut ticks = control.next(0);
        for _ in 0..10 {
            // 5 m/s² from rest.
            control.adapt_to_displacement(ticks, 5.0 * (ticks as f64 * 0.001_f64).powi(2));
            ticks = control.next(0);
        }
        assert_eq!(ticks, 16, "the longest allowed: 45 ticks would be a stride");
        control.adapt_to_displacement(ticks, 0.04);
        assert_eq!(control.next(0), 8);
    }
}
