use crate::error::Quantity;
use crate::formula::grows_gently;
use crate::incremental::{Halt, first_not_finite};
use crate::solver::Solver;
use crate::step_filter::SystemRef;
use crate::sub_step::{Span, relative};
use crate::tangent::Tangent;
use crate::{Error, Integrator, IntegratorState, Report, Settings, StepFilter, System};

/// Advances the motion of a system in time.
///
/// It holds settings and work space, nothing that the next step depends on: a new stepper gives the same bits.
/// After the first step of a system none allocates memory, unless its sparsity changes or a motion restarts.
#[derive(Debug)]
pub struct Stepper {
    pub(crate) settings: Settings,
    pub(crate) solver: Solver,
    version: u64,
    pub(crate) masses: Vec<f64>,
    pub(crate) held: Vec<bool>,
    /// `m/(β dt)²`, N/m.
    pub(crate) inertia: Vec<f64>,
    /// What the formula makes of past positions and velocities, before any acceleration.
    pub(crate) drift: Vec<f64>,
    pub(crate) momentum: Vec<f64>,
    /// Positions that deviations are counted from.
    pub(crate) base: Vec<f64>,
    /// Velocities at the end of the sub-step.
    pub(crate) velocities: Vec<f64>,
    /// What the last call of [`Self::advance`] took.
    report: Report,
}

impl Stepper {
    /// Prepares to advance a system.
    ///
    /// # Errors
    /// [`Error::Setting`], [`Error::Dimension`], or [`Error::TooLarge`] with the factorising solver.
    pub fn new(system: &dyn System, settings: Settings) -> Result<Self, Error> {
        settings.check()?;
        let solver = solver_for(system, &settings)?;
        let particles = system.particles();
        let zeros = || vec![0.0; 3 * particles];
        Ok(Self {
            settings,
            solver,
            version: system.sparsity_version(),
            masses: vec![0.0; particles],
            held: vec![false; particles],
            inertia: vec![0.0; particles],
            drift: zeros(),
            momentum: zeros(),
            base: zeros(),
            velocities: zeros(),
            report: Report::default(),
        })
    }

    /// The settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// What the last call of [`Self::advance`] took; of one that failed, what was made before.
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// Advances the motion by exactly `dt`, in s, in one step or, where that fails, in halves, quarters …
    ///
    /// # Errors
    /// [`Error::NotConverged`] or [`Error::NotFinite`] if the shortest sub-step allowed fails, and others for
    /// input that no step can be made with. The motion is then at the end of the last sub-step accepted, which
    /// its time tells.
    pub fn advance(
        &mut self,
        system: &mut dyn System,
        state: &mut IntegratorState,
        dt: f64,
    ) -> Result<Report, Error> {
        self.advance_either(SystemRef::Free(system), state, dt)
    }

    /// Does what [`Self::advance`] does, on steps that a filter limits and to solutions that it finds free of
    /// intersections.
    ///
    /// # Errors
    /// Those of [`Self::advance`], and [`Error::UnfilteredMethod`] with the textbook method.
    pub fn advance_filtered(
        &mut self,
        filter: &mut dyn StepFilter,
        state: &mut IntegratorState,
        dt: f64,
    ) -> Result<Report, Error> {
        self.advance_either(SystemRef::Filtered(filter), state, dt)
    }

    fn advance_either(
        &mut self,
        mut system: SystemRef<'_>,
        state: &mut IntegratorState,
        dt: f64,
    ) -> Result<Report, Error> {
        let mut report = Report::default();
        let advanced = self.advance_by_parts((&mut system, state), dt, &mut report);
        self.report.clone_from(&report);
        advanced.map(|()| report)
    }

