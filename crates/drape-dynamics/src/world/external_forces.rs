//! Forces from outside of the scene: of a program that steps the simulation.
//!
//! They are constant during a step, so that their potential is linear in the positions.

/// Forces on the particles that a program prescribes.
#[derive(Debug, Default)]
pub(crate) struct ExternalForces {
    /// Three numbers for each particle, in N; empty without forces.
    forces: Vec<f64>,
}

impl ExternalForces {
    /// Sets the forces, three numbers for each particle, in N; none at all if there are no numbers.
    pub(crate) fn set(&mut self, forces: &[f64]) {
        self.forces.clear();
        self.forces.extend_from_slice(forces);
    }

    pub(crate) fn add_forces(&self, forces: &mut [f64]) {
        forces.iter_mut().zip(&self.forces).for_each(|(force, own)| *force += own);
    }

    /// Potential, 0 at the origin, in J.
    pub(crate) fn potential(&self, positions: &[f64]) -> f64 {
        self.forces.iter().zip(positions).map(|(force, x)| -force * x).sum()
    }

    /// Work on the way from some positions to others, in J.
    pub(crate) fn work(&self, start: &[f64], end: &[f64]) -> f64 {
        let moved = end.iter().zip(start).map(|(end, start)| end - start);
        self.forces.iter().zip(moved).map(|(force, moved)| force * moved).sum()
    }
}
