//! Stopwatch of wall-clock and processor time.

use std::time::Instant;

use serde::{Deserialize, Serialize};

/// Wall-clock and processor time since the start of a run.
#[derive(Debug)]
pub(crate) struct Stopwatch {
    /// Time of the start, `None` where the target has no clock.
    start: Option<Instant>,
    /// Processor time of the process at the start, in s, if the system reports it.
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
    /// Returns a stopwatch that continues from the times `past`.
    pub(crate) fn resumed(past: PastTime) -> Self {
        Self { past, ..Self::start() }
    }

    /// Returns the times until now, as [`PastTime`].
    pub(crate) fn time(&self) -> PastTime {
        PastTime { wall: self.wall_seconds(), processor: self.cpu_seconds() }
    }

    /// Starts a stopwatch at zero.
    pub(crate) fn start() -> Self {
        let past = PastTime { wall: 0.0, processor: Some(0.0) };
        Self { start: now(), processor_start: processor_seconds(), past }
    }

    /// Returns the wall-clock time, in s, or 0 where the target has no clock.
    pub(crate) fn wall_seconds(&self) -> f64 {
        self.past.wall + self.start.map_or(0.0, |start| start.elapsed().as_secs_f64())
    }

    /// Returns the processor time of all threads, in s, or `None` if the system does not report it.
    pub(crate) fn cpu_seconds(&self) -> Option<f64> {
        let since_start =
            processor_seconds().zip(self.processor_start).map(|(now, start)| now - start);
        since_start.zip(self.past.processor).map(|(seconds, past)| seconds + past)
    }
}

/// Returns the time now, or `None` where the target has no clock: WebAssembly outside a system.
pub(crate) fn now() -> Option<Instant> {
    const HAS_CLOCK: bool = !cfg!(all(target_family = "wasm", target_os = "unknown"));
    HAS_CLOCK.then(Instant::now)
}

/// Returns the processor time of the process until now, in s, or `None` if the system does not
/// report it.
#[cfg(unix)]
fn processor_seconds() -> Option<f64> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Some(time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9)
}

#[cfg(not(unix))]
fn processor_seconds() -> Option<f64> {
    None
}

/// Returns the number of threads that a step may use.
pub(crate) fn thread_count() -> usize {
    #[cfg(feature = "rayon")]
    let count = rayon::current_num_threads();
    #[cfg(not(feature = "rayon"))]
    let count = 1;
    count
}
