//! Stepping: the world is carried through time, step by step.
//!
//! [`Stepping`] holds the integrator of the current system. The system is the world or, once a
//! garment is sewn, its reduction to independent degrees of freedom. For each step [`Stepping`]
//! chooses the length (`step_control.rs`), makes the step, estimates its error, and takes the step
//! back if the error is too large. With quasi-static relaxation it also chooses the accuracy of the
//! solution (`accuracy.rs`). Time is counted in ticks. A tick is the first step divided by a power
//! of two, so that sums of steps have no rounding errors.
//!
//! The state of the world holds the positions and velocities of all particles. Every accepted step
//! writes them, and contact, measures and the recorder borrow them. The integrator keeps a second
//! copy for two reasons: its unknowns are the degrees of freedom, which are fewer than the
//! particles once a garment is sewn, and its formula needs the previous step.
//! [`Simulation`](crate::simulation::Simulation) divides a run into phases.

mod accuracy;
mod phase_steps;
mod rest;
pub(crate) mod saved;
mod scheme;
pub(crate) mod statistics;
mod step_control;

use drape_cloth::{SeamBendingState, State};
use drape_collide::SurfaceMemory;
use drape_implicit::{Error, ErrorEstimate, Integrator, IntegratorState, Report};
use drape_scene::{Clock, Relaxation, SeamPairs};

use crate::sewing::reduced_system::ReducedSystem;
use crate::sewing::reduction::Reduction;
use crate::stepping::statistics::Statistics;
use crate::world::{EnergyBalance, World};

use self::accuracy::{Accuracy, PhaseScheme, relaxation_scheme};
use self::scheme::TimeStepper;
use self::step_control::StepControl;

pub(crate) use self::phase_steps::PhaseSteps;
pub(crate) use self::rest::{RestDetector, StepMotion};
pub use self::scheme::{ReferenceScheme, Scheme};

/// Integration of a world in time.
#[derive(Debug)]
pub(crate) struct Stepping {
    /// Scheme that the simulation asks for.
    scheme: Scheme,
    /// Accuracy of the current steps.
    accuracy: Accuracy,
    stepper: TimeStepper,
    /// Degrees of freedom, with their previous step.
    state: IntegratorState,
    /// Reduction to the independent degrees of freedom, once the garment is sewn.
    reduction: Option<Reduction>,
    estimate: ErrorEstimate,
    control: StepControl,
    clock: Clock,
    /// Current time, in ticks of the clock.
    ticks: usize,
}

/// Step that was accepted.
#[derive(Debug)]
pub(crate) struct AcceptedStep {
    pub(crate) ticks: usize,
    pub(crate) report: Report,
}

/// State of a world and its integrator at the start of a step that may be taken back.
struct StepStart {
    integrator: IntegratorState,
    cloth: State,
    balance: Option<EnergyBalance>,
    surfaces: Option<SurfaceMemory>,
    seams: Option<SeamBendingState>,
}

impl Stepping {
    /// Prepares the integration of `world` from its state by `scheme`, with the steps of `phase`.
    ///
    /// # Errors
    ///
    /// Returns an error if the solver cannot be set up.
    pub(crate) fn new(
        world: &World,
        scheme: Scheme,
        clock: Clock,
        phase: PhaseSteps,
    ) -> Result<Self, Error> {
        let PhaseScheme { scheme: phase_scheme, accuracy } =
            PhaseScheme::new(&scheme, phase.accuracy);
        Ok(Self {
            accuracy,
            stepper: TimeStepper::new(&phase_scheme, world)?,
            state: IntegratorState::new(
                world.state.positions.clone(),
                world.state.velocities.clone(),
            ),
            reduction: None,
            estimate: ErrorEstimate::new(world.cloth.particle_count()),
            control: StepControl::new(clock, phase.relaxation, scheme.order()),
            clock,
            ticks: 0,
            scheme,
        })
    }

    /// Returns the clock of the steps.
    pub(crate) fn clock(&self) -> &Clock {
        &self.clock
    }

    /// Returns the current time, in ticks of the clock.
    pub(crate) fn ticks(&self) -> usize {
        self.ticks
    }

    /// Returns the current time, in s.
    pub(crate) fn time(&self) -> f64 {
        self.ticks as f64 * self.clock.tick()
    }

    /// Returns the length of the next step, in s. The estimate of its error may still shorten this
    /// step.
    pub(crate) fn next_step(&self) -> f64 {
        self.control.next(self.ticks) as f64 * self.clock.tick()
    }

