//! Broad phase: pairs of bounding boxes that overlap, from a grid with cells of several sizes.
//!
//! `verdict` builds a [`Grid`] from the boxes of all triangles of a frame and visits each
//! overlapping pair once.

/// Axis-aligned bounding box, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Aabb {
    pub(crate) low: [f64; 3],
    pub(crate) high: [f64; 3],
}

impl Aabb {
    /// Returns the bounding box of the triangle with the given `corners`, enlarged by `margin` on
    /// every side, in m.
    pub(crate) fn around(corners: [[f64; 3]; 3], margin: f64) -> Aabb {
        let [a, b, c] = corners;
        let low = [0, 1, 2].map(|axis| a[axis].min(b[axis]).min(c[axis]));
        let high = [0, 1, 2].map(|axis| a[axis].max(b[axis]).max(c[axis]));

        // The box is enlarged by more than the rounding error of the sum with the margin.
        Aabb {
            low: low.map(|x| (x - margin) - f64::EPSILON * (x.abs() + margin)),
            high: high.map(|x| (x + margin) + f64::EPSILON * (x.abs() + margin)),
        }
    }

    /// Returns whether the box and `other` have a point in common.
    fn overlaps(&self, other: &Aabb) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }

    /// Returns the level of the smallest cells that are at least as large as the box.
    fn level(&self) -> i32 {
        /// Smallest level, whose cells have 1 µm. Positions up to 1000 km then have cell numbers of
        /// 40 bits.
        const LEVEL_MIN: i32 = -20;

        let longest = (0..3).map(|axis| self.high[axis] - self.low[axis]).fold(0.0, f64::max);
        let mut level = LEVEL_MIN;
        while cell_size(level) < longest {
            level += 1;
        }
        level
    }
}

/// Returns the size of the cells of `level`, in m.
fn cell_size(level: i32) -> f64 {
    2.0_f64.powi(level)
}

/// Level of a cell, then the numbers of the cell along z, y and x.
type Cell = (i32, [i64; 3]);

/// Boxes sorted by the cell of their lowest corner.
///
/// The cells of the level of a box are at least as large as the box. A box therefore extends at
/// most into the next cell along each axis.
#[derive(Debug)]
pub(crate) struct Grid {
    boxes: Vec<Aabb>,
    /// Cell and number of each box, in ascending order.
    cells: Vec<(Cell, u32)>,
    /// Each level with its range of `cells`.
    levels: Vec<(i32, std::ops::Range<usize>)>,
}

impl Grid {
    /// Returns the grid of `boxes`. The number of a box is its index.
    pub(crate) fn new(boxes: Vec<Aabb>) -> Grid {
        let mut cells: Vec<(Cell, u32)> = Vec::with_capacity(boxes.len());
        for (number, aabb) in boxes.iter().enumerate() {
            let level = aabb.level();
            let [x, y, z] = aabb.low.map(|low| cell_number(low, level));
            cells.push(((level, [z, y, x]), number as u32));
        }
        cells.sort_unstable();

        let mut levels = Vec::new();
        let mut first = 0;
        for group in cells.chunk_by(|a, b| a.0.0 == b.0.0) {
            levels.push((group[0].0.0, first..first + group.len()));
            first += group.len();
        }
        Grid { boxes, cells, levels }
    }

    /// Calls `visit` with each box that overlaps box `number` and follows it.
    ///
    /// A box follows another if its level is higher, or if the levels are equal and its number is
    /// higher. Calls for all boxes therefore visit each overlapping pair once.
    pub(crate) fn visit_following(&self, number: usize, mut visit: impl FnMut(usize)) {
        let aabb = &self.boxes[number];
        let box_level = aabb.level();
        for (level, range) in self.levels.iter().filter(|(level, _)| *level >= box_level) {
            let entries = &self.cells[range.clone()];

            // A box that extends into this box begins at most one cell below it.
            let low = aabb.low.map(|low| cell_number(low, *level) - 1);
            let high = aabb.high.map(|high| cell_number(high, *level));

            // The cells of a row along x are neighbours in the order of `cells`.
            for z in low[2]..=high[2] {
                for y in low[1]..=high[1] {
                    let [from, to] = [low[0], high[0]].map(|x| [z, y, x]);
                    let start = entries.partition_point(|((_, cell), _)| *cell < from);
                    let row = entries[start..].iter().take_while(|((_, cell), _)| *cell <= to);
                    for &(_, other) in row {
                        let follows = *level > box_level || other as usize > number;
                        if follows && aabb.overlaps(&self.boxes[other as usize]) {
                            visit(other as usize);
                        }
                    }
                }
            }
        }
    }
}

/// Returns the number, along one axis, of the cell of `level` that contains `coordinate`.
fn cell_number(coordinate: f64, level: i32) -> i64 {
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
            grid.visit_following(a, |b| found.push([a.min(b), a.max(b)]));
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
