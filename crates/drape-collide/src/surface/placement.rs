//! Placement: positions of all vertices, and the revision of those of bodies at rest.

use std::ops::Deref;

/// Positions of all vertices of a surface, the free ones first.
///
/// Placements of the same revision have the same positions of all bodies, so that only the free
/// vertices are copied and compared: a body may have a hundred times as many as the cloth on it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Placement {
    /// Flat, in m.
    positions: Vec<f64>,
    /// Revision of the bodies' positions; none while they move.
    revision: Option<u64>,
}

impl Deref for Placement {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.positions
    }
}

impl Placement {
    /// Revision of the bodies' positions; none while they move.
    pub(crate) fn revision(&self) -> Option<u64> {
        self.revision
    }

    /// Sets the positions of the free vertices, and those of the bodies unless they have the revision
    /// already.
    pub(crate) fn place(
        &mut self,
        free: &[f64],
        revision: Option<u64>,
        bodies: impl ExactSizeIterator<Item = f64>,
    ) {
        let length = free.len() + bodies.len();
        if revision.is_some() && self.revision == revision && self.positions.len() == length {
            self.positions[..free.len()].copy_from_slice(free);
            return;
        }
        self.positions.clear();
        self.positions.extend_from_slice(free);
        self.positions.extend(bodies);
        self.revision = revision;
    }

    /// Returns whether another placement has the same positions; `free` is the number of free vertices.
    /// A free vertex with NaN in its position is never the same.
    pub(crate) fn is_same(&self, other: &Placement, free: usize) -> bool {
        let compared = match self.revision.is_some() && self.revision == other.revision {
            true => 3 * free,
            false => self.positions.len(),
        };
        self.positions.len() == other.positions.len()
            && self.positions[..compared] == other.positions[..compared]
    }

    /// Drops the positions.
    pub(crate) fn clear(&mut self) {
        self.positions.clear();
        self.revision = None;
    }
}

/// Start of a trial step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepStart<'a> {
    /// Flat positions of all vertices, in m.
    pub(crate) positions: &'a [f64],
    /// Number of the first vertices, which may differ from the reference positions of the candidate
    /// pairs; the others do not.
    pub(crate) moved: usize,
}

impl StepStart<'_> {
    /// Start at which every vertex may differ from the reference positions.
    pub(crate) fn new(positions: &[f64]) -> StepStart<'_> {
        StepStart { positions, moved: positions.len() / 3 }
    }
}
