use crate::breen::well::Well;
use crate::breen::{length, place};
use crate::field::subtract;

/// Pairs are listed up to this part of the spacing beyond the spacing, so that the list holds while particles move.
///
/// With more, the list is longer, and with less it is made more often; a settling cloth moves by a quarter of the spacing
/// in a step at most.
const MARGIN: f64 = 0.5;

/// A cell of space, by the numbers of its place along the axes.
type Cell = [i64; 3];

/// Finds pairs of particles that are near each other in space: particles sorted by the cells of a grid.
#[derive(Debug, Clone)]
pub(crate) struct Near {
    /// Side of a cell and distance up to which pairs are listed, in m.
    reach: f64,
    /// How far a particle may move before the list is made anew, in m.
    slack: f64,
    /// The neighbours of each particle along its yarns, which are not listed.
    tied: Vec<[u32; 4]>,
    /// Where the particles were when the list was made.
    listed: Vec<f64>,
    pairs: Vec<[u32; 2]>,
    cells: Vec<(Cell, u32)>,
}

/// The cells after one cell among its 26 neighbours: each pair of cells once.
const AFTER: [Cell; 13] = [
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

impl Near {
    pub(crate) fn new(wells: &[Well], tied: Vec<[u32; 4]>) -> Self {
        let spacing = wells.iter().map(|well| well.spacing).fold(0.0, f64::max);
        Self {
            reach: (1.0 + MARGIN) * spacing,
            slack: 0.5 * MARGIN * spacing,
            tied,
            listed: Vec::new(),
            pairs: Vec::new(),
            cells: Vec::new(),
        }
    }

    /// All pairs nearer than the spacing, and some that are less near; in rising order.
    ///
    /// The order, and with it every sum over the pairs, does not depend on when the list was made: pairs beyond the
    /// spacing count for nothing.
    pub(crate) fn find(&mut self, positions: &[f64]) -> &[[u32; 2]] {
        let moved =
            self.listed.chunks_exact(3).zip(positions.chunks_exact(3)).any(|(then, now)| {
                let way = subtract([now[0], now[1], now[2]], [then[0], then[1], then[2]]);
                // What is not a number has moved.
                !(length(way) <= self.slack)
            });
        if moved || self.listed.len() != positions.len() {
            self.list(positions);
        }
        &self.pairs
    }

    fn list(&mut self, positions: &[f64]) {
        self.listed.clear();
        self.listed.extend_from_slice(positions);
        self.pairs.clear();
        let side = self.reach;
        let number = |x: f64| (x / side).floor() as i64;
        self.cells.clear();
        let places = positions.chunks_exact(3).enumerate();
        self.cells.extend(
            places.map(|(particle, x)| ([0, 1, 2].map(|axis| number(x[axis])), particle as u32)),
        );
        self.cells.sort_unstable();
        let mut start = 0;
        while start < self.cells.len() {
            let cell = self.cells[start].0;
            let end = start + self.cells[start..].partition_point(|(other, _)| *other == cell);
            for first in start..end {
                for second in first + 1..end {
                    self.compare((first, second), positions);
                }
            }
            for step in AFTER {
                let other = [0, 1, 2].map(|axis| cell[axis].saturating_add(step[axis]));
                let from = end + self.cells[end..].partition_point(|(cell, _)| *cell < other);
                let count = self.cells[from..].partition_point(|(cell, _)| *cell == other);
                for first in start..end {
                    for second in from..from + count {
                        self.compare((first, second), positions);
                    }
                }
            }
            start = end;
        }
        self.pairs.sort_unstable();
    }

    fn compare(&mut self, (first, second): (usize, usize), positions: &[f64]) {
        let [a, b] = [self.cells[first].1, self.cells[second].1];
        let pair = [a.min(b), a.max(b)];
        if self.tied[pair[0] as usize].contains(&pair[1]) {
            return;
        }
        if length(subtract(place(positions, b), place(positions, a))) < self.reach {
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
    fn every_near_pair_is_found_wherever_it_is() {
        let count = 400;
        let wells = vec![Well { spacing: 0.1, energy: 1.0 }; count];
        let mut tied = vec![[u32::MAX; 4]; count];
        tied[3] = [4, u32::MAX, u32::MAX, u32::MAX];
        tied[4] = [u32::MAX, 3, u32::MAX, u32::MAX];
        let mut near = Near::new(&wells, tied);
        let mut positions: Vec<f64> = random(3 * count).iter().map(|x| x - 0.5).collect();
        // Tied ones are together, and are not told.
        positions.copy_within(9..12, 12);
        for round in 0..3 {
            positions.iter_mut().for_each(|x| *x += 0.02 * f64::from(round));
            let found: Vec<[u32; 2]> = near.find(&positions).to_vec();
            let distance =
                |[a, b]: [u32; 2]| length(subtract(place(&positions, b), place(&positions, a)));
            let all = (0..count as u32).flat_map(|a| (a + 1..count as u32).map(move |b| [a, b]));
            let exact = all.filter(|&pair| distance(pair) < 0.1 && pair != [3, 4]);
            let within: Vec<[u32; 2]> =
                found.iter().copied().filter(|&pair| distance(pair) < 0.1).collect();
            assert_eq!(within, exact.collect::<Vec<_>>(), "in round {round}");
            assert!(found.len() < 4 * within.len() && within.len() > 100, "{}", within.len());
        }
    }
}
