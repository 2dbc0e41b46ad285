//! Layout of a sparsity in batches: runs, diagonals, and the place of every block.

use core::ops::Range;

use super::chunk::Chunk;
use super::row_order::{ABSENT, RowOrder};
use super::run::{BlockAddress, Diagonal, IrregularEntry, Run};
use crate::linear::lanes::LANES;
use crate::linear::sparsity::Sparsity;

/// Fewest rows of a chunk, so that its work outweighs handing it to a thread.
const MIN_ROWS: usize = 1024;

/// Most chunks of a layout.
const MAX_CHUNKS: usize = 64;

/// Layout of a matrix for elimination in batches.
#[derive(Debug)]
pub(crate) struct BatchLayout {
    pub order: RowOrder,
    /// Number of rows, margins and padding included.
    pub rows: usize,
    /// Runs in the order of elimination.
    pub runs: Vec<Run>,
    pub chunks: Vec<Chunk>,
    pub diagonals: Vec<Diagonal>,
    /// Slot of the matrix for each lane of each off-diagonal block of the batches.
    pub slots: Vec<[u32; LANES]>,
    /// Slot of the matrix for each lane of the main diagonal of each batch.
    pub main_slots: Vec<[u32; LANES]>,
    pub irregular: Vec<IrregularEntry>,
    /// Irregular entries of each batch.
    pub irregular_of: Vec<Range<usize>>,
    /// Address of the pivot of each row in the Schur complement.
    pub pivots: Vec<BlockAddress>,
    /// Run of each row.
    pub run_of_row: Vec<u32>,
    /// Largest number of diagonals of a run.
    pub max_diagonals: usize,
    /// Largest number of irregular entries of a batch.
    pub max_irregular: usize,
    /// Numbers in the Schur complement.
    pub numbers: usize,
    /// First number of the irregular entries in the Schur complement.
    first_irregular: usize,
}

/// Distance of a block from the main diagonal, and the run of its column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Distance {
    offset: usize,
    run: u32,
}

/// Run whose place in the order is not known yet.
struct FoundRun {
    start: usize,
    end: usize,
    diagonals: Vec<Distance>,
}

/// Slot and column of an off-diagonal block.
struct SlotColumn {
    slot: usize,
    column: usize,
}

impl BatchLayout {
    pub(crate) fn new(sparsity: &Sparsity) -> Self {
        let order = RowOrder::new(sparsity);
        let mut layout = Self {
            rows: order.particles.len(),
            order,
            runs: Vec::new(),
            chunks: Vec::new(),
            diagonals: Vec::new(),
            slots: Vec::new(),
            main_slots: Vec::new(),
            irregular: Vec::new(),
            irregular_of: Vec::new(),
            pivots: Vec::new(),
            run_of_row: Vec::new(),
            max_diagonals: 0,
            max_irregular: 0,
            numbers: 0,
            first_irregular: 0,
        };
        layout.find_runs(sparsity);
        layout.extend_margins();
        layout.find_slots(sparsity);
        layout.find_pivots();
        layout.find_look_ahead();
        layout.find_chunks();
        layout
    }

    /// Divides the levels into runs, the last level first, because a diagonal names the run that
    /// its columns lie in.
    fn find_runs(&mut self, sparsity: &Sparsity) {
        let mut found: Vec<FoundRun> = Vec::new();
        // Counted from the end until the number of runs is known.
        let mut run_of_row = vec![0; self.order.particles.len()];
        for level in self.order.levels.windows(2).rev() {
            let first = found.len();
            for start in (level[0]..level[1]).step_by(LANES).rev() {
                let own = self.shared_distances(sparsity, start, &run_of_row);
                let part = |a: &[Distance], b: &[Distance]| a.iter().all(|x| b.contains(x));
                match found[first..].last_mut() {
                    Some(run) if part(&own, &run.diagonals) => run.start = start,
                    Some(run) if part(&run.diagonals, &own) => {
                        run.start = start;
                        run.diagonals = own;
                    }
                    _ => found.push(FoundRun { start, end: start + LANES, diagonals: own }),
                }
                run_of_row[start..start + LANES].fill(found.len() as u32 - 1);
            }
        }
        let last = found.len() as u32 - u32::from(!found.is_empty());
        for FoundRun { start, end, diagonals } in found.into_iter().rev() {
            let (first, count) = (self.diagonals.len(), diagonals.len());
            self.runs.push(Run {
                start,
                end,
                diagonals: first..first + count,
                blocks: 0,
                batches: 0,
                numbers: self.numbers,
                look_ahead: 0,
            });
            self.numbers += (end - start) * (6 + 9 * count);
            self.max_diagonals = self.max_diagonals.max(count);
            let counted = diagonals.into_iter();
            self.diagonals.extend(
                counted.map(|Distance { offset, run }| Diagonal { offset, run: last - run }),
            );
        }
        self.run_of_row = run_of_row.into_iter().map(|run| last.saturating_sub(run)).collect();
    }

