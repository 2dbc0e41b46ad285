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
use drape_scene::{HoldUntil, Scene, Sewing};

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
pub(crate) use self::contact::{Contact, PlacedSurfaces};
pub use self::energy_balance::Energy;
pub(crate) use self::energy_balance::EnergyBalance;
pub use self::pins::PinLoad;

/// Cloth, bodies, gravity and air.
#[derive(Debug)]
pub(crate) struct World {
    /// Cloth, constant but for the moment at which it is sewn.
    pub(crate) cloth: Cloth,
    /// Positions, velocities and memory of the cloth.
    pub(crate) state: State,
    pub(crate) internal: InternalForces,
    pub(crate) contact: Contact,
    gravity: Gravity,
    air: AirDrag,
    /// Forces that a program applies between steps.
    pub(crate) external: ConstantForces,
    momentum: MomentumRemoval,
    pins: Pins,
    clock: MotionClock,
    seams: Seams,
    /// Balance of the energy, if it is asked for; not while a garment is sewn.
    pub(crate) balance: Option<EnergyBalance>,
    /// Whether the balance is asked for.
    with_balance: bool,
    /// Flag that gives up the step in hand.
    pub(crate) cancel: Option<Arc<AtomicBool>>,
}

/// Seams while a garment is sewn.
#[derive(Debug)]
struct Seams {
    /// Springs that close the seams, until they are closed.
    springs: Option<ClosingSprings>,
    /// The cloth once its seams are closed.
    sewn: Option<SewnCloth>,
}

/// Cloth with closed seams.
#[derive(Debug)]
struct SewnCloth {
    /// The cloth with the friction of its fabrics.
    cloth: Cloth,
    /// Bending across its seams.
    bending: SeamBending,
}

