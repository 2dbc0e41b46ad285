//! Later blocks: the off-diagonal blocks of each row whose columns are eliminated after it.

use super::grouped::Grouped;
use super::row_order::RowOrder;
use crate::linear::block::{self, Block};
use crate::linear::sparsity::Sparsity;

/// Mark of a slot whose block is transposed: its column is eliminated before its row.
const TRANSPOSED: u32 = 1 << 31;

/// Block of the matrix, or its transpose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct BlockSlot(u32);

impl BlockSlot {
    /// No block: a lane with zeros.
    pub(crate) const ABSENT: Self = Self(u32::MAX);

    /// Slot of the matrix.
    #[inline(always)]
    pub(crate) fn slot(self) -> usize {
        (self.0 & !TRANSPOSED) as usize
    }

    #[inline(always)]
    pub(crate) fn is_transposed(self) -> bool {
        self != Self::ABSENT && self.0 & TRANSPOSED != 0
    }

    /// Block of the matrix, not transposed, or `none`.
    #[inline(always)]
    pub(crate) fn stored<'a>(self, blocks: &'a [Block], none: &'a Block) -> &'a Block {
        if self == Self::ABSENT { none } else { &blocks[self.slot()] }
    }

    /// Copy of the block.
    #[inline(always)]
    pub(crate) fn copy(self, blocks: &[Block]) -> Block {
        let stored = self.stored(blocks, &block::ZERO);
        if self.is_transposed() { block::transposed(stored) } else { *stored }
    }
}

/// Block of a row and its column.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LaterBlock {
    pub slot: BlockSlot,
    pub column: usize,
}

/// Later blocks of each row.
pub(super) fn later_blocks(sparsity: &Sparsity, order: &RowOrder) -> Grouped<LaterBlock> {
    let blocks = (0..sparsity.particles()).flat_map(|particle| {
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
