//! Placement: positions of all vertices, with a revision number for bodies at rest.

use std::ops::Deref;

/// Positions of all vertices of a surface, the free ones first.
///
/// Placements of one revision have equal positions of all bodies. Then only the free vertices are
/// copied and compared, because a body may have a hundred times more vertices than the cloth on it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Placement {
    /// Flat positions, in m.
    positions: Vec<f64>,
    /// Revision of the bodies' positions, `None` while bodies move.
    revision: Option<u64>,
}

impl Deref for Placement {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.positions
    }
}

impl Placement {
    /// Returns the revision of the bodies' positions, `None` while bodies move.
    pub(crate) fn revision(&self) -> Option<u64> {
        self.revision
    }

    /// Sets the positions of the `free` vertices, and the positions of `bodies` unless this
    /// placement has their `revision` already.
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

    /// Returns whether `other` has equal positions. `free_count` is the number of free vertices. A
    /// NaN in the position of a free vertex makes placements differ.
    pub(crate) fn is_same(&self, other: &Placement, free_count: usize) -> bool {
        let bodies_equal = self.revision.is_some() && self.revision == other.revision;
        let compared = if bodies_equal { 3 * free_count } else { self.positions.len() };
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
    /// Number of leading vertices that may differ from the reference positions of the candidate
    /// pairs. All later vertices are at their reference positions.
    pub(crate) moved: usize,
}

impl StepStart<'_> {
    /// Returns a start at which every vertex of `positions` may differ from its reference position.
    pub(crate) fn new(positions: &[f64]) -> StepStart<'_> {
        StepStart { positions, moved: positions.len() / 3 }
    }
}
