//! Progress on stderr: bars, and the watcher of a run with the recorder of its frames.

use std::time::Duration;

use drape::dynamics::{
    Error, Frame, PhaseName, Progress, Recorder, SavedSimulation, Simulation, Step,
};
use drape::scene::Relaxation;
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;

use crate::console::{Console, ProgressKind, tell};
use crate::keep::signal;
use crate::keep::{Advance, Keeper};

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

/// Watcher of a run: its progress, and the recorder of its frames.
pub(crate) struct RunProgress<'a> {
    name: &'a str,
    bar: ProgressBar,
    recorder: Recorder<'a>,
    /// Latest frame.
    pub(crate) last: Option<Frame>,
    goal: Goal,
    pub(crate) keeper: Keeper,
}

/// Goal of a run: a time, or rest.
struct Goal {
    /// Time of the end at the latest, in ticks.
    ticks: usize,
    /// Length of a whole step, in s.
    step: f64,
    rest: Option<Relaxation>,
    phase: PhaseName,
    /// Largest distance from rest in the phase: speed or imbalance over what counts as rest.
    farthest: f64,
}

impl Goal {
    /// Returns the speed or the imbalance after a step over what counts as rest, the larger one.
    fn distance(&self, step: &Step) -> Option<f64> {
        let Relaxation { speed, residual, .. } = self.rest?;
        Some((step.speed_max / speed).max(step.imbalance / residual))
    }

    /// Returns how much of the phase is done, 0 to 1: of the time, or, on the way to rest, of the
    /// decades between the largest distance from rest and rest.
    fn done(&mut self, step: &Step, ticks: usize) -> f64 {
        if step.phase != self.phase {
            (self.phase, self.farthest) = (step.phase, 1.0);
        }
        match self.distance(step) {
            Some(distance) if step.phase == PhaseName::Relax => {
                self.farthest = self.farthest.max(distance);
                1.0 - distance.max(1.0).ln() / self.farthest.ln().max(f64::MIN_POSITIVE)
            }
            _ => ticks as f64 / self.ticks as f64,
        }
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
        format!("{phase}: t {:.4} s, {motion}, {iterations} iterations{slow}", step.time)
    }
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

impl<'a> RunProgress<'a> {
    /// Starts the progress of a simulation, with a name and a length of its steps in s, for which a
    /// recorder and a keeper write.
    pub(crate) fn new(
        (name, step): (&'a str, f64),
        simulation: &Simulation,
        recorder: Recorder<'a>,
        keeper: Keeper,
    ) -> Self {
        let bar = bar(PARTS as u64, "{percent} %  {msg}");
        bar.enable_steady_tick(Duration::from_millis(250));
        let goal = Goal {
            ticks: simulation.ticks_to_do(),
            step,
            rest: simulation.rest_criteria(),
            phase: PhaseName::Simulate,
            farthest: 1.0,
        };
        Self { name, bar, recorder, last: None, goal, keeper }
    }

    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for RunProgress<'_> {
    fn step(&mut self, step: &Step, ticks: usize) {
        step.events.iter().for_each(|event| {
            self.bar.suspend(|| tell(format_args!("warning: {event}")));
        });
        let done = self.goal.done(step, ticks);
        self.keeper.step(Advance { phase: step.phase, done, time: step.time });
        let console = Console::get();
        if console.progress == ProgressKind::Json {
            tell(json!({
                "scene": self.name, "phase": step.phase, "done": done, "time": step.time,
                "dt": step.dt, "speed_max": step.speed_max, "imbalance": step.imbalance,
                "iterations": step.report.iterations, "rejected": step.report.rejected,
                "slow": slow(step, self.goal.step),
            }));
        } else if console.verbose {
            tell(self.goal.describe(step));
        } else if !self.bar.is_hidden() {
            self.bar.set_message(self.goal.describe(step));
        }
        self.bar.set_position((PARTS * done) as u64);
    }

    fn frame(&mut self, frame: &Frame) -> Result<(), Error> {
        self.recorder.frame(frame)?;
        self.last = Some(frame.clone());
        Ok(())
    }

    fn is_checkpoint_due(&self) -> bool {
        self.keeper.is_due()
    }

    fn checkpoint(&mut self, saved: &SavedSimulation) -> Result<(), Error> {
        self.keeper.keep(saved, &self.recorder.save()?)
    }

    fn is_interrupted(&self) -> bool {
        signal::received().is_some() || self.keeper.reached().is_some()
    }
}
