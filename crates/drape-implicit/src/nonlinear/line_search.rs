//! Backtracking line searches: on residual and energy for Newton steps, and on the residual alone
//! for textbook Broyden.

use super::equations::StepEquations;
use super::search::Search;
use crate::linear::vector::dot;

/// Armijo's constant: decrease that a line search requires, as a fraction of the decrease that the
/// slope predicts. The customary value \[NW06\] is small, so that it only excludes steps without
/// progress.
const ARMIJO: f64 = 1e-4;

/// A step is accepted without evaluating the energy if its residual is at most this fraction of the
/// least residual so far. With the residual of the current iterate instead of the least, a step
/// that decreases the residual and a step that decreases the energy could alternate without end.
const RESIDUAL_DECREASE: f64 = 0.9;

/// Largest number of backtracks along a direction: 2⁻¹⁶ of a Newton step is no progress.
const MAX_BACKTRACKS: usize = 16;

/// Relative difference of two energies that may be due to rounding. Up to this difference the
/// slopes decide instead of the energies (\[HZ05\], eq. 4.1).
const ENERGY_NOISE: f64 = 1e-12;

/// Shortens the step along the direction of `search` until the residual falls below
/// `least_residual`, in N, or the energy decreases enough for its `slope`, in J. Moves the current
/// iterate to the end of the step and returns the length of the step. Returns `None` if no length
/// is admissible.
pub(crate) fn energy_search(
    search: &mut Search,
    equations: &mut StepEquations<'_, '_>,
    slope: f64,
    least_residual: f64,
) -> Option<f64> {
    let mut length = 1.0;
    // A direction that a step filter has shortened may point uphill.
    if !(slope < 0.0) {
        return None;
    }

    for _ in 0..=MAX_BACKTRACKS {
        search.try_step(equations, length);
        if search.trial.norm <= RESIDUAL_DECREASE * least_residual {
            search.accept_trial();
            return Some(length);
        }
        if search.trial.norm.is_finite() {
            let start = equations.energy(&mut search.current);
            let end = equations.energy(&mut search.trial);
            let noise = ENERGY_NOISE * (start.abs() + end.abs());
            let decreases = if noise.is_finite() && (end - start).abs() <= noise {
                dot(&search.trial.residual, &search.direction) <= (2.0 * ARMIJO - 1.0) * slope
            } else {
                end.is_finite() && end <= start + ARMIJO * length * slope
            };
            if decreases {
                search.accept_trial();
                return Some(length);
            }
        }

        equations.report.backtracks += 1;
        length *= 0.5;
    }
    None
}

/// Shortens the step along the direction of `search` until the residual decreases. Moves the
/// current iterate to the end of the step and returns the length of the step, or `None` if no
/// length is admissible.
pub(crate) fn residual_search(
    search: &mut Search,
    equations: &mut StepEquations<'_, '_>,
) -> Option<f64> {
    let mut length = 1.0;
    for _ in 0..=MAX_BACKTRACKS {
        search.try_step(equations, length);
        if search.trial.norm <= (1.0 - ARMIJO * length) * search.current.norm {
            search.accept_trial();
            return Some(length);
        }
        equations.report.backtracks += 1;
        length *= 0.5;
    }
    None
}
