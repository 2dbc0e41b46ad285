//! Model of the cloth, and settings of the solver.

use crate::check::checker::Checker;
use crate::scene::model::Model;
use crate::scene::solver::{Integrator, LinearSolver, Method, SolverSettings};

/// Root-mean-square error of the acceleration over g that a step may leave when the scene does not
/// say.
const TOLERANCE: f64 = 1e-4;

/// Error that the solver may leave in a step when the scene gives neither this nor a tolerance, as
/// a fraction of the step's own. From 0.1 to 0.3 a swing took 439 to 403 matrices, a curtain 314 to
/// 241.
const ERROR_FRACTION: f64 = 0.2;

/// Checks the model of the internal forces.
pub(crate) fn model(checker: &mut Checker<'_>) -> Model {
    let models = [("kes", Model::Kes), ("breen-1994", Model::Breen1994)];
    checker.choice("model", checker.file.model.as_deref(), &models)
}

/// Checks the settings of the solver.
pub(crate) fn solver(checker: &mut Checker<'_>) -> SolverSettings {
    let file = checker.file;
    let solver = &file.solver;
    let integrators = [
        ("bdf2", Integrator::Bdf2),
        ("backward-euler", Integrator::BackwardEuler),
        ("explicit", Integrator::Explicit),
    ];
    let methods = [
        ("broyden", Method::Broyden),
        ("newton", Method::Newton),
        ("textbook-mass", Method::TextbookMass),
        ("textbook-diagonal", Method::TextbookDiagonal),
    ];
    let linear = [
        ("conjugate-gradient", LinearSolver::ConjugateGradient),
        ("cholesky", LinearSolver::Cholesky),
    ];
    let word = solver.integrator.as_deref();
    let integrator = checker.choice("solver.integrator", word, &integrators);
    let method = checker.choice("solver.method", solver.method.as_deref(), &methods);
    let linear_solver = checker.choice("solver.linear", solver.linear.as_deref(), &linear);
    let tolerance = solver.tolerance.unwrap_or(TOLERANCE);
    let help = "rms acceleration error over g; 1e-4 is usual";
    checker.within("solver.tolerance", tolerance, 1e-10..=0.1, help);
    let usual = if solver.tolerance.is_none() { ERROR_FRACTION } else { 0.0 };
    let error_fraction = solver.error_fraction.unwrap_or(usual);
    let help = "fraction of the step's own error; 0.2 is fast, 0 leaves the tolerance alone";
    checker.within("solver.error_fraction", error_fraction, 0.0..=1.0, help);
    let varies = file.settle.is_some() || file.time.error.is_some();
    if integrator == Integrator::Explicit && varies {
        let help = "leave out [settle] and time.error, or take \"bdf2\"";
        let mistake = checker.fail("solver.integrator", "explicit steps are of one length", help);
        checker.remedy(mistake, "solver.integrator", Some("\"bdf2\""));
    }
    if file.keeps_surfaces_apart() {
        let textbook = matches!(method, Method::TextbookMass | Method::TextbookDiagonal);
        let whole = "its steps cannot be limited so that surfaces stay apart";
        if integrator == Integrator::Explicit {
            let help = "leave contact.surfaces out, or take integrator = \"bdf2\"";
            let message = format!("with explicit steps: {whole}");
            let mistake = checker.fail("contact.surfaces", message, help);
            checker.remedy(mistake, "contact.surfaces", None);
        } else if textbook {
            let help = "add surfaces = false to [contact], or take method = \"broyden\"";
            let word = solver.method.as_deref().unwrap_or_default();
            let mistake = checker.fail("solver.method", format!("\"{word}\": {whole}"), help);
            checker.remedy(mistake, "contact.surfaces", Some("false"));
        }
    }
    let energy_balance = file.output.energy.unwrap_or(true);
    SolverSettings { integrator, method, linear_solver, tolerance, error_fraction, energy_balance }
}
