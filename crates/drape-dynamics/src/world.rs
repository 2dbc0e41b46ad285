//! World: cloth, bodies, gravity and air as one mechanical system.
//!
//! A [`World`] is made of a checked scene and is what the solver moves. It implements
//! [`drape_implicit::System`] and, on top of it, [`drape_implicit::StepFilter`] (`system.rs`), and
//! so joins `drape-cloth` and `drape-collide` with `drape-implicit`. The forces on its particles
//! are
//!
//! ```math
//! f = M g + f_\text{internal} + f_\text{springs} + f_\text{air} + f_\text{contact} + f_\text{external}
//! ```
//!
//! and each term has a file of its own here, with its force, potential and stiffness.
//!
//! Evaluations of a trial leave the state as it is. Only an accepted step changes positions,
//! velocities and the memory of friction, and enters the balance of energy. The chapter knows
//! neither phases nor lengths of steps: `stepping` asks for steps, and `sewing` puts fewer degrees
//! of freedom in front of it.

mod air_drag;
pub(crate) mod closing_springs;
mod constant_forces;
mod contact;
mod energy_balance;
mod gravity;
mod internal_forces;
mod momentum_removal;
mod motion_clock;
mod pins;
pub(crate) mod saved;
mod system;
#[cfg(test)]
pub(crate) mod world_tests;

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use drape_cloth::{Cloth, SeamBending, State};
use drape_collide::SewnPlacement;
use drape_implicit::System;
use drape_scene::{HoldUntil, RigidMotion, Scene, Sewing};

use crate::error::Error;
use crate::world::closing_springs::ClosingSprings;

use self::air_drag::AirDrag;
use self::constant_forces::ConstantForces;
use self::gravity::Gravity;
use self::internal_forces::InternalForces;
use self::momentum_removal::MomentumRemoval;
use self::motion_clock::MotionClock;
use self::pins::{LoadTimes, Pins};

#[cfg(test)]
pub(crate) use self::contact::Omitted;
pub(crate) use self::contact::{ALL_PARTICLES, ClosestPlace, Contact, PlacedSurfaces};
pub use self::energy_balance::Energy;
pub(crate) use self::energy_balance::EnergyBalance;
pub use self::pins::PinLoad;

/// Cloth, bodies, gravity and air.
#[derive(Debug)]
pub(crate) struct World {
    /// Cloth. It changes once, when a garment is sewn.
    pub(crate) cloth: Cloth,
    /// Positions, velocities and memory of the cloth.
    pub(crate) state: State,
    pub(crate) internal: InternalForces,
    pub(crate) contact: Contact,
    gravity: Gravity,
    air: AirDrag,
    /// Forces that a program sets between steps.
    pub(crate) external: ConstantForces,
    momentum: MomentumRemoval,
    pins: Pins,
    clock: MotionClock,
    seams: Seams,
    /// Energy balance, if the scene asks for it. `None` while a garment is sewn.
    pub(crate) balance: Option<EnergyBalance>,
    /// Whether the scene asks for an energy balance.
    with_balance: bool,
    /// Flag that cancels the current step.
    pub(crate) cancel: Option<Arc<AtomicBool>>,
}

/// Seams while a garment is sewn.
#[derive(Debug)]
struct Seams {
    /// Closing springs, until the seams are merged.
    springs: Option<ClosingSprings>,
    /// Cloth with merged seams, until it replaces the cloth of the panels.
    sewn: Option<SewnCloth>,
}

/// Cloth with closed seams.
#[derive(Debug)]
struct SewnCloth {
    /// Cloth with the friction of its fabrics.
    cloth: Cloth,
    /// Bending across the seams.
    bending: SeamBending,
}

