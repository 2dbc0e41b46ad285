//! Removal of momentum in quasi-static relaxation: every step then starts from rest.

use super::constant_forces::ConstantForces;

/// Forces that remove the momentum with which particles enter a step, in N.
///
/// A step of relaxation is to start from rest, but the velocity with which the cloth enters it
/// makes a good first guess of its end. A constant force takes the momentum out during the step.
#[derive(Debug, Default)]
pub(crate) struct MomentumRemoval {
    active: bool,
    /// Forces of the step; none where momentum stays.
    pub(crate) forces: ConstantForces,
}

impl MomentumRemoval {
    /// Removes the momentum of so many particles from now on, or lets it be.
    pub(crate) fn set_active(&mut self, active: bool, particles: usize) {
        self.active = active;
        self.forces.values.clear();
        self.forces.values.resize(if active { 3 * particles } else { 0 }, 0.0);
    }

    /// Whether momentum is removed.
    pub(crate) fn is_active(&self) -> bool {
        self.active
    }

    /// Opens a step of a length, in s, from velocities, in m/s.
    pub(crate) fn begin(&mut self, masses: &[f64], velocities: &[f64], dt: f64) {
        let momenta = self.forces.values.chunks_exact_mut(3).zip(velocities.chunks_exact(3));
        for ((force, velocity), mass) in momenta.zip(masses) {
            for (force, v) in force.iter_mut().zip(velocity) {
                *force = -mass * v / dt;
            }
        }
    }

    /// Takes the forces out until the next step begins.
    pub(crate) fn clear(&mut self) {
        self.forces.values.fill(0.0);
    }
}
