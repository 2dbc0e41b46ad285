//! Clock by which bodies and pins move.

/// Clock by which bodies and pins move: it stands at 0 until they are set in motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MotionClock {
    /// Time of the simulation at which it starts, in s.
    start: f64,
}

impl MotionClock {
    /// A clock that starts with the simulation.
    pub(crate) fn running() -> Self {
        Self { start: 0.0 }
    }

    /// A clock that stands still until it is started.
    pub(crate) fn stopped() -> Self {
        Self { start: f64::INFINITY }
    }

    /// Starts the clock at a time of the simulation, in s.
    pub(crate) fn start(&mut self, time: f64) {
        self.start = time;
    }

    /// Time of the simulation at which it starts, in s; infinite as long as it stands still.
    pub(crate) fn start_time(&self) -> f64 {
        self.start
    }

    /// Time on this clock at a time of the simulation, in s.
    pub(crate) fn time(&self, time: f64) -> f64 {
        (time - self.start).max(0.0)
    }
}
