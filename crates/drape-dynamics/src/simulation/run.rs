//! Run: all steps of a simulation, from its start or from a checkpoint, with a watcher.

use std::time::Duration;

use drape_frames::Frame;

use super::saved::SavedSimulation;
use super::{Simulation, Step};
use crate::error::Error;
use crate::measure::{at_particles, measures, warnings};
use crate::record::stopwatch::now;
use crate::record::summary::{Status, Summary};
use crate::world::Energy;

/// Duration of a step above which the state is copied before the next step, which can then be
/// rolled back when it is cancelled. The copy takes less than a hundredth of the step.
const LONG_STEP: Duration = Duration::from_millis(200);

/// Fraction of the exchanged energy that may be unaccounted for without a warning. The quadrature
/// along the steps errs by a fifth of it.
const UNACCOUNTED: f64 = 1e-6;

/// Fraction of the exchanged energy above which the balance does not close, and the run fails.
const UNACCOUNTED_MAX: f64 = 1e-3;

/// Watcher of a running simulation. `()` watches nothing.
pub trait Progress {
    /// Called after each [`Step`], with the time in ticks of the clock
    /// ([`Clock`](drape_scene::Clock)). The end is at [`Simulation::end_ticks`].
    fn step(&mut self, _step: &Step, _ticks: usize) {}

    /// Called when a [`Frame`] is due, with the energy balance since the start, or since the
    /// garment was sewn, if the scene keeps one.
    ///
    /// # Errors
    /// Returns an error if the frame cannot be stored. The run then ends with this error.
    fn frame(&mut self, _frame: &Frame, _energy: Option<&Energy>) -> Result<(), Error> {
        Ok(())
    }

    /// Returns whether a checkpoint is wanted after this step. A checkpoint is also made at the end
    /// of each phase and when the run is interrupted, but not at the end of the run. Only a longer
    /// run resumes from there, and needs the state [`Simulation::saved`] after the summary.
    fn is_checkpoint_due(&self) -> bool {
        false
    }

    /// Called with the [`SavedSimulation`] from which the run can resume.
    ///
    /// # Errors
    /// Returns an error if the state cannot be stored. The run then ends with this error.
    fn checkpoint(&mut self, _saved: &SavedSimulation) -> Result<(), Error> {
        Ok(())
    }

    /// Returns whether the run is to end after this step, as if a person had interrupted it.
    fn is_interrupted(&self) -> bool {
        false
    }
}

impl Progress for () {}

/// Counts before a step. Their changes show the end of a phase or of a frame interval.
#[derive(Debug, Clone, Copy)]
struct CountsBefore {
    /// Frame intervals that are over.
    intervals: usize,
    /// Phases that have begun.
    phases: usize,
    /// Coarser grids that remain.
    grids: usize,
}

impl Simulation {
    /// Runs to the end, to rest, or to a step that cannot be solved, and reports to `progress`. The
    /// [`Summary`] says how the run ended.
    ///
    /// # Errors
    /// Returns the errors of `progress`, and no others.
    pub fn run(&mut self, progress: &mut dyn Progress) -> Result<Summary, Error> {
        if self.frame_times.is_empty() && self.coarser.is_empty() {
            self.emit_frame(progress)?;
        }
        let mut is_long = false;
        // A simulation resumed at the end of its run has no further step.
        let mut is_over = self.is_over();

        while !is_over {
            let before = CountsBefore {
                intervals: self.frame_intervals(),
                phases: self.phases.begun.len(),
                grids: self.coarser.len(),
            };
            let start = (is_long && self.world.cancel.is_some()).then(|| self.saved());
            let began = now();
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
            is_long = began.is_some_and(|began| began.elapsed() >= LONG_STEP);
            progress.step(&step, self.ticks());
            is_over = self.end_step(&step, before, progress)?;
        }

        if self.outcome.status == Status::Ok && self.settles() && !self.has_settled() {
            self.outcome.status = Status::DidNotSettle;
            self.outcome.reason = self.parts.first_slide();
        }
        if matches!(self.outcome.status, Status::Ok | Status::DidNotSettle) {
            self.judge_energy();
            self.judge_intersections();
        }
        if self.frame_times.is_empty() {
            self.emit_frame(progress)?;
        }

        self.outcome.measures = measures(&self.parts, &mut self.world);
        self.outcome.warnings = self.outcome.events.clone();
        self.outcome.warnings.extend(warnings(&self.parts, &self.world));
        self.outcome.warnings.extend(self.unfinished_growth());
        self.outcome.warnings.extend(self.energy().as_ref().and_then(doubtful_balance));
        Ok(self.summary())
    }

