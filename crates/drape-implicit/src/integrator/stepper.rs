//! Stepper: checks the input, divides a step into sub-steps and attempts each sub-step.

use super::state::{IntegratorState, Span, check_particles};
use super::step_control::StepControl;
use super::sub_step::SubStepper;
use crate::check::{check_length, check_step};
use crate::error::{Error, Quantity};
use crate::linear::system_matrix::SystemMatrix;
use crate::linear::vector::first_not_finite;
use crate::nonlinear::halt::Halt;
use crate::nonlinear::solver::NonlinearSolver;
use crate::report::Report;
use crate::settings::Settings;
use crate::step_filter::{StepFilter, SystemRef};
use crate::system::{MaterialPoint, System};

/// Integrator that advances the state of a system in time.
///
/// A stepper holds settings and work space, but no result that the next step depends on: a new
/// stepper computes equal bits. Only the first step of a system allocates memory, and a step after
/// a change of the sparsity or a restart of the state.
///
/// A particle that falls freely for a second, by backward Euler in ten steps:
///
/// ```
/// use drape_implicit::{
///     BlockMatrix, Integrator, IntegratorState, Settings, Sparsity, Stepper, Stiffness, System,
/// };
///
/// struct Stone;
///
/// impl System for Stone {
///     fn particle_count(&self) -> usize { 1 }
///     fn masses(&self) -> &[f64] { &[0.5] }
///     fn held(&self) -> &[bool] { &[false] }
///     fn begin(&mut self, _end: f64, _dt: f64, _start: &[f64], _target: &mut [f64]) {}
///     fn forces(&mut self, _x: &[f64], forces: &mut [f64]) {
///         forces.copy_from_slice(&[0.0, -0.5 * 9.81, 0.0]);
///     }
///     fn potential(&mut self, x: &[f64]) -> f64 { 0.5 * 9.81 * x[1] }
///     fn stiffness(&mut self, _x: &[f64], _kind: Stiffness, _matrix: &mut BlockMatrix) {}
///     fn sparsity(&self) -> Sparsity {
///         Sparsity::from_pairs(1, []).expect("no pairs, no mistake")
///     }
///     fn accept(&mut self, _x: &[f64], _v: &[f64], _dt: f64) {}
/// }
///
/// let settings = Settings { integrator: Integrator::BackwardEuler, ..Settings::default() };
/// let mut stepper = Stepper::new(&Stone, settings)?;
/// let mut state = IntegratorState::at_rest(vec![0.0; 3]);
/// for _ in 0..10 {
///     stepper.advance(&mut Stone, &mut state, 0.1)?;
/// }
/// // Backward Euler: g dt² (1 + 2 + … + 10).
/// assert!((state.positions[1] + 9.81 * 0.01 * 55.0).abs() < 1e-12);
/// # Ok::<(), drape_implicit::Error>(())
/// ```
#[derive(Debug)]
pub struct Stepper {
    sub_stepper: SubStepper,
    sparsity_version: u64,
    /// Report of the last call.
    report: Report,
}

impl Stepper {
    /// Checks `settings` and allocates a stepper for `system`.
    ///
    /// # Errors
    /// [`Error::Setting`], [`Error::Dimension`], [`Error::MaterialPoint`], or, with the Cholesky
    /// solver, [`Error::TooLarge`] and [`Error::WithoutCholesky`].
    pub fn new(system: &dyn System, settings: Settings) -> Result<Self, Error> {
        settings.check()?;
        let solver = solver_for(system, &settings)?;
        Ok(Self {
            sub_stepper: SubStepper::new(system.particle_count(), solver, settings),
            sparsity_version: system.sparsity_version(),
            report: Report::default(),
        })
    }

