//! The order in which a matrix is eliminated, eight rows at once.

use crate::Sparsity;
use crate::lanes::LANES;

/// Where a block would lie if the sparsity had room for it.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// Rows before the first and, at the least, after the last: a batch may reach that far, with blocks of zeros.
pub(crate) const MARGIN: usize = LANES;

/// Particles in waves, and all that follows from them and a sparsity.
///
/// A particle is in the first wave that comes after those of all its neighbours of smaller number: those of a wave do
/// not wait for each other, and the factor is the one of the order of the numbers. The rows of a wave are eliminated in
/// batches, one row to a lane. On a lattice the neighbours of a batch are batches again, at the same few distances in
/// all of a wave: the *diagonals* of a run of batches. Blocks that no other lane of the batch would share, as those about
/// an outline, are *strays* and computed one by one.
#[derive(Debug)]
pub(crate) struct Waves {
    /// The row of each particle.
    pub places: Vec<u32>,
    /// Number of rows, margins and the padding of waves included.
    pub rows: usize,
    /// In the order of elimination.
    pub runs: Vec<Run>,
    pub diagonals: Vec<Diagonal>,
    pub updates: Vec<Update>,
    /// For each block of the batches above the diagonal, and in it each lane, the slot of the matrix.
    pub slots: Vec<[u32; LANES]>,
    /// For each batch of the diagonal the slots of the matrix.
    pub own_slots: Vec<[u32; LANES]>,
    /// What each batch has besides its diagonals.
    pub batches: Vec<Batch>,
    pub strays: Vec<Stray>,
    pub stray_updates: Vec<StrayUpdate>,
    /// Where a factorisation has the pivot of each row.
    pub pivots: Vec<Place>,
    /// Most diagonals of a run.
    pub widest: usize,
    /// Most strays of a batch.
    pub most_strays: usize,
    /// Numbers of the factorisation: see [`Run::work`] and [`stray`](Self::stray).
    pub work: usize,
    /// First number of the strays.
    stray_work: usize,
}

/// Batches of a wave that share their diagonals.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    pub start: usize,
    pub end: usize,
    pub diagonals: core::ops::Range<usize>,
    /// First of its blocks above the diagonal, which are ordered by batch, then by diagonal.
    pub blocks: usize,
    /// First of its batches.
    pub batches: usize,
    /// First of its numbers in a factorisation: six columns of its rows for the pivots, then nine for each diagonal.
    pub work: usize,
    /// Runs from the first that its elimination, and that of those before, changes or reads.
    pub ahead: usize,
}

impl Run {
    /// Number of rows.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.end - self.start
    }

    /// Its blocks above the diagonal in a batch.
    #[inline(always)]
    pub(crate) fn blocks_of(&self, batch: usize) -> core::ops::Range<usize> {
        let first = self.blocks + batch * self.diagonals.len();
        first..first + self.diagonals.len()
    }

    /// Place in a factorisation of the first number of a batch of a diagonal, both counted within the run.
    #[inline(always)]
    pub(crate) fn above(&self, diagonal: usize, batch: usize) -> usize {
        self.work + (6 + 9 * diagonal) * self.len() + batch * LANES
    }

    /// The same for one row.
    #[inline(always)]
    pub(crate) fn place(&self, diagonal: usize, row: usize) -> Place {
        let first = self.above(diagonal, 0) + row - self.start;
        Place { first: first as u32, step: self.len() as u32 }
    }
}

/// Blocks of the rows of a run, all at one distance from their columns.
#[derive(Clone, Debug)]
pub(crate) struct Diagonal {
    /// Column less row.
    pub offset: usize,
    /// The run that the columns lie in.
    pub run: u32,
    /// What its blocks do with those of the run's later diagonals. With themselves, they are taken off the pivots.
    pub updates: core::ops::Range<usize>,
}

/// The blocks of a diagonal times those of another one of the run, taken off a third one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Update {
    /// The other, counted within the run.
    pub right: u32,
    /// The third, counted within the run of the first's columns, or [`NOWHERE`].
    pub target: u32,
}

/// What a batch has besides its diagonals.
#[derive(Clone, Debug)]
pub(crate) struct Batch {
    pub strays: core::ops::Range<usize>,
    pub updates: core::ops::Range<usize>,
}

