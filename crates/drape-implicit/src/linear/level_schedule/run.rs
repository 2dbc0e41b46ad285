//! Runs of batches, their diagonals and irregular entries, and the addresses of blocks in the Schur
//! complement.

use core::ops::Range;

use super::later_blocks::BlockSlot;
use crate::linear::lanes::LANES;

/// Batches of a level with common diagonals.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    /// First row.
    pub start: usize,
    /// End of the rows.
    pub end: usize,
    /// Indices of the diagonals.
    pub diagonals: Range<usize>,
    /// First diagonal, counted within the run, that leads from a part to a separator.
    pub crossing: usize,
    /// Index of the first off-diagonal block. Blocks are ordered by batch, then by diagonal.
    pub blocks: usize,
    /// Index of the first batch.
    pub batches: usize,
    /// Index of the first number in the Schur complement. The pivots have six columns with one
    /// number per row of the run. Then each diagonal has nine such columns, and each irregular
    /// entry nine numbers.
    pub numbers: usize,
    /// End of the numbers in the Schur complement.
    pub numbers_end: usize,
    /// Index of the first irregular entry.
    pub irregular: usize,
    /// Look-ahead: end of the runs that the elimination of this run, and of earlier runs of the
    /// part, reads or changes within the part.
    pub look_ahead: usize,
}

impl Run {
    /// Returns the number of rows.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.end - self.start
    }

    /// Returns the indices of the off-diagonal blocks of `batch`, counted within the run.
    #[inline(always)]
    pub(crate) fn blocks_of(&self, batch: usize) -> Range<usize> {
        let first = self.blocks + batch * self.diagonals.len();
        first..first + self.diagonals.len()
    }

    /// Returns the index in the Schur complement of the first number of `batch` on `diagonal`, both
    /// counted within the run.
    #[inline(always)]
    pub(crate) fn number(&self, diagonal: usize, batch: usize) -> usize {
        self.numbers + (6 + 9 * diagonal) * self.len() + batch * LANES
    }

    /// Returns the address of the block of `row` on `diagonal`, counted within the run.
    #[inline(always)]
    pub(crate) fn address(&self, diagonal: usize, row: usize) -> BlockAddress {
        let first = self.number(diagonal, 0) + row - self.start;
        BlockAddress { first: first as u32, stride: self.len() as u32 }
    }

    /// Returns the address of the irregular entry `index`.
    #[inline(always)]
    pub(crate) fn irregular_address(&self, index: usize) -> BlockAddress {
        let first = self.number(self.diagonals.len(), 0) + 9 * (index - self.irregular);
        BlockAddress { first: first as u32, stride: 1 }
    }
}

/// Off-diagonal blocks of the rows of a run with one distance between row and column.
#[derive(Clone, Debug)]
pub(crate) struct Diagonal {
    /// Column less row, negative if a separator lies before the part.
    pub offset: isize,
    /// Run of the columns.
    pub run: u32,
}

impl Diagonal {
    /// Returns the column of the block in `row`.
    #[inline(always)]
    pub(crate) fn column(&self, row: usize) -> usize {
        row.wrapping_add_signed(self.offset)
    }
}

/// Off-diagonal block on no diagonal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IrregularEntry {
    /// Row, counted within the batch.
    pub lane: u32,
    /// Column, as a row of the layout.
    pub column: u32,
    pub slot: BlockSlot,
}

/// Address of a block in the Schur complement. Its numbers begin at `first` and are a `stride`
/// apart.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BlockAddress {
    pub first: u32,
    pub stride: u32,
}
