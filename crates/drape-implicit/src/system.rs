//! Interface of a system of particles: masses, forces, potential and stiffness.

use crate::linear::block_matrix::BlockMatrix;
use crate::linear::sparsity::Sparsity;

/// Variant of the stiffness that [`System::stiffness`] writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stiffness {
    /// Hessian of the potential, indefinite where the system buckles. Newton's method converges
    /// fast with it.
    Exact,
    /// Positive semi-definite approximation, used where the exact one has a direction of negative
    /// curvature.
    Definite,
}

/// Place of a particle on a smooth sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaterialPoint {
    /// Number of the sheet.
    pub sheet: u32,
    /// Material coordinates, in m.
    pub coordinates: [f64; 2],
    /// Spacing of the particles around it, in m.
    pub spacing: f64,
}

/// System of particles in three dimensions, with masses, forces and a stiffness. Held particles
/// move by prescription.
///
/// Vectors are flat, three entries per particle: `x₀ y₀ z₀ x₁ …`. Positions are in m, forces in N.
///
/// One (sub)step calls `begin`, then any number of `forces`, `potential` and `stiffness` in any
/// order, and then `accept` if it succeeded or the next `begin` if it failed. The memory of a
/// system (friction, plasticity, lagged normals) is frozen between them, so that forces are a
/// function of the end positions alone; only `accept` may change it. Forces that depend on velocity
/// use the mean velocity of the step, which is such a function too.
///
/// A trial position may be unphysical, inside an obstacle for instance. A NaN or infinite force
/// says so, and such a position is never accepted.
pub trait System {
    /// Number of particles.
    fn particles(&self) -> usize;

    /// Mass of each particle, finite and positive, in kg.
    fn masses(&self) -> &[f64];

    /// Whether each particle moves by prescription. Read after each [`begin`](Self::begin).
    fn held(&self) -> &[bool];

    /// Begins an attempt at a (sub)step that ends at `end_time` and lasts `dt`, both in s, from the
    /// positions `start`.
    ///
    /// Writes the end positions of held particles into `target`, which is filled with `start` on
    /// entry; those of free particles are ignored.
    fn begin(&mut self, end_time: f64, dt: f64, start: &[f64], target: &mut [f64]);

    /// Overwrites `forces` with the force on each particle, weight included, in N.
    fn forces(&mut self, positions: &[f64], forces: &mut [f64]);

    /// Incremental potential whose negative gradient is the forces, in J.
    ///
    /// Within a step friction with frozen memory has one too: the work done against it since the
    /// start.
    fn potential(&mut self, positions: &[f64]) -> f64;

    /// Adds the negative derivative of the forces to `matrix`, which is filled with zeros on entry,
    /// in N/m.
    ///
    /// Held particles need no special care; their rows and columns are removed afterwards.
    fn stiffness(&mut self, positions: &[f64], kind: Stiffness, matrix: &mut BlockMatrix);

    /// Sparsity of the stiffness: the pairs of particles that it couples.
    fn sparsity(&self) -> Sparsity;

    /// Number that changes when [`sparsity`](Self::sparsity) does. Read once per call of
    /// [`Stepper::advance`](crate::Stepper::advance).
    fn sparsity_version(&self) -> u64 {
        0
    }

    /// Material point of each particle; empty if the particles form no sheets. Read when the
    /// [`sparsity`](Self::sparsity) is.
    ///
    /// From 8 000 particles on, linear systems are then solved in fewer iterations: motions that are
    /// smooth along the sheets are solved for on a coarse grid. Steps with an
    /// [energy tolerance](crate::Settings::energy_tolerance) do without.
    fn material_points(&self) -> Vec<MaterialPoint> {
        Vec::new()
    }

    /// Whether the step in hand is to be given up. Asked in every iteration; the step then ends with
    /// [`Error::Cancelled`](crate::Error::Cancelled).
    fn is_cancelled(&self) -> bool {
        false
    }

    /// Ends an accepted (sub)step: the memory may advance to its end positions, in m, and
    /// velocities, in m/s.
    fn accept(&mut self, positions: &[f64], velocities: &[f64], dt: f64);
}
