use drape_implicit::{
    Error, Explicit, InitialMatrix, Integrator, IntegratorState, LinearSolver, Method, Report,
    Settings, StepFilter, Stepper, System,
};
use drape_scene::Scene;

/// How a scene is carried through time.
#[derive(Debug, Clone, PartialEq)]
pub enum Scheme {
    /// Implicit steps, with the settings of their solver.
    Implicit(Settings),
    /// Many small explicit steps in each: a cross-check, not a way to get results.
    Explicit,
}

/// A scheme at work on one system.
#[derive(Debug)]
pub(crate) enum Integration {
    Implicit(Box<Stepper>),
    Explicit(Box<Explicit>),
}

impl Scheme {
    /// The scheme that a scene asks for.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let solver = scene.solver;
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
            energy_balance: scene.energy,
            ..Settings::default()
        })
    }

    pub(crate) fn start(&self, system: &dyn System) -> Result<Integration, Error> {
        Ok(match self {
            Self::Implicit(settings) => {
                Integration::Implicit(Box::new(Stepper::new(system, settings.clone())?))
            }
            Self::Explicit => Integration::Explicit(Box::new(Explicit::new(system))),
        })
    }
}

impl Integration {
    pub(crate) fn advance(
        &mut self,
        system: &mut dyn System,
        motion: &mut IntegratorState,
        dt: f64,
    ) -> Result<Report, Error> {
        match self {
            Self::Implicit(stepper) => stepper.advance(system, motion, dt),
            Self::Explicit(explicit) => explicit.advance(system, motion, dt),
        }
    }

    /// The same on steps that a filter limits.
    pub(crate) fn advance_filtered(
        &mut self,
        filter: &mut dyn StepFilter,
        motion: &mut IntegratorState,
        dt: f64,
    ) -> Result<Report, Error> {
        match self {
            Self::Implicit(stepper) => stepper.advance_filtered(filter, motion, dt),
            Self::Explicit(_) => Err(Error::UnfilteredMethod),
        }
    }
}

impl Integration {
    /// What was made of a step that failed.
    pub(crate) fn unfinished(&self) -> Option<&Report> {
        match self {
            Self::Implicit(stepper) => Some(stepper.report()),
            Self::Explicit(_) => None,
        }
    }
}
