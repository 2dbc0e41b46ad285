//! State of a cloth: positions, velocities and memories. Nothing else changes in time.

use drape_fabric::{Memories, Memory};
use serde::{Deserialize, Serialize};

use crate::kernel::memories::GridMemories;
use crate::rim::memories::RimMemories;

/// State of a cloth: positions, velocities and the memories of its connectors.
///
/// The state holds the accepted positions. A [`Trial`](crate::Trial) borrows the state together
/// with other positions, at which forces and stiffness are evaluated.
///
/// Vectors are flat: particle `i` has the numbers `3i`, `3i + 1`, `3i + 2`. Only
/// [`Cloth::commit`](crate::Cloth::commit) writes the memories.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Positions of the particles, in m.
    pub positions: Vec<f64>,
    /// Velocities of the particles, in m/s.
    pub velocities: Vec<f64>,
    /// Unit normals of the surface at the particles.
    pub(crate) normals: Vec<f64>,
    /// Memories of the connectors on the grids.
    pub(crate) grid: GridMemories,
    /// Memories of the connectors of the rims.
    pub(crate) rim: RimMemories,
    /// Fingerprint of the cloth.
    pub(crate) fingerprint: u64,
}

impl State {
    /// Returns the unit normals of the surface at the particles, along `$u \times v$`.
    #[must_use]
    pub fn normals(&self) -> &[f64] {
        &self.normals
    }

    /// Returns whether this may follow `earlier`, another state of the same cloth: it has as many
    /// particles and connectors, and positions, velocities and normals are finite.
    #[must_use]
    pub fn may_follow(&self, earlier: &Self) -> bool {
        let mut numbers = self.positions.iter().chain(&self.velocities).chain(&self.normals);
        self.fingerprint == earlier.fingerprint
            && self.positions.len() == earlier.positions.len()
            && self.velocities.len() == earlier.velocities.len()
            && self.normals.len() == earlier.normals.len()
            && numbers.all(|number| number.is_finite())
            && self.grid.has_lengths_of(&earlier.grid)
            && self.rim.has_lengths_of(&earlier.rim)
    }

    /// Returns each [`Memory`], for hashes and comparisons, in a fixed order. Memories of rims come
    /// last. Places without a connector, such as the end of a row, have the memory of a connector
    /// that has never been deformed.
    pub fn memories(&self) -> impl Iterator<Item = Memory> {
        let Self { grid, rim, .. } = self;
        let sets = grid.traction.iter().chain(&grid.shear).chain(&grid.bending);
        let sets = sets.chain(&rim.traction).chain([&rim.shear]).chain(&rim.bending);
        sets.flat_map(Memories::iter)
    }
}
