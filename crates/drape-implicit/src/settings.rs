//! Settings of a [`Stepper`](crate::Stepper).

use crate::error::Error;

/// Formula that advances a state by one step.
///
/// Both solve `$M\,(x - \tilde x)/(\beta\,\mathrm{dt})^2 = f(x)$` for the end positions, and differ
/// in `$\beta$` and in the prediction `$\tilde x$`. Both damp oscillations that the step is too
/// long to resolve, at any length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// Backward Euler: first order, `β = 1` (\[NB04\] eq. 6). Damps every motion, by a factor of
    /// `1/√(1 + ω²dt²)` per step for an oscillation of angular frequency `ω`.
    BackwardEuler,
    /// Second-order backward differentiation with variable step, `β = 2/3` for equal steps
    /// (\[HNW93\] III.5). Damps a slow oscillation by `1 − (ω dt)⁴/4` per step only. The first step
    /// and those after [`IntegratorState::restart`] are backward Euler; a step is at most twice as
    /// long as the one before it, so a longer one is divided into sub-steps that double.
    ///
    /// [`IntegratorState::restart`]: crate::IntegratorState::restart
    #[default]
    Bdf2,
}

/// Method that solves the equations of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Newton's method with fewer system matrices: each is kept for a few iterations, in which
    /// Broyden's rank-one updates improve its inverse. The first step with each matrix is
    /// safeguarded by a line search.
    #[default]
    Broyden,
    /// Newton's method: a new system matrix in every iteration.
    Newton,
    /// Broyden's method as in the textbooks, from a diagonal matrix, with a line search on the
    /// residual: a baseline to compare with (\[NB04\] section 5, \[Kel95\] chapter 7).
    ///
    /// It never assembles the couplings between particles, and so converges only where the
    /// stiffness `k` of a coupling gives a `k dt²/m` of order one.
    Textbook {
        /// Matrix to start from.
        initial: InitialMatrix,
    },
}

/// Matrix that textbook Broyden starts from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InitialMatrix {
    /// Inertia `M/(β dt)²`.
    #[default]
    Mass,
    /// Diagonal of the system matrix at the start of the step.
    Diagonal,
}

/// Solver of linear systems with the system matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LinearSolver {
    /// Conjugate gradients with an incomplete block Cholesky preconditioner: little memory, and the
    /// faster one unless the step is very long.
    #[default]
    ConjugateGradient,
    /// Sparse Cholesky factorisation: exact, so a cross-check of the other, and independent of how
    /// stiff the system is; memory and time grow faster than the number of particles.
    Cholesky,
}

