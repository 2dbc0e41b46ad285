//! Contact of the cloth with bodies, and with itself where surfaces are kept apart.
//!
//! A scene has one of two kinds. With *surfaces* (`surfaces.rs`) triangles, edges and vertices of
//! cloth and bodies repel each other within the activation distance,
//! `$E = \sum_{k} b(d_k, \hat d)$` over pairs at the distances `$d_k$` \[Li20\], and a step filter
//! keeps steps free of intersections. Otherwise *particles* are kept out of bodies, which move as
//! rigid ones (`particle_bodies.rs`). The world asks for forces, potentials and stiffnesses, opens
//! steps and commits them; only a commit changes the memory of friction.

mod closest_place;
mod particle_bodies;
mod step;
mod stopped_speeds;
mod surfaces;

use drape_collide::{Body, Triangulation};
use drape_implicit::BlockMatrix;
use drape_scene::Scene;
use serde::{Deserialize, Serialize};

use crate::error::Error;

use self::stopped_speeds::StoppedSpeeds;

pub(crate) use self::closest_place::ClosestPlace;
pub(crate) use self::particle_bodies::{MovingBody, ParticleBodies};
pub(crate) use self::step::{ALL_PARTICLES, ContactEnergy, ContactStep};
#[cfg(test)]
pub(crate) use self::surfaces::Omitted;
pub(crate) use self::surfaces::{LedSurface, PlacedSurfaces, SavedGrowth, Surfaces};

/// Contact of a world.
#[derive(Debug)]
pub(crate) enum Contact {
    /// Particles are kept out of bodies.
    Particles(Box<ParticleBodies>),
    /// All surfaces are kept apart.
    Surfaces(Box<Surfaces>),
}

/// Bodies that a program leads, between two steps.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) enum SavedLeads {
    /// Bodies that particles touch.
    Particles(Vec<MovingBody>),
    /// Bodies as surfaces.
    Surfaces(Vec<LedSurface>),
}

impl Contact {
    /// Returns the contact of the checked `scene`.
    ///
    /// # Errors
    ///
    /// Returns an error if `scene` was changed so that its contact cannot be set up.
    pub(crate) fn new(scene: &Scene) -> Result<Self, Error> {
        if scene.contact.surfaces {
            StoppedSpeeds::check_top_speed(scene)?;
            Ok(Self::Surfaces(Box::new(Surfaces::new(scene)?)))
        } else {
            Ok(Self::Particles(Box::new(ParticleBodies::new(scene)?)))
        }
    }

    /// Returns the [`Surfaces`], if surfaces are kept apart.
    pub(crate) fn surfaces(&self) -> Option<&Surfaces> {
        match self {
            Self::Surfaces(surfaces) => Some(surfaces),
            Self::Particles(_) => None,
        }
    }

    /// Returns the [`Surfaces`] mutably, if surfaces are kept apart.
    pub(crate) fn surfaces_mut(&mut self) -> Option<&mut Surfaces> {
        match self {
            Self::Surfaces(surfaces) => Some(surfaces),
            Self::Particles(_) => None,
        }
    }

    /// Returns the fraction of their distances that surfaces keep now, 0 to 1.
    pub(crate) fn growth_fraction(&self) -> f64 {
        self.surfaces().map_or(1.0, |surfaces| surfaces.growth_fraction())
    }

    /// Returns the bodies at the start, in the order of the scene.
    pub(crate) fn bodies(&self) -> &[Body] {
        match self {
            Self::Particles(bodies) => bodies.contact.bodies(),
            Self::Surfaces(surfaces) => surfaces.bodies(),
        }
    }

    /// Returns the triangles of `body` at `time` on the motion clock, in s, in its full size.
    pub(crate) fn outline(&self, body: usize, time: f64) -> Triangulation {
        match self {
            Self::Particles(bodies) => bodies.outline(body, time),
            Self::Surfaces(surfaces) => surfaces.outline(body, time),
        }
    }

