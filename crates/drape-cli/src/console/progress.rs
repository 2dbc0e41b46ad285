//! Progress on stderr: bars, and the watcher of a run.

use std::time::Duration;

use drape::dynamics::{PhaseName, Step};
use drape::run::Watcher;
use drape::scene::{Relaxation, Scene};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;

use crate::console::signal;
use crate::console::{Console, ProgressKind, tell};

/// Returns a progress bar on stderr, silent where that is no terminal or none is asked for, with a
/// template of indicatif for the text beside it.
pub(crate) fn bar(length: u64, template: &str) -> ProgressBar {
    if !Console::get().has_bar() {
        return ProgressBar::hidden();
    }
    let style = format!("{{elapsed_precise}} {{bar:32}} {template}");
    let style = ProgressStyle::with_template(&style).expect("the template is right");
    ProgressBar::new(length).with_style(style)
}

/// Parts into which the bar of a run is divided.
const PARTS: f64 = 1000.0;

/// Watcher of a run: its progress.
pub(crate) struct RunProgress {
    name: String,
    /// Length of a whole step, in s.
    step: f64,
    rest: Option<Relaxation>,
    bar: ProgressBar,
}

/// Returns what makes a step slow.
fn slow(step: &Step, whole: f64) -> Vec<String> {
    let report = &step.report;
    let mut reasons = Vec::new();
    if step.dt < 0.999 * whole {
        reasons.push(format!("steps of {:.3} ms instead of {:.3}", 1e3 * step.dt, 1e3 * whole));
    }
    for (count, what) in [
        (report.rejected, "attempts rejected"),
        (report.backtracks, "backtracks of the line search"),
        (report.linear_truncations, "linear solves cut off"),
    ] {
        if count > 0 {
            reasons.push(format!("{count} {what}"));
        }
    }
    reasons
}

/// Name of a phase, as a person reads it.
fn phase_name(phase: PhaseName) -> &'static str {
    match phase {
        PhaseName::Sew => "sewing",
        PhaseName::Relax => "to rest",
        PhaseName::Simulate => "moving",
    }
}

impl RunProgress {
    /// Starts the progress of a scene.
    pub(crate) fn new(scene: &Scene) -> Self {
        let bar = bar(PARTS as u64, "{percent} %  {msg}");
        bar.enable_steady_tick(Duration::from_millis(250));
        let (step, rest) = (scene.schedule.clock.step, scene.schedule.relaxation);
        Self { name: scene.name.clone(), step, rest, bar }
    }

    /// Describes a step: its phase, how far it is from rest, and what makes it slow.
    fn describe(&self, step: &Step) -> String {
        let speed = 1e3 * step.speed_max;
        let motion = match self.rest {
            Some(rest) if step.phase == PhaseName::Relax => format!(
                "fastest {speed:.1} mm/s (rest: {:.1}), imbalance {:.0e} g (rest: {:.0e})",
                1e3 * rest.speed,
                step.imbalance,
                rest.residual
            ),
            _ => format!("fastest {speed:.1} mm/s"),
        };
        let slow: String =
            slow(step, self.step).into_iter().map(|reason| ", ".to_owned() + &reason).collect();
        let (phase, iterations) = (phase_name(step.phase), step.report.iterations);
        let grid =
            step.coarser_grid.map(|spacing| format!(" on a grid of {:.1} mm", 1e3 * spacing));
        let grid = grid.unwrap_or_default();
        format!("{phase}{grid}: t {:.4} s, {motion}, {iterations} iterations{slow}", step.time)
    }

    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Watcher for RunProgress {
    fn step(&mut self, step: &Step, done: f64) {
        step.events.iter().for_each(|event| {
            self.bar.suspend(|| tell(format_args!("warning: {event}")));
        });
        let console = Console::get();
        if console.progress == ProgressKind::Json {
            tell(json!({
                "scene": self.name, "phase": step.phase, "done": done,
                "finished": step.finished, "time": step.time,
                "coarser_grid": step.coarser_grid, "dt": step.dt, "speed_max": step.speed_max, "imbalance": step.imbalance,
                "iterations": step.report.iterations, "rejected": step.report.rejected,
                "slow": slow(step, self.step),
            }));
        } else if console.verbose {
            tell(self.describe(step));
        } else if !self.bar.is_hidden() {
            self.bar.set_message(self.describe(step));
        }
        self.bar.set_position((PARTS * done) as u64);
    }

    fn is_interrupted(&self) -> bool {
        signal::received().is_some()
    }
}
