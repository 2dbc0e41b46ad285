//! Updates of the elimination: which products of blocks are subtracted from which later blocks.

use core::ops::Range;

use super::later_blocks::BlockSlot;
use super::layout::BatchLayout;
use super::row_order::ABSENT;
use super::run::{BlockAddress, Run};
use crate::linear::lanes::LANES;
use crate::linear::sparsity::Sparsity;

/// Updates of all runs, by diagonal, and of single lanes, by batch.
#[derive(Debug, Default)]
pub(crate) struct UpdateTable {
    pub regular: Vec<Update>,
    /// Updates of each diagonal with the later diagonals of its run. Each block also updates the
    /// pivots of its column.
    pub regular_of: Vec<Range<usize>>,
    pub irregular: Vec<IrregularUpdate>,
    /// Updates of single lanes of each batch.
    pub irregular_of: Vec<Range<usize>>,
}

/// Product of the blocks of a diagonal and those of another one of its run, subtracted from a
/// third.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Update {
    /// The other diagonal, counted within the run.
    pub right: u32,
    /// The third diagonal, counted within the run of the first one's columns, or [`ABSENT`].
    pub target: u32,
}

/// Product of two blocks of a lane, subtracted from a third one.
///
/// Blocks are numbered: the diagonals of the run first, then the irregular entries of the batch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IrregularUpdate {
    pub lane: u32,
    /// Block whose column is eliminated first.
    pub left: u32,
    pub right: u32,
    pub target: UpdateTarget,
}

/// Block that an update is subtracted from.
#[derive(Clone, Copy, Debug)]
pub(crate) enum UpdateTarget {
    Block(BlockAddress),
    /// Pivots of both columns, in place of a block that is not in the sparsity.
    Dropped([BlockAddress; 2]),
}

/// Off-diagonal block of a lane, numbered as in [`IrregularUpdate`], and its column.
#[derive(Clone, Copy)]
struct LaneBlock {
    number: usize,
    column: usize,
}

/// Two diagonals of a run, counted within it, whose products are computed lane by lane.
type DiagonalPair = [usize; 2];

impl UpdateTable {
    pub(crate) fn new(sparsity: &Sparsity, layout: &BatchLayout) -> Self {
        let mut table = Self::default();
        for run in &layout.runs {
            let by_lane = table.add_regular(sparsity, layout, run);
            for batch in 0..run.len() / LANES {
                let first = table.irregular.len();
                for lane in 0..LANES {
                    table.add_irregular(layout, run, batch * LANES + lane, &by_lane);
                }
                table.irregular_of.push(first..table.irregular.len());
            }
        }
        table
    }

    /// Adds the updates of pairs of diagonals of a run. Returns the pairs whose product is a block
    /// of the sparsity on no diagonal, in some lane at least.
    fn add_regular(
        &mut self,
        sparsity: &Sparsity,
        layout: &BatchLayout,
        run: &Run,
    ) -> Vec<DiagonalPair> {
        let particles = &layout.order.particles;
        let first_diagonal = run.diagonals.start;
        let mut by_lane = Vec::new();
        for left in run.diagonals.clone() {
            let first = self.regular.len();
            let a = &layout.diagonals[left];
            let others = &layout.diagonals[layout.runs[a.run as usize].diagonals.clone()];
            for right in left + 1..run.diagonals.end {
                let b = &layout.diagonals[right];
                let target = others
                    .iter()
                    .position(|d| d.run == b.run && a.offset + d.offset == b.offset)
                    .map_or(ABSENT, |place| place as u32);
                let coupled = |row: usize| {
                    let ends = [a.column(row), b.column(row)].map(|row| particles.get(row));
                    matches!(ends, [Some(&a), Some(&b)] if a != ABSENT && b != ABSENT
                        && sparsity.slot(a as usize, b as usize).is_some())
                };
                if target == ABSENT && (run.start..run.end).any(coupled) {
                    by_lane.push([left - first_diagonal, right - first_diagonal]);
                } else {
                    self.regular.push(Update { right: (right - first_diagonal) as u32, target });
                }
            }
            self.regular_of.push(first..self.regular.len());
        }
        by_lane
    }

    /// Adds the updates of a row, counted within its run: of the given pairs of diagonals, and of
    /// all pairs with irregular entries in them.
    fn add_irregular(
        &mut self,
        layout: &BatchLayout,
        run: &Run,
        row: usize,
        by_lane: &[DiagonalPair],
    ) {
        let (batch, lane, row) = (row / LANES, row % LANES, run.start + row);
        if layout.order.particles[row] == ABSENT {
            return;
        }
        let count = run.diagonals.len();
        let slots = &layout.slots[run.blocks_of(batch)];
        let diagonals = layout.diagonals[run.diagonals.clone()].iter().zip(slots).enumerate();
        let mut blocks: Vec<LaneBlock> = diagonals
            .filter(|(_, (_, slots))| slots[lane] != BlockSlot::ABSENT)
            .map(|(number, (diagonal, _))| LaneBlock { number, column: diagonal.column(row) })
            .collect();
        let entries = &layout.irregular[layout.irregular_of[run.batches + batch].clone()];
        let own = entries.iter().enumerate().filter(|(_, entry)| entry.lane as usize == lane);
        blocks.extend(own.map(|(index, entry)| LaneBlock {
            number: count + index,
            column: entry.column as usize,
        }));
        for (before, &later) in blocks.iter().enumerate() {
            for &earlier in &blocks[..before] {
                if later.number < count && !by_lane.contains(&[earlier.number, later.number]) {
                    continue;
                }
                let in_order = layout.order.rank(earlier.column) < layout.order.rank(later.column);
                let [left, right] = if in_order { [earlier, later] } else { [later, earlier] };
                let target = match layout.address(left.column, right.column) {
                    Some(block) => UpdateTarget::Block(block),
                    None => UpdateTarget::Dropped(
                        [left, right].map(|block| layout.pivots[block.column]),
                    ),
                };
                self.irregular.push(IrregularUpdate {
                    lane: lane as u32,
                    left: left.number as u32,
                    right: right.number as u32,
                    target,
                });
            }
        }
    }
}