    /// Distances that at least two rows of the batch from a row on have in common, ascending.
    fn shared_distances(
        &self,
        sparsity: &Sparsity,
        start: usize,
        run_of_row: &[u32],
    ) -> Vec<Distance> {
        let mut distances = Vec::new();
        for row in start..start + LANES {
            for SlotColumn { column, .. } in self.off_diagonal(sparsity, row) {
                distances.push(Distance { offset: column - row, run: run_of_row[column] });
            }
        }
        distances.sort_unstable();
        let shared = distances.chunk_by(|a, b| a == b).filter(|same| same.len() > 1);
        shared.map(|same| same[0]).collect()
    }

    /// Adds rows and numbers at the ends: all batches of a run have blocks at all its distances,
    /// and blocks of zeros may lead beyond the last row.
    fn extend_margins(&mut self) {
        for run in &self.runs {
            for diagonal in &self.diagonals[run.diagonals.clone()] {
                let target = &self.runs[diagonal.run as usize];
                let end = run.end + diagonal.offset;
                self.rows = self.rows.max(end);
                let last = target.number(target.diagonals.len(), 0) - target.len();
                self.numbers = self.numbers.max(last + end.saturating_sub(target.start));
            }
        }
    }

    /// Off-diagonal blocks of a row.
    fn off_diagonal(&self, sparsity: &Sparsity, row: usize) -> impl Iterator<Item = SlotColumn> {
        let slots = match self.order.particles[row] {
            ABSENT => 0..0,
            particle => sparsity.row(particle as usize),
        };
        slots.skip(1).map(|slot| {
            let column = self.order.row_of[sparsity.columns()[slot] as usize] as usize;
            SlotColumn { slot, column }
        })
    }

    /// Gives every block of the sparsity its place, on a diagonal if one leads to its column.
    fn find_slots(&mut self, sparsity: &Sparsity) {
        for index in 0..self.runs.len() {
            let run = self.runs[index].clone();
            self.runs[index].blocks = self.slots.len();
            self.runs[index].batches = self.main_slots.len();
            for start in (run.start..run.end).step_by(LANES) {
                let mut main = [ABSENT; LANES];
                let mut blocks = vec![[ABSENT; LANES]; run.diagonals.len()];
                let mut irregular = Vec::new();
                for lane in 0..LANES {
                    let row = start + lane;
                    let particle = self.order.particles[row];
                    if particle != ABSENT {
                        main[lane] = sparsity.row(particle as usize).start as u32;
                    }
                    for SlotColumn { slot, column } in self.off_diagonal(sparsity, row) {
                        let slot = slot as u32;
                        match self.diagonal(&run, row, column) {
                            Some(diagonal) => blocks[diagonal][lane] = slot,
                            None => irregular.push(IrregularEntry {
                                lane: lane as u32,
                                column: column as u32,
                                slot,
                            }),
                        }
                    }
                }
                self.main_slots.push(main);
                self.slots.append(&mut blocks);
                self.max_irregular = self.max_irregular.max(irregular.len());
                let first = self.irregular.len();
                self.irregular.append(&mut irregular);
                self.irregular_of.push(first..self.irregular.len());
            }
        }
        self.first_irregular = self.numbers;
        self.numbers += 9 * self.irregular.len();
    }

    /// Diagonal of a run, counted within it, that leads from a row to a column.
    fn diagonal(&self, run: &Run, row: usize, column: usize) -> Option<usize> {
        self.diagonals[run.diagonals.clone()].iter().position(|d| {
            let run = &self.runs[d.run as usize];
            row + d.offset == column && (run.start..run.end).contains(&column)
        })
    }

    fn find_pivots(&mut self) {
        self.pivots = vec![BlockAddress::default(); self.rows];
        for run in &self.runs {
            for row in run.start..run.end {
                let first = (run.numbers + row - run.start) as u32;
                self.pivots[row] = BlockAddress { first, stride: run.len() as u32 };
            }
        }
    }

    fn find_look_ahead(&mut self) {
        let mut look_ahead = 0;
        for (index, run) in self.runs.iter_mut().enumerate() {
            let diagonals = self.diagonals[run.diagonals.clone()].iter().map(|d| d.run);
            let batches = &self.irregular_of[run.batches..][..run.len() / LANES];
            let irregular = batches.iter().flat_map(|batch| &self.irregular[batch.clone()]);
            let columns = irregular.map(|entry| self.run_of_row[entry.column as usize]);
            let last = diagonals.chain(columns).max().map_or(0, |last| last as usize);
            look_ahead = look_ahead.max(index + 1).max(last + 1);
            run.look_ahead = look_ahead;
        }
    }