/// A block by itself.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stray {
    /// Its row, counted within its batch.
    pub lane: u32,
    /// The row of its column.
    pub column: u32,
    /// Its slot in the matrix.
    pub slot: u32,
}

/// A block of a lane times another one of it, taken off a third one. Those of the diagonals of the run count first, then
/// the strays of the batch. With themselves, they are taken off the pivots.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StrayUpdate {
    pub lane: u32,
    /// The one whose column is eliminated first.
    pub left: u32,
    pub right: u32,
    /// The third, or the pivots of both columns in place of one that the sparsity has no room for.
    pub target: Result<Place, [Place; 2]>,
}

/// Where a factorisation keeps the block of a lane: its numbers are so many apart.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Place {
    pub first: u32,
    pub step: u32,
}

impl Waves {
    pub(crate) fn new(sparsity: &Sparsity) -> Self {
        let waves = sort(sparsity);
        let mut places = vec![0; sparsity.particles()];
        let mut particles = vec![NOWHERE; MARGIN];
        let mut starts = Vec::new();
        for wave in &waves {
            starts.push(particles.len());
            for &particle in wave {
                places[particle as usize] = particles.len() as u32;
                particles.push(particle);
            }
            particles.resize(particles.len().next_multiple_of(LANES), NOWHERE);
        }
        starts.push(particles.len());
        particles.resize(particles.len() + MARGIN, NOWHERE);

        let mut waves = Self {
            rows: particles.len(),
            places,
            runs: Vec::new(),
            diagonals: Vec::new(),
            updates: Vec::new(),
            slots: Vec::new(),
            own_slots: Vec::new(),
            batches: Vec::new(),
            strays: Vec::new(),
            stray_updates: Vec::new(),
            pivots: Vec::new(),
            widest: 0,
            most_strays: 0,
            work: 0,
            stray_work: 0,
        };
        let run_of_row = waves.find_runs(sparsity, &particles, &starts);
        waves.make_room();
        waves.find_slots(sparsity, &particles);
        waves.find_pivots();
        waves.look_ahead(&run_of_row);
        waves.find_updates(sparsity, &particles, &run_of_row);
        waves
    }

    /// Cuts the waves, the last first, because diagonals name the runs that they lead to. Returns the run of each row.
    fn find_runs(&mut self, sparsity: &Sparsity, particles: &[u32], starts: &[usize]) -> Vec<u32> {
        let mut found: Vec<(usize, usize, Vec<Distance>)> = Vec::new();
        // Counted from the end until their number is known.
        let mut run_of_row = vec![0; particles.len()];
        for wave in starts.windows(2).rev() {
            let first = found.len();
            for start in (wave[0]..wave[1]).step_by(LANES).rev() {
                let mut distances = Vec::new();
                for (row, &particle) in particles.iter().enumerate().skip(start).take(LANES) {
                    for (_, column) in self.later(sparsity, particle) {
                        distances.push((column - row, run_of_row[column]));
                    }
                }
                distances.sort_unstable();
                let shared = distances.chunk_by(|a, b| a == b).filter(|same| same.len() > 1);
                let own: Vec<Distance> = shared.map(|same| same[0]).collect();
                let part = |a: &[Distance], b: &[Distance]| a.iter().all(|x| b.contains(x));
                match found[first..].last_mut() {
                    Some((first_row, _, diagonals)) if part(&own, diagonals) => *first_row = start,
                    Some((first_row, _, diagonals)) if part(diagonals, &own) => {
                        *first_row = start;
                        *diagonals = own;
                    }
                    _ => found.push((start, start + LANES, own)),
                }
                run_of_row[start..start + LANES].fill(found.len() as u32 - 1);
            }
        }
        let last = found.len() as u32 - u32::from(!found.is_empty());
        for (start, end, diagonals) in found.into_iter().rev() {
            let (first, count) = (self.diagonals.len(), diagonals.len());
            self.runs.push(Run {
                start,
                end,
                diagonals: first..first + count,
                blocks: 0,
                batches: 0,
                work: self.work,
                ahead: 0,
            });
            self.work += (end - start) * (6 + 9 * count);
            self.widest = self.widest.max(count);
            let counted = diagonals.into_iter();
            self.diagonals.extend(counted.map(|(offset, run)| Diagonal {
                offset,
                run: last - run,
                updates: 0..0,
            }));
        }
        run_of_row.into_iter().map(|run| last.saturating_sub(run)).collect()
    }

