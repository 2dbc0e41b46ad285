//! Updates of the elimination: products of blocks that are subtracted from later blocks.

use core::ops::Range;

use super::later_blocks::BlockSlot;
use super::layout::BatchLayout;
use super::row_order::ABSENT;
use super::run::{BlockAddress, Run};
use crate::linear::lanes::LANES;
use crate::linear::sparsity::Sparsity;

/// Updates of whole diagonals, and updates of single lanes.
#[derive(Debug, Default)]
pub(crate) struct UpdateTable {
    /// Updates of whole diagonals, ordered by diagonal.
    pub regular: Vec<Update>,
    /// Updates of each diagonal with later diagonals of its run. Each block also updates the pivot
    /// of its column.
    pub regular_of: Vec<Range<usize>>,
    /// Updates of single lanes, ordered by batch.
    pub irregular: Vec<IrregularUpdate>,
    /// Updates of single lanes of each batch.
    pub irregular_of: Vec<Range<usize>>,
}

/// Products of the blocks on two diagonals of a run, subtracted from the blocks on a third
/// diagonal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Update {
    /// Second diagonal, counted within the run.
    pub right: u32,
    /// Third diagonal, counted within the run of the first diagonal's columns, or [`ABSENT`].
    pub target: u32,
}

/// Product of two blocks of a lane, subtracted from a third block.
///
/// Blocks are numbered: first the diagonals of the run, then the irregular entries of the batch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IrregularUpdate {
    pub lane: u32,
    /// Block whose column is eliminated first.
    pub left: u32,
    /// Block whose column is eliminated second.
    pub right: u32,
    pub target: UpdateTarget,
}

/// Block from which an update is subtracted.
#[derive(Clone, Copy, Debug)]
pub(crate) enum UpdateTarget {
    /// Block of the sparsity.
    Block(BlockAddress),
    /// Pivots of both columns, in place of a block outside the sparsity.
    Dropped([BlockAddress; 2]),
}

/// Number of an off-diagonal block of a lane, as in [`IrregularUpdate`], and the block's column.
#[derive(Clone, Copy)]
struct LaneBlock {
    number: usize,
    column: usize,
}

/// Two diagonals of a run, counted within it, whose products are computed lane by lane.
type DiagonalPair = [usize; 2];

impl UpdateTable {
    /// Returns the updates of the elimination of `sparsity` in `layout`.
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

    /// Adds the updates of pairs of diagonals of `run`. Returns the pairs whose product is, in at
    /// least one lane, a block of `sparsity` on no diagonal.
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
            let targets = &layout.diagonals[layout.runs[a.run as usize].diagonals.clone()];
            for right in left + 1..run.diagonals.end {
                let b = &layout.diagonals[right];
                let target = targets
                    .iter()
                    .position(|d| d.run == b.run && a.offset + d.offset == b.offset)
                    .map_or(ABSENT, |index| index as u32);

                // Without a diagonal for the product, lanes may still have irregular entries for
                // it.
                let has_irregular_target = target == ABSENT
                    && (run.start..run.end).any(|row| {
                        let ends = [a.column(row), b.column(row)].map(|row| particles.get(row));
                        matches!(ends, [Some(&a), Some(&b)] if a != ABSENT && b != ABSENT
                            && sparsity.slot(a as usize, b as usize).is_some())
                    });
                if has_irregular_target {
                    by_lane.push([left - first_diagonal, right - first_diagonal]);
                } else {
                    self.regular.push(Update { right: (right - first_diagonal) as u32, target });
                }
            }
            self.regular_of.push(first..self.regular.len());
        }
        by_lane
    }

    /// Adds the updates of `row`, counted within `run`: the pairs of diagonals in `by_lane`, and
    /// all pairs with irregular entries.
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

        // Blocks of the row: diagonals first, then irregular entries.
        let count = run.diagonals.len();
        let slots = &layout.slots[run.blocks_of(batch)];
        let diagonals = layout.diagonals[run.diagonals.clone()].iter().zip(slots).enumerate();
        let mut blocks: Vec<LaneBlock> = diagonals
            .filter(|(_, (_, slots))| slots[lane] != BlockSlot::ABSENT)
            .map(|(number, (diagonal, _))| LaneBlock { number, column: diagonal.column(row) })
            .collect();
        let entries = &layout.irregular[layout.irregular_of[run.batches + batch].clone()];
        let lane_entries =
            entries.iter().enumerate().filter(|(_, entry)| entry.lane as usize == lane);
        blocks.extend(lane_entries.map(|(index, entry)| LaneBlock {
            number: count + index,
            column: entry.column as usize,
        }));

        for (index, &later) in blocks.iter().enumerate() {
            for &earlier in &blocks[..index] {
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
