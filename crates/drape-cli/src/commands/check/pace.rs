//! Pace: the time that a run takes, from its first steps.

use std::path::Path;
use std::time::{Duration, Instant};

use drape::dynamics::{Progress, Simulation, Status, Step};

use super::describe::read_scene;
use crate::failure::Failure;

/// Duration of the steps from which the pace is taken.
const CALIBRATION: Duration = Duration::from_secs(2);

/// Steps that a run has made, and their duration.
struct Steps {
    begin: Instant,
    count: usize,
    /// Ticks of the clock so far.
    ticks: usize,
    lasted: Duration,
}

impl Progress for Steps {
    fn step(&mut self, _: &Step, ticks: usize) {
        self.count += 1;
        self.ticks = ticks;
        self.lasted = self.begin.elapsed();
    }

    fn is_interrupted(&self) -> bool {
        self.lasted >= CALIBRATION
    }
}

/// Makes the first steps of a scene and says how long a run takes at their pace.
pub(super) fn describe(path: &Path) -> Result<String, Failure> {
    let scene = read_scene(path)?;
    let whole = scene.schedule.clock.ticks_to_do();
    let may_rest = scene.schedule.relaxation.is_some();
    let mut simulation = Simulation::new(scene)?;
    let begin = Instant::now();
    let mut steps = Steps { begin, count: 0, ticks: 0, lasted: Duration::ZERO };
    let summary = simulation.run(&mut steps)?;
    let Steps { count, ticks, lasted, .. } = steps;
    let seconds = lasted.as_secs_f64();
    if ticks == 0 {
        let reason = summary.reason.unwrap_or_else(|| "no step was made".into());
        return Ok(format!("  time: unknown, the first step fails: {reason}"));
    }
    if summary.status == Status::Ok {
        return Ok(format!("  time: {}, the whole run in {count} steps", in_words(seconds)));
    }
    let all = seconds * whole.max(ticks) as f64 / ticks as f64;
    let (up_to, rest) =
        if may_rest { ("up to ", ", less if it comes to rest earlier") } else { ("about ", "") };
    Ok(format!(
        "  time: {up_to}{} at the pace of the first {count} steps, which took {}{rest}",
        in_words(all),
        in_words(seconds)
    ))
}

/// Returns a duration in words.
fn in_words(seconds: f64) -> String {
    match seconds {
        ..10.0 => format!("{seconds:.1} s"),
        10.0..120.0 => format!("{seconds:.0} s"),
        120.0..7200.0 => format!("{:.0} min", seconds / 60.0),
        _ => format!("{:.1} h", seconds / 3600.0),
    }
}
