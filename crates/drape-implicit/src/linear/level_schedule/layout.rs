//! Layout of a sparsity in batches: runs, diagonals, and the place of every block.

use core::ops::Range;

use super::chunk::Chunk;
use super::grouped::Grouped;
use super::later_blocks::{BlockSlot, LaterBlock, later_blocks};
use super::part::{Group, Part};
use super::partition::Partition;
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
    /// Runs in the order of their rows.
    pub runs: Vec<Run>,
    /// Parts, eliminated side by side.
    pub parts: Vec<Part>,
    /// Separators, eliminated one after the other once the parts are.
    pub separators: Vec<Group>,
    pub chunks: Vec<Chunk>,
    pub diagonals: Vec<Diagonal>,
    /// Slot of the matrix for each lane of each off-diagonal block of the batches.
    pub slots: Vec<[BlockSlot; LANES]>,
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
    /// Numbers of all parts in the Schur complement; those of the separators follow.
    pub part_numbers: usize,
}

/// Distance of a block from the main diagonal, and the run of its column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Distance {
    /// Whether the block couples a part to a separator: such columns are eliminated last.
    crosses: bool,
    offset: isize,
    run: u32,
}

/// Run whose place among all is not known yet.
struct FoundRun {
    start: usize,
    end: usize,
    diagonals: Vec<Distance>,
}

impl BatchLayout {
    pub(crate) fn new(sparsity: &Sparsity, partition: &Partition) -> Self {
        let order = RowOrder::new(sparsity, partition);
        let later = later_blocks(sparsity, &order);
        let mut layout = Self {
            rows: order.particles.len(),
            order,
            runs: Vec::new(),
            parts: Vec::new(),
            separators: Vec::new(),
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
            part_numbers: 0,
        };
        layout.find_runs(&later);
        layout.extend_margins();
        layout.find_slots(sparsity, &later);
        let runs_of = layout.runs_of_groups();
        layout.find_numbers(&runs_of);
        layout.find_parts(&runs_of);
        layout.find_look_ahead();
        layout.find_chunks();
        layout
    }

    /// Divides the levels into runs, the last to be eliminated first, because a diagonal names the
    /// run that its columns lie in.
    fn find_runs(&mut self, later: &Grouped<LaterBlock>) {
        let mut found: Vec<FoundRun> = Vec::new();
        // Counted in the order of finding until all are found.
        let mut run_of_row = vec![0; self.order.particles.len()];
        let groups = self.order.levels.len();
        let separators = (1..groups).step_by(2).rev();
        for group in separators.chain((0..groups).step_by(2).rev()) {
            for level in self.order.levels[group].windows(2).rev() {
                let first = found.len();
                for start in (level[0]..level[1]).step_by(LANES).rev() {
                    let own = self.shared_distances(later, start, &run_of_row);
                    let holds = |b: &[Distance], a: &[Distance]| a.iter().all(|x| b.contains(x));
                    match found[first..].last_mut() {
                        Some(run) if holds(&run.diagonals, &own) => run.start = start,
                        Some(run) if holds(&own, &run.diagonals) => {
                            run.start = start;
                            run.diagonals = own;
                        }
                        _ => {
                            let end = start + LANES;
                            found.push(FoundRun { start, end, diagonals: own });
                        }
                    }
                    run_of_row[start..start + LANES].fill(found.len() as u32 - 1);
                }
            }
        }
        let mut by_rows: Vec<usize> = (0..found.len()).collect();
        by_rows.sort_unstable_by_key(|&run| found[run].start);
        let mut place = vec![0; found.len()];
        for (index, &run) in by_rows.iter().enumerate() {
            place[run] = index as u32;
        }
        for run in by_rows {
            let FoundRun { start, end, ref diagonals } = found[run];
            let (first, count) = (self.diagonals.len(), diagonals.len());
            self.runs.push(Run {
                start,
                end,
                diagonals: first..first + count,
                crossing: diagonals.iter().filter(|distance| !distance.crosses).count(),
                blocks: 0,
                batches: 0,
                irregular: 0,
                numbers: 0,
                numbers_end: 0,
                look_ahead: 0,
            });
            self.max_diagonals = self.max_diagonals.max(count);
            self.diagonals.extend(diagonals.iter().map(|&Distance { offset, run, .. }| Diagonal {
                offset,
                run: place[run as usize],
            }));
        }
        self.run_of_row = run_of_row
            .into_iter()
            .map(|run: u32| place.get(run as usize).copied().unwrap_or(0))
            .collect();
    }

