//! State of the iteration: the current iterate, a direction, and the trial iterate along it.

use super::equations::{Iterate, StepEquations};
use super::halt::Halt;
use crate::error::Error;
use crate::linear::vector::add_scaled;
use crate::report::Stop;

/// Iterates of an attempt at a sub-step, and its work space.
#[derive(Debug)]
pub(crate) struct Search {
    pub current: Iterate,
    pub trial: Iterate,
    /// One of two candidates for the start point.
    pub spare: Iterate,
    /// Step to take, or the last one taken, in m.
    pub direction: Vec<f64>,
    /// Inverse in use times the residual, in m.
    pub image: Vec<f64>,
    /// Iterations of this attempt.
    pub iterations: usize,
}

impl Search {
    /// Work space for vectors of a length.
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

    /// Counts an iteration, if one is left of the number allowed and the step is not given up.
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

    /// Moves the trial iterate to a length along the direction, without evaluating it.
    pub(crate) fn move_trial(&mut self, length: f64) {
        self.trial.deviation.copy_from_slice(&self.current.deviation);
        add_scaled(&mut self.trial.deviation, length, &self.direction);
        self.trial.obstacle_time = self.current.obstacle_time;
    }

    /// Evaluates the trial iterate at a length along the direction.
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

    /// Limits the direction to what a step filter allows of it with obstacles at rest. Returns
    /// whether that is all of it.
    pub(crate) fn limit_direction(&mut self, equations: &mut StepEquations<'_, '_>) -> bool {
        equations.limit_step(&self.current, &mut self.direction, 0.0).is_whole()
    }
}
