//! Start point of the iteration with a step filter: it must be reached from the start of the
//! sub-step without an intersection, and obstacles must be moved to it.

use super::equations::StepEquations;
use super::halt::Halt;
use super::search::Search;
use crate::linear::block::{triples, triples_mut};
use crate::linear::vector::dot;
use crate::report::Stop;
use crate::step_filter::StepLimit;

/// Least advance of the obstacle time in one iteration. With less the iterations that are left
/// would not suffice, and a shorter step helps sooner.
const MIN_ADVANCE: f64 = 1e-3;

/// Most limited steps from the start to the prediction, which need not be reached.
const MAX_STEPS: usize = 12;

/// Least fraction of the displacements left that one of these steps must cover.
const MIN_STEP: f64 = 0.05;

/// Fraction taken of an advance of the obstacles that the filter has shortened. The filter leaves a
/// tenth of a gap, and a Newton step at most doubles it: the whole advance in each iteration would
/// close the gap.
const OBSTACLE_PART: f64 = 0.5;

/// A particle that keeps less than this multiple of the largest fraction kept is near something,
/// and stays there. Moved on, it would go into the last tenth of a gap again and again, from where
/// no iteration brings it back soon.
const STOPPED: f64 = 0.5;

/// Finds the start point: the start of the sub-step, which is the trial iterate, with all that is
/// prescribed moved on; or what is allowed of the step from there to the prediction, which is the
/// current iterate. Makes the one with the smaller residual current, evaluated.
///
/// In free flight the prediction is exact. Where surfaces touch, moving on squeezes them until a
/// step would have to undo it: in a stack of five sheets the residual at the start was a hundred
/// times smaller. With `begin_at_prediction` the prediction is taken all the same if it is reached
/// whole.
pub(crate) fn find_start(
    search: &mut Search,
    equations: &mut StepEquations<'_, '_>,
    begin_at_prediction: bool,
) {
    core::mem::swap(&mut search.current, &mut search.trial);
    search.spare.deviation.copy_from_slice(&search.current.deviation);
    let reached = move_to_prediction(search, equations);
    if reached && begin_at_prediction && search.current.norm.is_finite() {
        return;
    }
    core::mem::swap(&mut search.current, &mut search.spare);
    search.current.obstacle_time = 0.0;
    equations.place(&mut search.current);
    let moved = advance_obstacles(search, equations).is_ok();
    let [start, prediction] = [&search.current, &search.spare];
    let better = start.obstacle_time >= prediction.obstacle_time && start.norm <= prediction.norm;
    if !(moved && better) {
        core::mem::swap(&mut search.current, &mut search.spare);
        equations.place(&mut search.current);
    }
}

/// Moves held particles and obstacles on towards the end of their motions, as far as the filter
/// allows, and evaluates the iterate there.
pub(crate) fn advance_obstacles(
    search: &mut Search,
    equations: &mut StepEquations<'_, '_>,
) -> Result<(), Halt> {
    let displacements = triples_mut(&mut search.direction).iter_mut();
    let left = triples(&search.current.deviation);
    for ((displacement, left), &held) in displacements.zip(left).zip(equations.held) {
        *displacement = if held { left.map(|left| -left) } else { [0.0; 3] };
    }
    let done = search.current.obstacle_time;
    take_step(search, equations, Advance { obstacles: 1.0 - done, part: OBSTACLE_PART });
    equations.evaluate(&mut search.trial);
    if !search.trial.norm.is_finite() || search.trial.obstacle_time < done + MIN_ADVANCE {
        return Err(Halt::Stop(Stop::Blocked));
    }
    search.accept_trial();
    Ok(())
}

/// Moves from the start, the current iterate, towards the prediction, the trial iterate, in limited
/// steps. Returns whether the first one reached it.
fn move_to_prediction(search: &mut Search, equations: &mut StepEquations<'_, '_>) -> bool {
    let Search { current, trial, image, .. } = search;
    current.obstacle_time = 0.0;
    equations.place(current);
    // The image is not in use yet: it holds the displacements that are left.
    let displacements = image.iter_mut().zip(&trial.deviation).zip(&current.deviation);
    for ((displacement, prediction), start) in displacements {
        *displacement = prediction - start;
    }
    let mut reached = false;
    for step in 0..MAX_STEPS {
        search.direction.copy_from_slice(&search.image);
        let left = 1.0 - search.current.obstacle_time;
        let whole = take_step(search, equations, Advance { obstacles: left, part: 1.0 });
        core::mem::swap(&mut search.current, &mut search.trial);
        reached = whole && step == 0;
        if whole || subtract_step(search, equations.held) < MIN_STEP {
            break;
        }
    }
    equations.evaluate(&mut search.current);
    reached
}

/// Subtracts the step along the direction from the displacements left in the image; of a stopped
/// particle nothing is left. Returns the largest fraction that a particle covered.
fn subtract_step(search: &mut Search, held: &[bool]) -> f64 {
    let fraction = |step: &[f64; 3], left: &[f64; 3]| {
        let square = dot(left, left);
        if square > 0.0 { dot(step, left) / square } else { 0.0 }
    };
    let steps = triples(&search.direction).iter().zip(triples(&search.image));
    let largest = steps.map(|(step, left)| fraction(step, left)).fold(0.0, f64::max);
    let steps = triples(&search.direction).iter();
    for ((step, left), &held) in steps.zip(triples_mut(&mut search.image)).zip(held) {
        let stopped = !held && fraction(step, left) < STOPPED * largest;
        for (left, step) in left.iter_mut().zip(step) {
            *left = if stopped { 0.0 } else { *left - step };
        }
    }
    largest
}

/// Advance of a step that the filter limits.
#[derive(Debug, Clone, Copy)]
struct Advance {
    /// Advance of the obstacle time.
    obstacles: f64,
    /// Fraction taken of what the filter allows, where that is not all.
    part: f64,
}

/// Moves the trial iterate along what the filter allows of the direction and of an advance of the
/// obstacles, without evaluating it. Returns whether that is all of it.
fn take_step(search: &mut Search, equations: &mut StepEquations<'_, '_>, advance: Advance) -> bool {
    let limit = equations.limit_step(&search.current, &mut search.direction, advance.obstacles);
    // After a whole step the obstacles are exactly where they should be.
    let (length, obstacles) = match limit {
        StepLimit::Whole => (1.0, advance.obstacles),
        StepLimit::Shortened { obstacle_advance } => {
            (advance.part, advance.part * obstacle_advance)
        }
    };
    search.move_trial(length);
    search.trial.obstacle_time = search.current.obstacle_time + obstacles;
    equations.place(&mut search.trial);
    limit.is_whole()
}
