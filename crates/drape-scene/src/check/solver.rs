//! Settings of the solver.

use crate::scene::solver::SolverSettings;
use crate::spec::SceneSpec;
use crate::spec::run::SolverSpec;

/// Root-mean-square error of the acceleration over g that a step may leave when the scene does not
/// say.
const TOLERANCE: f64 = 1e-4;

/// Error that the solver may leave in a step, as a fraction of the step's own error, when the scene
/// gives neither this fraction nor a tolerance of [`TOLERANCE`] or less. From 0.1 to 0.3 a swing
/// took 439 to 403 matrices, a curtain 314 to 241.
const ERROR_FRACTION: f64 = 0.2;

/// Returns the settings of the solver.
pub(crate) fn solver(spec: &SceneSpec) -> SolverSettings {
    let SolverSpec { integrator, method, tolerance, error_fraction } = spec.solver;
    // A scene with a looser tolerance wants steps that are at most as expensive as usual.
    let is_usual = tolerance.is_none_or(|tolerance| tolerance > TOLERANCE);
    let usual = if is_usual { ERROR_FRACTION } else { 0.0 };
    SolverSettings {
        integrator,
        method,
        tolerance: tolerance.unwrap_or(TOLERANCE),
        error_fraction: error_fraction.unwrap_or(usual),
        energy_balance: spec.output.energy,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_looser_tolerance_keeps_the_usual_fraction_and_a_tighter_one_counts_alone() {
        let fraction = |tolerance, error_fraction| {
            let solver_spec = SolverSpec { tolerance, error_fraction, ..SolverSpec::default() };
            solver(&SceneSpec { solver: solver_spec, ..SceneSpec::default() }).error_fraction
        };
        assert_eq!([fraction(None, None), fraction(Some(1e-3), None)], [ERROR_FRACTION; 2]);
        assert_eq!([fraction(Some(1e-4), None), fraction(Some(1e-8), None)], [0.0; 2]);
        assert_eq!(fraction(Some(1e-8), Some(0.3)), 0.3);
        assert_eq!(fraction(Some(1e-3), Some(0.0)), 0.0);
    }
}
