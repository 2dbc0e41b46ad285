use drape_fabric::Memory;

/// Where a cloth is and what its yarns remember: everything that changes in time.
///
/// Vectors are flat: particle `i` has the numbers `3i`, `3i + 1`, `3i + 2`. The memory is written by
/// [`Cloth::commit`](crate::Cloth::commit) alone.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Positions of the particles, in m.
    pub positions: Vec<f64>,
    /// Velocities of the particles, in m/s.
    pub velocities: Vec<f64>,
    /// Unit normals of the surface at the particles.
    pub(crate) normals: Vec<f64>,
    /// Memories of the segments, one list per set of connectors.
    pub(crate) traction: Vec<Vec<Memory>>,
    /// Memories of the corners.
    pub(crate) shear: Vec<Vec<Memory>>,
    /// Memories of the triples.
    pub(crate) bending: Vec<Vec<Memory>>,
}

impl State {
    /// Unit normals of the surface at the particles, along `$u \times v$`.
    #[must_use]
    pub fn normals(&self) -> &[f64] {
        &self.normals
    }

    /// All memories, for hashing and comparing: set by set, connector by connector.
    pub fn memories(&self) -> impl Iterator<Item = &Memory> {
        self.traction
            .iter()
            .chain(&self.shear)
            .chain(&self.bending)
            .flatten()
    }
}
