//! Stepping: the world is carried through time, step by step.
//!
//! [`Stepping`] holds the integrator of the system that is solved now, which is the world or, once
//! a garment is sewn, its reduction to independent degrees of freedom. It chooses the length of
//! each step (`step_control.rs`), makes it, estimates its error, and takes it back where that is
//! too large; with quasi-static relaxation it also chooses how well a step is solved
//! (`accuracy.rs`). Time is counted in ticks, each the first step divided by a power of two, so
//! that sums do not drift.
//!
//! The state of the world owns the positions and velocities of the particles: every accepted step
//! writes them, and contact, measures and the recorder borrow them. The integrator keeps a second
//! copy for a numerical reason: its unknowns are the degrees of freedom, fewer than the particles
//! once a garment is sewn, and its formula needs those of the step before.
//! Phases of a run are the business of [`Simulation`](crate::simulation::Simulation).

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
pub use self::scheme::Scheme;

/// Integration of a world in time.
#[derive(Debug)]
pub(crate) struct Stepping {
    /// Scheme that the simulation asks for.
    scheme: Scheme,
    /// Accuracy of the steps that are made now.
    accuracy: Accuracy,
    stepper: TimeStepper,
    /// Degrees of freedom that are solved for, with their past.
    state: IntegratorState,
    /// Reduction of the world to its independent degrees of freedom, once it is sewn.
    reduction: Option<Reduction>,
    estimate: ErrorEstimate,
    control: StepControl,
    clock: Clock,
    /// Time so far, in ticks of the clock.
    ticks: usize,
}

/// Step that has been made.
#[derive(Debug)]
pub(crate) struct MadeStep {
    pub(crate) ticks: usize,
    pub(crate) report: Report,
}

/// State of a world and its integrator, to which a step may be taken back.
struct StepStart {
    integrator: IntegratorState,
    cloth: State,
    balance: Option<EnergyBalance>,
    surfaces: Option<SurfaceMemory>,
    seams: Option<SeamBendingState>,
}

impl Stepping {
    /// Sets up the integration of a world from its state.
    pub(crate) fn new(
        world: &World,
        scheme: Scheme,
        clock: Clock,
        phase: PhaseSteps,
    ) -> Result<Self, Error> {
        let PhaseScheme { scheme: own, accuracy } = PhaseScheme::new(&scheme, phase.accuracy);
        Ok(Self {
            accuracy,
            stepper: TimeStepper::new(&own, world)?,
            state: IntegratorState::new(
                world.state.positions.clone(),
                world.state.velocities.clone(),
            ),
            reduction: None,
            estimate: ErrorEstimate::new(world.cloth.particles()),
            control: StepControl::new(clock, phase.relaxation, scheme.order()),
            clock,
            ticks: 0,
            scheme,
        })
    }

    /// Clock of the steps.
    pub(crate) fn clock(&self) -> &Clock {
        &self.clock
    }

    /// Time so far, in ticks of the clock.
    pub(crate) fn ticks(&self) -> usize {
        self.ticks
    }

    /// Time so far, in s.
    pub(crate) fn time(&self) -> f64 {
        self.ticks as f64 * self.clock.tick()
    }

    /// Length of the next step, in s, unless its error makes it shorter.
    pub(crate) fn next_step(&self) -> f64 {
        self.control.next(self.ticks) as f64 * self.clock.tick()
    }

    /// Lets the clock begin at a time, in ticks.
    pub(crate) fn start_at(&mut self, ticks: usize) {
        self.ticks = ticks;
        self.state.time = self.time();
    }

    /// Lets the run end after so many more seconds of steps that are not longer than the first.
    pub(crate) fn end_after(&mut self, seconds: f64) {
        self.clock.end = self.time() + seconds;
        self.clock.ticks_max = self.clock.ticks_per_step;
    }

    /// Reduces the world to its independent degrees of freedom from now on.
    pub(crate) fn reduce(&mut self, world: &World, pairs: &SeamPairs) -> Result<(), Error> {
        self.reduction = Some(Reduction::new(world, pairs)?);
        Ok(())
    }

    /// Goes on from rest at the positions of the world, with the steps of another phase.
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

