//! Run: all steps of a simulation, from its start or from a checkpoint, with a watcher.

use std::time::{Duration, Instant};

use super::saved::SavedSimulation;
use super::{Simulation, Step};
use crate::error::Error;
use crate::measure::{at_particles, measures, warnings};
use crate::record::frame::Frame;
use crate::record::summary::{Status, Summary};

/// Duration of a step above which the state is copied before the next one, so that this can be
/// rolled back when it is cancelled. The copy takes less than a hundredth of the step.
const LONG_STEP: Duration = Duration::from_millis(200);

/// Watcher of a running simulation. `()` watches nothing.
pub trait Progress {
    /// Is called after a step, with the time in ticks of the clock.
    fn step(&mut self, _step: &Step, _ticks: usize) {}

    /// Is called when a frame is due.
    ///
    /// # Errors
    /// Whatever keeps the frame from being stored; the run then ends with it.
    fn frame(&mut self, _frame: &Frame) -> Result<(), Error> {
        Ok(())
    }

    /// Returns whether a checkpoint is wanted after this step. One is made at the end of each phase
    /// and when the run is interrupted, but none at its end: from there on only a longer run goes on,
    /// for which [`Simulation::saved`] is kept after its summary.
    fn is_checkpoint_due(&self) -> bool {
        false
    }

    /// Is called with what the run can go on from.
    ///
    /// # Errors
    /// Whatever keeps it from being stored; the run then ends with it.
    fn checkpoint(&mut self, _saved: &SavedSimulation) -> Result<(), Error> {
        Ok(())
    }

    /// Returns whether the run is to end after this step, as if it were asked to by a person.
    fn is_interrupted(&self) -> bool {
        false
    }
}

impl Progress for () {}

/// Counts before a step, by which the end of a phase or of a frame interval is noticed.
#[derive(Debug, Clone, Copy)]
struct Before {
    /// Intervals of frames that are over.
    intervals: usize,
    phases: usize,
    /// Coarser grids that are still to come.
    grids: usize,
}

impl Simulation {
    /// Runs to the end, to rest, or to a step that cannot be solved; the summary says how it ended.
    ///
    /// # Errors
    /// Only those of the watcher.
    pub fn run(&mut self, progress: &mut dyn Progress) -> Result<Summary, Error> {
        if self.frame_times.is_empty() && self.coarser.is_empty() {
            self.emit_frame(progress)?;
        }
        let mut is_long = false;
        // A checkpoint of the end leaves no step to do.
        let mut is_over = self.is_over();
        while !is_over {
            let before = Before {
                intervals: self.frame_intervals(),
                phases: self.phases.begun.len(),
                grids: self.coarser.len(),
            };
            let start = (is_long && self.world.cancel.is_some()).then(|| self.saved());
            let began = Instant::now();
            let step = match self.step() {
                Ok(step) => step,
                Err(drape_implicit::Error::Cancelled) => {
                    self.give_up(start, progress)?;
                    break;
                }
                Err(error) => {
                    self.fail(&error);
                    break;
                }
            };
            is_long = began.elapsed() >= LONG_STEP;
            progress.step(&step, self.ticks());
            is_over = self.end_step(&step, before, progress)?;
        }
        if self.outcome.status == Status::Ok && self.settles() && !self.has_settled() {
            self.outcome.status = Status::DidNotSettle;
            self.outcome.reason = self.parts.first_slide();
        }
        if self.frame_times.is_empty() {
            self.emit_frame(progress)?;
        }
        self.outcome.measures = measures(&self.parts, &mut self.world);
        self.outcome.warnings = self.outcome.events.clone();
        self.outcome.warnings.extend(warnings(&self.parts, &self.world));
        self.outcome.warnings.extend(self.unfinished_growth());
        Ok(self.summary())
    }

    /// Hands frames and checkpoints of a step to the watcher; returns whether it was the last one.
    fn end_step(
        &mut self,
        step: &Step,
        before: Before,
        progress: &mut dyn Progress,
    ) -> Result<bool, Error> {
        let is_interrupted = !step.finished && progress.is_interrupted();
        let phase_ended =
            self.phases.begun.len() > before.phases || self.coarser.len() < before.grids;
        let is_due = self.frame_intervals() > before.intervals;
        if step.finished || is_due || phase_ended {
            self.emit_frame(progress)?;
        }
        let is_wanted = is_interrupted || phase_ended || progress.is_checkpoint_due();
        if is_wanted && !step.finished {
            progress.checkpoint(&self.saved())?;
        }
        if is_interrupted {
            // A run that goes on from the checkpoint does not have this frame.
            if !(is_due || phase_ended) {
                self.emit_frame(progress)?;
            }
            self.outcome.status = Status::Interrupted;
            return Ok(true);
        }
        Ok(step.finished)
    }

    /// Ends the run in a step that was given up: takes it back to its start, if there is a copy of
    /// that. Without one the last checkpoint stands.
    fn give_up(
        &mut self,
        start: Option<SavedSimulation>,
        progress: &mut dyn Progress,
    ) -> Result<(), Error> {
        if let Some(start) = start {
            progress.checkpoint(&start)?;
            self.resume(start)?;
            self.emit_frame(progress)?;
        }
        self.outcome.status = Status::Interrupted;
        Ok(())
    }

    /// Warning about a run that ended before surfaces kept their whole distances.
    fn unfinished_growth(&self) -> Option<String> {
        let fraction = self.world.contact.growth_fraction();
        (fraction < 1.0 && self.outcome.status == Status::Ok).then(|| {
            format!(
                "surfaces keep only {:.2} % of their distances yet: the run ended before contact.grow",
                100.0 * fraction
            )
        })
    }

    /// Intervals of frames that are over.
    fn frame_intervals(&self) -> usize {
        self.ticks() / self.stepping.clock().ticks_per_frame
    }

    /// Hands the next frame to the watcher. There is none on coarser grids, whose particles are others,
    /// but that of the start where the run ends on one.
    fn emit_frame(&mut self, progress: &mut dyn Progress) -> Result<(), Error> {
        if !self.coarser.is_empty() && self.outcome.status == Status::Ok {
            return Ok(());
        }
        let mut frame = self.frame();
        frame.pressures = at_particles(&mut self.world, &frame.positions);
        progress.frame(&frame)?;
        self.frame_times.push(self.time());
        Ok(())
    }
}