    /// Settings of the stepper.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.sub_stepper.settings
    }

    /// Report of the last call of [`Self::advance`] or [`Self::advance_filtered`]. After a failed
    /// call the report counts the work before the failure.
    #[must_use]
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// Advances `state` by exactly `dt`, in s, in one step. If the step fails, it is divided into
    /// halves, quarters and so on.
    ///
    /// # Errors
    /// [`Error::NotConverged`] or [`Error::NotFinite`] if the shortest sub-step allowed fails.
    /// Other variants for inadmissible input. The state is then at the end of the last accepted
    /// sub-step, at `state.time`.
    pub fn advance(
        &mut self,
        system: &mut dyn System,
        state: &mut IntegratorState,
        dt: f64,
    ) -> Result<Report, Error> {
        self.advance_either(SystemRef::Free(system), state, dt)
    }

    /// Advances `state` by exactly `dt`, in s, as [`Self::advance`] does. `filter` limits every
    /// step of the iteration and tests every solution.
    ///
    /// # Errors
    /// The errors of [`Self::advance`], and [`Error::UnfilteredMethod`] with the textbook method.
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
        let advanced = self.take_sub_steps(&mut system, state, dt, &mut report);
        self.report.clone_from(&report);
        advanced.map(|()| report)
    }

    fn take_sub_steps(
        &mut self,
        system: &mut SystemRef<'_>,
        state: &mut IntegratorState,
        dt: f64,
        report: &mut Report,
    ) -> Result<(), Error> {
        self.check(system.system(), state, dt)?;
        let mut control = StepControl::new(self.settings(), state, dt);

        while !control.is_finished() {
            let span = control.next(state.time, |start, end| system.resolves_motion(start, end));
            match self.sub_stepper.attempt(system, state, span, report) {
                Ok(()) => {
                    report.sub_steps += 1;
                    control.accept();
                }
                Err(Halt::Fatal(error)) => return Err(error),
                Err(halt) => {
                    report.rejected += 1;
                    if !control.halve() {
                        return Err(self.failure(halt, span));
                    }
                }
            }
        }
        Ok(())
    }

    /// Checks `system`, `state` and the step length `dt`, in s. Reads the masses and, after a
    /// change of version, the sparsity.
    fn check(
        &mut self,
        system: &dyn System,
        state: &IntegratorState,
        dt: f64,
    ) -> Result<(), Error> {
        let particles = self.sub_stepper.masses.len();
        check_step(dt)?;
        check_particles(system, particles)?;
        state.check(particles)?;

        self.sub_stepper.masses.copy_from_slice(system.masses());

        let previous = state.previous.as_ref();
        let start = [
            (Quantity::Position, Some(&state.positions)),
            (Quantity::Velocity, Some(&state.velocities)),
            (Quantity::Position, previous.map(|previous| &previous.positions)),
            (Quantity::Velocity, previous.map(|previous| &previous.velocities)),
        ];
        for (quantity, values) in start {
            if let Some(particle) = values.and_then(|values| first_not_finite(values)) {
                return Err(Error::NotFinite { quantity, particle, time: state.time, dt });
            }
        }

        if system.sparsity_version() != self.sparsity_version {
            self.sub_stepper.solver = solver_for(system, self.settings())?;
            self.sparsity_version = system.sparsity_version();
        }
        Ok(())
    }

    /// Returns the error of the sub-step `span`, which ended with `halt` at the shortest length.
    fn failure(&self, halt: Halt, span: Span) -> Error {
        let Span { start: time, dt, .. } = span;
        match halt {
            Halt::Fatal(error) => error,
            Halt::NotFinite { quantity, particle } => {
                Error::NotFinite { quantity, particle, time, dt }
            }
            Halt::Stop(stop) => Error::NotConverged {
                time,
                dt,
                residual: self.sub_stepper.relative_residual(),
                tolerance: self.settings().tolerance,
                iterations: self.sub_stepper.solver.search.iterations,
                stop,
            },
        }
    }
}

/// Returns a nonlinear solver for the sparsity and the material points of `system`.
fn solver_for(system: &dyn System, settings: &Settings) -> Result<NonlinearSolver, Error> {
    let sparsity = system.sparsity();
    let points = system.material_points();
    check_length("sparsity", system.particle_count(), sparsity.particle_count())?;
    if !points.is_empty() {
        check_length("material points", system.particle_count(), points.len())?;
    }
    let is_point = |point: &MaterialPoint| {
        let [u, v] = point.coordinates;
        u.is_finite() && v.is_finite() && point.spacing > 0.0 && point.spacing.is_finite()
    };
    if let Some(particle) = points.iter().position(|point| !is_point(point)) {
        return Err(Error::MaterialPoint { particle });
    }
    Ok(NonlinearSolver::new(SystemMatrix::new(sparsity, points, settings)?, settings))
}