    /// Adds rows and numbers at the ends: all batches of a run have blocks at all its distances, and those of zeros may
    /// lead beyond the last row.
    fn make_room(&mut self) {
        for run in &self.runs {
            for diagonal in &self.diagonals[run.diagonals.clone()] {
                let target = &self.runs[diagonal.run as usize];
                let reach = run.end + diagonal.offset;
                self.rows = self.rows.max(reach);
                let last = target.above(target.diagonals.len(), 0) - target.len();
                self.work = self.work.max(last + reach.saturating_sub(target.start));
            }
        }
    }

    /// Slots and columns of a particle's blocks above the diagonal.
    fn later(&self, sparsity: &Sparsity, particle: u32) -> impl Iterator<Item = (usize, usize)> {
        let slots = match particle {
            NOWHERE => 0..0,
            particle => sparsity.row(particle as usize),
        };
        slots.skip(1).map(|slot| (slot, self.places[sparsity.columns()[slot] as usize] as usize))
    }

    /// Gives every block of the sparsity its place, on a diagonal if there is one for it.
    fn find_slots(&mut self, sparsity: &Sparsity, particles: &[u32]) {
        for index in 0..self.runs.len() {
            let run = self.runs[index].clone();
            self.runs[index].blocks = self.slots.len();
            self.runs[index].batches = self.own_slots.len();
            for start in (run.start..run.end).step_by(LANES) {
                let mut own = [NOWHERE; LANES];
                let mut blocks = vec![[NOWHERE; LANES]; run.diagonals.len()];
                let mut strays = Vec::new();
                for lane in 0..LANES {
                    let row = start + lane;
                    let particle = particles[row];
                    if particle != NOWHERE {
                        own[lane] = sparsity.row(particle as usize).start as u32;
                    }
                    for (slot, column) in self.later(sparsity, particle) {
                        let slot = slot as u32;
                        match self.diagonal(&run, row, column) {
                            Some(place) => blocks[place][lane] = slot,
                            None => strays.push(Stray {
                                lane: lane as u32,
                                column: column as u32,
                                slot,
                            }),
                        }
                    }
                }
                self.own_slots.push(own);
                self.slots.append(&mut blocks);
                self.most_strays = self.most_strays.max(strays.len());
                let first = self.strays.len();
                self.strays.append(&mut strays);
                self.batches.push(Batch { strays: first..self.strays.len(), updates: 0..0 });
            }
        }
        self.stray_work = self.work;
        self.work += 9 * self.strays.len();
    }

    /// The diagonal of a run, counted within it, that leads from a row to a column.
    fn diagonal(&self, run: &Run, row: usize, column: usize) -> Option<usize> {
        self.diagonals[run.diagonals.clone()].iter().position(|d| {
            let run = &self.runs[d.run as usize];
            row + d.offset == column && (run.start..run.end).contains(&column)
        })
    }

    /// Where a factorisation keeps a stray.
    #[inline(always)]
    pub(crate) fn stray(&self, index: usize) -> Place {
        Place { first: (self.stray_work + 9 * index) as u32, step: 1 }
    }

    /// Finds how far ahead of a run its columns lie.
    fn look_ahead(&mut self, run_of_row: &[u32]) {
        let mut ahead = 0;
        for (index, run) in self.runs.iter_mut().enumerate() {
            let diagonals = self.diagonals[run.diagonals.clone()].iter().map(|d| d.run);
            let batches = &self.batches[run.batches..][..run.len() / LANES];
            let strays = batches.iter().flat_map(|batch| &self.strays[batch.strays.clone()]);
            let columns = strays.map(|stray| run_of_row[stray.column as usize]);
            let last = diagonals.chain(columns).max().map_or(0, |last| last as usize);
            ahead = ahead.max(index + 1).max(last + 1);
            run.ahead = ahead;
        }
    }

    fn find_pivots(&mut self) {
        self.pivots = vec![Place::default(); self.rows];
        for run in &self.runs {
            for row in run.start..run.end {
                let first = (run.work + row - run.start) as u32;
                self.pivots[row] = Place { first, step: run.len() as u32 };
            }
        }
    }

