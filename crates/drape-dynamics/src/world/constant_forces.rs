//! Constant forces: those that a step begins with act until it ends.

/// Forces on the particles that do not change during a step, so that their potential is linear in
/// the positions.
#[derive(Debug, Default)]
pub(crate) struct ConstantForces {
    /// Three numbers for each particle, in N; empty without forces.
    pub(crate) values: Vec<f64>,
}

impl ConstantForces {
    pub(crate) fn add_forces(&self, forces: &mut [f64]) {
        forces.iter_mut().zip(&self.values).for_each(|(force, own)| *force += own);
    }

    /// Potential, 0 at the origin, in J.
    pub(crate) fn potential(&self, positions: &[f64]) -> f64 {
        self.values.iter().zip(positions).map(|(force, x)| -force * x).sum()
    }

    /// Work of the forces on a straight path between the positions at the start and the end of a
    /// step, in J.
    pub(crate) fn work(&self, start: &[f64], end: &[f64]) -> f64 {
        let moved = end.iter().zip(start).map(|(end, start)| end - start);
        self.values.iter().zip(moved).map(|(force, moved)| force * moved).sum()
    }
}