impl World {
    /// Returns the world of the checked `scene`, at its start.
    ///
    /// # Errors
    ///
    /// Returns an error if contact cannot be set up for `scene`, or if its cloth does not fit it.
    pub(crate) fn new(scene: Scene) -> Result<Self, Error> {
        let contact = Contact::new(&scene)?;
        let held = scene.held_particles();
        let moves_at_once = scene.schedule.motion_seconds.is_none();
        let Scene { mut cloth, breen, start, pins, environment, sewing, schedule, .. } = scene;
        let seams = match sewing {
            // The panels are drawn together without friction. The cloth with friction follows.
            Some(Sewing { pairs, cloth: sewing_cloth, seconds, bending, .. }) => {
                let springs = ClosingSprings::new(&pairs, &start.positions, seconds);
                let cloth = std::mem::replace(&mut cloth, sewing_cloth);
                Seams { springs: Some(springs), sewn: Some(SewnCloth { cloth, bending }) }
            }
            None => Seams { springs: None, sewn: None },
        };

        let mut state = cloth.state(start.positions)?;
        state.velocities = start.velocities;
        let coupled = seams.springs.as_ref().map_or_else(Vec::new, ClosingSprings::coupled_pairs);
        let mut internal = InternalForces::new(&cloth, breen, &coupled, &state.positions)?;
        let stored = internal.stored(&cloth, &state)?;

        let with_balance = scene.solver.energy_balance;
        let is_sewing = seams.springs.is_some();
        let mut world = Self {
            air: AirDrag::new(environment.air, cloth.particle_count()),
            cloth,
            state,
            internal,
            contact,
            gravity: Gravity::new(environment.gravity, schedule.clock.ramp),
            external: ConstantForces::default(),
            momentum: MomentumRemoval::default(),
            pins: Pins::new(pins, held),
            clock: if moves_at_once { MotionClock::running() } else { MotionClock::stopped() },
            seams,
            balance: None,
            with_balance,
            cancel: None,
        };

        world.set_relaxing(
            is_sewing || schedule.relaxation.is_some_and(|relaxation| !relaxation.inertia),
        );

        // The balance of a garment starts when its seams are merged.
        if with_balance && !is_sewing {
            world.balance = Some(EnergyBalance::new(stored, world.kinetic_energy()));
        }
        Ok(world)
    }

    /// Sets whether each step starts from rest, as in quasi-static relaxation (`relaxes`), or keeps
    /// the momentum of the cloth.
    pub(crate) fn set_relaxing(&mut self, relaxes: bool) {
        self.momentum.set_active(relaxes, self.cloth.particle_count());
    }

    /// Returns whether each step starts from rest.
    pub(crate) fn relaxes(&self) -> bool {
        self.momentum.is_active()
    }

    /// Starts the motions of bodies and pins at `time`, in s. The cloth is at rest and keeps its
    /// momentum from then on.
    pub(crate) fn set_in_motion(&mut self, time: f64) {
        self.clock.start(time);
        self.pins.release(HoldUntil::Rest, time);
        self.state.velocities.fill(0.0);
        self.set_relaxing(false);
    }

    /// Returns the time of the prescribed motions at `time` of the simulation, both in s. Returns
    /// `None` before the motions start.
    pub(crate) fn motion_time(&self, time: f64) -> Option<f64> {
        self.clock.start_time().is_finite().then(|| self.clock.time(time))
    }

    /// Returns whether each particle is held in all directions in this step.
    pub(crate) fn held(&self) -> &[bool] {
        &self.pins.held
    }

    /// Returns the pins.
    pub(crate) fn pins(&self) -> &Pins {
        &self.pins
    }

    /// Leads the pin `number` along `motion` from the positions `start` of its particles, in m.
    pub(crate) fn lead_pin(&mut self, number: usize, start: Vec<[f64; 3]>, motion: RigidMotion) {
        self.pins.lead(number, start, motion);
    }

    /// Holds `particles` where they are from now on. Returns the number of their pin.
    pub(crate) fn hold(&mut self, particles: &[usize]) -> usize {
        self.pins.hold(particles, &self.state.positions)
    }

    /// Takes `particle` out of all pins.
    pub(crate) fn free(&mut self, particle: usize) {
        self.pins.free(particle);
    }

    /// Returns the air.
    pub(crate) fn air(&self) -> &AirDrag {
        &self.air
    }

    /// Sets the velocity of the air to `velocity`, in m/s.
    pub(crate) fn set_air_velocity(&mut self, velocity: [f64; 3]) {
        self.air.set_velocity(velocity);
    }

    /// Returns the acceleration of gravity, in m/s².
    pub(crate) fn gravity(&self) -> [f64; 3] {
        self.gravity.acceleration()
    }

    /// Sets the acceleration of gravity to `acceleration`, in m/s².
    pub(crate) fn set_gravity(&mut self, acceleration: [f64; 3]) {
        self.gravity.set_acceleration(acceleration);
    }

    /// Returns the springs that close the seams, while the garment is sewn.
    pub(crate) fn closing_springs(&self) -> Option<&ClosingSprings> {
        self.seams.springs.as_ref()
    }

    /// Stiffens the closing springs from `time` on, in s, so that a seam with the gap `gap`, in m,
    /// closes. Returns whether the springs had their usual stiffness before.
    pub(crate) fn stiffen_springs(&mut self, time: f64, gap: f64) -> bool {
        self.seams.springs.as_mut().is_some_and(|springs| springs.stiffen(time, gap))
    }

    /// Returns whether the closing springs are stiffened.
    pub(crate) fn springs_are_stiffened(&self) -> bool {
        self.seams.springs.as_ref().is_some_and(ClosingSprings::are_stiffened)
    }

