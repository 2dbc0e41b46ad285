//! Start point of the iteration with a step filter. The path from the start of the sub-step to the
//! start point must be free of intersections, and obstacles must move along.

use super::equations::StepEquations;
use super::halt::Halt;
use super::search::Search;
use crate::linear::block::{triples, triples_mut};
use crate::linear::vector::dot;
use crate::report::Stop;
use crate::step_filter::AllowedStep;

/// Least advance of the obstacle time in one iteration. With a smaller advance the remaining
/// iterations would not suffice, and a shorter step succeeds sooner.
const MIN_ADVANCE: f64 = 1e-3;

/// Largest number of limited steps from the start towards the prediction.
const MAX_STEPS: usize = 12;

/// Least fraction of the remaining displacements that a limited step must cover.
const MIN_STEP: f64 = 0.05;

/// Fraction of a shortened advance of the obstacles that is used. The filter leaves a tenth of a
/// gap, and a Newton step at most doubles the gap: using the whole advance in each iteration would
/// close the gap.
const OBSTACLE_FRACTION: f64 = 0.5;

/// A particle stops if the filter allows it less than this multiple of the largest allowed
/// fraction: such a particle is close to an obstacle. In further steps the particle would enter the
/// last tenth of the gap again and again, and the iterations would need long to move it out.
const STOPPED: f64 = 0.5;

/// Finds the start point of `search` and makes it the evaluated current iterate.
///
/// On entry the trial iterate is the start of the sub-step, and the current iterate the prediction.
/// There are two candidates. The first is the start of the sub-step with the prescribed motions
/// advanced. The second is the allowed part of the step to the prediction. The candidate with the
/// smaller residual becomes the start point.
///
/// In free flight the prediction is exact. Where surfaces touch, a motion towards the prediction
/// compresses them, and later steps would have to reverse it: in a stack of five sheets the
/// residual at the start was a hundred times smaller. With `begin_at_prediction` the prediction is
/// the start point whenever the filter allows the whole step to it.
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
    let advanced = advance_obstacles(search, equations).is_ok();

    let [start, prediction] = [&search.current, &search.spare];
    let better = start.obstacle_time >= prediction.obstacle_time && start.norm <= prediction.norm;
    if !(advanced && better) {
        core::mem::swap(&mut search.current, &mut search.spare);
        equations.place(&mut search.current);
    }
}

/// Moves held particles and obstacles towards the end of their motions as far as the filter allows,
/// and evaluates the current iterate of `search` there. Fails if the advance is too small.
pub(crate) fn advance_obstacles(
    search: &mut Search,
    equations: &mut StepEquations<'_, '_>,
) -> Result<(), Halt> {
    let displacements = triples_mut(&mut search.direction).iter_mut();
    let deviations = triples(&search.current.deviation);
    for ((displacement, deviation), &held) in displacements.zip(deviations).zip(equations.held) {
        *displacement = if held { deviation.map(|d| -d) } else { [0.0; 3] };
    }

    let time = search.current.obstacle_time;
    take_step(search, equations, Advance { obstacles: 1.0 - time, fraction: OBSTACLE_FRACTION });
    equations.evaluate(&mut search.trial);
    if !search.trial.norm.is_finite() || search.trial.obstacle_time < time + MIN_ADVANCE {
        return Err(Halt::Stop(Stop::Blocked));
    }
    search.accept_trial();
    Ok(())
}

/// Moves the current iterate, the start, towards the trial iterate, the prediction, in limited
/// steps. Returns whether the first step reached the prediction.
fn move_to_prediction(search: &mut Search, equations: &mut StepEquations<'_, '_>) -> bool {
    let Search { current, trial, image, .. } = search;
    current.obstacle_time = 0.0;
    equations.place(current);

    // The image is not in use yet: it holds the remaining displacements.
    let displacements = image.iter_mut().zip(&trial.deviation).zip(&current.deviation);
    for ((displacement, prediction), start) in displacements {
        *displacement = prediction - start;
    }

    let mut reached = false;
    for step in 0..MAX_STEPS {
        search.direction.copy_from_slice(&search.image);
        let remaining = 1.0 - search.current.obstacle_time;
        let whole = take_step(search, equations, Advance { obstacles: remaining, fraction: 1.0 });
        core::mem::swap(&mut search.current, &mut search.trial);
        reached = whole && step == 0;
        if whole || subtract_step(search, equations.held) < MIN_STEP {
            break;
        }
    }
    equations.evaluate(&mut search.current);
    reached
}

/// Subtracts the step along the direction from the remaining displacements in the image, and
/// removes the remaining displacement of stopped particles. Returns the largest fraction that a
/// particle covered.
fn subtract_step(search: &mut Search, held: &[bool]) -> f64 {
    let steps = triples(&search.direction).iter().zip(triples(&search.image));
    let largest =
        steps.map(|(step, remaining)| covered_fraction(step, remaining)).fold(0.0, f64::max);
    let steps = triples(&search.direction).iter();
    for ((step, remaining), &held) in steps.zip(triples_mut(&mut search.image)).zip(held) {
        let stopped = !held && covered_fraction(step, remaining) < STOPPED * largest;
        for (remaining, step) in remaining.iter_mut().zip(step) {
            *remaining = if stopped { 0.0 } else { *remaining - step };
        }
    }
    largest
}

/// Returns the fraction of the `remaining` displacement that `step` covers, 0 without a
/// displacement.
fn covered_fraction(step: &[f64; 3], remaining: &[f64; 3]) -> f64 {
    let square = dot(remaining, remaining);
    if square > 0.0 { dot(step, remaining) / square } else { 0.0 }
}

/// Advance of a step before the filter limits it.
#[derive(Debug, Clone, Copy)]
struct Advance {
    /// Advance of the obstacle time.
    obstacles: f64,
    /// Fraction of the allowed step that is taken if the filter shortens the step.
    fraction: f64,
}

/// Moves the trial iterate along the allowed part of the direction, and the obstacles by the
/// allowed part of `advance`, without evaluating the iterate. Returns whether the whole step is
/// allowed.
fn take_step(search: &mut Search, equations: &mut StepEquations<'_, '_>, advance: Advance) -> bool {
    let limit = equations.limit_step(&search.current, &mut search.direction, advance.obstacles);
    // After a whole step the obstacle time is exact.
    let (length, obstacles) = match limit {
        AllowedStep::Whole => (1.0, advance.obstacles),
        AllowedStep::Shortened { obstacle_advance } => {
            (advance.fraction, advance.fraction * obstacle_advance)
        }
    };
    search.move_trial(length);
    search.trial.obstacle_time = search.current.obstacle_time + obstacles;
    equations.place(&mut search.trial);
    limit.is_whole()
}
