use crate::{BlockMatrix, Sparsity};

/// Which derivative of the forces [`System::stiffness`] writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stiffness {
    /// The exact one, indefinite where the system buckles. It makes Newton's method converge fast.
    Exact,
    /// A positive semi-definite one near it, used where the exact one has a direction of negative curvature.
    Definite,
}

/// Particles in three dimensions with masses, forces and a stiffness, some of them moved by prescription.
///
/// Vectors are flat, three entries per particle: `x₀ y₀ z₀ x₁ …`. Positions are in m, forces in N.
///
/// One (sub)step runs `begin`, then any number of `forces`, `potential` and `stiffness` in any order, and then
/// `accept` if it succeeded or the next `begin` if it failed. Whatever the system remembers (friction,
/// plasticity, lagged normals) is frozen between them, so that forces are a function of the end positions
/// alone; only `accept` may change it for good. Velocity-dependent forces use the step's mean velocity, which
/// is such a function too.
///
/// A trial position may be unphysical, inside an obstacle for instance: a NaN or infinite force says so, and is
/// never accepted.
pub trait System {
    /// Number of particles.
    fn particles(&self) -> usize;

    /// Mass of each particle, finite and positive, in kg.
    fn masses(&self) -> &[f64];

    /// Which particles move by prescription; asked after each [`begin`](Self::begin).
    fn held(&self) -> &[bool];

    /// Opens an attempted (sub)step that ends at `end_time` and lasts `dt`, both in s, from the positions
    /// `start`. Writes the end positions of held particles into `target`, which comes filled with `start`;
    /// what it says of free particles is ignored.
    fn begin(&mut self, end_time: f64, dt: f64, start: &[f64], target: &mut [f64]);

    /// Overwrites `forces` with the force on each particle, weight included, in N.
    fn forces(&mut self, positions: &[f64], forces: &mut [f64]);

    /// Incremental potential whose negative gradient is the forces, in J.
    ///
    /// Within a step friction with frozen memory has one too: the work done against it since the start.
    fn potential(&mut self, positions: &[f64]) -> f64;

    /// Adds the negative derivative of the forces to `matrix`, which comes filled with zeros, in N/m.
    ///
    /// Held particles need no special care; their rows are cut out afterwards.
    fn stiffness(&mut self, positions: &[f64], kind: Stiffness, matrix: &mut BlockMatrix);

    /// Which pairs of particles the stiffness couples.
    fn sparsity(&self) -> Sparsity;

    /// A number that changes when [`sparsity`](Self::sparsity) does. Read once per call of
    /// [`Stepper::advance`](crate::Stepper::advance).
    fn sparsity_version(&self) -> u64 {
        0
    }

    /// Closes an accepted (sub)step: memory may advance to these end positions (m) and velocities (m/s).
    fn accept(&mut self, positions: &[f64], velocities: &[f64], dt: f64);
}