    /// Sets the current time to `ticks` of the clock.
    pub(crate) fn start_at(&mut self, ticks: usize) {
        self.ticks = ticks;
        self.state.time = self.time();
    }

    /// Ends the run after another `seconds`, with steps that are at most as long as the first step.
    pub(crate) fn end_after(&mut self, seconds: f64) {
        self.clock.end = self.time() + seconds;
        self.clock.ticks_max = self.clock.ticks_per_step;
    }

    /// Reduces `world` to its independent degrees of freedom, with the seams `pairs` merged, from
    /// now on.
    pub(crate) fn reduce(&mut self, world: &World, pairs: &SeamPairs) -> Result<(), Error> {
        self.reduction = Some(Reduction::new(world, pairs)?);
        Ok(())
    }

    /// Continues from rest at the positions of `world`, with the steps of `phase`.
    pub(crate) fn restart(&mut self, world: &mut World, phase: PhaseSteps) -> Result<(), Error> {
        let positions = match &self.reduction {
            Some(reduction) => reduction.restrict(&world.state.positions),
            None => world.state.positions.clone(),
        };
        self.state =
            IntegratorState { time: self.state.time, ..IntegratorState::at_rest(positions) };
        let PhaseScheme { scheme, accuracy } = PhaseScheme::new(&self.scheme, phase.accuracy);
        self.set_up(world, &scheme)?;
        self.accuracy = accuracy;
        self.control = StepControl::new(self.clock, phase.relaxation, self.scheme.order());
        Ok(())
    }

    /// Stops `particles` of `world`, with the particles that are sewn to them. The next step has no
    /// previous step.
    pub(crate) fn stop(&mut self, world: &mut World, particles: &[usize]) {
        for &particle in particles {
            let reduction = self.reduction.as_ref();
            let index = reduction.map_or(particle, |sewn| sewn.independent_particle(particle));
            self.state.velocities[3 * index..][..3].fill(0.0);
        }
        self.state.restart();
        match &self.reduction {
            Some(reduction) => {
                reduction.prolong(&self.state.velocities, &mut world.state.velocities);
            }
            None => world.state.velocities.copy_from_slice(&self.state.velocities),
        }
    }

    /// Makes one step of `world` with the length that step control chooses. Counts rejected steps
    /// in `statistics`.
    ///
    /// # Errors
    ///
    /// Returns an error if the step cannot be solved even in parts.
    pub(crate) fn advance(
        &mut self,
        world: &mut World,
        statistics: &mut Statistics,
    ) -> Result<AcceptedStep, Error> {
        // The clock counts ticks, because a sum of step lengths has rounding errors.
        self.state.time = self.time();
        if world.relaxes() {
            self.state.restart();
        }

        loop {
            let ticks = self.control.next(self.ticks);
            let dt = ticks as f64 * self.clock.tick();
            if self.control.error().is_none() {
                let report = self.integrate(world, dt)?;
                self.ticks += ticks;
                return Ok(AcceptedStep { ticks, report });
            }

            // A step whose error is too large is repeated from its start.
            let start = self.step_start(world);
            self.predict(world, dt)?;
            let report = self.integrate(world, dt)?;
            let error = self.estimate_error();
            if self.control.adapt_to_error(self.ticks, ticks, error) {
                statistics.note_error(error);
                self.ticks += ticks;
                return Ok(AcceptedStep { ticks, report });
            }
            self.take_back(world, start);
            statistics.add_inexact(&report);
        }
    }

    /// Adapts the length of the next step to a step of `ticks` in which no particle moved farther
    /// than `displacement`, in m.
    pub(crate) fn adapt_to_displacement(&mut self, ticks: usize, displacement: f64) {
        self.control.adapt_to_displacement(ticks, displacement);
    }

    /// Returns the root-mean-square acceleration of the free particles of `world` in the last step,
    /// in m/s². The step has the length `dt`, in s. A step of quasi-static relaxation starts from
    /// rest.
    pub(crate) fn acceleration(&self, world: &World, dt: f64) -> f64 {
        let Some(previous) = &self.state.previous else { return 0.0 };
        // A step may have been made in parts. The length of the last part is in `previous`.
        let dt = if previous.dt < dt { previous.dt } else { dt };
        let kept = if world.relaxes() { 0.0 } else { 1.0 };

        let (mut squares, mut free_count) = (0.0, 0_usize);
        let velocities = world.state.velocities.chunks_exact(3).zip(world.held());
        for (particle, (now, _)) in velocities.enumerate().filter(|(_, (_, held))| !**held) {
            let before = match &self.reduction {
                None => [0, 1, 2].map(|axis| previous.velocities[3 * particle + axis]),
                Some(reduction) => reduction.value_of(particle, &previous.velocities),
            };
            let change = [0, 1, 2].map(|axis| now[axis] - kept * before[axis]);
            squares += change.map(|change| change * change).iter().sum::<f64>();
            free_count += 1;
        }
        (squares / free_count.max(1) as f64).sqrt() / dt
    }

