//! State of the iteration: the current iterate, a direction, and a trial iterate along the
//! direction.

use super::equations::{Iterate, StepEquations};
use super::halt::Halt;
use crate::error::Error;
use crate::linear::vector::add_scaled;
use crate::report::Stop;

/// Iterates and work space of an attempt at a sub-step.
#[derive(Debug)]
pub(crate) struct Search {
    pub current: Iterate,
    pub trial: Iterate,
    /// Second candidate for the start point.
    pub spare: Iterate,
    /// Next step, or the last step taken, in m.
    pub direction: Vec<f64>,
    /// Product of the approximate inverse and the residual, in m.
    pub image: Vec<f64>,
    /// Number of iterations of this attempt.
    pub iterations: usize,
}

impl Search {
    /// Allocates work space for vectors with `length` entries.
    pub(crate) fn new(length: usize) -> Self {
        Self {
            current: Iterate::new(length),
            trial: Iterate::new(length),
            spare: Iterate::new(length),
            direction: vec![0.0; length],
            image: vec![0.0; length],
            iterations: 0,
        }
    }

    /// Counts an iteration. Fails after `max_iterations`, and if the system cancels the step.
    pub(crate) fn count_iteration(
        &mut self,
        equations: &mut StepEquations<'_, '_>,
        max_iterations: usize,
    ) -> Result<(), Halt> {
        if equations.system.system().is_cancelled() {
            return Err(Halt::Fatal(Error::Cancelled));
        }
        if self.iterations == max_iterations {
            return Err(Halt::Stop(Stop::Iterations));
        }
        self.iterations += 1;
        equations.report.iterations += 1;
        Ok(())
    }

    /// Moves the trial iterate by `length` times the direction, without evaluating it.
    pub(crate) fn move_trial(&mut self, length: f64) {
        self.trial.deviation.copy_from_slice(&self.current.deviation);
        add_scaled(&mut self.trial.deviation, length, &self.direction);
        self.trial.obstacle_time = self.current.obstacle_time;
    }

    /// Moves the trial iterate by `length` times the direction, and evaluates it.
    pub(crate) fn try_step(&mut self, equations: &mut StepEquations<'_, '_>, length: f64) {
        self.move_trial(length);
        equations.evaluate(&mut self.trial);
    }

    /// Makes the trial iterate the current one.
    pub(crate) fn accept_trial(&mut self) {
        core::mem::swap(&mut self.current, &mut self.trial);
    }

    /// Sets the direction to the negative image.
    pub(crate) fn descend(&mut self) {
        for (p, z) in self.direction.iter_mut().zip(&self.image) {
            *p = -z;
        }
    }

    /// Shortens the direction to the step that the filter allows with obstacles at rest. Returns
    /// `true` if the whole direction is allowed.
    pub(crate) fn limit_direction(&mut self, equations: &mut StepEquations<'_, '_>) -> bool {
        equations.limit_step(&self.current, &mut self.direction, 0.0).is_whole()
    }
}
