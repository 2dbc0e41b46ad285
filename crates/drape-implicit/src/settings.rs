//! Settings of a [`Stepper`](crate::Stepper).

use crate::error::Error;

/// Formula that advances a state by one step.
///
/// Both formulas solve `$M\,(x - \tilde x)/(\beta\,\mathrm{dt})^2 = f(x)$` for the end positions.
/// The formulas differ in `$\beta$` and in the prediction `$\tilde x$`. Both are stable for steps
/// of any length, and damp oscillations that the step is too long to resolve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Integrator {
    /// Backward Euler: first order, `β = 1` (\[NB04\] eq. 6). Every motion is damped: an
    /// oscillation of angular frequency `ω` by a factor of `1/√(1 + ω²dt²)` per step.
    BackwardEuler,
    /// Second-order backward differentiation with variable step, `β = 2/3` for equal steps
    /// (\[HNW93\] III.5). A slow oscillation is damped by a factor of only `1 − (ω dt)⁴/4` per
    /// step. The first step, and each step after [`IntegratorState::restart`], is backward Euler. A
    /// step is at most twice as long as the step before. A longer step is divided into sub-steps,
    /// each twice as long as the last. The default.
    ///
    /// [`IntegratorState::restart`]: crate::IntegratorState::restart
    #[default]
    Bdf2,
}

/// Method that solves the equations of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Newton's method with fewer system matrices. Each matrix is kept for a few iterations, in
    /// which Broyden's rank-one updates improve the inverse. A line search safeguards the first
    /// step with each matrix. The default.
    #[default]
    Broyden,
    /// Newton's method: a new system matrix in every iteration.
    Newton,
    /// Broyden's method as in the textbooks, from a diagonal matrix, with a line search on the
    /// residual: a baseline for comparisons (\[NB04\] section 5, \[Kel95\] chapter 7).
    ///
    /// Textbook Broyden never assembles the couplings between particles. Iterations therefore
    /// converge only where `k dt²/m` is of order one, with the stiffness `k` of a coupling.
    Textbook {
        /// Matrix to start from.
        initial: InitialMatrix,
    },
}

/// Initial matrix of textbook Broyden.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum InitialMatrix {
    /// Inertia `M/(β dt)²`. The default.
    #[default]
    Mass,
    /// Diagonal of the system matrix at the start of the step.
    Diagonal,
}

