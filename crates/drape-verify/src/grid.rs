/// Smallest exponent of a cell: cells of 1 µm, so that places up to 1000 km have numbers of 40 bits.
const LEVEL_MIN: i32 = -20;

/// A box along the axes, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extent {
    pub(crate) low: [f64; 3],
    pub(crate) high: [f64; 3],
}

impl Extent {
    /// The box of a triangle and so much around it.
    pub(crate) fn around(corners: [[f64; 3]; 3], more: f64) -> Extent {
        let over = |axis: usize, pick: fn(f64, f64) -> f64| {
            pick(pick(corners[0][axis], corners[1][axis]), corners[2][axis])
        };
        // Outward by more than the sum rounds.
        let down = |x: f64| (x - more) - f64::EPSILON * (x.abs() + more);
        let up = |x: f64| (x + more) + f64::EPSILON * (x.abs() + more);
        Extent {
            low: [0, 1, 2].map(|axis| down(over(axis, f64::min))),
            high: [0, 1, 2].map(|axis| up(over(axis, f64::max))),
        }
    }

    fn meets(&self, other: &Extent) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }

    /// Exponent of the smallest cell that is as large as the box.
    fn level(&self) -> i32 {
        let longest = (0..3).map(|axis| self.high[axis] - self.low[axis]).fold(0.0, f64::max);
        let mut level = LEVEL_MIN;
        while cell_size(level) < longest {
            level += 1;
        }
        level
    }
}

fn cell_size(level: i32) -> f64 {
    2.0_f64.powi(level)
}

/// A cell: its level, then its number along z, y and x.
type Cell = (i32, [i64; 3]);

/// Boxes by the cells that their lowest corners are in, of cells as large as the box: so a box reaches no farther
/// than into the next cell along each axis.
#[derive(Debug)]
pub(crate) struct Grid {
    extents: Vec<Extent>,
    /// Sorted.
    cells: Vec<(Cell, u32)>,
    /// The levels that there are, with their range of `cells`.
    levels: Vec<(i32, std::ops::Range<usize>)>,
}

impl Grid {
    pub(crate) fn new(extents: Vec<Extent>) -> Grid {
        let place = |(number, extent): (usize, &Extent)| {
            let level = extent.level();
            let [x, y, z] = extent.low.map(|low| number_of(low, level));
            ((level, [z, y, x]), number as u32)
        };
        let mut cells: Vec<(Cell, u32)> = extents.iter().enumerate().map(place).collect();
        cells.sort_unstable();
        let mut levels = Vec::new();
        let mut first = 0;
        for group in cells.chunk_by(|a, b| a.0.0 == b.0.0) {
            levels.push((group[0].0.0, first..first + group.len()));
            first += group.len();
        }
        Grid { extents, cells, levels }
    }

    /// Calls with every box that meets a box of the grid and comes behind it: one of a higher level, or of the same
    /// level and a higher number. So every pair is seen once.
    pub(crate) fn each_behind(&self, number: usize, mut visit: impl FnMut(usize)) {
        let extent = &self.extents[number];
        let own = extent.level();
        for (level, range) in self.levels.iter().filter(|(level, _)| *level >= own) {
            let entries = &self.cells[range.clone()];
            // What reaches into the box starts at most one cell below it.
            let low = extent.low.map(|low| number_of(low, *level) - 1);
            let high = extent.high.map(|high| number_of(high, *level));
            for z in low[2]..=high[2] {
                for y in low[1]..=high[1] {
                    let [from, to] = [low[0], high[0]].map(|x| [z, y, x]);
                    let start = entries.partition_point(|((_, cell), _)| *cell < from);
                    let row = entries[start..].iter().take_while(|((_, cell), _)| *cell <= to);
                    for &(_, other) in row {
                        let behind = *level > own || other as usize > number;
                        if behind && extent.meets(&self.extents[other as usize]) {
                            visit(other as usize);
                        }
                    }
                }
            }
        }
    }
}

/// Number of the cell that a coordinate is in, along an axis.
fn number_of(coordinate: f64, level: i32) -> i64 {
    (coordinate / cell_size(level)).floor() as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pair_of_boxes_that_meet_is_found_once() {
        // Boxes of very different sizes, at places that a small generator scatters.
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as f64 / (1_u64 << 31) as f64
        };
        let boxes = (0..600).map(|_| {
            let size = 10.0_f64.powf(4.0 * random() - 4.0);
            let at = [random() - 0.5, random() - 0.5, 0.1 * random()];
            let corner = |k: usize| [0, 1, 2].map(|axis| at[axis] + size * ((k + axis) % 3) as f64);
            Extent::around([corner(0), corner(1), corner(2)], 1e-4)
        });
        let boxes: Vec<Extent> = boxes.collect();
        let mut expected = Vec::new();
        for a in 0..boxes.len() {
            for b in a + 1..boxes.len() {
                let apart = |k: usize| {
                    boxes[a].high[k] < boxes[b].low[k] || boxes[b].high[k] < boxes[a].low[k]
                };
                if !(0..3).any(apart) {
                    expected.push([a, b]);
                }
            }
        }
        let grid = Grid::new(boxes.clone());
        let mut found = Vec::new();
        for a in 0..boxes.len() {
            grid.each_behind(a, |b| found.push([a.min(b), a.max(b)]));
        }
        found.sort_unstable();
        assert!(expected.len() > 1000, "{}", expected.len());
        assert_eq!(found, expected);
    }
}
