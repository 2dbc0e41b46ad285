use drape_implicit::{
    Error, Explicit, InitialMatrix, Integrator, IntegratorState, LinearSolver, Method, Report,
    Settings, StepFilter, Stepper, System,
};

use crate::file::SceneFile;
use crate::reader::Reader;

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

impl Reader<'_> {
    pub(crate) fn scheme(&mut self, file: &SceneFile) -> Scheme {
        let solver = &file.solver;
        let mut settings = Settings::default();
        let integrators = [
            ("bdf2", Some(Integrator::Bdf2)),
            ("backward-euler", Some(Integrator::BackwardEuler)),
            ("explicit", None),
        ];
        let methods = [
            ("broyden", Method::Broyden),
            ("newton", Method::Newton),
            ("textbook-mass", Method::Textbook { initial: InitialMatrix::Mass }),
            ("textbook-diagonal", Method::Textbook { initial: InitialMatrix::Diagonal }),
        ];
        let linear = [
            ("conjugate-gradient", LinearSolver::ConjugateGradient),
            ("cholesky", LinearSolver::Cholesky),
        ];
        let word = solver.integrator.as_deref();
        let integrator = self.choice("solver.integrator", word, &integrators);
        settings.method = self.choice("solver.method", solver.method.as_deref(), &methods);
        settings.linear_solver = self.choice("solver.linear", solver.linear.as_deref(), &linear);
        if let Some(tolerance) = solver.tolerance {
            let help = "rms acceleration error over g; 1e-4 is usual";
            self.within("solver.tolerance", tolerance, (1e-10, 0.1), help);
            settings.tolerance = tolerance;
        }
        settings.energy_balance = file.output.energy.unwrap_or(true);
        let Some(integrator) = integrator else {
            if file.settle.is_some() || file.time.error.is_some() {
                let help = "leave out [settle] and time.error, or take \"bdf2\"";
                self.fail("solver.integrator", "explicit steps are of one length".into(), help);
            }
            return Scheme::Explicit;
        };
        settings.integrator = integrator;
        Scheme::Implicit(settings)
    }
}
