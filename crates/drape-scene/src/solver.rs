use crate::file::SceneFile;
use crate::reader::Reader;

/// Root-mean-square error of the acceleration over g that a step may leave when the scene does not say.
const TOLERANCE: f64 = 1e-4;

/// Settings of the solver that a scene asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolverSettings {
    /// Formula of a step.
    pub integrator: Integrator,
    /// Iteration that solves the equations of an implicit step.
    pub method: Method,
    /// Solver of the linear systems of that iteration.
    pub linear_solver: LinearSolver,
    /// Root-mean-square error of the acceleration that a step may leave, over g.
    pub tolerance: f64,
}

/// Formula of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Integrator {
    /// Backward differences of second order.
    #[default]
    Bdf2,
    /// Backward Euler, of first order.
    BackwardEuler,
    /// Many small explicit steps in each: a cross-check, not a way to get results.
    Explicit,
}

/// Iteration that solves the equations of an implicit step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Broyden's quasi-Newton method, begun with the stiffness.
    #[default]
    Broyden,
    /// Newton's method.
    Newton,
    /// Broyden's method begun with the masses.
    TextbookMass,
    /// Broyden's method begun with the diagonal of the stiffness.
    TextbookDiagonal,
}

/// Solver of the linear systems.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LinearSolver {
    /// Preconditioned conjugate gradients.
    #[default]
    ConjugateGradient,
    /// Sparse Cholesky factorisation.
    Cholesky,
}

impl Reader<'_> {
    pub(crate) fn solver(&mut self, file: &SceneFile) -> SolverSettings {
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
        let integrator = self.choice("solver.integrator", word, &integrators);
        let method = self.choice("solver.method", solver.method.as_deref(), &methods);
        let linear_solver = self.choice("solver.linear", solver.linear.as_deref(), &linear);
        let tolerance = solver.tolerance.unwrap_or(TOLERANCE);
        let help = "rms acceleration error over g; 1e-4 is usual";
        self.within("solver.tolerance", tolerance, (1e-10, 0.1), help);
        let varies = file.settle.is_some() || file.time.error.is_some();
        if integrator == Integrator::Explicit && varies {
            let help = "leave out [settle] and time.error, or take \"bdf2\"";
            self.fail("solver.integrator", "explicit steps are of one length".into(), help);
        }
        SolverSettings { integrator, method, linear_solver, tolerance }
    }
}