    fn find_updates(&mut self, sparsity: &Sparsity, particles: &[u32], run_of_row: &[u32]) {
        for index in 0..self.runs.len() {
            let run = self.runs[index].clone();
            let own = run.diagonals.start;
            // Pairs of diagonals whose product belongs to strays, in some lane at least.
            let mut apart = Vec::new();
            for left in run.diagonals.clone() {
                let first = self.updates.len();
                let a = self.diagonals[left].clone();
                let others = &self.diagonals[self.runs[a.run as usize].diagonals.clone()];
                for right in left + 1..run.diagonals.end {
                    let b = &self.diagonals[right];
                    let target = others
                        .iter()
                        .position(|d| d.run == b.run && a.offset + d.offset == b.offset)
                        .map_or(NOWHERE, |place| place as u32);
                    let coupled = |row: usize| {
                        let ends = [row + a.offset, row + b.offset].map(|row| particles.get(row));
                        matches!(ends, [Some(&a), Some(&b)] if a != NOWHERE && b != NOWHERE
                            && sparsity.slot(a as usize, b as usize).is_some())
                    };
                    if target == NOWHERE && (run.start..run.end).any(coupled) {
                        apart.push((left - own, right - own));
                    } else {
                        self.updates.push(Update { right: (right - own) as u32, target });
                    }
                }
                self.diagonals[left].updates = first..self.updates.len();
            }
            for batch in 0..run.len() / LANES {
                let first = self.stray_updates.len();
                for lane in 0..LANES {
                    self.find_stray_updates((&run, batch, lane), &apart, (particles, run_of_row));
                }
                let updates = first..self.stray_updates.len();
                self.batches[run.batches + batch].updates = updates;
            }
        }
    }

    /// Of a lane, for pairs of diagonals and for all with strays in them.
    fn find_stray_updates(
        &mut self,
        (run, batch, lane): (&Run, usize, usize),
        apart: &[(usize, usize)],
        (particles, run_of_row): (&[u32], &[u32]),
    ) {
        let row = run.start + batch * LANES + lane;
        if particles[row] == NOWHERE {
            return;
        }
        let count = run.diagonals.len();
        let slots = &self.slots[run.blocks_of(batch)];
        let diagonals = self.diagonals[run.diagonals.clone()].iter().zip(slots).enumerate();
        let mut items: Vec<(usize, usize)> = diagonals
            .filter(|(_, (_, slots))| slots[lane] != NOWHERE)
            .map(|(index, (diagonal, _))| (index, row + diagonal.offset))
            .collect();
        let strays = &self.strays[self.batches[run.batches + batch].strays.clone()];
        let own = strays.iter().enumerate().filter(|(_, stray)| stray.lane as usize == lane);
        items.extend(own.map(|(index, stray)| (count + index, stray.column as usize)));
        for (before, &later) in items.iter().enumerate() {
            for &earlier in &items[..before] {
                if later.0 < count && !apart.contains(&(earlier.0, later.0)) {
                    continue;
                }
                let in_order = earlier.1 < later.1;
                let ((a, left), (b, right)) =
                    if in_order { (earlier, later) } else { (later, earlier) };
                let place = self.place((left, right), run_of_row);
                self.stray_updates.push(StrayUpdate {
                    lane: lane as u32,
                    left: a as u32,
                    right: b as u32,
                    target: place.ok_or([self.pivots[left], self.pivots[right]]),
                });
            }
        }
    }

    /// Where a factorisation keeps the block of a row and a later one, if there is room for it.
    fn place(&self, (row, column): (usize, usize), run_of_row: &[u32]) -> Option<Place> {
        let run = &self.runs[run_of_row[row] as usize];
        if let Some(diagonal) = self.diagonal(run, row, column) {
            return Some(run.place(diagonal, row));
        }
        let range = self.batches[run.batches + (row - run.start) / LANES].strays.clone();
        let is =
            |stray: &Stray| stray.column as usize == column && stray.lane as usize == row % LANES;
        let index = self.strays[range.clone()].iter().position(is)?;
        Some(self.stray(range.start + index))
    }
}

/// Column less row, and the run of the column.
type Distance = (usize, u32);

