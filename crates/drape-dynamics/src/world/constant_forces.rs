//! Forces that are constant during a step.

/// Forces on the particles that do not change during a step, so that their potential is linear in
/// the positions.
#[derive(Debug, Default)]
pub(crate) struct ConstantForces {
    /// Three components for each particle, in N. Empty if there are no forces.
    pub(crate) values: Vec<f64>,
}

impl ConstantForces {
    /// Adds the constant forces to `forces`, in N.
    pub(crate) fn add_forces(&self, forces: &mut [f64]) {
        forces.iter_mut().zip(&self.values).for_each(|(force, constant)| *force += constant);
    }

    /// Returns the potential at `positions`, in J. It is 0 at the origin.
    pub(crate) fn potential(&self, positions: &[f64]) -> f64 {
        self.values.iter().zip(positions).map(|(force, x)| -force * x).sum()
    }

    /// Returns the work of the forces on a straight path from the positions `start` to `end`, in J.
    pub(crate) fn work(&self, start: &[f64], end: &[f64]) -> f64 {
        let moved = end.iter().zip(start).map(|(end, start)| end - start);
        self.values.iter().zip(moved).map(|(force, moved)| force * moved).sum()
    }
}
