//! Runs of batches, their diagonals and irregular entries, and the addresses of blocks in the Schur
//! complement.

use core::ops::Range;

use super::later_blocks::BlockSlot;
use crate::linear::lanes::LANES;

/// Batches of a level that share their diagonals.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    pub start: usize,
    pub end: usize,
    pub diagonals: Range<usize>,
    /// First of these, counted within the run, that leads from a part to a separator.
    pub crossing: usize,
    /// First of its off-diagonal blocks, which are ordered by batch, then by diagonal.
    pub blocks: usize,
    /// First of its batches.
    pub batches: usize,
    /// First of its numbers in the Schur complement: six columns of its rows for the pivots, then
    /// nine for each diagonal, then nine numbers for each irregular entry.
    pub numbers: usize,
    pub numbers_end: usize,
    /// First of its irregular entries.
    pub irregular: usize,
    /// Look-ahead: number of runs, counted from the first of all, that the elimination of this run
    /// and of those before it in its part reads or changes within the part.
    pub look_ahead: usize,
}

impl Run {
    /// Number of rows.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.end - self.start
    }

    /// Indices of the off-diagonal blocks of a batch.
    #[inline(always)]
    pub(crate) fn blocks_of(&self, batch: usize) -> Range<usize> {
        let first = self.blocks + batch * self.diagonals.len();
        first..first + self.diagonals.len()
    }

    /// Index in the Schur complement of the first number of a batch on a diagonal, both counted
    /// within the run.
    #[inline(always)]
    pub(crate) fn number(&self, diagonal: usize, batch: usize) -> usize {
        self.numbers + (6 + 9 * diagonal) * self.len() + batch * LANES
    }

    /// Address of the block of a row on a diagonal.
    #[inline(always)]
    pub(crate) fn address(&self, diagonal: usize, row: usize) -> BlockAddress {
        let first = self.number(diagonal, 0) + row - self.start;
        BlockAddress { first: first as u32, stride: self.len() as u32 }
    }

    /// Address of an irregular entry.
    #[inline(always)]
    pub(crate) fn irregular_address(&self, index: usize) -> BlockAddress {
        let first = self.number(self.diagonals.len(), 0) + 9 * (index - self.irregular);
        BlockAddress { first: first as u32, stride: 1 }
    }
}

/// Off-diagonal blocks of the rows of a run, all at one distance from their columns.
#[derive(Clone, Debug)]
pub(crate) struct Diagonal {
    /// Column less row. Negative where a separator lies before the part.
    pub offset: isize,
    /// Run that the columns lie in.
    pub run: u32,
}

impl Diagonal {
    /// Column of a row.
    #[inline(always)]
    pub(crate) fn column(&self, row: usize) -> usize {
        row.wrapping_add_signed(self.offset)
    }
}

/// Off-diagonal block on no diagonal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IrregularEntry {
    /// Row, counted within its batch.
    pub lane: u32,
    /// Row of its column.
    pub column: u32,
    pub slot: BlockSlot,
}

/// Place of a single block in the Schur complement: its numbers are a stride apart.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BlockAddress {
    pub first: u32,
    pub stride: u32,
}
