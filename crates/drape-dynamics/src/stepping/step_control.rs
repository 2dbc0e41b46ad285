//! Step control: lengths of the steps, by an estimate of their error or, in relaxation, by
//! displacements.

use drape_scene::{Clock, Relaxation};
use serde::{Deserialize, Serialize};

/// Fraction of the allowed step length that is used. The error estimate lags by a step, and a step
/// that fails is made twice.
const CAUTION: f64 = 0.9;

/// Largest factor by which a rejected step is shortened at once. Large error estimates are
/// inaccurate.
const SHORTEST_CUT: usize = 8;

/// Largest ratio of the lengths of two consecutive steps of relaxation.
const CHANGE: f64 = 2.0;

/// Lengths of the steps, in ticks of the clock.
#[derive(Debug, Clone)]
pub(crate) struct StepControl {
    clock: Clock,
    relaxation: Option<Relaxation>,
    /// Order of accuracy of the integrator.
    order: f64,
    /// Length of the next step, in ticks, unless a frame or the end shortens it.
    wanted: usize,
    /// Length of the next step, in ticks, that the error of the last step allows.
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
    /// Returns the state of the control between two steps.
    pub(crate) fn saved(&self) -> SavedControl {
        let Self { relaxation, wanted, exact, .. } = *self;
        SavedControl { relaxation, wanted, exact }
    }

    /// Returns a control by `clock` that continues from `saved`. `order` is the order of the
    /// integrator.
    pub(crate) fn resumed(clock: Clock, order: f64, saved: SavedControl) -> Self {
        let SavedControl { relaxation, wanted, exact } = saved;
        let wanted = wanted.clamp(1, clock.ticks_max.max(1));
        Self { clock, relaxation, order, wanted, exact }
    }

    /// Returns a control that begins with the first step of `clock`. `order` is the order of the
    /// integrator.
    pub(crate) fn new(clock: Clock, relaxation: Option<Relaxation>, order: f64) -> Self {
        Self { clock, relaxation, order, wanted: clock.ticks_per_step, exact: usize::MAX }
    }

    /// Returns the largest error of a step, in m, if the scene limits it. Steps of quasi-static
    /// relaxation have no error, because they do not follow the motion in time.
    pub(crate) fn error(&self) -> Option<f64> {
        self.clock.error.filter(|_| self.relaxation.is_none_or(|relaxation| relaxation.inertia))
    }

    /// Returns the length of the next step at the time `now`, both in ticks. The step does not go
    /// past a frame or the end.
    ///
    /// A step of quasi-static relaxation may go past frames, because shortening it would cost
    /// another step.
    pub(crate) fn next(&self, now: usize) -> usize {
        let Clock { ticks_per_frame, .. } = self.clock;
        let remaining = self.clock.end_ticks().saturating_sub(now).max(1);
        let is_quasi_static = self.relaxation.is_some_and(|relaxation| !relaxation.inertia);
        let to_frame =
            if is_quasi_static { remaining } else { ticks_per_frame - now % ticks_per_frame };
        self.wanted.min(to_frame).min(remaining)
    }

    /// Adapts to a step of `ticks` in which no particle moved farther than `displacement`, in m.
    pub(crate) fn adapt_to_displacement(&mut self, ticks: usize, displacement: f64) {
        let Some(relaxation) = self.relaxation else { return };
        // The displacement is proportional to the length of the step at constant speed, and to
        // the square of the length from rest.
        let ratio = relaxation.stride / displacement;
        let change = if relaxation.inertia { ratio } else { ratio.sqrt() };
        let wanted = ticks as f64 * change.clamp(1.0 / CHANGE, CHANGE);
        self.wanted = (wanted as usize).min(self.exact).clamp(1, self.clock.ticks_max);
    }

    /// Adapts to the error `error`, in m, of a step of `ticks` from the time `now`. Returns whether
    /// the step may be accepted.
    ///
    /// Lengths are ticks times powers of two, and each step begins at a multiple of its length.
    /// Lengths therefore change rarely, and the formula of second order is most accurate with equal
    /// steps.
    pub(crate) fn adapt_to_error(&mut self, now: usize, ticks: usize, error: f64) -> bool {
        let Some(limit) = self.error() else { return true };
        let fitting = CAUTION * (limit / error).powf(1.0 / (self.order + 1.0));
        if error > limit && ticks > 1 {
            let floor = ticks.div_ceil(SHORTEST_CUT);
            let wanted = (ticks as f64 * fitting) as usize;
            self.wanted = power_of_two(wanted.clamp(floor, ticks - 1));
            return false;
        }

        // The step is accepted. The next one may be twice as long if it fits the grid of its
        // length.
        self.exact = (ticks as f64 * fitting) as usize;
        let next = now + ticks;
        let longer = 2 * self.wanted;
        // A step that a frame shortened gives no information on longer steps.
        let is_whole = ticks == self.wanted;
        let grows = is_whole && fitting >= 2.0 && longer <= self.clock.ticks_max;
        if grows && next.is_multiple_of(longer) {
            self.wanted = longer;
        }
        true
    }
}

/// Returns the largest power of two that is not above `number`, or 1.
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