    /// Returns the bodies that a program leads.
    pub(crate) fn saved_leads(&self) -> SavedLeads {
        match self {
            Self::Particles(bodies) => SavedLeads::Particles(bodies.led().to_vec()),
            Self::Surfaces(surfaces) => SavedLeads::Surfaces(surfaces.led().to_vec()),
        }
    }

    /// Restores the bodies `saved` that a program leads, at `time` on the motion clock, in s.
    /// Returns `false` if they do not fit.
    pub(crate) fn restore_leads(&mut self, saved: SavedLeads, time: f64) -> bool {
        match (self, saved) {
            (Self::Particles(bodies), SavedLeads::Particles(led)) => bodies.restore_led(led, time),
            (Self::Surfaces(surfaces), SavedLeads::Surfaces(led)) => surfaces.restore_led(led),
            _ => false,
        }
    }

    /// Returns the triangles of the bodies at their current positions.
    pub(crate) fn triangulations(&self) -> Vec<Triangulation> {
        let bodies = self.bodies().iter();
        let outlines = bodies.map(|body| body.triangulate().expect("contact has checked it"));
        let mut outlines: Vec<Triangulation> = outlines.collect();

        // Surfaces may have been inflated or deformed, so their vertices are read from contact.
        if let Self::Surfaces(surfaces) = self {
            let positions = surfaces.contact.state().body_positions().as_chunks::<3>().0;
            let vertices = outlines.iter_mut().flat_map(|outline| &mut outline.vertices);
            vertices.zip(positions).for_each(|(vertex, position)| *vertex = *position);
        }
        outlines
    }

    /// Prepares contact for `step`. Returns the energy of contact at its start, if `step` asks for
    /// it.
    pub(crate) fn begin(&mut self, step: &ContactStep<'_>) -> Option<ContactEnergy> {
        match self {
            Self::Particles(bodies) => bodies.begin(step),
            Self::Surfaces(surfaces) => surfaces.begin(step),
        }
    }

    /// Adds the contact forces at `positions` to `forces`, in N.
    pub(crate) fn add_forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        match self {
            Self::Particles(bodies) => {
                bodies.contact.add_forces(positions, forces).expect(ALL_PARTICLES);
            }
            Self::Surfaces(surfaces) => {
                let mut energy = surfaces.contact.energy(positions).expect(ALL_PARTICLES);
                energy.add_forces(forces).expect(ALL_PARTICLES);
            }
        }
    }

    /// Returns the potential of contact and friction at `positions`, in J.
    pub(crate) fn potential(&mut self, positions: &[f64]) -> f64 {
        match self {
            Self::Particles(bodies) => bodies.contact.potential(positions).expect(ALL_PARTICLES),
            Self::Surfaces(surfaces) => {
                surfaces.contact.energy(positions).expect(ALL_PARTICLES).potential()
            }
        }
    }

    /// Adds the stiffness at `positions` to `matrix`. The stiffness of particles is positive
    /// semi-definite if `definite`; the stiffness of surfaces always is.
    pub(crate) fn add_stiffness(
        &mut self,
        positions: &[f64],
        definite: bool,
        matrix: &mut BlockMatrix,
    ) {
        match self {
            Self::Particles(bodies) => {
                let added =
                    bodies.contact.add_stiffness(positions, definite, &mut |particle, block| {
                        matrix.add_block(matrix.sparsity().row(particle).start, &block);
                    });
                added.expect(ALL_PARTICLES);
            }
            Self::Surfaces(surfaces) => {
                surfaces.contact.energy(positions).expect(ALL_PARTICLES).add_stiffness(
                    &mut |[i, j], block| {
                        matrix.add_coupling(i, j, block);
                    },
                );
            }
        }
    }

    /// Accepts a step that ends at `positions`: updates the memory of friction.
    pub(crate) fn commit(&mut self, positions: &[f64]) {
        if let Self::Surfaces(surfaces) = self {
            surfaces.open_step().commit(positions).expect("an accepted step is finite");
        }
    }
}
