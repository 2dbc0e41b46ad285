//! Level schedule: the order in which a matrix is eliminated, eight rows at once \[Saad03\].
//!
//! The level of a particle is the first level after the levels of all neighbours with smaller
//! numbers. The rows of a level do not depend on each other, so they can be eliminated together.
//! The factor equals the factor in the order of the particles' numbers:
//!
//! ```math
//! \mathrm{level}(j) = 1 + \max_{i < j,\ a_{ij} \neq 0} \mathrm{level}(i)
//! ```
//!
//! The level is 0 without such a neighbour.
//!
//! The rows of a level are processed in *batches* of eight, one row per lane. On a lattice the
//! neighbours of a batch are batches too, at a few distances that are constant along a level: the
//! *diagonals* of a *run* of batches. A block on no diagonal, for example along an outline, is an
//! *irregular entry* and is computed separately.
//!
//! Particles of a large matrix are first divided into parts, which are eliminated side by side, and
//! separators, which are eliminated after the parts ([`partition`]). Parts and separators have
//! separate levels.
//!
//! A schedule is built once per sparsity pattern in this order: rows ([`row_order`]), runs and
//! slots of blocks ([`layout`]), the runs of each part ([`part`]), chunks of rows for operations in
//! any order ([`chunk`]), and updates of the elimination ([`updates`]).

pub(crate) mod chunk;
mod grouped;
pub(crate) mod later_blocks;
pub(crate) mod layout;
mod levels;
pub(crate) mod part;
pub(crate) mod partial_sum;
pub(crate) mod partition;
pub(crate) mod row_order;
pub(crate) mod run;
#[cfg(test)]
pub(crate) mod sample;
pub(crate) mod updates;

use crate::linear::sparsity::Sparsity;
use layout::BatchLayout;
use partition::Partition;
use updates::UpdateTable;

/// Layout of a sparsity in batches, and the updates of its elimination.
#[derive(Debug)]
pub(crate) struct LevelSchedule {
    pub layout: BatchLayout,
    pub updates: UpdateTable,
}

impl LevelSchedule {
    /// Returns the schedule of `sparsity`, divided into parts by `partition`.
    pub(crate) fn new(sparsity: &Sparsity, partition: &Partition) -> Self {
        let layout = BatchLayout::new(sparsity, partition);
        let updates = UpdateTable::new(sparsity, &layout);
        Self { layout, updates }
    }
}
