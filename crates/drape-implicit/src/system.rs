//! Interface of a system of particles: masses, forces, potential and stiffness.

use crate::linear::block_matrix::BlockMatrix;
use crate::linear::sparsity::Sparsity;

/// Variant of the stiffness that [`System::stiffness`] writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stiffness {
    /// Hessian of the potential, indefinite where the system buckles. With this stiffness Newton's
    /// method converges fast.
    Exact,
    /// Positive semi-definite approximation of the Hessian, used where the exact stiffness has a
    /// direction of negative curvature.
    Definite,
}

/// Position of a particle on a smooth sheet, in coordinates of the undeformed material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaterialPoint {
    /// Number of the sheet.
    pub sheet: u32,
    /// Material coordinates, in m.
    pub coordinates: [f64; 2],
    /// Spacing of the particles around this point, in m.
    pub spacing: f64,
}

/// System of particles in three dimensions, with masses, forces and a stiffness. Held particles
/// have prescribed motions.
///
/// Vectors are flat, three entries per particle: `x₀ y₀ z₀ x₁ …`. Positions are in m, forces in N.
/// Indices such as the rows and columns of a matrix count particles, from 0, and not coordinates.
///
/// The solver calls `begin` at the start of a (sub)step, then `forces`, `potential` and `stiffness`
/// any number of times in any order. A (sub)step that succeeded ends with `accept`. After one that
/// failed the next call is `begin` again. The memory of a system (friction, plasticity, lagged
/// normals) is constant from `begin` to `accept`, so that forces are a function of the end
/// positions alone. Only `accept` may change the memory. Forces that depend on velocity use the
/// mean velocity of the step, which is a function of the end positions too.
///
/// A trial position may be unphysical, inside an obstacle for instance. The system then returns a
/// NaN or infinite force. The solver never accepts such a position.
pub trait System {
    /// Number of particles.
    fn particle_count(&self) -> usize;

    /// Mass of each particle, finite and positive, in kg. The solver reads this list at each call
    /// of [`Stepper::advance`](crate::Stepper::advance).
    fn masses(&self) -> &[f64];

    /// Whether the motion of each particle is prescribed, one entry per particle. The solver reads
    /// this list after each [`begin`](Self::begin).
    fn held(&self) -> &[bool];

    /// Begins an attempt at a (sub)step that ends at `end_time` and lasts `dt`, both in s, from the
    /// positions `start`.
    ///
    /// Writes the end positions of held particles into `target`, which holds `start` on entry. The
    /// solver ignores the entries of free particles.
    fn begin(&mut self, end_time: f64, dt: f64, start: &[f64], target: &mut [f64]);

    /// Overwrites `forces` with the force on each particle, weight included, in N.
    fn forces(&mut self, positions: &[f64], forces: &mut [f64]);

    /// Returns the incremental potential at `positions`, in J. Its negative gradient is `forces`.
    ///
    /// Within a step, where the memory is constant, friction has a potential too: the work against
    /// friction since the start of the step.
    fn potential(&mut self, positions: &[f64]) -> f64;

    /// Adds the negative derivative of the forces at `positions` to `matrix`, in N/m. The matrix
    /// holds zeros on entry. `kind` selects the exact stiffness or its definite approximation.
    ///
    /// Held particles need no special care: the solver removes their rows and columns afterwards.
    fn stiffness(&mut self, positions: &[f64], kind: Stiffness, matrix: &mut BlockMatrix);

    /// Sparsity of the stiffness: the pairs of particles that it couples.
    fn sparsity(&self) -> Sparsity;

    /// Version number that changes whenever [`sparsity`](Self::sparsity) changes. The solver reads
    /// it once per call of [`Stepper::advance`](crate::Stepper::advance).
    fn sparsity_version(&self) -> u64 {
        0
    }

    /// Material point of each particle, or an empty list if the particles form no sheets. The
    /// solver reads this list whenever it reads the [`sparsity`](Self::sparsity).
    ///
    /// With material points, systems of at least 8 000 particles take fewer iterations of conjugate
    /// gradients: a coarse grid resolves the motions that are smooth along the sheets. Steps with
    /// an [energy tolerance](crate::Settings::energy_tolerance) do not use the points.
    fn material_points(&self) -> Vec<MaterialPoint> {
        Vec::new()
    }

    /// Returns whether the caller wants to cancel the current step. The solver asks in every
    /// iteration. A cancelled step ends with [`Error::Cancelled`](crate::Error::Cancelled).
    fn is_cancelled(&self) -> bool {
        false
    }

    /// Ends an accepted (sub)step of length `dt`, in s. The memory may advance to the end
    /// `positions`, in m, and `velocities`, in m/s.
    fn accept(&mut self, positions: &[f64], velocities: &[f64], dt: f64);
}
