//! Broad phase: pairs of bounding boxes that overlap, from a grid with cells of several sizes.
//!
//! `verdict` fills it with the boxes of all triangles of a frame and visits each overlapping pair once.

/// Smallest exponent of a cell size: cells of 1 µm, so that positions up to 1000 km have cell numbers
/// of 40 bits.
const LEVEL_MIN: i32 = -20;

/// Axis-aligned bounding box, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Aabb {
    pub(crate) low: [f64; 3],
    pub(crate) high: [f64; 3],
}

impl Aabb {
    /// Returns the bounding box of a triangle, enlarged on every side by a margin in m.
    pub(crate) fn around(corners: [[f64; 3]; 3], margin: f64) -> Aabb {
        let over = |axis: usize, pick: fn(f64, f64) -> f64| {
            pick(pick(corners[0][axis], corners[1][axis]), corners[2][axis])
        };
        // Rounded outwards by more than the rounding error of the sum.
        let down = |x: f64| (x - margin) - f64::EPSILON * (x.abs() + margin);
        let up = |x: f64| (x + margin) + f64::EPSILON * (x.abs() + margin);
        Aabb {
            low: [0, 1, 2].map(|axis| down(over(axis, f64::min))),
            high: [0, 1, 2].map(|axis| up(over(axis, f64::max))),
        }
    }

    fn overlaps(&self, other: &Aabb) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }

    /// Returns the exponent of the smallest cell size that is at least the size of the box.
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

/// Cell: its level, then its numbers along z, y and x.
type Cell = (i32, [i64; 3]);

/// Boxes sorted by the cell of their lowest corner, in the grid whose cells are at least as large as
/// the box: a box extends no farther than into the next cell along each axis.
#[derive(Debug)]
pub(crate) struct Grid {
    boxes: Vec<Aabb>,
    /// Cell and number of each box, sorted.
    cells: Vec<(Cell, u32)>,
    /// Levels in use, with their range of `cells`.
    levels: Vec<(i32, std::ops::Range<usize>)>,
}

impl Grid {
    pub(crate) fn new(boxes: Vec<Aabb>) -> Grid {
        let place = |(number, aabb): (usize, &Aabb)| {
            let level = aabb.level();
            let [x, y, z] = aabb.low.map(|low| number_of(low, level));
            ((level, [z, y, x]), number as u32)
        };
        let mut cells: Vec<(Cell, u32)> = boxes.iter().enumerate().map(place).collect();
        cells.sort_unstable();
        let mut levels = Vec::new();
        let mut first = 0;
        for group in cells.chunk_by(|a, b| a.0.0 == b.0.0) {
            levels.push((group[0].0.0, first..first + group.len()));
            first += group.len();
        }
        Grid { boxes, cells, levels }
    }

    /// Visits every box that overlaps a given one and follows it in order: it has a higher level, or the
    /// same level and a higher number. Each overlapping pair is visited once.
    pub(crate) fn each_following(&self, number: usize, mut visit: impl FnMut(usize)) {
        let aabb = &self.boxes[number];
        let own = aabb.level();
        for (level, range) in self.levels.iter().filter(|(level, _)| *level >= own) {
            let entries = &self.cells[range.clone()];
            // A box that extends into this one begins at most one cell below it.
            let low = aabb.low.map(|low| number_of(low, *level) - 1);
            let high = aabb.high.map(|high| number_of(high, *level));
            for z in low[2]..=high[2] {
                for y in low[1]..=high[1] {
                    let [from, to] = [low[0], high[0]].map(|x| [z, y, x]);
                    let start = entries.partition_point(|((_, cell), _)| *cell < from);
                    let row = entries[start..].iter().take_while(|((_, cell), _)| *cell <= to);
                    for &(_, other) in row {
                        let follows = *level > own || other as usize > number;
                        if follows && aabb.overlaps(&self.boxes[other as usize]) {
                            visit(other as usize);
                        }
                    }
                }
            }
        }
    }
}

/// Returns the number of the cell along an axis that holds a coordinate.
fn number_of(coordinate: f64, level: i32) -> i64 {
    (coordinate / cell_size(level)).floor() as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pair_of_boxes_that_meet_is_found_once() {
        // Boxes of very different sizes at random positions.
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as f64 / (1_u64 << 31) as f64
        };
        let boxes = (0..600).map(|_| {
            let size = 10.0_f64.powf(4.0 * random() - 4.0);
            let at = [random() - 0.5, random() - 0.5, 0.1 * random()];
            let corner = |k: usize| [0, 1, 2].map(|axis| at[axis] + size * ((k + axis) % 3) as f64);
            Aabb::around([corner(0), corner(1), corner(2)], 1e-4)
        });
        let boxes: Vec<Aabb> = boxes.collect();
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
            grid.each_following(a, |b| found.push([a.min(b), a.max(b)]));
        }
        found.sort_unstable();
        assert!(expected.len() > 1000, "{}", expected.len());
        assert_eq!(found, expected);
    }

    #[test]
    fn a_box_is_larger_than_its_triangle_by_the_margin_and_a_rounding() {
        for margin in [0.0, 1e-20, 1e-9, 1e-4] {
            for x in [-1.0, -0.7, 0.3, 1.0, 1000.0] {
                let apart = 0.5 * f64::abs(x);
                let Aabb { low, high } =
                    Aabb::around([[x; 3], [x + apart; 3], [x + 0.5 * apart; 3]], margin);
                for axis in 0..3 {
                    // Numbers within a factor of two of each other have an exact difference.
                    for over in [x - low[axis], high[axis] - (x + apart)] {
                        let most = margin + 4.0 * f64::EPSILON * (f64::abs(x) + margin);
                        assert!(over >= margin && over <= most, "{x}, {margin}: {over}");
                    }
                }
            }
        }
    }
}
