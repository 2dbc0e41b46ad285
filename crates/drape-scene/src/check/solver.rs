//! Settings of the solver.

use crate::check::checker::Checker;
use crate::scene::solver::{Integrator, Method, SolverSettings};

/// Root-mean-square error of the acceleration over g that a step may leave when the scene does not
/// say.
const TOLERANCE: f64 = 1e-4;

/// Error that the solver may leave in a step when the scene gives neither this nor a tolerance, as
/// a fraction of the step's own. From 0.1 to 0.3 a swing took 439 to 403 matrices, a curtain 314 to
/// 241.
const ERROR_FRACTION: f64 = 0.2;

/// Checks the settings of the solver.
pub(crate) fn solver(checker: &mut Checker<'_>) -> SolverSettings {
    let spec = checker.spec;
    let solver = &spec.solver;
    let (integrator, method, linear_solver) = (solver.integrator, solver.method, solver.linear);
    let tolerance = solver.tolerance.unwrap_or(TOLERANCE);
    let usual = if solver.tolerance.is_none() { ERROR_FRACTION } else { 0.0 };
    let error_fraction = solver.error_fraction.unwrap_or(usual);
    let varies = spec.settle.is_some() || spec.time.error.is_some();
    if integrator == Integrator::Explicit && varies {
        let help = "leave out [settle] and time.error, or take \"bdf2\"";
        let mistake = checker.fail("solver.integrator", "explicit steps are of one length", help);
        checker.remedy(mistake, "solver.integrator", Some("\"bdf2\""));
    }
    if spec.keeps_surfaces_apart() {
        let textbook = matches!(method, Method::TextbookMass | Method::TextbookDiagonal);
        let whole = "its steps cannot be limited so that surfaces stay apart";
        if integrator == Integrator::Explicit {
            let help = "leave contact.surfaces out, or take integrator = \"bdf2\"";
            let message = format!("with explicit steps: {whole}");
            let mistake = checker.fail("contact.surfaces", message, help);
            checker.remedy(mistake, "contact.surfaces", None);
        } else if textbook {
            let help = "add surfaces = false to [contact], or take method = \"broyden\"";
            let word =
                if method == Method::TextbookMass { "textbook-mass" } else { "textbook-diagonal" };
            let mistake = checker.fail("solver.method", format!("\"{word}\": {whole}"), help);
            checker.remedy(mistake, "contact.surfaces", Some("false"));
        }
    }
    let energy_balance = spec.output.energy;
    SolverSettings { integrator, method, linear_solver, tolerance, error_fraction, energy_balance }
}