    /// Divides the runs into chunks.
    fn find_chunks(&mut self) {
        let target = MIN_ROWS.max(self.rows.div_ceil(MAX_CHUNKS));
        let mut chunks: Vec<Chunk> = Vec::new();
        let mut first = 0;
        for (last, run) in self.runs.iter().enumerate() {
            let rows = run.end - self.runs[first].start;
            let is_last = last + 1 == self.runs.len();
            if is_last || (rows >= target && self.rows - run.end >= target) {
                chunks.push(Chunk { index: chunks.len(), ..self.chunk(first..last + 1) });
                first = last + 1;
            }
        }
        if let [first, ..] = &mut chunks[..] {
            first.rows.start = 0;
        }
        if let [.., last] = &mut chunks[..] {
            last.rows.end = self.rows;
            last.reach = self.rows;
        }
        self.chunks = chunks;
        for index in 0..self.irregular.len() {
            let target = self.chunk_of(self.irregular[index].column as usize);
            let target = &mut self.chunks[target];
            if !target.irregular.contains(&index) {
                target.incoming.push(index as u32);
            }
        }
    }

    /// Chunk of some runs, without what comes in.
    fn chunk(&self, runs: Range<usize>) -> Chunk {
        let own = &self.runs[runs.clone()];
        let (first, last) = (&own[0], &own[own.len() - 1]);
        let batches = last.len() / LANES;
        let end = |run: &Run| {
            let offsets = self.diagonals[run.diagonals.clone()].iter().map(|own| own.offset);
            run.end + offsets.max().unwrap_or(0)
        };
        let irregular = |batch: usize| &self.irregular_of[batch];
        Chunk {
            index: 0,
            rows: first.start..last.end,
            blocks: first.blocks..last.blocks_of(batches).start,
            irregular: irregular(first.batches).start..irregular(last.batches + batches - 1).end,
            reach: own.iter().map(end).fold(last.end, usize::max),
            incoming: Vec::new(),
            runs,
        }
    }

    /// Number of the chunk that a row lies in.
    pub(crate) fn chunk_of(&self, row: usize) -> usize {
        self.chunks.partition_point(|chunk| chunk.rows.end <= row)
    }

    /// Number of the chunk that an irregular entry lies in.
    pub(crate) fn chunk_of_entry(&self, index: usize) -> usize {
        self.chunks.partition_point(|chunk| chunk.irregular.end <= index)
    }

    /// Address of an irregular entry in the Schur complement.
    #[inline(always)]
    pub(crate) fn irregular_address(&self, index: usize) -> BlockAddress {
        BlockAddress { first: (self.first_irregular + 9 * index) as u32, stride: 1 }
    }

    /// Address in the Schur complement of the block of a row and a later one, if the sparsity has
    /// it.
    pub(crate) fn address(&self, row: usize, column: usize) -> Option<BlockAddress> {
        let run = &self.runs[self.run_of_row[row] as usize];
        if let Some(diagonal) = self.diagonal(run, row, column) {
            return Some(run.address(diagonal, row));
        }
        let range = self.irregular_of[run.batches + (row - run.start) / LANES].clone();
        let is = |entry: &IrregularEntry| {
            entry.column as usize == column && entry.lane as usize == row % LANES
        };
        let index = self.irregular[range.clone()].iter().position(is)?;
        Some(self.irregular_address(range.start + index))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::level_schedule::sample::{rimmed, weave};

    #[test]
    fn the_surroundings_of_a_lattice_do_not_widen_its_runs() {
        let layout = BatchLayout::new(&rimmed(40));
        assert!(layout.max_diagonals <= 6, "{} diagonals in a run", layout.max_diagonals);
        // Each link has three blocks.
        assert!(layout.irregular.len() <= 3 * 156, "{} irregular", layout.irregular.len());
    }

    #[test]
    fn every_block_has_one_place() {
        let few = Sparsity::from_pairs(9, [[0, 8], [3, 4], [1, 7]]).unwrap();
        for sparsity in [weave(11), rimmed(12), few] {
            let layout = BatchLayout::new(&sparsity);
            let slots = layout.slots.iter().chain(&layout.main_slots).flatten().copied();
            let found = slots.filter(|&slot| slot != ABSENT);
            let irregular = layout.irregular.iter().map(|entry| entry.slot);
            let mut found: Vec<u32> = found.chain(irregular).collect();
            found.sort_unstable();
            assert_eq!(found, (0..sparsity.blocks() as u32).collect::<Vec<_>>());
        }
    }

    #[test]
    fn no_row_of_a_run_waits_for_another() {
        for sparsity in [weave(11), rimmed(12)] {
            let layout = BatchLayout::new(&sparsity);
            for run in &layout.runs {
                for diagonal in &layout.diagonals[run.diagonals.clone()] {
                    let target = &layout.runs[diagonal.run as usize];
                    assert!(target.start >= run.end, "{run:?} leads to {target:?}");
                }
                for batch in &layout.irregular_of[run.batches..][..run.len() / LANES] {
                    for entry in &layout.irregular[batch.clone()] {
                        assert!(entry.column as usize >= run.end, "{run:?} leads to {entry:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn cloth_needs_six_diagonals() {
        let layout = BatchLayout::new(&weave(40));
        assert_eq!(layout.max_diagonals, 6);
        let irregular = layout.irregular.len();
        assert!(irregular < 200, "{irregular} of 9200 blocks are irregular");
        // A level has up to 20 particles, and its last batch is half empty on average.
        assert!(layout.rows < 1600 * 4 / 3, "{} rows", layout.rows);
    }
}