    /// Runs of each part and separator.
    fn runs_of_groups(&self) -> Vec<Range<usize>> {
        let before = |row: usize| self.runs.partition_point(|run| run.start < row);
        let runs = |levels: &Vec<usize>| before(levels[0])..before(levels[levels.len() - 1]);
        self.order.levels.iter().map(runs).collect()
    }

    /// Distances that at least two rows of the batch from a row on have in common, in the order in
    /// which their columns are eliminated.
    fn shared_distances(
        &self,
        later: &Grouped<LaterBlock>,
        start: usize,
        run_of_row: &[u32],
    ) -> Vec<Distance> {
        let is_separator = &self.order.is_separator;
        let mut distances = Vec::new();
        for row in start..start + LANES {
            for block in later.of(row) {
                distances.push(Distance {
                    crosses: is_separator[row] != is_separator[block.column],
                    offset: block.column as isize - row as isize,
                    run: run_of_row[block.column],
                });
            }
        }
        distances.sort_unstable();
        let shared = distances.chunk_by(|a, b| a == b).filter(|same| same.len() > 1);
        shared.map(|same| same[0]).collect()
    }

    /// Adds rows at the end: all batches of a run have blocks at all its distances, and blocks of
    /// zeros may lead beyond the last row.
    fn extend_margins(&mut self) {
        for run in &self.runs {
            self.rows = self.rows.max(self.rows_of(run).end);
        }
    }

