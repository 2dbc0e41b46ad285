//! Stopwatch of wall-clock and processor time.

use std::time::Instant;

use serde::{Deserialize, Serialize};

/// Time and processor time since it was started.
#[derive(Debug)]
pub(crate) struct Stopwatch {
    start: Instant,
    /// Processor time of the process at the start, in s, where the system tells.
    processor_start: Option<f64>,
    past: PastTime,
}

/// Wall-clock and processor time of a run before it was resumed.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct PastTime {
    /// Wall-clock time, in s.
    wall: f64,
    /// Processor time, in s; `None` where the system does not report it.
    processor: Option<f64>,
}

impl Stopwatch {
    /// A stopwatch that has been running for a while already.
    pub(crate) fn resumed(past: PastTime) -> Self {
        Self { past, ..Self::start() }
    }

    /// Times until now.
    pub(crate) fn time(&self) -> PastTime {
        PastTime { wall: self.wall_seconds(), processor: self.cpu_seconds() }
    }

    pub(crate) fn start() -> Self {
        let past = PastTime { wall: 0.0, processor: Some(0.0) };
        Self { start: Instant::now(), processor_start: processor_seconds(), past }
    }

    /// Wall-clock time, in s.
    pub(crate) fn wall_seconds(&self) -> f64 {
        self.past.wall + self.start.elapsed().as_secs_f64()
    }

    /// Processor time of all threads, in s, where the system tells.
    pub(crate) fn cpu_seconds(&self) -> Option<f64> {
        let own = processor_seconds().zip(self.processor_start).map(|(now, start)| now - start);
        own.zip(self.past.processor).map(|(own, past)| own + past)
    }
}

/// Processor time of the process so far, in s, where the system tells.
#[cfg(unix)]
fn processor_seconds() -> Option<f64> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Some(time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9)
}

#[cfg(not(unix))]
fn processor_seconds() -> Option<f64> {
    None
}