    /// Solves the next steps of quasi-static relaxation of `world` more accurately the nearer the
    /// cloth is to `rest`. `imbalance` is the imbalance of the last step over g. Returns whether
    /// the last step was accurate enough for the cloth to count as at rest.
    pub(crate) fn refine(
        &mut self,
        world: &mut World,
        rest: &Relaxation,
        imbalance: f64,
    ) -> Result<bool, Error> {
        let Scheme::Implicit(settings) = &self.scheme else { return Ok(true) };
        if !world.relaxes() {
            return Ok(true);
        }

        let suffices = self.accuracy.suffices(settings, rest);
        let wanted = self.accuracy.refined(settings, rest, imbalance);
        if wanted != self.accuracy {
            let scheme = relaxation_scheme(settings, wanted);
            self.accuracy = wanted;
            self.set_up(world, &scheme)?;
        }
        Ok(suffices)
    }

    /// Sets up `scheme` for the current system.
    fn set_up(&mut self, world: &mut World, scheme: &Scheme) -> Result<(), Error> {
        self.stepper = match &mut self.reduction {
            Some(reduction) => TimeStepper::new(scheme, &ReducedSystem { world, reduction })?,
            None => TimeStepper::new(scheme, world)?,
        };
        Ok(())
    }

    /// Advances the system by a step of the length `dt`, in s.
    fn integrate(&mut self, world: &mut World, dt: f64) -> Result<Report, Error> {
        let Self { stepper, state, reduction, .. } = self;

        let is_filtered = world.contact.surfaces().is_some();
        let result = match (reduction, is_filtered) {
            (None, false) => stepper.advance(world, state, dt),
            (None, true) => stepper.advance_filtered(world, state, dt),
            (Some(reduction), false) => {
                stepper.advance(&mut ReducedSystem { world, reduction }, state, dt)
            }
            (Some(reduction), true) => {
                stepper.advance_filtered(&mut ReducedSystem { world, reduction }, state, dt)
            }
        };

        // A step that failed has accepted parts, which belong to the energy balance.
        let relaxes = world.relaxes();
        if result.is_err()
            && let (Some(balance), Some(report)) = (&mut world.balance, self.stepper.unfinished())
        {
            balance.add_report(report, relaxes);
        }
        result
    }

    /// Predicts the end of a step of the length `dt`, in s, for the estimate of its error.
    fn predict(&mut self, world: &World, dt: f64) -> Result<(), Error> {
        let integrator = match &self.scheme {
            Scheme::Implicit(settings) if !world.relaxes() => settings.integrator,
            _ => Integrator::BackwardEuler,
        };
        match &self.reduction {
            Some(reduction) => {
                self.estimate.predict(&reduction.prolonged(&self.state), integrator, dt)
            }
            None => self.estimate.predict(&self.state, integrator, dt),
        }
    }

    /// Returns the estimated error of the last step, in m, over all particles of the panels.
    fn estimate_error(&mut self) -> f64 {
        match &self.reduction {
            Some(reduction) => self.estimate.estimate(&reduction.prolonged(&self.state)),
            None => self.estimate.estimate(&self.state),
        }
    }

    /// Returns the current state of `world` and its integrator.
    fn step_start(&self, world: &World) -> StepStart {
        StepStart {
            integrator: self.state.clone(),
            cloth: world.state.clone(),
            balance: world.balance.clone(),
            surfaces: world.contact.surfaces().map(|surfaces| surfaces.contact.state().memory()),
            seams: world.internal.seam_state().cloned(),
        }
    }

    /// Restores the state `start` of `world` and its integrator.
    fn take_back(&mut self, world: &mut World, start: StepStart) {
        self.state = start.integrator;
        world.state = start.cloth;
        world.balance = start.balance;
        world.internal.restore_seams(start.seams);
        if let (Some(surfaces), Some(memory)) = (world.contact.surfaces_mut(), start.surfaces) {
            surfaces.contact.restore(&memory).expect("the memory is of this contact");
        }
    }
}
