//! Pace: the duration of a run, estimated from its first steps.

use std::path::Path;
use std::time::{Duration, Instant};

use drape::dynamics::{Progress, Simulation, Status, Step};
use drape::input::duration_in_words;

use super::describe::read_scene;
use crate::failure::Failure;

/// Duration of the steps from which the pace is measured.
const CALIBRATION: Duration = Duration::from_secs(2);

/// Steps that a simulation has made, and their duration.
struct MeasuredSteps {
    begin: Instant,
    count: usize,
    /// Number of ticks of the clock so far.
    ticks: usize,
    duration: Duration,
}

impl Progress for MeasuredSteps {
    fn step(&mut self, _: &Step, ticks: usize) {
        self.count += 1;
        self.ticks = ticks;
        self.duration = self.begin.elapsed();
    }

    fn is_interrupted(&self) -> bool {
        self.duration >= CALIBRATION
    }
}

/// Simulates the first steps of the scene at `path` and returns the estimated duration of a run at
/// that pace, as a line.
pub(super) fn describe(path: &Path) -> Result<String, Failure> {
    let scene = read_scene(path)?;
    let total_ticks = scene.schedule.clock.end_ticks();
    let may_rest = scene.schedule.relaxation.is_some();
    let mut simulation = Simulation::new(scene)?;
    let begin = Instant::now();
    let mut steps = MeasuredSteps { begin, count: 0, ticks: 0, duration: Duration::ZERO };
    let summary = simulation.run(&mut steps)?;
    let MeasuredSteps { count, ticks, duration, .. } = steps;
    let seconds = duration.as_secs_f64();

    if ticks == 0 {
        let reason = summary.reason.unwrap_or_else(|| "no step was made".into());
        return Ok(format!("  time: unknown, the first step fails: {reason}"));
    }
    if summary.status == Status::Ok {
        return Ok(format!(
            "  time: {}, the whole run in {count} steps",
            duration_in_words(seconds)
        ));
    }

    let estimate = seconds * total_ticks.max(ticks) as f64 / ticks as f64;
    let (up_to, rest) =
        if may_rest { ("up to ", ", less if it comes to rest earlier") } else { ("about ", "") };
    Ok(format!(
        "  time: {up_to}{} at the pace of the first {count} steps, which took {}{rest}",
        duration_in_words(estimate),
        duration_in_words(seconds)
    ))
}
