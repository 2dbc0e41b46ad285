use crate::Error;

/// The formula that carries a motion over one step.
///
/// Both solve `M (x − x̃)/(β dt)² = f(x)` for the end positions and differ in what they predict, `x̃`, and in
/// `β`. Both damp oscillations that the step is too long for, at any length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// First order, `β = 1` (Ngo Ngoc & Boivin 2004, eq. 6). Damps every motion, by a factor of
    /// `1/√(1 + ω²dt²)` per step for an oscillation of angular frequency `ω`.
    BackwardEuler,
    /// Second-order backward differentiation with variable step, `β = 2/3` for equal steps. Damps a slow
    /// oscillation by `1 − (ω dt)⁴/4` per step only. The first step and those after [`IntegratorState::restart`] are backward
    /// Euler; a step is at most twice as long as the one before it, so a longer one is built up to in sub-steps.
    ///
    /// [`IntegratorState::restart`]: crate::IntegratorState::restart
    #[default]
    Bdf2,
}

/// How the equations of a step are solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Broyden's rank-one updates of the inverse of a tangent frozen for a few iterations, each tangent's first
    /// step safeguarded by a line search: [`Method::Newton`] with fewer tangents.
    #[default]
    Broyden,
    /// A new tangent in every iteration.
    Newton,
    /// Broyden's method as in the textbooks, from a diagonal matrix, with a line search on the residual.
    ///
    /// It never looks at the couplings between particles, which is its charm and its limit: with a stiffness
    /// `k` it needs `k dt²/m` of order one. Here as a baseline to compare with (Ngo Ngoc & Boivin 2004, §5;
    /// Kelley, *Iterative Methods for Linear and Nonlinear Equations*, 1995, ch. 7).
    Textbook {
        /// The matrix to start from.
        initial: InitialMatrix,
    },
}

/// What textbook Broyden starts from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InitialMatrix {
    /// The inertia `M/(β dt)²`.
    #[default]
    Mass,
    /// The diagonal of inertia and stiffness at the start of the step.
    Diagonal,
}

/// How linear systems with the tangent are solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LinearSolver {
    /// Conjugate gradients with an incomplete block Cholesky preconditioner: little memory, and the faster one
    /// unless the step is very long.
    #[default]
    ConjugateGradient,
    /// Sparse Cholesky factorisation: exact, so a cross-check of the other, and independent of how stiff the
    /// system is; memory and time grow faster than the number of particles.
    Cholesky,
}

/// Settings of a [`Stepper`](crate::Stepper).
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Formula of the step. Default: second-order backward differentiation.
    pub integrator: Integrator,
    /// Solver of its equations. Default: Broyden on a frozen tangent.
    pub method: Method,
    /// Solver of the linear systems inside. Default: conjugate gradients.
    pub linear_solver: LinearSolver,
    /// A step has converged when `‖M a − f‖₂ ≤ tolerance · acceleration · √Σm²` over the free particles: the
    /// root-mean-square error of the acceleration, as a fraction of `acceleration`. Default 1e-4.
    pub tolerance: f64,
    /// A step has also converged when a Newton step promised to gain, by half its decrement `−pᵀφ`, at most this part of
    /// the kinetic energy `½ Σ m |x − x₀|²/h²` of the way from where the step began, and has left at most a hundred
    /// times what `tolerance` asks for: what is left then changes the way by little, however stiff what resists it. For
    /// motion that goes on from there, not for its end. Default 0, which leaves only the tolerance.
    pub energy_tolerance: f64,
    /// Acceleration that the tolerance refers to, in m/s². Default 9.81, the one of gravity; a system without
    /// weight sets the one that matters to it.
    pub acceleration: f64,
    /// Iterations after which an attempt at a (sub)step is given up. Default 100: cloth in contact at steps three
    /// times too long was seen to need 79.
    pub max_iterations: usize,
    /// How often a failing step may be halved. Default 10: sub-steps down to `dt/1024`.
    pub max_halvings: u32,
    /// Broyden: iterations on one tangent, the first (Newton's) included. Default 3: a tangent is kept only close to
    /// the solution, where two more steps on it are enough or it was not worth keeping.
    pub iterations_per_matrix: usize,
    /// Broyden: the linear residual relative to the nonlinear one at which conjugate gradients stop. Default 0.03.
    pub broyden_forcing: f64,
    /// The same for Newton steps. Default 0.01: looser costs more tangents than it saves iterations, and one tangent
    /// costs as much as ten to fifteen of these; from 0.01 to 0.001 the cost is flat within a tenth.
    pub newton_forcing: f64,
    /// Conjugate-gradient iterations after which the direction found so far is taken. Default 2000.
    pub max_linear_iterations: usize,
    /// Whether a step of a system that guards its ways begins where velocities lead if nothing is in the way, even if the
    /// start is better balanced: for motion that goes on, such as creeping to rest, whose forces are small at the start
    /// however far it has to go. Default false.
    pub begin_at_prediction: bool,
    /// Whether the report has the energy balance, at the price of two potentials per sub-step. Default false.
    pub energy_balance: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            integrator: Integrator::default(),
            method: Method::default(),
            linear_solver: LinearSolver::default(),
            tolerance: 1e-4,
            energy_tolerance: 0.0,
            acceleration: 9.81,
            max_iterations: 100,
            max_halvings: 10,
            iterations_per_matrix: 3,
            broyden_forcing: 0.03,
            newton_forcing: 0.01,
            max_linear_iterations: 2000,
            begin_at_prediction: false,
            energy_balance: false,
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
