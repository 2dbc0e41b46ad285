//! Clock: lengths of steps and times of frames, in ticks.

/// Clock of a simulation. Time is counted in ticks, each the first step divided by a power of two,
/// so that it does not drift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Length of a step, of the first one where lengths vary, in s.
    pub step: f64,
    /// Number of ticks in a step.
    pub ticks_per_step: usize,
    /// Largest number of ticks that a step may grow to.
    pub ticks_max: usize,
    /// Root-mean-square error of the positions that a step may make, in m; steps are even without.
    pub error: Option<f64>,
    /// Time of the end at the latest, in s.
    pub end: f64,
    /// Time over which gravity grows to its value, in s.
    pub ramp: f64,
    /// Number of ticks between frames.
    pub ticks_per_frame: usize,
}

impl Clock {
    /// Latest end of a simulation, in s: a little more than a day.
    pub const END_MAX: f64 = 1e5;

    /// Returns the length of a tick, in s.
    #[must_use]
    pub fn tick(&self) -> f64 {
        self.step / self.ticks_per_step as f64
    }

    /// Returns the time `end`, in ticks: the number of ticks of a run that does not end earlier.
    #[must_use]
    pub fn end_ticks(&self) -> usize {
        (self.end / self.tick()).round() as usize
    }
}
