//! Time-stepping schemes: implicit steps with their solver, or explicit ones.

use drape_implicit::{
    Error, Explicit, InitialMatrix, Integrator, IntegratorState, LinearSolver, Method, Report,
    Settings, StepFilter, Stepper, System,
};
use drape_scene::SolverSettings;

/// Sampling of the energy balance: the dissipation of the integrator is computed in one of this
/// number of sub-steps. Computed in all sub-steps, a run took 2.6 times as long where surfaces
/// touch, and half as long again in a swing.
const ENERGY_SAMPLING: u64 = 32;

/// Energy that the last two iterations of conjugate gradients gain when they end, as a fraction of
/// the whole gain, if energies decide on the end of a step. With residuals at 0.03 of the nonlinear
/// residuals instead, a curtain of 40 000 particles took 14.1 s rather than 10.8 s, a T-shirt 62 s
/// rather than 52 s, and a skirt 70 s rather than 58 s.
pub(crate) const ENERGY_FORCING: f64 = 0.01;

/// Scheme by which a scene is integrated in time.
#[derive(Debug, Clone, PartialEq)]
pub enum Scheme {
    /// Implicit steps, with the settings of their solver.
    Implicit(Settings),
    /// Many small explicit steps in each step. They check the implicit steps, and are too slow for
    /// other uses.
    Explicit,
}

impl Scheme {
    /// Returns the scheme that the settings `solver` of a scene ask for.
    #[must_use]
    pub fn new(solver: &SolverSettings) -> Self {
        let integrator = match solver.integrator {
            drape_scene::Integrator::Bdf2 => Integrator::Bdf2,
            drape_scene::Integrator::BackwardEuler => Integrator::BackwardEuler,
            drape_scene::Integrator::Explicit => return Self::Explicit,
        };
        let method = match solver.method {
            drape_scene::Method::Broyden => Method::Broyden,
            drape_scene::Method::Newton => Method::Newton,
            drape_scene::Method::TextbookMass => Method::Textbook { initial: InitialMatrix::Mass },
            drape_scene::Method::TextbookDiagonal => {
                Method::Textbook { initial: InitialMatrix::Diagonal }
            }
        };
        let linear_solver = match solver.linear_solver {
            drape_scene::LinearSolver::ConjugateGradient => LinearSolver::ConjugateGradient,
            drape_scene::LinearSolver::Cholesky => LinearSolver::Cholesky,
        };

        Self::Implicit(Settings {
            integrator,
            method,
            linear_solver,
            tolerance: solver.tolerance,
            error_fraction: solver.error_fraction,
            energy_forcing: if solver.error_fraction > 0.0 { ENERGY_FORCING } else { 0.0 },
            energy_balance: solver.energy_balance,
            energy_sampling: ENERGY_SAMPLING,
            ..Settings::default()
        })
    }

    /// Returns the order of accuracy of the integrator.
    pub(crate) fn order(&self) -> f64 {
        match self {
            Self::Implicit(settings) if settings.integrator == Integrator::Bdf2 => 2.0,
            _ => 1.0,
        }
    }
}

/// Integrator of one system by a scheme.
#[derive(Debug)]
pub(crate) enum TimeStepper {
    Implicit(Box<Stepper>),
    Explicit(Box<Explicit>),
}

impl TimeStepper {
    /// Sets up `scheme` for `system`.
    pub(crate) fn new(scheme: &Scheme, system: &dyn System) -> Result<Self, Error> {
        Ok(match scheme {
            Scheme::Implicit(settings) => {
                Self::Implicit(Box::new(Stepper::new(system, settings.clone())?))
            }
            Scheme::Explicit => Self::Explicit(Box::new(Explicit::new(system))),
        })
    }

    /// Advances `system` by a step of the length `dt`, in s.
    pub(crate) fn advance(
        &mut self,
        system: &mut dyn System,
        state: &mut IntegratorState,
        dt: f64,
    ) -> Result<Report, Error> {
        match self {
            Self::Implicit(stepper) => stepper.advance(system, state, dt),
            Self::Explicit(explicit) => explicit.advance(system, state, dt),
        }
    }

    /// Advances a system by a step of the length `dt`, in s, which `filter` limits.
    pub(crate) fn advance_filtered(
        &mut self,
        filter: &mut dyn StepFilter,
        state: &mut IntegratorState,
        dt: f64,
    ) -> Result<Report, Error> {
        match self {
            Self::Implicit(stepper) => stepper.advance_filtered(filter, state, dt),
            Self::Explicit(_) => Err(Error::UnfilteredMethod),
        }
    }

    /// Returns the report of the accepted parts of a failed step, if the scheme divides steps.
    pub(crate) fn unfinished(&self) -> Option<&Report> {
        match self {
            Self::Implicit(stepper) => Some(stepper.report()),
            Self::Explicit(_) => None,
        }
    }
}
