//! Parts and separators of a layout: consecutive runs, with the rows and numbers that the runs
//! change.

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

/// Part of a matrix that is eliminated beside the other parts, and the separators that its
/// elimination changes.
#[derive(Clone, Debug, Default)]
pub(crate) struct MatrixPart {
    /// Runs of the part.
    pub group: Group,
    /// Range of rows of the separators coupled to the part, with a margin for blocks of zeros.
    pub window: Range<usize>,
    /// Rows of each separator coupled to the part.
    pub separators: Vec<Range<usize>>,
    /// Range of numbers in the Schur complement from the first to the last of `separators`.
    pub separator_numbers: Range<usize>,
}

impl Group {
    /// Returns the group of the range `runs` of `all` runs of a layout. The range may be empty.
    /// `irregular_of` holds the irregular entries of each batch.
    pub(super) fn new(all: &[Run], runs: Range<usize>, irregular_of: &[Range<usize>]) -> Self {
        let [start, end] = [runs.start, runs.end].map(|run| RunStart::new(all, run, irregular_of));
        let group = &all[runs.clone()];
        Self {
            rows: start.row..group.last().map_or(start.row, |last| last.end),
            batches: start.batch..end.batch,
            blocks: start.block..end.block,
            irregular: start.irregular..end.irregular,
            numbers: match group {
                [] => 0..0,
                [first, ..] => first.numbers..group[group.len() - 1].numbers_end,
            },
            runs,
        }
    }
}

/// First row, batch, block and irregular entry of a run, or their ends after the last run.
#[derive(Default)]
struct RunStart {
    row: usize,
    batch: usize,
    block: usize,
    irregular: usize,
}

impl RunStart {
    /// Returns the start of the run with the index `run` of `all`, or the end of the last run.
    fn new(all: &[Run], run: usize, irregular_of: &[Range<usize>]) -> Self {
        if let Some(Run { start, batches, blocks, irregular, .. }) = all.get(run) {
            return Self { row: *start, batch: *batches, block: *blocks, irregular: *irregular };
        }
        all.last().map_or(Self::default(), |last| {
            let batches = last.len() / LANES;
            Self {
                row: last.end,
                batch: last.batches + batches,
                block: last.blocks_of(batches).start,
                irregular: irregular_of.last().map_or(0, |entries| entries.end),
            }
        })
    }
}