    /// Ends the sewing at `time`, in s, with the cloth at rest at `positions`, in m.
    pub(crate) fn finish_sewing(&mut self, time: f64, positions: &[f64]) {
        self.seams.springs = None;
        if let Some(surfaces) = self.contact.surfaces_mut() {
            surfaces.close_seams();
        }

        self.gravity.start_ramp(time);
        if let Some(SewnCloth { cloth, bending }) = self.seams.sewn.take() {
            self.cloth = cloth;
            self.internal.sew(&self.cloth, bending, positions).expect(ALL_PARTICLES);
        }

        let state = self.cloth.state(positions.to_vec());
        self.state = state.expect(ALL_PARTICLES);
        self.pins.release(HoldUntil::Sewn, time);
        self.begin_balance();
    }

    /// Returns how the cloth with merged seams lies at `positions`, in m, among the bodies.
    pub(crate) fn sewn_placement(
        &mut self,
        positions: &[f64],
    ) -> Result<SewnPlacement, drape_collide::Error> {
        let Some(surfaces) = self.contact.surfaces_mut() else {
            return Ok(SewnPlacement::Free(f64::INFINITY));
        };
        let bodies = surfaces.contact.state().body_positions().to_vec();
        surfaces.contact.setup()?.sewn_placement(positions, &bodies)
    }

    /// Places the cloth with merged seams at `positions`, in m, at `time`, in s. Nothing may
    /// intersect at `positions`. Minimum separations are reduced to the distances there, and grow
    /// again within `growth_seconds`.
    pub(crate) fn place_sewn(
        &mut self,
        time: f64,
        positions: &[f64],
        growth_seconds: f64,
    ) -> Result<(), Error> {
        let Some(surfaces) = self.contact.surfaces_mut() else { return Ok(()) };
        let bodies = surfaces.contact.state().body_positions().to_vec();
        surfaces.place(time, &PlacedSurfaces { positions, bodies: &bodies, growth_seconds })?;
        Ok(())
    }

    /// Starts the energy balance at the current state, if the run keeps one.
    fn begin_balance(&mut self) {
        if self.with_balance {
            let stored = self.internal.stored(&self.cloth, &self.state).expect(ALL_PARTICLES);
            self.balance = Some(EnergyBalance::new(stored, self.kinetic_energy()));
        }
    }

    /// Starts at `time`, in s, with cloth at rest as `placed`, with merged seams.
    pub(crate) fn begin_at(&mut self, time: f64, placed: &PlacedSurfaces<'_>) -> Result<(), Error> {
        if let Some(surfaces) = self.contact.surfaces_mut() {
            surfaces.place(time, placed)?;
        }
        self.finish_sewing(time, placed.positions);
        // Gravity reached its full value on the previous grid.
        self.gravity.finish_ramp(time);
        Ok(())
    }

    /// Resets the memories of friction and the energy balance, as if the cloth had moved to its
    /// current positions in one step.
    pub(crate) fn forget(&mut self) {
        let velocities = std::mem::take(&mut self.state.velocities);
        let positions = std::mem::take(&mut self.state.positions);
        self.internal.forget(&positions).expect(ALL_PARTICLES);
        self.state = self.cloth.state(positions).expect(ALL_PARTICLES);
        self.state.velocities = velocities;
        self.begin_balance();
    }

    /// Returns the time of the last change that the scene prescribes, in s: full gravity, full size
    /// of bodies, or release of a pin.
    pub(crate) fn last_change(&self) -> f64 {
        let ramp_end = self.gravity.ramp_end();
        let surfaces = self.contact.surfaces();
        let full_time =
            surfaces.map_or(ramp_end, |surfaces| ramp_end.max(surfaces.full_size_time()));
        self.pins.last_release(full_time)
    }

    /// Returns the loads of the pins at `time`, in s, without the inertia of the particles that the
    /// pins hold.
    pub(crate) fn pin_loads(&mut self, time: f64) -> Vec<PinLoad> {
        let positions = self.state.positions.clone();
        // The forces that replace inertia are left out, as inertia is.
        self.momentum.clear();
        let mut forces = vec![0.0; positions.len()];
        self.forces(&positions, &mut forces);
        let times = LoadTimes { now: time, motion: self.clock.time(time) };
        self.pins.loads(times, &positions, &forces)
    }

    /// Returns the energy balance since the start, if the run keeps one.
    pub(crate) fn energy(&self) -> Option<Energy> {
        self.balance.as_ref().map(|balance| balance.energy(self.kinetic_energy()))
    }

    /// Returns the kinetic energy of the cloth, in J.
    pub(crate) fn kinetic_energy(&self) -> f64 {
        let velocities = self.state.velocities.chunks_exact(3);
        let squares = velocities.map(|velocity| velocity.iter().map(|v| v * v).sum::<f64>());
        self.cloth.masses().iter().zip(squares).map(|(mass, square)| 0.5 * mass * square).sum()
    }
}