/// Solver of linear systems with the system matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LinearSolver {
    /// Conjugate gradients with an incomplete block Cholesky preconditioner. This solver needs
    /// little memory, and is the faster solver unless the step is very long. The default.
    #[default]
    ConjugateGradient,
    /// Sparse Cholesky factorisation. This solver is exact, so it is a cross-check of conjugate
    /// gradients, and takes equally long for soft and stiff systems. Memory and time grow faster
    /// than the number of particles. The solver needs the feature `cholesky`.
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
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Formula of the step. Default: second-order backward differentiation.
    pub integrator: Integrator,
    /// Method that solves the equations of a step. Default: Newton's method with Broyden steps.
    pub method: Method,
    /// Solver of the linear systems of `method`. Default: conjugate gradients.
    pub linear_solver: LinearSolver,
    /// Tolerance of the residual. A step has converged when
    /// `‖M a − f‖₂ ≤ tolerance · acceleration · √Σm²` over the free particles: the root-mean-square
    /// error of the acceleration, as a fraction of `acceleration`. Default 1e-4.
    pub tolerance: f64,
    /// Decrease of the energy that an exact solution may still have over a converged step, as a
    /// fraction of the kinetic energy `½ Σ m |x − x₀|²/(β dt)²` of the straight motion from the
    /// start of the step. Default 0, which leaves only `tolerance`.
    ///
    /// A step has also converged when a Newton step `p` predicted a decrease of the energy `−½ pᵀφ`
    /// of at most this fraction, and the residual is at most a hundred times `tolerance`. Further
    /// iterations would change the positions little, however stiff the unbalanced forces are. This
    /// tolerance suits motion that continues, not the state at the end of a run.
    pub energy_tolerance: f64,
    /// Error that the solver may leave in a step, as a fraction of the error of the step's formula.
    /// Default 0, which leaves only `tolerance`.
    ///
    /// A step has also converged when two conditions hold. A Newton or Broyden step `p` predicted a
    /// decrease of the energy `−½ pᵀφ` of at most `½ Σ m |θ e|²/(β dt)²`, with this fraction `θ`
    /// and the error `e` of the formula, estimated as by [`ErrorEstimate`](crate::ErrorEstimate).
    /// And the residual is at most `acceleration · √Σm²`, or a hundredth of this bound with a step
    /// filter. The energy bounds the displacements `p`, also where stiff forces remain unbalanced.
    /// The remaining error is smaller than `p` by the contraction of the iteration.
    pub error_fraction: f64,
    /// Acceleration that `tolerance` refers to, in m/s². Default 9.81, the acceleration of gravity.
    /// For a system without weight, set a typical acceleration of the system.
    pub acceleration: f64,
    /// Largest number of iterations of an attempt at a (sub)step. Default 100: cloth in contact at
    /// steps three times too long was seen to need 79.
    pub max_iterations: usize,
    /// Number of times that a failing step may be halved. Default 10: sub-steps down to `dt/1024`.
    pub max_halvings: u32,
    /// Number of iterations of Broyden's method on one system matrix, including the first
    /// iteration, a Newton step. Default 3: a matrix is kept only close to the solution, where two
    /// Broyden steps either suffice or show that the matrix was not worth keeping.
    pub iterations_per_matrix: usize,
    /// Forcing term of Broyden steps: ratio of the linear to the nonlinear residual at which
    /// conjugate gradients stop. Default 0.03.
    pub broyden_forcing: f64,
    /// Forcing term of Newton steps. Default 0.01. Larger values cost more in matrices than they
    /// save in iterations of conjugate gradients: one matrix costs as much as ten to fifteen
    /// iterations. From 0.01 to 0.001 the cost is flat within a tenth.
    pub newton_forcing: f64,
    /// Decrease of the energy in the last two iterations of conjugate gradients, as a fraction of
    /// the decrease in all iterations, at which conjugate gradients stop. Default 0, with which
    /// only the forcing terms stop them.
    ///
    /// The energy above the minimum is half the square of the error in the norm of the matrix.
    /// Stiff forces that hardly move anything count little in this energy, but dominate the
    /// residual. Set this fraction together with `energy_tolerance` or `error_fraction`.
    pub energy_forcing: f64,
    /// Largest number of iterations of conjugate gradients. After the last one the solver uses the
    /// direction reached so far. Default 2000.
    pub max_linear_iterations: usize,
    /// Whether the iteration of a filtered step begins at the positions that the velocities
    /// predict, if the filter does not limit the motion there, even if the residual at the start of
    /// the step is smaller. This suits motion that continues, such as quasi-static relaxation,
    /// whose forces are small at the start however far the cloth is from rest. Default false.
    pub begin_at_prediction: bool,
    /// Whether the report has the energy balance, at the cost of two potentials per sub-step.
    /// Default false.
    pub energy_balance: bool,
    /// Sampling interval of the energy balance: in one of `energy_sampling` sub-steps the numerical
    /// dissipation is computed independently, by the work of the forces along the sub-step, so that
    /// the balance is a test. In the other sub-steps the dissipation is the difference of the other
    /// entries. The time of a sub-step decides whether it is sampled. Default 1, every sub-step:
    /// where surfaces touch this more than doubled the computing time.
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
    /// Checks that every number is in its admissible range.
    ///
    /// # Errors
    /// [`Error::Setting`] names the first field out of range.
    pub fn check(&self) -> Result<(), Error> {
        // Name, value, whether the value is admissible, and the range in words.
        let rules = [
            ("tolerance", self.tolerance, is_positive(self.tolerance), "positive"),
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
            ("acceleration", self.acceleration, is_positive(self.acceleration), "positive"),
            ("max_iterations", self.max_iterations as f64, self.max_iterations > 0, "at least 1"),
            ("max_halvings", self.max_halvings.into(), self.max_halvings <= 40, "at most 40"),
            (
                "iterations_per_matrix",
                self.iterations_per_matrix as f64,
                self.iterations_per_matrix > 0,
                "at least 1",
            ),
            (
                "broyden_forcing",
                self.broyden_forcing,
                is_proper_fraction(self.broyden_forcing),
                "between 0 and 1",
            ),
            (
                "newton_forcing",
                self.newton_forcing,
                is_proper_fraction(self.newton_forcing),
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
                self.max_linear_iterations > 0,
                "at least 1",
            ),
        ];

        for (name, value, is_admissible, range) in rules {
            if !is_admissible {
                return Err(Error::Setting { name, value, range });
            }
        }
        Ok(())
    }
}

/// Returns whether `value` is finite and greater than 0.
fn is_positive(value: f64) -> bool {
    value > 0.0 && value.is_finite()
}

/// Returns whether `value` lies strictly between 0 and 1.
fn is_proper_fraction(value: f64) -> bool {
    value > 0.0 && value < 1.0
}
