//! Layout of a sparsity in batches: runs, diagonals, and the position of every block.

use core::ops::Range;

use super::chunk::Chunk;
use super::grouped::Grouped;
use super::later_blocks::{BlockSlot, LaterBlock, later_blocks};
use super::part::{Group, MatrixPart};
use super::partition::Partition;
use super::row_order::{ABSENT, RowOrder};
use super::run::{BlockAddress, Diagonal, IrregularEntry, Run};
use crate::linear::lanes::LANES;
use crate::linear::sparsity::Sparsity;

/// Least number of rows of a chunk, so that its work outweighs the cost of a thread's task.
const MIN_ROWS: usize = 1024;

/// Largest number of chunks of a layout.
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
    pub parts: Vec<MatrixPart>,
    /// Separators, eliminated one after another after all parts.
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
    /// Count of the parts' numbers in the Schur complement. The separators' numbers follow.
    pub part_numbers: usize,
}

/// Distance of a block from the main diagonal, and the run of the block's column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Distance {
    /// Whether the block couples a part to a separator. Columns of separators are eliminated last.
    crosses: bool,
    offset: isize,
    run: u32,
}

/// Run without a final index.
struct UnplacedRun {
    start: usize,
    end: usize,
    diagonals: Vec<Distance>,
}

impl BatchLayout {
    /// Returns the layout of `sparsity`, divided by `partition`.
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