impl World {
    /// Makes the world of a scene that has been checked.
    pub(crate) fn new(scene: Scene) -> Result<Self, Error> {
        let contact = Contact::new(&scene)?;
        let held = scene.held_particles();
        let moves_at_once = scene.schedule.motion_seconds.is_none();
        let Scene { mut cloth, breen, start, pins, environment, sewing, schedule, .. } = scene;
        let seams = match sewing {
            Some(Sewing { pairs, cloth: own, seconds, bending, .. }) => {
                let springs = ClosingSprings::new(&pairs, &start.positions, seconds);
                let cloth = std::mem::replace(&mut cloth, own);
                Seams { springs: Some(springs), sewn: Some(SewnCloth { cloth, bending }) }
            }
            None => Seams { springs: None, sewn: None },
        };
        let mut state = cloth.state(start.positions).expect("a scene places every particle");
        state.velocities = start.velocities;
        let coupled = seams.springs.as_ref().map_or_else(Vec::new, ClosingSprings::coupled_pairs);
        let mut internal = InternalForces::new(&cloth, breen, &coupled, &state.positions);
        let stored = internal.stored(&cloth, &state);
        let with_balance = scene.solver.energy_balance;
        let is_sewing = seams.springs.is_some();
        let mut world = Self {
            air: AirDrag::new(environment.air, cloth.particles()),
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
        world.set_relaxing(is_sewing || schedule.relaxation.is_some_and(|own| !own.inertia));
        // The balance of a garment begins when it is sewn.
        if with_balance && !is_sewing {
            world.balance = Some(EnergyBalance::new(stored, world.kinetic_energy()));
        }
        Ok(world)
    }

    /// Lets the steps start from rest from now on, as in quasi-static relaxation, or keep their
    /// momentum.
    pub(crate) fn set_relaxing(&mut self, relaxes: bool) {
        self.momentum.set_active(relaxes, self.cloth.particles());
    }

    /// Whether steps start from rest.
    pub(crate) fn relaxes(&self) -> bool {
        self.momentum.is_active()
    }

    /// Starts the motions of bodies and pins at a time, in s, with a cloth at rest that keeps its
    /// momentum.
    pub(crate) fn set_in_motion(&mut self, time: f64) {
        self.clock.start(time);
        self.pins.release(HoldUntil::Rest, time);
        self.state.velocities.fill(0.0);
        self.set_relaxing(false);
    }

    /// Time of the prescribed motions at a time of the simulation, both in s; none before they begin.
    pub(crate) fn motion_time(&self, time: f64) -> Option<f64> {
        self.clock.start_time().is_finite().then(|| self.clock.time(time))
    }

    /// Whether each particle is held in all directions in this step.
    pub(crate) fn held(&self) -> &[bool] {
        &self.pins.held
    }

    /// Springs that close the seams, while the garment is sewn.
    pub(crate) fn closing_springs(&self) -> Option<&ClosingSprings> {
        self.seams.springs.as_ref()
    }

    /// Stiffens the springs that close the seams from a time on, in s, so far that a gap in m
    /// closes; returns whether they were as usual before.
    pub(crate) fn stiffen_springs(&mut self, time: f64, gap: f64) -> bool {
        self.seams.springs.as_mut().is_some_and(|springs| springs.stiffen(time, gap))
    }

    /// Whether the closing springs are stiffened.
    pub(crate) fn springs_are_stiffened(&self) -> bool {
        self.seams.springs.as_ref().is_some_and(|springs| springs.stiffening().is_some())
    }

    /// Ends the sewing at a time, in s, with the cloth at rest at some positions, in m.
    pub(crate) fn finish_sewing(&mut self, time: f64, positions: &[f64]) {
        self.seams.springs = None;
        if let Some(surfaces) = self.contact.surfaces_mut() {
            surfaces.contact.close_seams();
        }
        self.gravity.start_ramp(time);
        if let Some(SewnCloth { cloth, bending }) = self.seams.sewn.take() {
            self.cloth = cloth;
            self.internal.sew(&self.cloth, bending, positions);
        }
        let state = self.cloth.state(positions.to_vec());
        self.state = state.expect("a place for every particle");
        self.pins.release(HoldUntil::Sewn, time);
        self.begin_balance();
    }

    /// Placement of cloth with closed seams at some positions, in m, among the bodies.
    pub(crate) fn sewn_placement(
        &mut self,
        positions: &[f64],
    ) -> Result<SewnPlacement, drape_collide::Error> {
        let Some(surfaces) = self.contact.surfaces_mut() else {
            return Ok(SewnPlacement::Free(f64::INFINITY));
        };
        let bodies = surfaces.contact.body_positions().to_vec();
        surfaces.contact.sewn_placement(positions, &bodies)
    }

    /// Sets the cloth, once its seams are closed, to positions in m at which nothing intersects, at a time in s.
    /// Minimum separations are reduced to the distances there, and grow again within a time, in s.
    pub(crate) fn place_sewn(
        &mut self,
        time: f64,
        positions: &[f64],
        growth_seconds: f64,
    ) -> Result<(), Error> {
        let Some(surfaces) = self.contact.surfaces_mut() else { return Ok(()) };
        let bodies = surfaces.contact.body_positions().to_vec();
        surfaces.place(time, &PlacedSurfaces { positions, bodies: &bodies, growth_seconds })?;
        Ok(())
    }

    /// Starts the energy balance at the present state, where the run keeps one.
    fn begin_balance(&mut self) {
        if self.with_balance {
            let stored = self.internal.stored(&self.cloth, &self.state);
            self.balance = Some(EnergyBalance::new(stored, self.kinetic_energy()));
        }
    }

    /// Begins at a time, in s, with cloth at rest at other places, in m, whose seams are closed there.
    pub(crate) fn begin_at(&mut self, time: f64, placed: &PlacedSurfaces<'_>) -> Result<(), Error> {
        if let Some(surfaces) = self.contact.surfaces_mut() {
            surfaces.place(time, placed)?;
        }
        self.finish_sewing(time, placed.positions);
        // Gravity has grown on the grid before.
        self.gravity.finish_ramp(time);
        Ok(())
    }

    /// Lets the memories of friction and the balance of the energy begin anew from where the cloth is, as if
    /// it had come there in one go.
    pub(crate) fn forget(&mut self) {
        let velocities = std::mem::take(&mut self.state.velocities);
        let positions = std::mem::take(&mut self.state.positions);
        self.internal.forget(&positions);
        self.state = self.cloth.state(positions).expect("a place for every particle");
        self.state.velocities = velocities;
        self.begin_balance();
    }

    /// Time of the last change that a scene prescribes, in s: full gravity, full size of bodies,
    /// and releases of pins.
    pub(crate) fn last_change(&self) -> f64 {
        let ramp_end = self.gravity.ramp_end();
        let surfaces = self.contact.surfaces();
        let full = surfaces.map_or(ramp_end, |surfaces| ramp_end.max(surfaces.full_size_time()));
        self.pins.last_release(full)
    }

    /// Loads of the pins at a time, in s, without the inertia of the particles that they hold.
    pub(crate) fn pin_loads(&mut self, time: f64) -> Vec<PinLoad> {
        let positions = self.state.positions.clone();
        // The forces that stand in for inertia count as little as inertia itself.
        self.momentum.clear();
        let mut forces = vec![0.0; positions.len()];
        self.forces(&positions, &mut forces);
        let times = LoadTimes { now: time, motion: self.clock.time(time) };
        self.pins.loads(times, &positions, &forces)
    }

    /// Balance of the energy since the start, if it is asked for.
    pub(crate) fn energy(&self) -> Option<Energy> {
        self.balance.as_ref().map(|balance| balance.energy(self.kinetic_energy()))
    }

    fn kinetic_energy(&self) -> f64 {
        let square = |v: &[f64]| v.iter().map(|c| c * c).sum::<f64>();
        let speeds = self.state.velocities.chunks_exact(3).map(square);
        self.cloth.masses().iter().zip(speeds).map(|(mass, square)| 0.5 * mass * square).sum()
    }
}
