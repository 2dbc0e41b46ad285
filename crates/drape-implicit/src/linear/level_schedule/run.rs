//! Runs of batches, their diagonals and irregular entries, and the addresses of blocks in the Schur
//! complement.

use core::ops::Range;

use crate::linear::lanes::LANES;

/// Batches of a level that share their diagonals.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    pub start: usize,
    pub end: usize,
    pub diagonals: Range<usize>,
    /// First of its off-diagonal blocks, which are ordered by batch, then by diagonal.
    pub blocks: usize,
    /// First of its batches.
    pub batches: usize,
    /// First of its numbers in the Schur complement: six columns of its rows for the pivots, then
    /// nine for each diagonal.
    pub numbers: usize,
    /// Look-ahead: number of runs, counted from the first of all, that the elimination of this run
    /// and of those before it reads or changes.
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
}

/// Off-diagonal blocks of the rows of a run, all at one distance from their columns.
#[derive(Clone, Debug)]
pub(crate) struct Diagonal {
    /// Column less row.
    pub offset: usize,
    /// Run that the columns lie in.
    pub run: u32,
}

/// Off-diagonal block on no diagonal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IrregularEntry {
    /// Row, counted within its batch.
    pub lane: u32,
    /// Row of its column.
    pub column: u32,
    /// Slot in the matrix.
    pub slot: u32,
}

/// Place of a single block in the Schur complement: its numbers are a stride apart.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BlockAddress {
    pub first: u32,
    pub stride: u32,
}
