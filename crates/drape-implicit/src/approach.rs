//! The ways of a guarded solver before its equations count: from the start of the step to its first guess, and
//! those of what moves by prescription.

use crate::incremental::{Halt, Incremental};
use crate::solver::Solver;
use crate::{Stop, block};

/// Least part of the prescribed motions that one iteration must do. Less, and the iterations that are left would not
/// do: a shorter step helps sooner.
const ADVANCE_MIN: f64 = 1e-3;

impl Solver {
    /// Goes from the start, which lies in `trial`, as far as the system allows towards the first guess, which lies in
    /// `current`. Both are left evaluated or, if the forces at the guess are not finite, the start in `trial` to be.
    pub(crate) fn approach(&mut self, problem: &mut Incremental<'_>) {
        core::mem::swap(&mut self.current, &mut self.trial);
        let Self { current, trial, direction, .. } = self;
        current.progress = 0.0;
        problem.locate(current);
        let ways = direction.iter_mut().zip(&trial.deviation).zip(&current.deviation);
        for ((way, guess), start) in ways {
            *way = guess - start;
        }
        self.go(problem, 1.0);
        core::mem::swap(&mut self.current, &mut self.trial);
    }

    /// Moves held particles and bodies on towards their places, as far as the system allows.
    pub(crate) fn carry(&mut self, problem: &mut Incremental<'_>) -> Result<(), Halt> {
        let ways = block::triples_mut(&mut self.direction).iter_mut();
        let left = block::triples(&self.current.deviation);
        for ((way, left), &held) in ways.zip(left).zip(problem.held) {
            *way = if held { left.map(|left| -left) } else { [0.0; 3] };
        }
        let done = self.current.progress;
        self.go(problem, 1.0 - done);
        if !self.trial.norm.is_finite() || self.trial.progress < done + ADVANCE_MIN {
            return Err(Halt::Stop(Stop::Blocked));
        }
        self.accept(1.0);
        Ok(())
    }

    /// Evaluates the end of what the system allows of the way along the direction.
    fn go(&mut self, problem: &mut Incremental<'_>, advance: f64) {
        let mut allowed = advance;
        problem.allow(&self.current, &mut self.direction, &mut allowed);
        let done = self.current.progress;
        self.move_trial(1.0);
        // A part that was not cut ends exactly where it should.
        self.trial.progress = if allowed < advance { done + allowed } else { done + advance };
        problem.evaluate(&mut self.trial);
    }
}
