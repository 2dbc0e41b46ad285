//! Failure of a step, described with its place and with a remedy in the words of a scene.

use drape_implicit::{Error, Stop};

use crate::world::ClosestPlace;

/// Largest multiple of the tolerance of the solver at which a larger tolerance is the remedy.
const NEARLY_SOLVED: f64 = 1e3;

/// Largest tolerance of the solver that a scene may have.
const TOLERANCE_MAX: f64 = 0.1;

/// Describes that a step failed with `error`. `place` is where surfaces are closest. If
/// `is_of_scene`, the tolerance is the one of the scene, which can be larger.
pub(super) fn describe(error: &Error, place: Option<&ClosestPlace>, is_of_scene: bool) -> String {
    let where_closest = place.map(|place| format!("; {place}")).unwrap_or_default();
    let Error::NotConverged { time, dt, residual, tolerance, iterations, stop } = error else {
        return format!("{error}{where_closest}");
    };
    let closing = place.and_then(|place| place.closing.as_ref());
    let nearly_solved = is_of_scene && *residual <= NEARLY_SOLVED * tolerance;

    let remedy = match (closing, stop) {
        (Some(closing), _) => closing.remedy(),
        (None, Stop::Blocked) => {
            "slow what moves by prescription, or leave room where it moves to".to_owned()
        }
        (None, Stop::Iterations | Stop::LineSearch) if nearly_solved => {
            let enough = (2.0 * residual).min(TOLERANCE_MAX);
            format!("write solver.tolerance = {enough:.0e}")
        }
        _ => "a shorter time.step or a larger spacing may help".to_owned(),
    };
    format!(
        "the step from t = {time} s did not converge ({stop}): with dt = {dt:.1e} s the residual is \
         {residual:.2e} against a tolerance of {tolerance:e} after {iterations} iterations\
         {where_closest}; {remedy}"
    )
}
