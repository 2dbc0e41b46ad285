//! Stopwatch of wall-clock and processor time.

use std::time::Instant;

/// Time and processor time since it was started.
#[derive(Debug)]
pub(crate) struct Stopwatch {
    start: Instant,
    /// Processor time of the process at the start, in s, where the system tells.
    processor_start: Option<f64>,
}

impl Stopwatch {
    pub(crate) fn start() -> Self {
        Self { start: Instant::now(), processor_start: processor_seconds() }
    }

    /// Wall-clock time, in s.
    pub(crate) fn wall_seconds(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    /// Processor time of all threads, in s, where the system tells.
    pub(crate) fn cpu_seconds(&self) -> Option<f64> {
        processor_seconds().zip(self.processor_start).map(|(now, start)| now - start)
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
