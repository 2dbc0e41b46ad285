//! Placement: positions of all vertices, and a number for where bodies at rest are.

use std::ops::Deref;

/// Positions of all vertices of a surface, the free ones first.
///
/// A body may have a hundred times as many vertices as the cloth on it. Two placements with the same
/// stand differ in their free vertices alone, and only these are copied and compared.
#[derive(Debug, Clone, Default)]
pub(crate) struct Placement {
    /// Flat, in m.
    positions: Vec<f64>,
    /// Number of the positions at which the bodies rest; none while they move.
    stand: Option<u64>,
}

impl Deref for Placement {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.positions
    }
}

impl Placement {
    /// Number of the positions at which the bodies rest; none while they move.
    pub(crate) fn stand(&self) -> Option<u64> {
        self.stand
    }

    /// Places the free vertices, and bodies that have a stand or move.
    pub(crate) fn place(
        &mut self,
        free: &[f64],
        stand: Option<u64>,
        bodies: impl ExactSizeIterator<Item = f64>,
    ) {
        let length = free.len() + bodies.len();
        if stand.is_some() && self.stand == stand && self.positions.len() == length {
            self.positions[..free.len()].copy_from_slice(free);
            return;
        }
        self.positions.clear();
        self.positions.extend_from_slice(free);
        self.positions.extend(bodies);
        self.stand = stand;
    }

    /// Returns whether another placement has the same positions; never if one is not a number.
    pub(crate) fn is_same(&self, other: &Placement, free: usize) -> bool {
        let compared = match self.stand.is_some() && self.stand == other.stand {
            true => 3 * free,
            false => self.positions.len(),
        };
        self.positions.len() == other.positions.len()
            && self.positions[..compared] == other.positions[..compared]
    }

    /// Drops the positions.
    pub(crate) fn clear(&mut self) {
        self.positions.clear();
        self.stand = None;
    }
}

/// Start of a trial step: flat positions of all vertices, in m, of which the first ones may have left
/// the reference positions of the candidate pairs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepStart<'a> {
    pub(crate) positions: &'a [f64],
    /// Number of the vertices that may have left them.
    pub(crate) moved: usize,
}