    /// Hands the frames and checkpoints of `step` to `progress`. Returns whether `step` was the
    /// last one.
    fn end_step(
        &mut self,
        step: &Step,
        before: CountsBefore,
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
            // A run that resumes from the checkpoint does not have this frame.
            if !(is_due || phase_ended) {
                self.emit_frame(progress)?;
            }
            self.outcome.status = Status::Interrupted;
            return Ok(true);
        }
        Ok(step.finished)
    }

    /// Ends the run in a cancelled step. Restores the state `start` at its start, if there is one.
    /// Otherwise the last checkpoint remains.
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

    /// Ends the run as failed if the balance of energy does not close by far.
    fn judge_energy(&mut self) {
        let Some(energy) = self.energy() else { return };
        let fraction = energy.unaccounted_fraction();
        // The comparison is written so that NaN fails.
        if !(fraction <= UNACCOUNTED_MAX) {
            let reason = format!(
                "the balance of energy does not close: {:.1e} J are unaccounted for, {fraction:.1e} of what was exchanged \
                 where it was measured",
                energy.residual
            );
            self.end_early(Status::Unbalanced, reason);
        }
    }

    /// Ends the run as failed if surfaces intersected in a state that was accepted.
    fn judge_intersections(&mut self) {
        let count = self.statistics.intersections_max;
        if count == 0 {
            return;
        }
        let remedy = if self.statistics.released_max > 0 {
            "where bodies pinched the cloth and were let through; contact.pinch = \"thin\" keeps them apart"
        } else {
            "of the sides of seams that had opened again; sew more slowly (sew.seconds), or choose another spacing"
        };
        let reason = format!("up to {count} intersections remained after a step, {remedy}");
        self.end_early(Status::Intersecting, reason);
    }

    /// Returns a warning if the run ended before surfaces kept their full distances.
    fn unfinished_growth(&self) -> Option<String> {
        let fraction = self.world.contact.growth_fraction();
        (fraction < 1.0 && self.outcome.status == Status::Ok).then(|| {
            format!(
                "surfaces keep only {:.2} % of their distances yet: the run ended before contact.grow",
                100.0 * fraction
            )
        })
    }

    /// Returns the number of frame intervals that are over.
    fn frame_intervals(&self) -> usize {
        self.ticks() / self.stepping.clock().ticks_per_frame
    }

    /// Hands the next frame to `progress`. Coarser grids have no frames, because their particles
    /// differ, except for the frame of the start if the run ends on a coarser grid.
    fn emit_frame(&mut self, progress: &mut dyn Progress) -> Result<(), Error> {
        if !self.coarser.is_empty() && self.outcome.status == Status::Ok {
            return Ok(());
        }
        let mut frame = self.frame();
        frame.pressures = at_particles(&mut self.world, frame.cloth.as_flattened());
        progress.frame(&frame, self.energy().as_ref())?;
        self.frame_times.push(self.time());
        Ok(())
    }
}

/// Returns a warning about a balance of `energy` that does not close.
fn doubtful_balance(energy: &Energy) -> Option<String> {
    let fraction = energy.unaccounted_fraction();
    // The comparison is written so that NaN is doubtful.
    (!(fraction <= UNACCOUNTED)).then(|| {
        format!(
            "{:.1e} J of energy are unaccounted for, {fraction:.1e} of what was exchanged where it was measured; \
             up to {UNACCOUNTED:.0e} is usual",
            energy.residual
        )
    })
}
