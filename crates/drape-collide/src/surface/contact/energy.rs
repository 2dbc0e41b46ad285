//! Energy of a contact at given positions: potential, forces and stiffness.

use super::active_pairs::{ActivePair, ActivePairs};
use super::surface_contact::SurfaceContact;
use crate::error::Error;
use crate::surface::barrier::Gradient;
use crate::surface::friction::{FrictionEnergy, SurfaceFriction};
use crate::vector::{Matrix, outer};

/// Energy of barriers and friction at the positions that
/// [`energy`](SurfaceContact::energy) took.
#[derive(Debug)]
pub struct SurfaceEnergy<'a> {
    contact: &'a mut SurfaceContact,
}

impl<'a> SurfaceEnergy<'a> {
    /// Detects the active pairs of `contact` at the `positions` of the free vertices, in m.
    ///
    /// # Errors
    /// There are not three coordinates for each free vertex.
    pub(super) fn new(
        contact: &'a mut SurfaceContact,
        positions: &[f64],
    ) -> Result<SurfaceEnergy<'a>, Error> {
        contact.check_free("positions", positions)?;
        contact.update(positions);
        Ok(SurfaceEnergy { contact })
    }

    /// Returns the energy of the contact with the potential of friction, in J. It is infinite or
    /// NaN if the positions are not finite.
    #[must_use]
    pub fn potential(&self) -> f64 {
        self.without_friction() + self.friction().potential
    }

    /// Returns the energy of the contact without friction, in J, like
    /// [`potential`](Self::potential).
    #[must_use]
    pub fn without_friction(&self) -> f64 {
        let SurfaceContact { active, stiffness, .. } = &*self.contact;
        if active.failure.is_some() { f64::NAN } else { active.energy(*stiffness) }
    }

    /// Returns the [`FrictionEnergy`]: the potential of friction, and its part that is dissipated
    /// if the step ends at the positions, in J.
    #[must_use]
    pub fn friction(&self) -> FrictionEnergy {
        let SurfaceContact { active, friction, surface, .. } = &*self.contact;
        friction.energy(&active.positions, surface.free_count())
    }

    /// Adds the forces on the free vertices to `forces`, in N. They are NaN if the positions are
    /// not finite.
    ///
    /// # Errors
    /// There are not three forces for each free vertex.
    pub fn add_forces(&mut self, forces: &mut [f64]) -> Result<(), Error> {
        self.contact.check_free("forces", forces)?;
        let SurfaceContact { stiffness, active, friction, .. } = &mut *self.contact;
        if active.failure.is_some() {
            forces.fill(f64::NAN);
            return Ok(());
        }
        for_each_gradient(*stiffness, active, friction, |vertices, gradient| {
            for (corner, &vertex) in vertices.iter().enumerate() {
                let first = 3 * vertex as usize;
                if first < forces.len() {
                    for axis in 0..3 {
                        forces[first + axis] -= gradient[3 * corner + axis];
                    }
                }
            }
        });
        Ok(())
    }

    /// Calls `add` with two free vertices and the block of the potential's second derivative with
    /// respect to both, row by row, in N/m. Each two vertices of a pair come once, in either order,
    /// and each vertex comes with itself.
    ///
    /// The blocks are the Gauss–Newton part, without negative eigenvalues. With the exact second
    /// derivative a stack of sheets took no fewer iterations.
    pub fn add_stiffness(&self, add: &mut dyn FnMut([usize; 2], &[f64; 9])) {
        let SurfaceContact { surface, stiffness, active, friction, .. } = &*self.contact;
        let free = surface.free_count();
        // Barriers and friction both have one block per pair, times the weights of two vertices.
        let mut add_weighted = |vertices: [u32; 4], weights: [f64; 4], block: &Matrix| {
            for a in 0..4 {
                for b in a..4 {
                    let [i, j] = [vertices[a], vertices[b]].map(|vertex| vertex as usize);
                    let weight = weights[a] * weights[b];
                    if i < free && j < free && weight != 0.0 {
                        add([i, j], &block.map(|entry| weight * entry));
                    }
                }
            }
        };
        for ActivePair { pair, gap } in active.iter() {
            let curvature = gap.gauss_newton(*stiffness).factor;
            let block = outer(gap.normal()).map(|entry| curvature * entry);
            add_weighted(pair.vertices, gap.weights(), &block);
        }
        friction.for_each_stiffness(&active.positions, add_weighted);
    }
}

/// Calls `visit` with the vertices and the gradient of each energy, in N: of barriers with
/// `stiffness`, in N/m³, then of friction.
pub(super) fn for_each_gradient(
    stiffness: f64,
    active: &mut ActivePairs,
    friction: &SurfaceFriction,
    mut visit: impl FnMut(&[u32; 4], &Gradient),
) {
    active.for_each_gradient(stiffness, &mut visit);
    friction.for_each_gradient(&active.positions, &mut visit);
}
