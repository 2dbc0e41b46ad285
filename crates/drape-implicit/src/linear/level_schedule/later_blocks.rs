//! Later blocks: the off-diagonal blocks of each row whose columns are eliminated after the row.

use super::grouped::Grouped;
use super::row_order::RowOrder;
use crate::linear::block::{self, Block};
use crate::linear::sparsity::Sparsity;

/// Bit of a slot whose block is transposed, because the column of the stored block is eliminated
/// before its row.
const TRANSPOSED: u32 = 1 << 31;

/// Slot of a block of the matrix, or of its transpose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct BlockSlot(u32);

impl BlockSlot {
    /// Marker of a lane without a block, which holds zeros.
    pub(crate) const ABSENT: Self = Self(u32::MAX);

    /// Returns the slot of the matrix, without the bit of the transpose.
    #[inline(always)]
    pub(crate) fn slot(self) -> usize {
        (self.0 & !TRANSPOSED) as usize
    }

    #[inline(always)]
    pub(crate) fn is_transposed(self) -> bool {
        self != Self::ABSENT && self.0 & TRANSPOSED != 0
    }

    /// Returns the stored block, not transposed, or `none` for an absent block.
    #[inline(always)]
    pub(crate) fn stored<'a>(self, blocks: &'a [Block], none: &'a Block) -> &'a Block {
        if self == Self::ABSENT { none } else { &blocks[self.slot()] }
    }

    /// Returns the block from `blocks`, transposed if needed.
    #[inline(always)]
    pub(crate) fn copy(self, blocks: &[Block]) -> Block {
        let stored = self.stored(blocks, &block::ZERO);
        if self.is_transposed() { block::transposed(stored) } else { *stored }
    }
}

/// Off-diagonal block of a row, and its column.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LaterBlock {
    pub slot: BlockSlot,
    pub column: usize,
}

/// Returns the later blocks of each row of `order`.
pub(super) fn later_blocks(sparsity: &Sparsity, order: &RowOrder) -> Grouped<LaterBlock> {
    let blocks = (0..sparsity.particle_count()).flat_map(|particle| {
        let row = order.row_of[particle] as usize;
        sparsity.row(particle).skip(1).map(move |slot| {
            let column = order.row_of[sparsity.columns()[slot] as usize] as usize;
            if order.rank(row) < order.rank(column) {
                (row, LaterBlock { slot: BlockSlot(slot as u32), column })
            } else {
                let slot = BlockSlot(slot as u32 | TRANSPOSED);
                (column, LaterBlock { slot, column: row })
            }
        })
    });
    Grouped::new(order.particles.len(), blocks)
}