    /// Gives every block of the sparsity its place, on a diagonal if one leads to its column.
    fn find_slots(&mut self, sparsity: &Sparsity, later: &Grouped<LaterBlock>) {
        for index in 0..self.runs.len() {
            let run = self.runs[index].clone();
            self.runs[index].blocks = self.slots.len();
            self.runs[index].batches = self.main_slots.len();
            self.runs[index].irregular = self.irregular.len();
            for start in (run.start..run.end).step_by(LANES) {
                let mut main = [ABSENT; LANES];
                let mut blocks = vec![[BlockSlot::ABSENT; LANES]; run.diagonals.len()];
                let mut irregular = Vec::new();
                for lane in 0..LANES {
                    let row = start + lane;
                    let particle = self.order.particles[row];
                    if particle != ABSENT {
                        main[lane] = sparsity.row(particle as usize).start as u32;
                    }
                    for &LaterBlock { slot, column } in later.of(row) {
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
    }

    /// Diagonal of a run, counted within it, that leads from a row to a column.
    fn diagonal(&self, run: &Run, row: usize, column: usize) -> Option<usize> {
        self.diagonals[run.diagonals.clone()].iter().position(|d| {
            let run = &self.runs[d.run as usize];
            d.column(row) == column && (run.start..run.end).contains(&column)
        })
    }

    /// Assigns each run its range of numbers of the Schur complement. Those of the parts come
    /// first.
    fn find_numbers(&mut self, runs_of: &[Range<usize>]) {
        let parts = runs_of.iter().step_by(2).cloned().flatten();
        self.part_numbers = self.number_runs(parts, 0);
        let separators = runs_of.iter().skip(1).step_by(2).cloned().flatten();
        self.number_runs(separators, self.part_numbers);
        self.pivots = vec![BlockAddress::default(); self.rows];
        for run in &self.runs {
            for row in run.start..run.end {
                let first = (run.numbers + row - run.start) as u32;
                self.pivots[row] = BlockAddress { first, stride: run.len() as u32 };
            }
        }
    }

    /// Assigns runs their ranges of numbers, from a first number on. Returns the end of all.
    fn number_runs(&mut self, runs: impl Iterator<Item = usize>, first: usize) -> usize {
        let mut numbers = first;
        for index in runs {
            let end = self.runs.get(index + 1).map_or(self.irregular.len(), |next| next.irregular);
            let run = &mut self.runs[index];
            run.numbers = numbers;
            numbers = run.number(run.diagonals.len(), 0) + 9 * (end - run.irregular);
            run.numbers_end = numbers;
        }
        numbers
    }

    fn find_parts(&mut self, runs_of: &[Range<usize>]) {
        let group = |runs: &Range<usize>| Group::new(&self.runs, runs.clone(), &self.irregular_of);
        let separators: Vec<Group> = runs_of.iter().skip(1).step_by(2).map(group).collect();
        let parts = runs_of.iter().step_by(2).map(|runs| self.part(group(runs), &separators));
        self.parts = parts.collect();
        self.separators = separators;
    }

    /// Part of some runs, with what it changes of the separators.
    fn part(&self, own: Group, separators: &[Group]) -> Part {
        let mut window: Option<Range<usize>> = None;
        let mut reached = vec![false; separators.len()];
        for run in &self.runs[own.runs.clone()] {
            let diagonals = &self.diagonals[run.diagonals.clone()];
            for diagonal in &diagonals[run.crossing..] {
                let rows = diagonal.column(run.start)..diagonal.column(run.end);
                include(window.get_or_insert(rows.clone()), rows);
            }
            for target in self.targets(run) {
                let holds = |separator: &Group| separator.runs.contains(&target);
                if let Some(separator) = separators.iter().position(holds) {
                    reached[separator] = true;
                }
            }
        }
        let reached = || separators.iter().zip(&reached).filter(|pair| *pair.1).map(|pair| pair.0);
        let mut numbers: Option<Range<usize>> = None;
        for separator in reached() {
            include(window.get_or_insert(separator.rows.clone()), separator.rows.clone());
            include(numbers.get_or_insert(separator.numbers.clone()), separator.numbers.clone());
        }
        Part {
            window: window.unwrap_or_default(),
            separators: reached().map(|separator| separator.rows.clone()).collect(),
            separator_numbers: numbers.unwrap_or_default(),
            own,
        }
    }

    /// Runs that the columns of a run lie in.
    fn targets(&self, run: &Run) -> impl Iterator<Item = usize> {
        let diagonals = self.diagonals[run.diagonals.clone()].iter().map(|d| d.run);
        let batches = &self.irregular_of[run.batches..][..run.len() / LANES];
        let irregular = batches.iter().flat_map(|batch| &self.irregular[batch.clone()]);
        let columns = irregular.map(|entry| self.run_of_row[entry.column as usize]);
        diagonals.chain(columns).map(|target| target as usize)
    }

    /// Rows of a run and those that its diagonals lead to.
    fn rows_of(&self, run: &Run) -> Range<usize> {
        let mut rows = run.start..run.end;
        for diagonal in &self.diagonals[run.diagonals.clone()] {
            include(&mut rows, diagonal.column(run.start)..diagonal.column(run.end));
        }
        rows
    }

    fn find_look_ahead(&mut self) {
        let groups = self.parts.iter().map(|part| &part.own).chain(&self.separators);
        for group in groups.cloned().collect::<Vec<_>>() {
            let mut look_ahead = 0;
            for index in group.runs.clone() {
                let run = &self.runs[index];
                let last = self.targets(run).filter(|target| group.runs.contains(target)).max();
                look_ahead = look_ahead.max(index + 1).max(last.map_or(0, |last| last + 1));
                self.runs[index].look_ahead = look_ahead;
            }
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
            first.window.start = 0;
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
        let Group { blocks, irregular, .. } =
            Group::new(&self.runs, runs.clone(), &self.irregular_of);
        let end = self.runs.get(runs.end).map_or(self.rows, |next| next.start);
        let rows = self.runs[runs.start].start..end;
        let mut window = rows.clone();
        for run in &self.runs[runs.clone()] {
            include(&mut window, self.rows_of(run));
        }
        Chunk { index: 0, rows, blocks, irregular, window, incoming: Vec::new(), runs }
    }

    /// Number of the chunk that a row lies in.
    pub(crate) fn chunk_of(&self, row: usize) -> usize {
        self.chunks.partition_point(|chunk| chunk.rows.end <= row)
    }

    /// Number of the chunk that an irregular entry lies in.
    pub(crate) fn chunk_of_entry(&self, index: usize) -> usize {
        self.chunks.partition_point(|chunk| chunk.irregular.end <= index)
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
        Some(run.irregular_address(range.start + index))
    }
}

/// Widens a range so that it includes another.
fn include(range: &mut Range<usize>, other: Range<usize>) {
    *range = range.start.min(other.start)..range.end.max(other.end);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::level_schedule::sample::{layout, rimmed, weave};

    #[test]
    fn the_surroundings_of_a_lattice_do_not_widen_its_runs() {
        let layout = layout(&rimmed(40), 1);
        assert!(layout.max_diagonals <= 6, "{} diagonals in a run", layout.max_diagonals);
        // Each link has three blocks.
        assert!(layout.irregular.len() <= 3 * 156, "{} irregular", layout.irregular.len());
    }

    #[test]
    fn every_block_has_one_place() {
        let few = Sparsity::from_pairs(9, [[0, 8], [3, 4], [1, 7]]).unwrap();
        let cases = [(weave(11), 1), (weave(11), 3), (rimmed(12), 1), (rimmed(12), 2), (few, 1)];
        for (sparsity, parts) in cases {
            let layout = layout(&sparsity, parts);
            let main = layout.main_slots.iter().flatten().filter(|&&slot| slot != ABSENT);
            let slots = layout.slots.iter().flatten().filter(|&&slot| slot != BlockSlot::ABSENT);
            let irregular = layout.irregular.iter().map(|entry| &entry.slot);
            let off_diagonal = slots.chain(irregular).map(|slot| slot.slot());
            let mut found: Vec<usize> =
                main.map(|&slot| slot as usize).chain(off_diagonal).collect();
            found.sort_unstable();
            assert_eq!(found, (0..sparsity.blocks()).collect::<Vec<_>>());
        }
    }

    #[test]
    fn no_row_of_a_run_waits_for_another() {
        for (sparsity, parts) in [(weave(11), 1), (weave(24), 3), (rimmed(12), 1), (rimmed(12), 2)]
        {
            let layout = layout(&sparsity, parts);
            let rank = |row: usize| layout.order.rank(row);
            for run in &layout.runs {
                for diagonal in &layout.diagonals[run.diagonals.clone()] {
                    let target = &layout.runs[diagonal.run as usize];
                    assert!(rank(target.start) > rank(run.end - 1), "{run:?} leads to {target:?}");
                }
                for batch in &layout.irregular_of[run.batches..][..run.len() / LANES] {
                    for entry in &layout.irregular[batch.clone()] {
                        let column = rank(entry.column as usize);
                        assert!(column > rank(run.end - 1), "{run:?} leads to {entry:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn cuts_along_levels_leave_blocks_on_their_diagonals() {
        let [whole, cut] = [1, 4].map(|parts| layout(&weave(80), parts));
        let [rows, irregular] = [cut.rows - whole.rows, cut.irregular.len()];
        assert!(irregular < whole.irregular.len() * 5 / 4, "{irregular} irregular blocks");
        assert!(rows < whole.rows / 10, "{rows} rows more than {}", whole.rows);
    }

    #[test]
    fn cloth_needs_six_diagonals() {
        let layout = layout(&weave(40), 1);
        assert_eq!(layout.max_diagonals, 6);
        let irregular = layout.irregular.len();
        assert!(irregular < 200, "{irregular} of 9200 blocks are irregular");
        // A level has up to 20 particles, and its last batch is half empty on average.
        assert!(layout.rows < 1600 * 4 / 3, "{} rows", layout.rows);
    }
}