    /// Divides the levels into runs of batches with common diagonals.
    fn find_runs(&mut self, later: &Grouped<LaterBlock>) {
        let (runs, mut run_of_row) = self.unplaced_runs(later);

        // Runs are numbered in the order of their rows.
        let mut by_rows: Vec<usize> = (0..runs.len()).collect();
        by_rows.sort_unstable_by_key(|&run| runs[run].start);
        let mut final_index = vec![0; runs.len()];
        for (index, &run) in by_rows.iter().enumerate() {
            final_index[run] = index as u32;
        }

        for run in by_rows {
            let UnplacedRun { start, end, ref diagonals } = runs[run];
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
                run: final_index[run as usize],
            }));
        }

        for run in &mut run_of_row {
            *run = final_index.get(*run as usize).copied().unwrap_or(0);
        }
        self.run_of_row = run_of_row;
    }

    /// Returns the runs, and the run of each row, numbered in the order in which the runs are
    /// formed.
    ///
    /// The runs that are eliminated last come first, because a diagonal names the run of its
    /// columns.
    fn unplaced_runs(&self, later: &Grouped<LaterBlock>) -> (Vec<UnplacedRun>, Vec<u32>) {
        let mut runs: Vec<UnplacedRun> = Vec::new();
        let mut run_of_row = vec![0; self.order.particles.len()];
        let groups = self.order.levels.len();
        let separators = (1..groups).step_by(2).rev();
        for group in separators.chain((0..groups).step_by(2).rev()) {
            for level in self.order.levels[group].windows(2).rev() {
                let first = runs.len();
                for start in (level[0]..level[1]).step_by(LANES).rev() {
                    let shared = self.shared_distances(later, start, &run_of_row);
                    match runs[first..].last_mut() {
                        Some(run) if contains_all(&run.diagonals, &shared) => run.start = start,
                        Some(run) if contains_all(&shared, &run.diagonals) => {
                            run.start = start;
                            run.diagonals = shared;
                        }
                        _ => {
                            let end = start + LANES;
                            runs.push(UnplacedRun { start, end, diagonals: shared });
                        }
                    }
                    run_of_row[start..start + LANES].fill(runs.len() as u32 - 1);
                }
            }
        }
        (runs, run_of_row)
    }

    /// Returns the runs of each part and separator.
    fn runs_of_groups(&self) -> Vec<Range<usize>> {
        let groups = self.order.levels.iter();
        let ends = groups.map(|levels| [levels[0], levels[levels.len() - 1]]);
        ends.map(|ends| {
            let [first, end] = ends.map(|row| self.runs.partition_point(|run| run.start < row));
            first..end
        })
        .collect()
    }

    /// Returns the distances with a block in at least two rows of the batch that begins at `start`,
    /// in the order in which the columns are eliminated.
    fn shared_distances(
        &self,
        later: &Grouped<LaterBlock>,
        start: usize,
        run_of_row: &[u32],
    ) -> Vec<Distance> {
        let is_separator = &self.order.is_separator;
        let mut distances = Vec::new();
        for row in start..start + LANES {
            for block in later.group(row) {
                distances.push(Distance {
                    crosses: is_separator[row] != is_separator[block.column],
                    offset: block.column as isize - row as isize,
                    run: run_of_row[block.column],
                });
            }
        }
        distances.sort_unstable();
        let shared = distances.chunk_by(|a, b| a == b).filter(|equal| equal.len() > 1);
        shared.map(|equal| equal[0]).collect()
    }

    /// Adds rows at the end. Every batch of a run has blocks on all diagonals of the run, and
    /// blocks of zeros may lead beyond the last row.
    fn extend_margins(&mut self) {
        for run in &self.runs {
            self.rows = self.rows.max(self.rows_of(run).end);
        }
    }

    /// Assigns every block of `sparsity` to a diagonal that leads to the block's column, or to an
    /// irregular entry.
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
                    for &LaterBlock { slot, column } in later.group(row) {
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

    /// Returns the diagonal of `run`, counted within the run, that leads from `row` to `column`.
    fn diagonal(&self, run: &Run, row: usize, column: usize) -> Option<usize> {
        self.diagonals[run.diagonals.clone()].iter().position(|d| {
            let run = &self.runs[d.run as usize];
            d.column(row) == column && (run.start..run.end).contains(&column)
        })
    }

    /// Assigns ranges of numbers of the Schur complement to all runs, first of the parts, then of
    /// the separators. `runs_of` holds the runs of each group.
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

    /// Assigns consecutive ranges of numbers to `runs`, beginning at `first`. Returns the end of
    /// the last range.
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

    /// Finds the parts and the separators. `runs_of` holds the runs of each group.
    fn find_parts(&mut self, runs_of: &[Range<usize>]) {
        let groups = runs_of.iter();
        let mut parts = Vec::new();
        let mut separators = Vec::new();
        for (index, runs) in groups.enumerate() {
            let group = Group::new(&self.runs, runs.clone(), &self.irregular_of);
            if index % 2 == 0 { parts.push(group) } else { separators.push(group) }
        }
        self.parts = parts.into_iter().map(|part| self.part(part, &separators)).collect();
        self.separators = separators;
    }

    /// Returns the part with the runs of `group`, and the `separators` that its elimination
    /// changes.
    fn part(&self, group: Group, separators: &[Group]) -> MatrixPart {
        let mut window: Option<Range<usize>> = None;
        let mut is_reached = vec![false; separators.len()];
        for run in &self.runs[group.runs.clone()] {
            let diagonals = &self.diagonals[run.diagonals.clone()];
            for diagonal in &diagonals[run.crossing..] {
                let rows = diagonal.column(run.start)..diagonal.column(run.end);
                include(window.get_or_insert(rows.clone()), rows);
            }
            for target in self.targets(run) {
                for (is_reached, separator) in is_reached.iter_mut().zip(separators) {
                    *is_reached |= separator.runs.contains(&target);
                }
            }
        }

        let mut rows = Vec::new();
        let mut numbers: Option<Range<usize>> = None;
        for (separator, _) in separators.iter().zip(is_reached).filter(|pair| pair.1) {
            rows.push(separator.rows.clone());
            include(window.get_or_insert(separator.rows.clone()), separator.rows.clone());
            include(numbers.get_or_insert(separator.numbers.clone()), separator.numbers.clone());
        }
        MatrixPart {
            window: window.unwrap_or_default(),
            separators: rows,
            separator_numbers: numbers.unwrap_or_default(),
            group,
        }
    }

    /// Returns the runs of the columns of `run`, in any order and with repeats.
    fn targets(&self, run: &Run) -> impl Iterator<Item = usize> {
        let diagonals = self.diagonals[run.diagonals.clone()].iter().map(|d| d.run);
        let batches = &self.irregular_of[run.batches..][..run.len() / LANES];
        let irregular = batches.iter().flat_map(|batch| &self.irregular[batch.clone()]);
        let columns = irregular.map(|entry| self.run_of_row[entry.column as usize]);
        diagonals.chain(columns).map(|target| target as usize)
    }

    /// Returns the range of the rows of `run` and of the columns of its diagonals.
    fn rows_of(&self, run: &Run) -> Range<usize> {
        let mut rows = run.start..run.end;
        for diagonal in &self.diagonals[run.diagonals.clone()] {
            include(&mut rows, diagonal.column(run.start)..diagonal.column(run.end));
        }
        rows
    }

    /// Finds the look-ahead of each run.
    fn find_look_ahead(&mut self) {
        let groups = self.parts.iter().map(|part| &part.group).chain(&self.separators);
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

    /// Returns the chunk of `runs`, without the incoming entries of other chunks.
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

    /// Returns the index of the chunk of `row`.
    pub(crate) fn chunk_of(&self, row: usize) -> usize {
        self.chunks.partition_point(|chunk| chunk.rows.end <= row)
    }

    /// Returns the index of the chunk of the irregular entry `index`.
    pub(crate) fn chunk_of_entry(&self, index: usize) -> usize {
        self.chunks.partition_point(|chunk| chunk.irregular.end <= index)
    }

    /// Returns the address in the Schur complement of the block of `row` and a later `column`, if
    /// the sparsity has this block.
    pub(crate) fn address(&self, row: usize, column: usize) -> Option<BlockAddress> {
        let run = &self.runs[self.run_of_row[row] as usize];
        if let Some(diagonal) = self.diagonal(run, row, column) {
            return Some(run.address(diagonal, row));
        }
        let range = self.irregular_of[run.batches + (row - run.start) / LANES].clone();
        let index = self.irregular[range.clone()].iter().position(|entry| {
            entry.column as usize == column && entry.lane as usize == row % LANES
        })?;
        Some(run.irregular_address(range.start + index))
    }
}

/// Returns whether `distances` contain all of `others`.
fn contains_all(distances: &[Distance], others: &[Distance]) -> bool {
    others.iter().all(|other| distances.contains(other))
}

/// Widens `range` so that it includes `other`.
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
            assert_eq!(found, (0..sparsity.block_count()).collect::<Vec<_>>());
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
