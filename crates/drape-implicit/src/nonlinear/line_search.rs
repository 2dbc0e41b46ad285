//! Backtracking line searches: on residual and energy for Newton steps, on the residual alone for
//! textbook Broyden.

use super::equations::StepEquations;
use super::search::Search;
use crate::linear::vector::dot;

/// Armijo's constant: decrease that a line search asks for, as a fraction of the one that the slope
/// predicts. The customary value \[NW06\], small, so that it only excludes steps that gain nothing.
const ARMIJO: f64 = 1e-4;

/// A step is accepted without asking for the energy if it leaves at most this fraction of the least
/// residual so far. With the residual of the current iterate instead, a step that decreased the
/// residual and one that decreased the energy could undo each other for ever.
const RESIDUAL_DECREASE: f64 = 0.9;

/// Backtracks before the direction is given up: 2⁻¹⁶ of a Newton step is no progress.
const MAX_BACKTRACKS: usize = 16;

/// Relative difference of two energies below which rounding may have caused it; the slopes then
/// decide instead (\[HZ05\], eq. 4.1).
const ENERGY_NOISE: f64 = 1e-12;

/// Shortens the step along the direction until the residual falls below the least so far or,
/// failing that, the energy decreases enough for its slope. Moves the current iterate there and
/// returns the length.
pub(crate) fn energy_search(
    search: &mut Search,
    equations: &mut StepEquations<'_, '_>,
    slope: f64,
    least_residual: f64,
) -> Option<f64> {
    let mut length = 1.0;
    // A direction that a step filter has limited need not be one of descent.
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
            let good = if noise.is_finite() && (end - start).abs() <= noise {
                dot(&search.trial.residual, &search.direction) <= (2.0 * ARMIJO - 1.0) * slope
            } else {
                end.is_finite() && end <= start + ARMIJO * length * slope
            };
            if good {
                search.accept_trial();
                return Some(length);
            }
        }
        equations.report.backtracks += 1;
        length *= 0.5;
    }
    None
}

/// Shortens the step along the direction until the residual falls. Moves the current iterate there
/// and returns the length.
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