/// Settings of a [`Stepper`](crate::Stepper).
///
/// ```
/// use drape_implicit::{Integrator, Settings};
///
/// let settings = Settings { integrator: Integrator::BackwardEuler, ..Settings::default() };
/// assert_eq!(settings.check(), Ok(()));
/// assert!(Settings { tolerance: 0.0, ..settings }.check().is_err());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Formula of the step. Default: second-order backward differentiation.
    pub integrator: Integrator,
    /// Solver of its equations. Default: Newton's method with Broyden steps.
    pub method: Method,
    /// Solver of the linear systems in it. Default: conjugate gradients.
    pub linear_solver: LinearSolver,
    /// Tolerance of the residual. A step has converged when
    /// `‖M a − f‖₂ ≤ tolerance · acceleration · √Σm²` over the free particles: the root-mean-square
    /// error of the acceleration, as a fraction of `acceleration`. Default 1e-4.
    pub tolerance: f64,
    /// Energy that a converged step may have left to gain, as a fraction of the kinetic energy
    /// `½ Σ m |x − x₀|²/(β dt)²` of the straight motion from its start. Default 0, which leaves
    /// only the tolerance.
    ///
    /// A step has also converged when a Newton step predicted a decrease of the energy, half its
    /// decrement `−pᵀφ`, of at most that, and has left a residual of at most a hundred times the
    /// tolerance. The rest then changes the positions little, however stiff the forces that are
    /// left unbalanced. For motion that goes on from there, not for its end.
    pub energy_tolerance: f64,
    /// Error that the solver may leave in a step, as a fraction of the step's own. Default 0, which
    /// leaves only the tolerance.
    ///
    /// A step has also converged when a Newton or Broyden step predicted a decrease of the energy,
    /// half its decrement `−pᵀφ`, of at most `½ Σ m |θ e|²/(β dt)²`, with this fraction `θ` and the
    /// error `e` of the step as [`ErrorEstimate`](crate::ErrorEstimate) finds it, and has left a
    /// residual of at most `acceleration · √Σm²`, with a step filter a hundredth of it. The energy
    /// bounds the displacements of that step, also where stiff forces are left unbalanced. The error
    /// that is left is smaller by its contraction.
    pub error_fraction: f64,
    /// Acceleration that the tolerance refers to, in m/s². Default 9.81, that of gravity; a system
    /// without weight sets the one that matters to it.
    pub acceleration: f64,
    /// Iterations after which an attempt at a (sub)step is given up. Default 100: cloth in contact
    /// at steps three times too long was seen to need 79.
    pub max_iterations: usize,
    /// Times that a failing step may be halved. Default 10: sub-steps down to `dt/1024`.
    pub max_halvings: u32,
    /// Iterations of Broyden's method on one system matrix, the first (Newton's) included. Default
    /// 3: a matrix is kept only close to the solution, where two more steps on it are enough or it
    /// was not worth keeping.
    pub iterations_per_matrix: usize,
    /// Forcing term of Broyden steps: linear residual relative to the nonlinear one at which
    /// conjugate gradients stop. Default 0.03.
    pub broyden_forcing: f64,
    /// Forcing term of Newton steps. Default 0.01: larger ones cost more matrices than they save
    /// iterations of conjugate gradients, and one matrix costs as much as ten to fifteen of these;
    /// from 0.01 to 0.001 the cost is flat within a tenth.
    pub newton_forcing: f64,
    /// Energy that the last two iterations of conjugate gradients gain when they end, as a fraction
    /// of all that they have gained. Default 0, which leaves their end to the forcing terms.
    ///
    /// What is left to gain is half the square of the error in the norm of the matrix. Stiff forces
    /// that hardly move anything count little, while they decide on the residual. For steps that end
    /// by their energy or by their own error.
    pub energy_forcing: f64,
    /// Iterations of conjugate gradients after which the direction found so far is taken. Default
    /// 2000.
    pub max_linear_iterations: usize,
    /// Whether a step with a step filter begins where the velocities lead, if nothing limits the
    /// step to there, even if the residual at the start is smaller. For motion that goes on, such
    /// as quasi-static relaxation, whose forces are small at the start however far it has to go.
    /// Default false.
    pub begin_at_prediction: bool,
    /// Whether the report has the energy balance, at the cost of two potentials per sub-step.
    /// Default false.
    pub energy_balance: bool,
    /// Sub-steps of which one has its loss found by itself, by the work of the forces along it, so
    /// that the balance may fail; in the others the loss is what the other entries leave. Which one
    /// follows from its time. Default 1, all of them: where surfaces touch that more than doubled
    /// the time.
    pub energy_sampling: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            integrator: Integrator::default(),
            method: Method::default(),
            linear_solver: LinearSolver::default(),
            tolerance: 1e-4,
            energy_tolerance: 0.0,
            error_fraction: 0.0,
            acceleration: 9.81,
            max_iterations: 100,
            max_halvings: 10,
            iterations_per_matrix: 3,
            broyden_forcing: 0.03,
            newton_forcing: 0.01,
            energy_forcing: 0.0,
            max_linear_iterations: 2000,
            begin_at_prediction: false,
            energy_balance: false,
            energy_sampling: 1,
        }
    }
}

impl Settings {
    /// Checks that every number is in the range where it means something.
    ///
    /// # Errors
    /// [`Error::Setting`] names the first that is not.
    pub fn check(&self) -> Result<(), Error> {
        let positive = |value: f64| value > 0.0 && value.is_finite();
        let fraction = |value: f64| value > 0.0 && value < 1.0;
        let count = |value: usize| value > 0;
        let rules = [
            ("tolerance", self.tolerance, positive(self.tolerance), "positive"),
            (
                "energy_tolerance",
                self.energy_tolerance,
                (0.0..1.0).contains(&self.energy_tolerance),
                "at least 0 and below 1",
            ),
            (
                "error_fraction",
                self.error_fraction,
                (0.0..=1.0).contains(&self.error_fraction),
                "from 0 to 1",
            ),
            ("acceleration", self.acceleration, positive(self.acceleration), "positive"),
            (
                "max_iterations",
                self.max_iterations as f64,
                count(self.max_iterations),
                "at least 1",
            ),
            ("max_halvings", self.max_halvings.into(), self.max_halvings <= 40, "at most 40"),
            (
                "iterations_per_matrix",
                self.iterations_per_matrix as f64,
                count(self.iterations_per_matrix),
                "at least 1",
            ),
            (
                "broyden_forcing",
                self.broyden_forcing,
                fraction(self.broyden_forcing),
                "between 0 and 1",
            ),
            (
                "newton_forcing",
                self.newton_forcing,
                fraction(self.newton_forcing),
                "between 0 and 1",
            ),
            (
                "energy_forcing",
                self.energy_forcing,
                (0.0..1.0).contains(&self.energy_forcing),
                "at least 0 and below 1",
            ),
            (
                "max_linear_iterations",
                self.max_linear_iterations as f64,
                count(self.max_linear_iterations),
                "at least 1",
            ),
        ];
        for (name, value, good, range) in rules {
            if !good {
                return Err(Error::Setting { name, value, range });
            }
        }
        Ok(())
    }
}
