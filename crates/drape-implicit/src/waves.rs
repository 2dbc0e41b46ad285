//! The order in which a matrix is eliminated, eight rows at once.

use crate::Pattern;
use crate::lanes::LANES;

/// Where a block would lie if the pattern had room for it.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// Rows before the first and, at the least, after the last: a batch may reach that far, with blocks of zeros.
pub(crate) const MARGIN: usize = LANES;

/// Particles in waves, and all that follows from them and a pattern.
///
/// A particle is in the first wave that comes after those of all its neighbours of smaller number: those of a wave do
/// not wait for each other, and the factor is the one of the order of the numbers. The rows of a wave are eliminated in
/// batches, one row to a lane. On a lattice the neighbours of a batch are batches again, at the same few distances in
/// all of a wave: the *diagonals* of a run of batches. Anything else works too, with more diagonals and zeros in them.
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
    /// Most diagonals of a run.
    pub widest: usize,
    /// Numbers of the factorisation: see [`Run::work`].
    pub work: usize,
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
}

impl Run {
    /// Number of rows.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.end - self.start
    }

    /// Place in a factorisation of the first number of a batch of a diagonal, both counted within the run.
    #[inline(always)]
    pub(crate) fn above(&self, diagonal: usize, batch: usize) -> usize {
        self.work + (6 + 9 * diagonal) * self.len() + batch * LANES
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

impl Waves {
    pub(crate) fn new(pattern: &Pattern) -> Self {
        let waves = sort(pattern);
        let mut places = vec![0; pattern.particles()];
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
            widest: 0,
            work: 0,
        };
        waves.find_runs(pattern, &particles, &starts);
        waves.make_room();
        waves.find_slots(pattern, &particles);
        waves.find_updates();
        waves
    }

    /// Cuts the waves, the last first, because diagonals name the runs that they lead to.
    fn find_runs(&mut self, pattern: &Pattern, particles: &[u32], starts: &[usize]) {
        let mut found: Vec<(usize, usize, Vec<Distance>)> = Vec::new();
        // Counted from the end until their number is known.
        let mut run_of_row = vec![0; particles.len()];
        for wave in starts.windows(2).rev() {
            let first = found.len();
            for start in (wave[0]..wave[1]).step_by(LANES).rev() {
                let mut own = Vec::new();
                for (row, &particle) in particles.iter().enumerate().skip(start).take(LANES) {
                    for (_, column) in self.later(pattern, particle) {
                        own.push((column - row, run_of_row[column]));
                    }
                }
                own.sort_unstable();
                own.dedup();
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
    fn later(&self, pattern: &Pattern, particle: u32) -> impl Iterator<Item = (usize, usize)> {
        let slots = match particle {
            NOWHERE => 0..0,
            particle => pattern.row(particle as usize),
        };
        slots.skip(1).map(|slot| (slot, self.places[pattern.columns()[slot] as usize] as usize))
    }

    fn find_slots(&mut self, pattern: &Pattern, particles: &[u32]) {
        for index in 0..self.runs.len() {
            let run = self.runs[index].clone();
            self.runs[index].blocks = self.slots.len();
            self.runs[index].batches = self.own_slots.len();
            for start in (run.start..run.end).step_by(LANES) {
                let mut own = [NOWHERE; LANES];
                let mut blocks = vec![[NOWHERE; LANES]; run.diagonals.len()];
                for lane in 0..LANES {
                    let row = start + lane;
                    let particle = particles[row];
                    if particle != NOWHERE {
                        own[lane] = pattern.row(particle as usize).start as u32;
                    }
                    for (slot, column) in self.later(pattern, particle) {
                        let leads = |d: &Diagonal| {
                            let run = &self.runs[d.run as usize];
                            d.offset == column - row && (run.start..run.end).contains(&column)
                        };
                        let diagonals = &self.diagonals[run.diagonals.clone()];
                        let place = diagonals.iter().position(leads);
                        blocks[place.expect("it was collected from these rows")][lane] =
                            slot as u32;
                    }
                }
                self.own_slots.push(own);
                self.slots.append(&mut blocks);
            }
        }
    }

    fn find_updates(&mut self) {
        for run in &self.runs {
            for left in run.diagonals.clone() {
                let first = self.updates.len();
                let a = &self.diagonals[left];
                let others = &self.diagonals[self.runs[a.run as usize].diagonals.clone()];
                for right in left + 1..run.diagonals.end {
                    let b = &self.diagonals[right];
                    let target = others
                        .iter()
                        .position(|d| d.run == b.run && a.offset + d.offset == b.offset)
                        .map_or(NOWHERE, |place| place as u32);
                    let right = (right - run.diagonals.start) as u32;
                    self.updates.push(Update { right, target });
                }
                self.diagonals[left].updates = first..self.updates.len();
            }
        }
    }
}

/// Column less row, and the run of the column.
type Distance = (usize, u32);

/// The particles of each wave, ascending.
fn sort(pattern: &Pattern) -> Vec<Vec<u32>> {
    let mut wave_of = vec![0; pattern.particles()];
    let mut waves: Vec<Vec<u32>> = Vec::new();
    for particle in 0..pattern.particles() {
        let own: usize = wave_of[particle];
        for slot in pattern.row(particle).skip(1) {
            let later = &mut wave_of[pattern.columns()[slot] as usize];
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
mod tests {
    use super::*;

    /// The couplings of woven cloth: neighbours, those beyond them, and those across a cell.
    fn weave(n: usize) -> Pattern {
        let steps = [(0, 1), (0, 2), (1, -1), (1, 0), (1, 1), (2, 0)];
        let cells = (0..n as i64).flat_map(|i| (0..n as i64).map(move |j| (i, j)));
        let inside = |&((_, _), (i, j)): &((i64, i64), (i64, i64))| {
            i < n as i64 && (0..n as i64).contains(&j)
        };
        let number = |(i, j): (i64, i64)| i as usize * n + j as usize;
        let pairs = cells
            .flat_map(|(i, j)| steps.map(|(down, right)| ((i, j), (i + down, j + right))))
            .filter(inside)
            .map(|(a, b)| (number(a), number(b)));
        Pattern::from_pairs(n * n, pairs).unwrap()
    }

    #[test]
    fn every_block_has_one_place() {
        for pattern in [weave(11), Pattern::from_pairs(9, [(0, 8), (3, 4), (1, 7)]).unwrap()] {
            let waves = Waves::new(&pattern);
            let slots = waves.slots.iter().chain(&waves.own_slots).flatten();
            let mut found: Vec<u32> = slots.copied().filter(|&slot| slot != NOWHERE).collect();
            found.sort_unstable();
            assert_eq!(found, (0..pattern.blocks() as u32).collect::<Vec<_>>());
        }
    }

    #[test]
    fn no_row_of_a_run_waits_for_another() {
        let waves = Waves::new(&weave(11));
        for run in &waves.runs {
            for diagonal in &waves.diagonals[run.diagonals.clone()] {
                let target = &waves.runs[diagonal.run as usize];
                assert!(target.start >= run.end, "{run:?} leads to {target:?}");
            }
        }
    }

    #[test]
    fn cloth_needs_six_diagonals() {
        let waves = Waves::new(&weave(40));
        assert_eq!(waves.widest, 6);
        // A wave has up to 20 particles, and its last batch is half empty on average.
        assert!(waves.rows < 1600 * 4 / 3, "{} rows", waves.rows);
    }
}