    /// Makes one step, as long as it may be.
    pub(crate) fn advance(
        &mut self,
        world: &mut World,
        statistics: &mut Statistics,
    ) -> Result<MadeStep, Error> {
        // The clock counts ticks; a sum of lengths would drift.
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
                return Ok(MadeStep { ticks, report });
            }
            let start = self.step_start(world);
            self.predict(world, dt);
            let report = self.integrate(world, dt)?;
            let error = self.estimate_error();
            if self.control.adapt_to_error(self.ticks, ticks, error) {
                statistics.note_error(error);
                self.ticks += ticks;
                return Ok(MadeStep { ticks, report });
            }
            self.take_back(world, start);
            statistics.add_inexact(&report);
        }
    }

    /// Adapts the length of the next step to one in which no particle moved farther than a
    /// distance, in m.
    pub(crate) fn adapt_to_displacement(&mut self, ticks: usize, moved: f64) {
        self.control.adapt_to_displacement(ticks, moved);
    }

    /// Root-mean-square acceleration of the free particles in the last step, in m/s², of a length,
    /// in s. A step of quasi-static relaxation began at rest.
    pub(crate) fn acceleration(&self, world: &World, dt: f64) -> f64 {
        let Some(previous) = &self.state.previous else { return 0.0 };
        // The step may have been made in parts; the last one is as long as it says.
        let dt = if previous.dt < dt { previous.dt } else { dt };
        let kept = if world.relaxes() { 0.0 } else { 1.0 };
        let (mut squares, mut free) = (0.0, 0_usize);
        let mut add = |now: &[f64], before: &[f64]| {
            let change = [0, 1, 2].map(|axis| now[axis] - kept * before[axis]);
            squares += change.map(|change| change * change).iter().sum::<f64>();
            free += 1;
        };
        let now = world.state.velocities.chunks_exact(3).zip(world.held());
        match &self.reduction {
            None => {
                let pairs = now.zip(previous.velocities.chunks_exact(3));
                for ((now, _), before) in pairs.filter(|((_, held), _)| !**held) {
                    add(now, before);
                }
            }
            Some(reduction) => {
                for (particle, (now, _)) in now.enumerate().filter(|(_, (_, held))| !**held) {
                    add(now, &reduction.value_of(particle, &previous.velocities));
                }
            }
        }
        (squares / free.max(1) as f64).sqrt() / dt
    }

    /// Solves the next steps of quasi-static relaxation the better the nearer the cloth is to rest.
    /// Returns whether the last one was solved so well that the cloth may count as at rest.
    pub(crate) fn refine(
        &mut self,
        world: &mut World,
        rest: &Relaxation,
        imbalance: f64,
    ) -> Result<bool, Error> {
        let (true, Scheme::Implicit(settings)) = (world.relaxes(), &self.scheme) else {
            return Ok(true);
        };
        let suffices = self.accuracy.suffices(settings, rest);
        let wanted = self.accuracy.refined(settings, rest, imbalance);
        if wanted != self.accuracy {
            let scheme = relaxation_scheme(settings, wanted);
            self.accuracy = wanted;
            self.set_up(world, &scheme)?;
        }
        Ok(suffices)
    }

    /// Sets up a scheme for the system that is solved now.
    fn set_up(&mut self, world: &mut World, scheme: &Scheme) -> Result<(), Error> {
        self.stepper = match &mut self.reduction {
            Some(reduction) => TimeStepper::new(scheme, &ReducedSystem { world, reduction })?,
            None => TimeStepper::new(scheme, world)?,
        };
        Ok(())
    }

    /// Advances the system by a step of a length, in s.
    fn integrate(&mut self, world: &mut World, dt: f64) -> Result<Report, Error> {
        let Self { stepper, state, reduction, .. } = self;
        let filtered = world.contact.surfaces().is_some();
        let result = match (reduction, filtered) {
            (None, false) => stepper.advance(world, state, dt),
            (None, true) => stepper.advance_filtered(world, state, dt),
            (Some(reduction), false) => {
                stepper.advance(&mut ReducedSystem { world, reduction }, state, dt)
            }
            (Some(reduction), true) => {
                stepper.advance_filtered(&mut ReducedSystem { world, reduction }, state, dt)
            }
        };
        let made = match &result {
            Ok(_) => None,
            // A step that failed has moved on by the parts that were made.
            Err(_) => self.stepper.unfinished(),
        };
        if let (Some(balance), Some(made)) = (&mut world.balance, made) {
            balance.add_report(made);
        }
        result
    }

    /// Predicts the end of a step of a length, in s, for the estimate of its error.
    fn predict(&mut self, world: &World, dt: f64) {
        let integrator = match &self.scheme {
            Scheme::Implicit(settings) if !world.relaxes() => settings.integrator,
            _ => Integrator::BackwardEuler,
        };
        match &self.reduction {
            Some(reduction) => {
                self.estimate.predict(&reduction.prolonged(&self.state), integrator, dt);
            }
            None => self.estimate.predict(&self.state, integrator, dt),
        }
    }

    /// Error of the step that has been made, in m: that of all particles of the panels.
    fn estimate_error(&mut self) -> f64 {
        match &self.reduction {
            Some(reduction) => self.estimate.estimate(&reduction.prolonged(&self.state)),
            None => self.estimate.estimate(&self.state),
        }
    }

    fn step_start(&self, world: &World) -> StepStart {
        StepStart {
            integrator: self.state.clone(),
            cloth: world.state.clone(),
            balance: world.balance.clone(),
            surfaces: world.contact.surfaces().map(|surfaces| surfaces.contact.memory()),
            seams: world.internal.seam_state().cloned(),
        }
    }

    fn take_back(&mut self, world: &mut World, start: StepStart) {
        self.state = start.integrator;
        world.state = start.cloth;
        world.balance = start.balance;
        world.internal.restore_seams(start.seams);
        if let (Some(surfaces), Some(memory)) = (world.contact.surfaces_mut(), start.surfaces) {
            surfaces.contact.restore(&memory);
        }
    }
}
