//! Time-stepping schemes: implicit steps with their solver, or explicit ones.

use drape_implicit::{
    Error, Explicit, InitialMatrix, Integrator, IntegratorState, LinearSolver, Method, Report,
    Settings, StepFilter, Stepper, System,
};
use drape_scene::{Scene, SolverSettings};

/// Sampling of the energy balance: the dissipation of the integrator is computed in one of this
/// number of sub-steps. Computed in all sub-steps, a run took 2.6 times as long where surfaces
/// touch, and half as long again in a swing.
const ENERGY_SAMPLING: u64 = 32;

/// Energy that the last two iterations of conjugate gradients gain when they end, as a fraction of
/// the whole gain, if energies decide on the end of a step. With residuals at 0.03 of the nonlinear
/// residuals instead, a curtain of 40 000 particles took 14.1 s rather than 10.8 s, a T-shirt 62 s
/// rather than 52 s, and a skirt 70 s rather than 58 s.
pub(crate) const ENERGY_FORCING: f64 = 0.01;

/// Scheme that checks the others, for tests and comparisons. No scene asks for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReferenceScheme {
    /// Semi-implicit Euler, each step in as many parts as stability requires.
    Explicit,
    /// Broyden's method begun with the masses, as textbooks have it.
    TextbookMass,
    /// Broyden's method begun with the diagonal of the system matrix.
    TextbookDiagonal,
    /// The scheme of the scene, with a sparse Cholesky factorisation in place of conjugate
    /// gradients.
    Cholesky,
}

impl ReferenceScheme {
    /// Returns why the scheme cannot simulate `scene`, or `None` if it can.
    pub(crate) fn objection(self, scene: &Scene) -> Option<&'static str> {
        let varies = scene.schedule.relaxation.is_some() || scene.schedule.clock.error.is_some();
        match self {
            Self::Cholesky => None,
            _ if scene.contact.surfaces => Some(
                "its steps cannot be limited so that surfaces stay apart: set contact.surfaces = false",
            ),
            Self::Explicit if varies => {
                Some("explicit steps are of one length: leave out [settle] and time.error")
            }
            Self::Explicit if scene.sewing.is_some() => Some("explicit steps cannot sew"),
            _ => None,
        }
    }
}

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
        };
        let method = match solver.method {
            drape_scene::Method::Broyden => Method::Broyden,
            drape_scene::Method::Newton => Method::Newton,
        };

        Self::Implicit(Settings {
            integrator,
            method,
            tolerance: solver.tolerance,
            error_fraction: solver.error_fraction,
            energy_forcing: if solver.error_fraction > 0.0 { ENERGY_FORCING } else { 0.0 },
            energy_balance: solver.energy_balance,
            energy_sampling: ENERGY_SAMPLING,
            ..Settings::default()
        })
    }

    /// Returns the scheme `reference`, with the other settings `solver` of a scene.
    pub(crate) fn reference(reference: ReferenceScheme, solver: &SolverSettings) -> Self {
        let Self::Implicit(settings) = Self::new(solver) else { return Self::Explicit };
        let textbook = |initial| Method::Textbook { initial };
        Self::Implicit(match reference {
            ReferenceScheme::Explicit => return Self::Explicit,
            ReferenceScheme::TextbookMass => {
                Settings { method: textbook(InitialMatrix::Mass), ..settings }
            }
            ReferenceScheme::TextbookDiagonal => {
                Settings { method: textbook(InitialMatrix::Diagonal), ..settings }
            }
            ReferenceScheme::Cholesky => {
                Settings { linear_solver: LinearSolver::Cholesky, ..settings }
            }
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
