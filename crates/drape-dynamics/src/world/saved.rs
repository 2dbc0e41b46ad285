//! Saved state of a world between two steps, on which its next steps depend.
//!
//! A world is built from its scene again, and then its saved state is restored. Data that each step
//! prepares is not saved: gravity, air and springs at its end, and the poses of bodies.

use drape_cloth::State;
use drape_collide::SavedContact;
use serde::{Deserialize, Serialize};

use super::World;
use super::contact::{Contact, SavedGrowth};
use super::energy_balance::EnergyBalance;
use super::internal_forces::SavedForces;
use crate::world::closing_springs::{ClosingSprings, Stiffening};

/// State of a world between two steps, on which its next steps depend.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct SavedWorld {
    pub(crate) cloth: State,
    forces: SavedForces,
    contact: Option<SavedSurfaces>,
    /// Whether seams are being closed.
    pub(crate) is_sewing: bool,
    stiffening: Option<Stiffening>,
    /// Whether steps start from rest.
    relaxes: bool,
    /// Time at which gravity begins to grow, in s.
    ramp_start: f64,
    /// Time at which bodies and pins start to move, in s.
    motion_start: f64,
    /// Times of the releases of the pins, in s.
    releases: Vec<f64>,
    held: Vec<bool>,
    balance: Option<EnergyBalance>,
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
        let springs = self.closing_springs();
        let surfaces = self.contact.surfaces();
        SavedWorld {
            cloth: self.state.clone(),
            forces: self.internal.saved(),
            contact: surfaces.map(|surfaces| SavedSurfaces {
                contact: surfaces.contact.state().saved(),
                intersections_found: surfaces.intersections_found,
                growth: surfaces.saved_growth(),
            }),
            is_sewing: springs.is_some(),
            stiffening: springs.and_then(ClosingSprings::stiffening),
            relaxes: self.relaxes(),
            ramp_start: self.gravity.ramp_start(),
            motion_start: self.clock.start_time(),
            releases: self.pins.releases(),
            held: self.pins.held.clone(),
            balance: self.balance.clone(),
        }
    }

    /// Restores the state `saved`. This world was just built from its scene.
    ///
    /// # Errors
    ///
    /// Returns a description of the part that does not fit the scene.
    ///
    /// # Errors
    /// What does not fit, in words.
    pub(crate) fn resume(&mut self, saved: SavedWorld) -> Result<(), String> {
        if saved.cloth.positions.len() != self.state.positions.len() {
            return Err("the cloth has another number of particles".into());
        }

        // The sewn cloth has other connectors, so the sewing is finished before they are compared.
        let is_sewing = self.closing_springs().is_some();
        if saved.is_sewing && !is_sewing {
            return Err("there is nothing to sew".into());
        }
        if !saved.is_sewing && is_sewing {
            self.finish_sewing(0.0, &saved.cloth.positions);
        }

        if !saved.cloth.may_follow(&self.state) {
            return Err("the cloth has other connectors, or numbers that are not finite".into());
        }
        if !self.internal.resume(&self.cloth, saved.forces) {
            return Err("the seams or the close pairs are others".into());
        }
        if !self.pins.restore(&saved.releases, &saved.held) {
            return Err("the pins are others".into());
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

        if let Some(springs) = &mut self.seams.springs {
            springs.restore(saved.stiffening);
        }
        self.state = saved.cloth;
        self.set_relaxing(saved.relaxes);
        self.gravity.start_ramp(saved.ramp_start);
        self.clock.start(saved.motion_start);
        self.balance = saved.balance;
        Ok(())
    }
}