/// The particles of each wave, ascending.
fn sort(sparsity: &Sparsity) -> Vec<Vec<u32>> {
    let mut wave_of = vec![0; sparsity.particles()];
    let mut waves: Vec<Vec<u32>> = Vec::new();
    for particle in 0..sparsity.particles() {
        let own: usize = wave_of[particle];
        for slot in sparsity.row(particle).skip(1) {
            let later = &mut wave_of[sparsity.columns()[slot] as usize];
            *later = (*later).max(own + 1);
        }
        if own >= waves.len() {
            waves.resize(own + 1, Vec::new());
        }
        waves[own].push(particle as u32);
    }
    waves
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// The couplings of woven cloth: neighbours, those beyond them, and those across a cell.
    fn weave(n: usize) -> Sparsity {
        let steps = [(0, 1), (0, 2), (1, -1), (1, 0), (1, 1), (2, 0)];
        let cells = (0..n as i64).flat_map(|i| (0..n as i64).map(move |j| (i, j)));
        let inside = |&((_, _), (i, j)): &((i64, i64), (i64, i64))| {
            i < n as i64 && (0..n as i64).contains(&j)
        };
        let number = |(i, j): (i64, i64)| i as usize * n + j as usize;
        let pairs = cells
            .flat_map(|(i, j)| steps.map(|(down, right)| ((i, j), (i + down, j + right))))
            .filter(inside)
            .map(|(a, b)| [number(a), number(b)]);
        Sparsity::from_pairs(n * n, pairs).unwrap()
    }

    /// A square of `n` by `n` with a chain around it, numbered last, each link tied to the nearest of the square.
    pub(crate) fn rimmed(n: usize) -> Sparsity {
        let inside = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let steps = [(0, 1), (1, 0), (1, 1)];
        let lattice = inside
            .flat_map(|(i, j)| steps.map(|(down, right)| ((i, j), (i + down, j + right))))
            .filter(|&(_, (i, j))| i < n && j < n)
            .map(|((i, j), (k, l))| [i * n + j, k * n + l]);
        let side = |k: usize| {
            (0..n - 1).map(move |along| match k {
                0 => along,
                1 => along * n + n - 1,
                2 => n * n - 1 - along,
                _ => (n - 1 - along) * n,
            })
        };
        let edge: Vec<usize> = (0..4).flat_map(side).collect();
        let first = n * n;
        let links = (0..edge.len()).flat_map(|k| {
            let next = (k + 1) % edge.len();
            [[first + k, first + next], [first + k, edge[k]], [first + k, edge[next]]]
        });
        Sparsity::from_pairs(first + edge.len(), lattice.chain(links)).unwrap()
    }

    #[test]
    fn what_surrounds_a_lattice_does_not_widen_its_runs() {
        let waves = Waves::new(&rimmed(40));
        assert!(waves.widest <= 6, "{} diagonals in a run", waves.widest);
        // Each link has three blocks.
        assert!(waves.strays.len() <= 3 * 156, "{} strays", waves.strays.len());
    }

    #[test]
    fn every_block_has_one_place() {
        let few = Sparsity::from_pairs(9, [[0, 8], [3, 4], [1, 7]]).unwrap();
        for sparsity in [weave(11), rimmed(12), few] {
            let waves = Waves::new(&sparsity);
            let slots = waves.slots.iter().chain(&waves.own_slots).flatten().copied();
            let found = slots.filter(|&slot| slot != NOWHERE);
            let strays = waves.strays.iter().map(|stray| stray.slot);
            let mut found: Vec<u32> = found.chain(strays).collect();
            found.sort_unstable();
            assert_eq!(found, (0..sparsity.blocks() as u32).collect::<Vec<_>>());
        }
    }

    #[test]
    fn no_row_of_a_run_waits_for_another() {
        for sparsity in [weave(11), rimmed(12)] {
            let waves = Waves::new(&sparsity);
            for run in &waves.runs {
                for diagonal in &waves.diagonals[run.diagonals.clone()] {
                    let target = &waves.runs[diagonal.run as usize];
                    assert!(target.start >= run.end, "{run:?} leads to {target:?}");
                }
                for batch in &waves.batches[run.batches..][..run.len() / LANES] {
                    for stray in &waves.strays[batch.strays.clone()] {
                        assert!(stray.column as usize >= run.end, "{run:?} leads to {stray:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn cloth_needs_six_diagonals() {
        let waves = Waves::new(&weave(40));
        assert_eq!(waves.widest, 6);
        assert!(waves.strays.len() < 200, "{} of 9200 blocks go astray", waves.strays.len());
        // A wave has up to 20 particles, and its last batch is half empty on average.
        assert!(waves.rows < 1600 * 4 / 3, "{} rows", waves.rows);
    }
}
