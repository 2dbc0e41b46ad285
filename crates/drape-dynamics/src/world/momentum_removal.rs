//! Removal of momentum in quasi-static relaxation: every step then starts from rest.

use super::constant_forces::ConstantForces;

/// Forces that remove the momentum with which particles enter a step, in N.
///
/// A step of relaxation starts from rest, but the velocity at its start is a good first guess for
/// the end of the step. A constant force removes the momentum during the step.
#[derive(Debug, Default)]
pub(crate) struct MomentumRemoval {
    active: bool,
    /// Forces of the step. Empty if momentum is kept.
    pub(crate) forces: ConstantForces,
}

impl MomentumRemoval {
    /// Sets whether the momentum of `particles` particles is removed from now on.
    pub(crate) fn set_active(&mut self, active: bool, particles: usize) {
        self.active = active;
        self.forces.values.clear();
        self.forces.values.resize(if active { 3 * particles } else { 0 }, 0.0);
    }

    /// Returns whether momentum is removed.
    pub(crate) fn is_active(&self) -> bool {
        self.active
    }

    /// Prepares a step of the length `dt`, in s, of particles with `masses`, in kg, from
    /// `velocities`, in m/s.
    pub(crate) fn begin(&mut self, masses: &[f64], velocities: &[f64], dt: f64) {
        let momenta = self.forces.values.chunks_exact_mut(3).zip(velocities.chunks_exact(3));
        for ((force, velocity), mass) in momenta.zip(masses) {
            for (force, v) in force.iter_mut().zip(velocity) {
                *force = -mass * v / dt;
            }
        }
    }

    /// Sets the forces to zero until the next step begins.
    pub(crate) fn clear(&mut self) {
        self.forces.values.fill(0.0);
    }
}
