//! Lattice: the nodes of a regular grid inside a region that keep clear of its sides.
//!
//! `rim` fills the strip between the full cells of the lattice and the region's sides with
//! triangles.

use super::region::Region;
use crate::edge::difference;
use crate::polygon::range;

/// Smallest distance of a lattice node from the outline, in spacings.
///
/// Edges at lattice nodes are at least this long. A larger distance makes the rim wide and its
/// triangles obtuse.
const CLEAR: f64 = 0.6;

/// Distance from the outline within which a lattice node may be dropped for better triangles, in
/// spacings. Dropping a node farther away would leave triangles larger than the spacing.
pub(crate) const LOOSE: f64 = 1.03;

/// Number of phases of the grid that are tried in each direction, over one spacing.
const PHASES: usize = 4;

/// Regular grid over a region. Lengths are in spacings.
#[derive(Debug, Clone)]
pub(crate) struct Lattice {
    /// Position of column 0 and row 0.
    origin: [f64; 2],
    /// Numbers of columns and rows.
    pub size: [usize; 2],
    /// Whether each grid point is a node, row by row.
    kept: Vec<bool>,
    /// Distance of each grid point from the outline, row by row. It is exact under [`LOOSE`]. A
    /// larger value says only that the distance is larger.
    clearance: Vec<f64>,
}

impl Lattice {
    /// Returns the phases of the grid over `region`, in descending order of their numbers of full
    /// cells.
    pub fn phases(region: &Region) -> Vec<usize> {
        let mut phases: Vec<(usize, usize)> = (0..PHASES * PHASES)
            .map(|phase| (Self::new(region, phase).cells().len(), phase))
            .collect();
        phases.sort_by_key(|&(cells, phase)| (std::cmp::Reverse(cells), phase));
        phases.into_iter().map(|(_, phase)| phase).collect()
    }

    /// Returns the grid over `region` at `phase`.
    pub fn new(region: &Region, phase: usize) -> Self {
        let offset = [phase % PHASES, phase / PHASES].map(|k| k as f64 / PHASES as f64);
        let extents = [0, 1].map(|k| range(region.corners.iter().map(|p| p[k])));
        let origin = [0, 1].map(|k| extents[k][0] + offset[k]);
        let size = [0, 1].map(|k| (extents[k][1] - origin[k]).max(0.0) as usize + 1);
        let count = size[0] * size[1];
        let clearance = vec![f64::MAX; count];
        let mut lattice = Self { origin, size, kept: vec![false; count], clearance };
        for [from, to] in region.sides() {
            lattice.measure_clearance(region.corners[from], region.corners[to]);
        }
        lattice.fill(region);
        lattice
    }

    /// Returns the columns (`axis` 0) or rows (1) from the coordinate `low` to `high`.
    fn between(&self, axis: usize, low: f64, high: f64) -> std::ops::Range<usize> {
        let low = (low - self.origin[axis]).ceil().max(0.0) as usize;
        let high = (high - self.origin[axis]).floor();
        if high < 0.0 { 0..0 } else { low..(high as usize + 1).min(self.size[axis]) }
    }

    /// Lowers the clearance of the grid points near the side of the region from `a` to `b`.
    fn measure_clearance(&mut self, a: [f64; 2], b: [f64; 2]) {
        let side = difference(b, a);
        let square = side[0] * side[0] + side[1] * side[1];
        let [[x0, x1], [y0, y1]] = [0, 1].map(|k| [a[k].min(b[k]) - LOOSE, a[k].max(b[k]) + LOOSE]);
        for row in self.between(1, y0, y1) {
            for column in self.between(0, x0, x1) {
                let arm = difference(self.position([column, row]), a);
                let along = (arm[0] * side[0] + arm[1] * side[1]) / square;
                let along = along.clamp(0.0, 1.0);
                let distance = (arm[0] - along * side[0]).hypot(arm[1] - along * side[1]);
                let index = self.index([column, row]);
                self.clearance[index] = self.clearance[index].min(distance);
            }
        }
    }

    /// Makes nodes of the grid points inside `region` that are clear of its sides.
    fn fill(&mut self, region: &Region) {
        // Coordinates at which each row of the grid crosses the sides.
        let mut crossings: Vec<Vec<f64>> = vec![Vec::new(); self.size[1]];
        for side in region.sides() {
            let [a, b] = side.map(|corner| region.corners[corner]);
            let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) };
            for row in self.between(1, low[1], high[1]) {
                let y = self.position([0, row])[1];
                // Half-open, so that a corner between two sides counts once.
                if low[1] <= y && y < high[1] {
                    let part = (y - low[1]) / (high[1] - low[1]);
                    crossings[row].push(low[0] + part * (high[0] - low[0]));
                }
            }
        }

        // A row is inside between every second crossing and the next.
        for (row, mut row_crossings) in crossings.into_iter().enumerate() {
            row_crossings.sort_by(f64::total_cmp);
            for pair in row_crossings.chunks_exact(2) {
                for column in self.between(0, pair[0], pair[1]) {
                    let index = self.index([column, row]);
                    self.kept[index] = self.clearance[index] >= CLEAR;
                }
            }
        }
    }

    /// Returns the index of a grid point in `kept` and `clearance`.
    fn index(&self, [column, row]: [usize; 2]) -> usize {
        row * self.size[0] + column
    }

    /// Returns the position of a grid point.
    pub fn position(&self, [column, row]: [usize; 2]) -> [f64; 2] {
        [self.origin[0] + column as f64, self.origin[1] + row as f64]
    }

    /// Returns whether the grid point `node` is a node.
    pub fn has(&self, node: [usize; 2]) -> bool {
        self.kept[self.index(node)]
    }

    /// Returns the distance of the grid point `node` from the outline; a number above [`LOOSE`] if
    /// it is larger than that.
    pub fn clearance(&self, node: [usize; 2]) -> f64 {
        self.clearance[self.index(node)]
    }

    /// Removes the node `node`.
    pub fn drop_node(&mut self, node: [usize; 2]) {
        let index = self.index(node);
        self.kept[index] = false;
    }

    /// Returns the nodes as columns and rows, row by row.
    pub fn nodes(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let points = (0..self.size[1]).flat_map(|row| (0..self.size[0]).map(move |c| [c, row]));
        points.filter(|&node| self.has(node))
    }

    /// Returns whether the cell to the right of and above a grid point has all four nodes.
    ///
    /// No side of the region intersects such a cell: every point on its border is closer to one of
    /// its nodes than [`CLEAR`].
    pub fn is_full(&self, [column, row]: [usize; 2]) -> bool {
        column + 1 < self.size[0]
            && row + 1 < self.size[1]
            && [[0, 0], [1, 0], [1, 1], [0, 1]].iter().all(|[x, y]| self.has([column + x, row + y]))
    }

    /// Returns the full cells, row by row, by their lower left nodes.
    pub fn cells(&self) -> Vec<[usize; 2]> {
        self.nodes().filter(|&node| self.is_full(node)).collect()
    }
}
