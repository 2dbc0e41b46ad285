//! Contact of the cloth with bodies, and with itself where surfaces are kept apart.
//!
//! A scene has one of two kinds. With *surfaces* (`surfaces.rs`) triangles, edges and vertices of
//! cloth and bodies repel each other within the activation distance,
//! `$E = \sum_{k} b(d_k, \hat d)$` over pairs at the distances `$d_k$` \[Li20\], and a step filter
//! keeps steps free of intersections. Otherwise *particles* are kept out of bodies, which move as
//! rigid ones (`particle_bodies.rs`). The world asks for forces, potentials and stiffnesses, opens
//! steps and commits them; only a commit changes the memory of friction.

mod particle_bodies;
mod step;
mod surfaces;

use drape_collide::{Body, Triangulation};
use drape_implicit::BlockMatrix;
use drape_scene::Scene;

use crate::error::Error;

pub(crate) use self::particle_bodies::ParticleBodies;
pub(crate) use self::step::{ContactEnergy, ContactStep};
#[cfg(test)]
pub(crate) use self::surfaces::Omitted;
pub(crate) use self::surfaces::{PlacedSurfaces, SavedGrowth, Surfaces};

/// Contact of a world.
#[derive(Debug)]
pub(crate) enum Contact {
    /// Particles are kept out of bodies.
    Particles(Box<ParticleBodies>),
    /// All surfaces are kept apart.
    Surfaces(Box<Surfaces>),
}

impl Contact {
    /// Contact of a scene that has been checked.
    pub(crate) fn new(scene: &Scene) -> Result<Self, Error> {
        Ok(match scene.contact.surfaces {
            true => Self::Surfaces(Box::new(Surfaces::new(scene)?)),
            false => Self::Particles(Box::new(ParticleBodies::new(scene)?)),
        })
    }

    /// Surfaces, where they are kept apart.
    pub(crate) fn surfaces(&self) -> Option<&Surfaces> {
        match self {
            Self::Surfaces(surfaces) => Some(surfaces),
            Self::Particles(_) => None,
        }
    }

    /// The same, to be changed.
    pub(crate) fn surfaces_mut(&mut self) -> Option<&mut Surfaces> {
        match self {
            Self::Surfaces(surfaces) => Some(surfaces),
            Self::Particles(_) => None,
        }
    }

    /// Fraction of the distances of surfaces that they keep now, 0 to 1.
    pub(crate) fn growth_fraction(&self) -> f64 {
        self.surfaces().map_or(1.0, |surfaces| surfaces.contact.growth_fraction())
    }

    /// Bodies, in the order of the scene.
    pub(crate) fn bodies(&self) -> &[Body] {
        match self {
            Self::Particles(bodies) => bodies.contact.bodies(),
            Self::Surfaces(surfaces) => surfaces.bodies(),
        }
    }

    /// Triangles of a body at a time on the clock of motions, in s, in its own size.
    pub(crate) fn outline(&self, body: usize, time: f64) -> Triangulation {
        match self {
            Self::Particles(bodies) => bodies.outline(body, time),
            Self::Surfaces(surfaces) => surfaces.outline(body, time),
        }
    }

    /// Triangles of the bodies, where they are now.
    pub(crate) fn triangulations(&self) -> Vec<Triangulation> {
        let bodies = self.bodies().iter();
        let outlines = bodies.map(|body| body.triangulate().expect("contact has checked it"));
        let mut outlines: Vec<Triangulation> = outlines.collect();
        if let Self::Surfaces(surfaces) = self {
            let mut places = surfaces.contact.body_positions().as_chunks::<3>().0.iter();
            let vertices = outlines.iter_mut().flat_map(|outline| &mut outline.vertices);
            vertices.zip(&mut places).for_each(|(vertex, place)| *vertex = *place);
        }
        outlines
    }

    /// Opens a step and returns the energy of contact at its start if that is asked for.
    pub(crate) fn begin(&mut self, step: &ContactStep<'_>) -> Option<ContactEnergy> {
        match self {
            Self::Particles(bodies) => bodies.begin(step),
            Self::Surfaces(surfaces) => surfaces.begin(step),
        }
    }

    pub(crate) fn add_forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        match self {
            Self::Particles(bodies) => bodies.contact.add_forces(positions, forces),
            Self::Surfaces(surfaces) => surfaces.contact.add_forces(positions, forces),
        }
    }

    pub(crate) fn potential(&mut self, positions: &[f64]) -> f64 {
        match self {
            Self::Particles(bodies) => bodies.contact.potential(positions),
            Self::Surfaces(surfaces) => surfaces.contact.potential(positions),
        }
    }

    /// Adds the stiffness; that of particles may be asked to be positive semi-definite, that of
    /// surfaces always is.
    pub(crate) fn add_stiffness(
        &mut self,
        positions: &[f64],
        definite: bool,
        matrix: &mut BlockMatrix,
    ) {
        match self {
            Self::Particles(bodies) => {
                bodies.contact.add_stiffness(positions, definite, &mut |particle, block| {
                    matrix.add_block(matrix.sparsity().row(particle).start, &block);
                });
            }
            Self::Surfaces(surfaces) => {
                surfaces.contact.add_stiffness(positions, &mut |[i, j], block| {
                    matrix.add_coupling(i, j, block);
                });
            }
        }
    }

    /// Closes a step: friction remembers what slid.
    pub(crate) fn commit(&mut self, positions: &[f64]) {
        if let Self::Surfaces(surfaces) = self {
            surfaces.contact.commit(positions);
        }
    }
}
