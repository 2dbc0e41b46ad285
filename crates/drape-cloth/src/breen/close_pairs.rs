//! Particles that are close in space, wherever they are in the cloth. The list is kept while they
//! move little.

use crate::breen::well::Well;
use crate::measure::vector::{length, subtract, vector_at};

/// Distance beyond the spacing up to which pairs are listed, in spacings. It keeps the list valid
/// while particles move.
///
/// Larger values lengthen the list, smaller values renew it more often. A settling cloth moves by
/// at most a quarter of the spacing in a step.
const MARGIN: f64 = 0.5;

/// Cell of space, by its indices along the axes.
type SpaceCell = [i64; 3];

/// Pairs of particles that are close in space, found by sorting the particles into the cells of a
/// grid.
#[derive(Debug, Clone)]
pub(crate) struct ClosePairs {
    /// Distance up to which pairs are listed, and side of a cell, in m.
    list_distance: f64,
    /// Distance that a particle may move before the list is renewed, in m.
    slack: f64,
    /// Neighbours of each particle along its yarns, which are not listed.
    neighbours: Vec<[u32; 4]>,
    /// Positions at which the list was made, in m.
    listed: Vec<f64>,
    pairs: Vec<[u32; 2]>,
    cells: Vec<(SpaceCell, u32)>,
}

/// Half of the 26 neighbours of a cell, so that each pair of cells occurs once.
const AFTER: [SpaceCell; 13] = [
    [0, 0, 1],
    [0, 1, -1],
    [0, 1, 0],
    [0, 1, 1],
    [1, -1, -1],
    [1, -1, 0],
    [1, -1, 1],
    [1, 0, -1],
    [1, 0, 0],
    [1, 0, 1],
    [1, 1, -1],
    [1, 1, 0],
    [1, 1, 1],
];

impl ClosePairs {
    pub(crate) fn new(wells: &[Well], neighbours: Vec<[u32; 4]>) -> Self {
        let spacing = wells.iter().map(|well| well.spacing).fold(0.0, f64::max);
        Self {
            list_distance: (1.0 + MARGIN) * spacing,
            slack: 0.5 * MARGIN * spacing,
            neighbours,
            listed: Vec::new(),
            pairs: Vec::new(),
            cells: Vec::new(),
        }
    }

    /// Returns all pairs that are nearer than the spacing at `positions`, and some that are
    /// farther, in rising order.
    ///
    /// The sums over the pairs do not depend on when the list was made, because the order is fixed
    /// and pairs beyond the spacing contribute nothing.
    pub(crate) fn find(&mut self, positions: &[f64]) -> &[[u32; 2]] {
        let moved =
            self.listed.chunks_exact(3).zip(positions.chunks_exact(3)).any(|(then, now)| {
                let moved = subtract([now[0], now[1], now[2]], [then[0], then[1], then[2]]);
                // Written so that NaN counts as moved.
                !(length(moved) <= self.slack)
            });
        if moved || self.listed.len() != positions.len() {
            self.list(positions);
        }
        &self.pairs
    }

    /// Returns the positions at which the list was made, in m, empty before the first list.
    pub(crate) fn listed(&self) -> &[f64] {
        &self.listed
    }

    /// Makes the list at `positions`, in m.
    pub(crate) fn list(&mut self, positions: &[f64]) {
        self.listed.clear();
        self.listed.extend_from_slice(positions);
        self.pairs.clear();
        let side = self.list_distance;
        self.cells.clear();
        self.cells.extend(positions.chunks_exact(3).enumerate().map(|(particle, x)| {
            ([0, 1, 2].map(|axis| (x[axis] / side).floor() as i64), particle as u32)
        }));
        self.cells.sort_unstable();

        // Each run of equal cells is paired with itself and with half of the cells around it.
        let mut start = 0;
        while start < self.cells.len() {
            let cell = self.cells[start].0;
            let end = start + self.cells[start..].partition_point(|(next, _)| *next == cell);
            for first in start..end {
                for second in first + 1..end {
                    self.list_pair(first, second, positions);
                }
            }
            for step in AFTER {
                let beside = [0, 1, 2].map(|axis| cell[axis].saturating_add(step[axis]));
                let from = end + self.cells[end..].partition_point(|(cell, _)| *cell < beside);
                let count = self.cells[from..].partition_point(|(cell, _)| *cell == beside);
                for first in start..end {
                    for second in from..from + count {
                        self.list_pair(first, second, positions);
                    }
                }
            }
            start = end;
        }
        self.pairs.sort_unstable();
    }

    /// Lists the particles of the entries `first` and `second` of the cells if they are close and
    /// not neighbours on a yarn.
    fn list_pair(&mut self, first: usize, second: usize, positions: &[f64]) {
        let [a, b] = [self.cells[first].1, self.cells[second].1];
        let pair = [a.min(b), a.max(b)];
        if self.neighbours[pair[0] as usize].contains(&pair[1]) {
            return;
        }
        if length(subtract(vector_at(positions, b), vector_at(positions, a))) < self.list_distance {
            self.pairs.push(pair);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers between 0 and 1, the same on every machine.
    fn random(count: usize) -> Vec<f64> {
        let mut state = 7_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..count).map(|_| next()).collect()
    }

    #[test]
    fn every_close_pair_is_found_wherever_it_is_at_every_spacing() {
        for spacing in [1e-3, 0.1, 10.0] {
            finds_every_close_pair(spacing);
        }
    }

    /// Finds the pairs of particles in a cube with sides of ten spacings.
    fn finds_every_close_pair(spacing: f64) {
        let count = 400;
        let wells = vec![Well { spacing, energy: 1.0 }; count];
        let mut neighbours = vec![[u32::MAX; 4]; count];
        neighbours[3] = [4, u32::MAX, u32::MAX, u32::MAX];
        neighbours[4] = [u32::MAX, 3, u32::MAX, u32::MAX];
        let mut pairs = ClosePairs::new(&wells, neighbours);
        let mut positions: Vec<f64> =
            random(3 * count).iter().map(|x| 10.0 * spacing * (x - 0.5)).collect();
        // Neighbours on a yarn are at one point, and are not listed.
        positions.copy_within(9..12, 12);
        for round in 0..3 {
            positions.iter_mut().for_each(|x| *x += 0.2 * spacing * f64::from(round));
            let found: Vec<[u32; 2]> = pairs.find(&positions).to_vec();
            let distance = |[a, b]: [u32; 2]| {
                length(subtract(vector_at(&positions, b), vector_at(&positions, a)))
            };
            let all = (0..count as u32).flat_map(|a| (a + 1..count as u32).map(move |b| [a, b]));
            let exact = all.filter(|&pair| distance(pair) < spacing && pair != [3, 4]);
            let within: Vec<[u32; 2]> =
                found.iter().copied().filter(|&pair| distance(pair) < spacing).collect();
            assert_eq!(within, exact.collect::<Vec<_>>(), "spacing {spacing}, round {round}");
            assert!(found.len() < 4 * within.len() && within.len() > 100, "{}", within.len());
        }
    }
}
