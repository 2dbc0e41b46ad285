//! Parts and separators of a layout: consecutive runs, with the rows and numbers that they change.

use core::ops::Range;

use crate::linear::lanes::LANES;
use crate::linear::level_schedule::run::Run;

/// Runs of a part or of a separator, with their rows, batches, blocks and irregular entries.
#[derive(Clone, Debug, Default)]
pub(crate) struct Group {
    pub runs: Range<usize>,
    pub rows: Range<usize>,
    pub batches: Range<usize>,
    /// Off-diagonal blocks.
    pub blocks: Range<usize>,
    pub irregular: Range<usize>,
    /// Numbers in the Schur complement.
    pub numbers: Range<usize>,
}

/// Part, and what its elimination changes of separators.
#[derive(Clone, Debug, Default)]
pub(crate) struct Part {
    pub own: Group,
    /// Range of rows of the separators that it is coupled to, with a margin for blocks of zeros.
    pub window: Range<usize>,
    /// Rows of the separators that it is coupled to.
    pub separators: Vec<Range<usize>>,
    /// Numbers of these separators in the Schur complement, with those between them.
    pub separator_numbers: Range<usize>,
}

impl Group {
    /// Group of some runs, of all of a layout; they may be none. `irregular_of` holds the irregular
    /// entries of each batch.
    pub(super) fn new(all: &[Run], runs: Range<usize>, irregular_of: &[Range<usize>]) -> Self {
        let [start, end] = [runs.start, runs.end].map(|run| Place::of(all, run, irregular_of));
        let own = &all[runs.clone()];
        Self {
            rows: start.row..own.last().map_or(start.row, |last| last.end),
            batches: start.batch..end.batch,
            blocks: start.block..end.block,
            irregular: start.irregular..end.irregular,
            numbers: match own {
                [] => 0..0,
                [first, ..] => first.numbers..own[own.len() - 1].numbers_end,
            },
            runs,
        }
    }
}

/// Place where a run begins, or the last one ends.
#[derive(Default)]
struct Place {
    row: usize,
    batch: usize,
    block: usize,
    irregular: usize,
}

impl Place {
    fn of(all: &[Run], run: usize, irregular_of: &[Range<usize>]) -> Self {
        if let Some(Run { start, batches, blocks, irregular, .. }) = all.get(run) {
            return Self { row: *start, batch: *batches, block: *blocks, irregular: *irregular };
        }
        all.last().map_or(Self::default(), |last| {
            let batches = last.len() / LANES;
            Self {
                row: last.end,
                batch: last.batches + batches,
                block: last.blocks_of(batches).start,
                irregular: irregular_of.last().map_or(0, |own| own.end),
            }
        })
    }
}
