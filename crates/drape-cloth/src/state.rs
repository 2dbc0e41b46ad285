//! State of a cloth: positions, velocities and memories, all that changes in time.

use drape_fabric::{Memories, Memory};
use serde::{Deserialize, Serialize};

use crate::kernel::memories::GridMemories;
use crate::rim::memories::RimMemories;

/// State of a cloth: positions, velocities and the memories of its connectors.
///
/// It owns the accepted positions; a [`Trial`](crate::Trial) borrows it beside other positions, at
/// which forces and stiffness are evaluated.
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
}

impl State {
    /// Unit normals of the surface at the particles, along `$u \times v$`.
    #[must_use]
    pub fn normals(&self) -> &[f64] {
        &self.normals
    }

    /// Returns whether this may follow another state of the same cloth: it has as many particles and
    /// connectors, and positions, velocities and normals are finite.
    #[must_use]
    pub fn may_follow(&self, other: &Self) -> bool {
        let vectors = |own: &Self| [&own.positions, &own.velocities, &own.normals].map(Vec::len);
        let mut numbers = self.positions.iter().chain(&self.velocities).chain(&self.normals);
        vectors(self) == vectors(other)
            && numbers.all(|number| number.is_finite())
            && self.grid.has_lengths_of(&other.grid)
            && self.rim.has_lengths_of(&other.rim)
    }

    /// All memories, for hashing and comparing, in a fixed order; those of rims come last. Where
    /// there is no connector, as at the end of a row, the memory is that of a connector never
    /// deformed.
    pub fn memories(&self) -> impl Iterator<Item = Memory> {
        let Self { grid, rim, .. } = self;
        let sets = grid.traction.iter().chain(&grid.shear).chain(&grid.bending);
        let sets = sets.chain(&rim.traction).chain([&rim.shear]).chain(&rim.bending);
        sets.flat_map(Memories::iter)
    }
}
