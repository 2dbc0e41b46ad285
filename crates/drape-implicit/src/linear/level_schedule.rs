//! Level schedule: the order in which a matrix is eliminated, eight rows at once \[Saad03\].
//!
//! A particle is in the first level after those of all its neighbours of smaller number. The rows
//! of a level do not depend on each other, so they can be eliminated together, and the factor is
//! that of the particles' own order:
//!
//! ```math
//! \mathrm{level}(j) = 1 + \max_{i < j,\ a_{ij} \neq 0} \mathrm{level}(i)
//! ```
//!
//! or 0 without such a neighbour.
//!
//! The rows of a level are taken in *batches* of eight, one row per lane. On a lattice the
//! neighbours of a batch are batches again, at the same few distances all along a level: the
//! *diagonals* of a *run* of batches. A block on no diagonal, such as those along an outline, is an
//! *irregular entry* and is computed by itself.
//!
//! Particles of a large matrix are first divided into parts, which are eliminated side by side, and
//! separators, which are eliminated after them ([`partition`]). Each has levels of its own.
//!
//! Built once per sparsity, in this order: rows ([`row_order`]), runs and places of blocks
//! ([`layout`]), the runs of each part ([`part`]), the division of the runs among threads for all
//! that needs no order ([`chunk`]), updates of the elimination ([`updates`]).

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
    pub(crate) fn new(sparsity: &Sparsity, partition: &Partition) -> Self {
        let layout = BatchLayout::new(sparsity, partition);
        let updates = UpdateTable::new(sparsity, &layout);
        Self { layout, updates }
    }
}
