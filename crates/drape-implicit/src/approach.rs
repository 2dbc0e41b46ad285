//! The ways of a guarded solver before its equations count: from the start of the step to its first guess, and
//! those of what moves by prescription.

use crate::incremental::{Halt, Incremental};
use crate::solver::Solver;
use crate::vector::dot;
use crate::{StepLimit, Stop, block};

/// Least part of the prescribed motions that one iteration must do. Less, and the iterations that are left would not
/// do: a shorter step helps sooner.
const ADVANCE_MIN: f64 = 1e-3;

/// Most ways from the start to the first guess, and the least share of the rest that one of them must go: a guess need
/// not be reached.
const APPROACHES: usize = 12;
const APPROACH_MIN: f64 = 0.05;

/// A particle that goes less than this of what the freest one goes is near something. It stays there: pushed on, it
/// would go into the last tenth of a gap again and again, from where no iteration brings it back soon.
const STOPPED: f64 = 0.5;

impl Solver {
    /// Finds a place to begin from: the start, which lies in `trial`, with all that moves by prescription carried on, or
    /// what is allowed of the way from there to the first guess, which lies in `current`. Leaves the one that is better
    /// balanced in `current`, evaluated.
    ///
    /// In free flight the guess is exact. Where surfaces touch, going on squeezes them until a step would have to undo
    /// it: in a stack of five sheets the residual at the start was a hundred times smaller. What `begin_at_prediction` begins at the
    /// guess all the same, if nothing is in its way.
    pub(crate) fn approach(
        &mut self,
        problem: &mut Incremental<'_, '_>,
        begin_at_prediction: bool,
    ) {
        core::mem::swap(&mut self.current, &mut self.trial);
        self.spare.deviation.copy_from_slice(&self.current.deviation);
        let arrived = self.advance(problem);
        if arrived && begin_at_prediction && self.current.norm.is_finite() {
            return;
        }
        core::mem::swap(&mut self.current, &mut self.spare);
        self.current.obstacle_time = 0.0;
        problem.locate(&mut self.current);
        let carried = self.carry(problem).is_ok();
        let [held, reached] = [&self.current, &self.spare];
        let better = held.obstacle_time >= reached.obstacle_time && held.norm <= reached.norm;
        if !(carried && better) {
            core::mem::swap(&mut self.current, &mut self.spare);
            problem.locate(&mut self.current);
        }
    }

    /// Goes from the start, in `current`, as far as the system allows towards the first guess, in `trial`. Returns whether
    /// it is there at once.
    fn advance(&mut self, problem: &mut Incremental<'_, '_>) -> bool {
        let Self { current, trial, image, .. } = self;
        current.obstacle_time = 0.0;
        problem.locate(current);
        // Nothing else needs the image yet: it keeps what is left of the way.
        let ways = image.iter_mut().zip(&trial.deviation).zip(&current.deviation);
        for ((way, guess), start) in ways {
            *way = guess - start;
        }
        let mut arrived = false;
        for way in 0..APPROACHES {
            self.direction.copy_from_slice(&self.image);
            let left = 1.0 - self.current.obstacle_time;
            let whole = self.go(problem, left);
            core::mem::swap(&mut self.current, &mut self.trial);
            arrived = whole && way == 0;
            if whole || self.leave(problem.held) < APPROACH_MIN {
                break;
            }
        }
        problem.evaluate(&mut self.current);
        arrived
    }

    /// Takes the way gone along `direction` from what is left of it in `image`, all of it where a particle was stopped.
    /// Returns the share that the freest particle went.
    fn leave(&mut self, held: &[bool]) -> f64 {
        let share = |went: &[f64; 3], left: &[f64; 3]| {
            let square = dot(left, left);
            if square > 0.0 { dot(went, left) / square } else { 0.0 }
        };
        let ways = block::triples(&self.direction).iter().zip(block::triples(&self.image));
        let freest = ways.map(|(went, left)| share(went, left)).fold(0.0, f64::max);
        let ways = block::triples(&self.direction).iter();
        let ways = ways.zip(block::triples_mut(&mut self.image)).zip(held);
        for ((went, left), &held) in ways {
            let stopped = !held && share(went, left) < STOPPED * freest;
            for (left, went) in left.iter_mut().zip(went) {
                *left = if stopped { 0.0 } else { *left - went };
            }
        }
        freest
    }

    /// Moves held particles and bodies on towards their places, as far as the system allows.
    pub(crate) fn carry(&mut self, problem: &mut Incremental<'_, '_>) -> Result<(), Halt> {
        let ways = block::triples_mut(&mut self.direction).iter_mut();
        let left = block::triples(&self.current.deviation);
        for ((way, left), &held) in ways.zip(left).zip(problem.held) {
            *way = if held { left.map(|left| -left) } else { [0.0; 3] };
        }
        let done = self.current.obstacle_time;
        self.go(problem, 1.0 - done);
        problem.evaluate(&mut self.trial);
        if !self.trial.norm.is_finite() || self.trial.obstacle_time < done + ADVANCE_MIN {
            return Err(Halt::Stop(Stop::Blocked));
        }
        self.accept(1.0);
        Ok(())
    }

    /// Moves the trial to the end of what the system allows of the way along the direction; whether that is all of it.
    fn go(&mut self, problem: &mut Incremental<'_, '_>, advance: f64) -> bool {
        let limit = problem.limit_step(&self.current, &mut self.direction, advance);
        let done = self.current.obstacle_time;
        self.move_trial(1.0);
        // A whole step ends exactly where it should.
        self.trial.obstacle_time = match limit {
            StepLimit::Whole => done + advance,
            StepLimit::Shortened { obstacle_advance } => done + obstacle_advance,
        };
        problem.locate(&mut self.trial);
        limit.is_whole()
    }
}
