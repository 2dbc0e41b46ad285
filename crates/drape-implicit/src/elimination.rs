//! Which blocks an incomplete factorisation works on, and in which order.

use crate::Pattern;

/// Where an update's block would lie if the pattern had room for it.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// A block `left` times a block `right` of one row, taken off the block `target`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Update {
    pub left: u32,
    pub right: u32,
    pub target: u32,
}

/// A block of the matrix, by its slot, or its transpose.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source {
    pub slot: u32,
    pub transposed: bool,
}

/// The order of elimination and all that follows from it and a pattern.
///
/// Particles are eliminated from both ends towards the middle, in turn. Neighbours in this order do not wait for each
/// other, so the processor works on both at once: a solve takes a fifth less time than from one end, with the same
/// number of iterations.
///
/// The blocks above the diagonal are counted row by row in the order of elimination; those of the diagonal follow, by
/// particle.
#[derive(Debug)]
pub(crate) struct Elimination {
    /// Particles in the order of elimination.
    pub order: Vec<u32>,
    /// Where each row starts, and the end of the last.
    pub offsets: Vec<u32>,
    /// Particle of each block above the diagonal, in a row by the order of elimination.
    pub columns: Vec<u32>,
    pub sources: Vec<Source>,
    pub updates: Vec<Update>,
    /// Where each row's updates start, and the end of the last.
    pub update_offsets: Vec<u32>,
    /// Most blocks of a row above the diagonal.
    pub longest: usize,
}

impl Elimination {
    pub(crate) fn new(pattern: &Pattern) -> Self {
        let order = both_ends(pattern.particles());
        let rows = rows(pattern, &order);
        let mut offsets = vec![0];
        for row in &rows {
            offsets.push(offsets[offsets.len() - 1] + row.len() as u32);
        }
        let above = offsets[rows.len()];
        let mut updates = Vec::new();
        let mut update_offsets = vec![0];
        for (row, &start) in rows.iter().zip(&offsets) {
            for (left, &(i, _)) in row.iter().enumerate() {
                for (right, &(j, _)) in row.iter().enumerate().skip(left) {
                    let place = || rows[i].binary_search_by_key(&j, |entry| entry.0).ok();
                    let target = match place() {
                        _ if i == j => above + order[i],
                        Some(place) => offsets[i] + place as u32,
                        None => NOWHERE,
                    };
                    let [left, right] = [left, right].map(|place| start + place as u32);
                    updates.push(Update { left, right, target });
                }
            }
            update_offsets.push(updates.len() as u32);
        }
        let entries = || rows.iter().flatten();
        Self {
            columns: entries().map(|&(rank, _)| order[rank]).collect(),
            sources: entries().map(|&(_, source)| source).collect(),
            longest: rows.iter().map(Vec::len).max().unwrap_or(0),
            order,
            offsets,
            updates,
            update_offsets,
        }
    }

    /// The blocks above the diagonal of the row that is eliminated at some rank.
    pub(crate) fn row(&self, rank: usize) -> core::ops::Range<usize> {
        self.offsets[rank] as usize..self.offsets[rank + 1] as usize
    }

    pub(crate) fn updates(&self, rank: usize) -> &[Update] {
        let (start, end) = (self.update_offsets[rank], self.update_offsets[rank + 1]);
        &self.updates[start as usize..end as usize]
    }
}

/// 0, n − 1, 1, n − 2 …
fn both_ends(particles: usize) -> Vec<u32> {
    let end = |place: usize| match place % 2 {
        0 => place / 2,
        _ => particles - 1 - place / 2,
    };
    (0..particles).map(|place| end(place) as u32).collect()
}

/// For each rank the later ranks coupled to it, ascending, and where their blocks come from.
fn rows(pattern: &Pattern, order: &[u32]) -> Vec<Vec<(usize, Source)>> {
    let mut rank = vec![0; order.len()];
    for (place, &particle) in order.iter().enumerate() {
        rank[particle as usize] = place;
    }
    let mut rows = vec![Vec::new(); order.len()];
    for particle in 0..order.len() {
        for slot in pattern.row(particle).skip(1) {
            let (own, other) = (rank[particle], rank[pattern.columns()[slot] as usize]);
            let source = Source { slot: slot as u32, transposed: other < own };
            rows[own.min(other)].push((own.max(other), source));
        }
    }
    for row in &mut rows {
        row.sort_unstable_by_key(|entry| entry.0);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elimination_runs_from_both_ends_and_names_each_particle_once() {
        assert_eq!(both_ends(5), [0, 4, 1, 3, 2]);
        assert_eq!(both_ends(4), [0, 3, 1, 2]);
        assert_eq!(both_ends(0), []);
    }

    #[test]
    fn a_block_below_the_diagonal_of_the_order_is_read_transposed() {
        // Order 0, 2, 1: the block (1, 2) of the pattern is the block (2, 1) of the order.
        let pattern = Pattern::from_pairs(3, [(0, 1), (1, 2)]).unwrap();
        let elimination = Elimination::new(&pattern);
        assert_eq!(elimination.columns, [1, 1]);
        let transposed: Vec<bool> = elimination.sources.iter().map(|s| s.transposed).collect();
        assert_eq!(transposed, [false, true]);
    }
}
