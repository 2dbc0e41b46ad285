//! Saved state of a world between two steps, on which its next steps depend.
//!
//! A world is built from its scene again, and then its saved state is restored. The world that was
//! saved may also be restored itself, as long as its seams have not been closed since. What a
//! program has prescribed between the steps is part of the state. Data that each step prepares is
//! not saved: gravity, air and springs at its end, and the poses of bodies.

use drape_cloth::State;
use drape_collide::SavedContact;
use serde::{Deserialize, Serialize};

use super::World;
use super::contact::{Contact, SavedGrowth, SavedLeads};
use super::energy_balance::EnergyBalance;
use super::internal_forces::SavedForces;
use super::pins::SavedPins;
use crate::world::closing_springs::{ClosingSprings, SavedSprings};

/// State of a world between two steps, on which its next steps depend.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct SavedWorld {
    pub(crate) cloth: State,
    forces: SavedForces,
    contact: Option<SavedSurfaces>,
    /// Springs that close the seams, while a garment is sewn.
    springs: Option<SavedSprings>,
    /// Whether steps start from rest.
    relaxes: bool,
    /// Time at which gravity begins to grow, in s.
    ramp_start: f64,
    /// Time at which bodies and pins start to move, in s.
    motion_start: f64,
    pins: SavedPins,
    balance: Option<EnergyBalance>,
    prescribed: Prescribed,
}

impl SavedWorld {
    /// Returns whether seams are being closed.
    pub(crate) fn is_sewing(&self) -> bool {
        self.springs.is_some()
    }
}

/// Values that a program may prescribe between steps.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Prescribed {
    /// Acceleration of gravity, in m/s².
    gravity: [f64; 3],
    /// Velocity of the air, in m/s.
    air_velocity: [f64; 3],
    /// Forces on the particles, in N.
    forces: Vec<f64>,
    /// Bodies that a program leads.
    bodies: SavedLeads,
}

impl Prescribed {
    /// Returns whether the numbers are finite and the forces are for `coordinate_count`
    /// coordinates.
    fn is_sound(&self, coordinate_count: usize) -> bool {
        let numbers = self.gravity.iter().chain(&self.air_velocity).chain(&self.forces);
        (self.forces.is_empty() || self.forces.len() == coordinate_count)
            && numbers.copied().all(f64::is_finite)
    }
}

/// Contact of surfaces between two steps.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct SavedSurfaces {
    contact: SavedContact,
    intersections_found: usize,
    growth: Option<SavedGrowth>,
}

impl World {
    /// Returns the state on which the next steps depend.
    pub(crate) fn saved(&self) -> SavedWorld {
        let surfaces = self.contact.surfaces();
        SavedWorld {
            cloth: self.state.clone(),
            forces: self.internal.saved(),
            contact: surfaces.map(|surfaces| SavedSurfaces {
                contact: surfaces.contact.state().saved(),
                intersections_found: surfaces.intersections_found,
                growth: surfaces.saved_growth(),
            }),
            springs: self.closing_springs().map(ClosingSprings::saved),
            relaxes: self.relaxes(),
            ramp_start: self.gravity.ramp_start(),
            motion_start: self.clock.start_time(),
            pins: self.pins.saved(),
            balance: self.balance.clone(),
            prescribed: Prescribed {
                gravity: self.gravity.acceleration(),
                air_velocity: self.air.velocity(),
                forces: self.external.values.clone(),
                bodies: self.contact.saved_leads(),
            },
        }
    }

    /// Restores the state `saved` at `time`, in s. This world was just built from its scene, or is
    /// the world that was saved.
    ///
    /// # Errors
    /// Returns a description of the part that does not fit the scene.
    pub(crate) fn resume(&mut self, saved: SavedWorld, time: f64) -> Result<(), String> {
        if saved.cloth.positions.len() != self.state.positions.len() {
            return Err("the cloth has another number of particles".into());
        }

        // The sewn cloth has other connectors, so the sewing is finished before they are compared.
        let is_sewing = self.closing_springs().is_some();
        if saved.is_sewing() && !is_sewing {
            return Err("there is nothing to sew".into());
        }
        if !saved.is_sewing() && is_sewing {
            self.finish_sewing(0.0, &saved.cloth.positions);
        }

        if !saved.prescribed.is_sound(saved.cloth.positions.len()) {
            return Err("the forces, the gravity or the air are others".into());
        }
        if !saved.cloth.may_follow(&self.state) {
            return Err("the cloth has other connectors, or numbers that are not finite".into());
        }
        if !self.internal.resume(&self.cloth, saved.forces) {
            return Err("the seams or the close pairs are others".into());
        }
        if !self.pins.restore(saved.pins) {
            return Err("the pins are others".into());
        }
        if !self.pins.is_steered()
            && let Some(surfaces) = self.contact.surfaces_mut()
        {
            surfaces.set_held(&self.pins.held_at_start());
        }
        match (&mut self.contact, saved.contact) {
            (Contact::Surfaces(surfaces), Some(saved_surfaces)) => {
                let contact = &mut surfaces.contact;
                let resumed = contact.resume(&saved.cloth.positions, &saved_surfaces.contact);
                resumed.map_err(|error| error.to_string())?;
                surfaces.intersections_found = saved_surfaces.intersections_found;
                surfaces.restore_growth(saved_surfaces.growth);
            }
            (Contact::Particles(_), None) => {}
            _ => return Err("the contact is of another kind".into()),
        }

        self.clock.start(saved.motion_start);
        let Prescribed { gravity, air_velocity, forces, bodies } = saved.prescribed;
        if !self.contact.restore_leads(bodies, self.clock.time(time)) {
            return Err("the bodies are others".into());
        }
        self.gravity.set_acceleration(gravity);
        self.air.set_velocity(air_velocity);
        self.external.values = forces;

        if let (Some(springs), Some(saved)) = (&mut self.seams.springs, saved.springs)
            && !springs.restore(saved)
        {
            return Err("the seams that are closed are others".into());
        }
        self.state = saved.cloth;
        self.set_relaxing(saved.relaxes);
        self.gravity.start_ramp(saved.ramp_start);
        self.balance = saved.balance;
        Ok(())
    }
}