    fn advance_by_parts(
        &mut self,
        (system, state): (&mut SystemRef<'_>, &mut IntegratorState),
        dt: f64,
        report: &mut Report,
    ) -> Result<(), Error> {
        self.check(system.system(), state, dt)?;
        let origin = state.time;
        let finest = self.settings.max_halvings;
        let whole = 1_u64 << finest;
        let mut halvings = self.first_halvings(state, dt);
        // The position within the step in units of the finest sub-step: exact.
        let mut at = 0;
        while at < whole {
            let end_of = |next: u64| {
                if next == whole { origin + dt } else { origin + dt * (next as f64 / whole as f64) }
            };
            let goes = |halvings: u32| {
                system.is_nearly_straight(state.time, end_of(at + (whole >> halvings)))
            };
            halvings = (halvings..finest).find(|&halvings| goes(halvings)).unwrap_or(finest);
            let next = at + (whole >> halvings);
            let end = end_of(next);
            let span = Span { start: state.time, end, dt: dt / (1_u64 << halvings) as f64 };
            match self.attempt(system, state, span, report) {
                Ok(()) => {
                    report.sub_steps += 1;
                    at = next;
                    // Longer again, but at most by two and on the grid of the longer step.
                    let aligned = finest.saturating_sub(at.trailing_zeros());
                    halvings = aligned.max(halvings.saturating_sub(1));
                }
                Err(Halt::Fatal(error)) => return Err(error),
                Err(halt) => {
                    report.rejected += 1;
                    if halvings == finest {
                        return Err(self.failure(halt, span));
                    }
                    halvings += 1;
                }
            }
        }
        Ok(())
    }

    fn check(
        &mut self,
        system: &dyn System,
        state: &IntegratorState,
        dt: f64,
    ) -> Result<(), Error> {
        if !(dt > 0.0 && dt.is_finite()) {
            return Err(Error::StepLength { dt });
        }
        let particles = self.masses.len();
        let agree = |what, expected, found| {
            if expected == found { Ok(()) } else { Err(Error::Dimension { what, expected, found }) }
        };
        agree("particles", particles, system.particles())?;
        agree("masses", particles, system.masses().len())?;
        agree("held", particles, system.held().len())?;
        agree("positions", 3 * particles, state.positions.len())?;
        agree("velocities", 3 * particles, state.velocities.len())?;
        if let Some(previous) = &state.previous {
            if !(previous.dt > 0.0 && previous.dt.is_finite()) {
                return Err(Error::StepLength { dt: previous.dt });
            }
            agree("previous positions", 3 * particles, previous.positions.len())?;
            agree("previous velocities", 3 * particles, previous.velocities.len())?;
        }
        self.masses.copy_from_slice(system.masses());
        let bad = self.masses.iter().position(|&mass| !(mass > 0.0 && mass.is_finite()));
        if let Some(particle) = bad {
            return Err(Error::Mass { particle, mass: self.masses[particle] });
        }
        let start = [
            (Quantity::Position, Some(&state.positions)),
            (Quantity::Velocity, Some(&state.velocities)),
            (Quantity::Position, state.previous.as_ref().map(|previous| &previous.positions)),
            (Quantity::Velocity, state.previous.as_ref().map(|previous| &previous.velocities)),
        ];
        for (quantity, values) in start {
            if let Some(particle) = values.and_then(|values| first_not_finite(values)) {
                return Err(Error::NotFinite { quantity, particle, time: state.time, dt });
            }
        }
        if system.sparsity_version() != self.version {
            self.solver = solver_for(system, &self.settings)?;
            self.version = system.sparsity_version();
        }
        Ok(())
    }

    /// How often the step is halved from the outset, so that the first sub-step does not grow too much.
    fn first_halvings(&self, state: &IntegratorState, dt: f64) -> u32 {
        let finest = self.settings.max_halvings;
        match (&state.previous, self.settings.integrator) {
            (Some(previous), Integrator::Bdf2) => (0..=finest)
                .find(|&halvings| grows_gently(dt / (1_u64 << halvings) as f64, previous))
                .unwrap_or(finest),
            _ => 0,
        }
    }

    fn failure(&self, halt: Halt, span: Span) -> Error {
        let (time, dt) = (span.start, span.dt);
        match halt {
            Halt::Fatal(error) => error,
            Halt::NotFinite(quantity, particle) => {
                Error::NotFinite { quantity, particle, time, dt }
            }
            Halt::Stop(stop) => {
                let free = self.masses.iter().zip(&self.held).filter(|(_, held)| !**held);
                let squares: f64 = free.map(|(mass, _)| mass * mass).sum();
                let unit = self.settings.acceleration * squares.sqrt();
                Error::NotConverged {
                    time,
                    dt,
                    residual: relative(self.solver.current.norm, unit),
                    tolerance: self.settings.tolerance,
                    iterations: self.solver.iterations,
                    stop,
                }
            }
        }
    }
}

fn solver_for(system: &dyn System, settings: &Settings) -> Result<Solver, Error> {
    let sparsity = system.sparsity();
    let (expected, found) = (system.particles(), sparsity.particles());
    if expected != found {
        return Err(Error::Dimension { what: "sparsity", expected, found });
    }
    Ok(Solver::new(Tangent::new(sparsity, settings)?, settings))
}
