//! Motion clock: the time of the prescribed motions of bodies and pins.

/// Clock of the prescribed motions of bodies and pins. It stands at 0 until the motions start.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MotionClock {
    /// Time of the simulation at which the clock starts, in s.
    start: f64,
}

impl MotionClock {
    /// Returns a clock that starts with the simulation.
    pub(crate) fn running() -> Self {
        Self { start: 0.0 }
    }

    /// Returns a clock that stands still until it is started.
    pub(crate) fn stopped() -> Self {
        Self { start: f64::INFINITY }
    }

    /// Starts the clock at `time` of the simulation, in s.
    pub(crate) fn start(&mut self, time: f64) {
        self.start = time;
    }

    /// Returns the time of the simulation at which the clock starts, in s. It is infinite while the
    /// clock stands still.
    pub(crate) fn start_time(&self) -> f64 {
        self.start
    }

    /// Returns the time on this clock at `time` of the simulation, both in s.
    pub(crate) fn time(&self, time: f64) -> f64 {
        (time - self.start).max(0.0)
    }
}
