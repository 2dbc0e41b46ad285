//! Progress on stderr: bars, and the watcher of a run.

use std::time::Duration;

use drape::dynamics::{PhaseName, Step};
use drape::run::Watcher;
use drape::scene::{Relaxation, Scene};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;

use crate::console::signal;
use crate::console::{Console, ProgressKind, print_message};

/// Returns a progress bar of `length` on stderr. The bar is hidden where stderr is no terminal or
/// the user asked for no bar. `template` is indicatif's template of the text beside the bar.
pub(crate) fn bar(length: u64, template: &str) -> ProgressBar {
    if !Console::get().has_bar() {
        return ProgressBar::hidden();
    }
    let style = format!("{{elapsed_precise}} {{bar:32}} {template}");
    let style = ProgressStyle::with_template(&style).expect("the template is valid");
    ProgressBar::new(length).with_style(style)
}

/// Number of parts into which the bar of a run is divided.
const PARTS: f64 = 1000.0;

/// Watcher that shows the progress of one run.
pub(crate) struct RunProgress {
    name: String,
    /// Full time step of the scene, in s.
    step: f64,
    /// Thresholds of rest, if the scene relaxes.
    rest: Option<Relaxation>,
    bar: ProgressBar,
}

/// Returns the reasons why `step` was slow. `full_step` is the scene's time step, in s.
fn slow_reasons(step: &Step, full_step: f64) -> Vec<String> {
    let report = &step.report;
    let mut reasons = Vec::new();
    if step.dt < 0.999 * full_step {
        reasons.push(format!("steps of {:.3} ms instead of {:.3}", 1e3 * step.dt, 1e3 * full_step));
    }
    for (count, name) in [
        (report.rejected, "attempts rejected"),
        (report.backtracks, "backtracks of the line search"),
        (report.linear_truncations, "linear solves cut off"),
    ] {
        if count > 0 {
            reasons.push(format!("{count} {name}"));
        }
    }
    reasons
}

/// Returns the name of `phase` in messages.
fn phase_name(phase: PhaseName) -> &'static str {
    match phase {
        PhaseName::Sew => "sewing",
        PhaseName::Relax => "to rest",
        PhaseName::Simulate => "moving",
    }
}

impl RunProgress {
    /// Starts the progress of a run of `scene`.
    pub(crate) fn new(scene: &Scene) -> Self {
        let bar = bar(PARTS as u64, "{percent} %  {msg}");
        bar.enable_steady_tick(Duration::from_millis(250));

        let (step, rest) = (scene.schedule.clock.step, scene.schedule.relaxation);
        Self { name: scene.name.clone(), step, rest, bar }
    }

    /// Describes `step`: its phase, its distance from rest, and what made it slow.
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

        let slow: String = slow_reasons(step, self.step)
            .into_iter()
            .map(|reason| ", ".to_owned() + &reason)
            .collect();
        let (phase, iterations) = (phase_name(step.phase), step.report.iterations);
        let grid = step
            .coarser_grid
            .map(|spacing| format!(" on a grid of {:.1} mm", 1e3 * spacing))
            .unwrap_or_default();
        format!("{phase}{grid}: t {:.4} s, {motion}, {iterations} iterations{slow}", step.time)
    }

    /// Removes the bar.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Watcher for RunProgress {
    fn step(&mut self, step: &Step, done: f64) {
        step.events.iter().for_each(|event| {
            self.bar.suspend(|| print_message(format_args!("warning: {event}")));
        });

        let console = Console::get();
        if console.progress == ProgressKind::Json {
            print_message(json!({
                "scene": self.name, "phase": step.phase, "done": done,
                "finished": step.finished, "time": step.time,
                "coarser_grid": step.coarser_grid, "dt": step.dt, "speed_max": step.speed_max, "imbalance": step.imbalance,
                "iterations": step.report.iterations, "rejected": step.report.rejected,
                "slow": slow_reasons(step, self.step),
            }));
        } else if console.verbose {
            print_message(self.describe(step));
        } else if !self.bar.is_hidden() {
            self.bar.set_message(self.describe(step));
        }

        self.bar.set_position((PARTS * done) as u64);
    }

    fn is_interrupted(&self) -> bool {
        signal::received().is_some()
    }
}
