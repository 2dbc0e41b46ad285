//! Numbering of the particles that a graded panel keeps of a finer panel.

use crate::panel::grid::Grid;
use crate::panel::lattice::Lattice;

/// Numbering of the particles that a graded panel keeps of a finer panel.
pub(crate) struct Numbering<'a> {
    pub(crate) lattice: &'a Lattice,
    pub(crate) grid: &'a Grid,
    /// Material coordinates of the kept particles, in m.
    pub(crate) coordinates: Vec<[f64; 2]>,
    /// Number of each particle of the finer panel, if it is kept.
    pub(crate) numbers: Vec<Option<u32>>,
}

impl Numbering<'_> {
    /// Keeps `node` of the finer panel and returns its new number.
    pub(crate) fn keep(&mut self, node: u32) -> u32 {
        let number = self.coordinates.len() as u32;
        self.coordinates.push(self.lattice.coordinates[node as usize]);
        self.numbers[node as usize] = Some(number);
        number
    }

    /// Returns the number of `node` of the finer panel, if it is kept.
    pub(crate) fn number(&self, node: u32) -> Option<u32> {
        self.numbers[node as usize]
    }

    /// Returns the node of the finer panel at a point of its grid.
    fn node(&self, [column, row]: [usize; 2]) -> Option<u32> {
        self.grid.points[row * self.grid.columns + column]
    }

    /// Returns the number of the node at `point` of the finer grid, if it is kept.
    pub(crate) fn at_point(&self, point: [usize; 2]) -> Option<u32> {
        self.node(point).and_then(|node| self.number(node))
    }

    /// Keeps the nodes of the grid by their levels, the finest first. `level_at` returns the level
    /// of the node at a point, up to `level_max`. Returns the grid of each level that has nodes.
    pub(crate) fn number_grids(
        &mut self,
        level_max: u8,
        level_at: impl Fn([usize; 2]) -> Option<u8>,
    ) -> Vec<Grid> {
        let mut grids = Vec::new();
        for level in 0..=level_max {
            let step = 1 << level;
            let columns = self.grid.columns.div_ceil(step);
            let rows = (self.grid.points.len() / self.grid.columns).div_ceil(step);
            let points: Vec<Option<u32>> = (0..rows)
                .flat_map(|row| (0..columns).map(move |column| [step * column, step * row]))
                .map(|point| {
                    let is_kept = level_at(point) == Some(level);
                    let node = is_kept.then(|| self.node(point)).flatten();
                    node.map(|node| self.keep(node))
                })
                .collect();
            if points.iter().any(Option::is_some) {
                let spacing = self.grid.spacing.map(|spacing| step as f64 * spacing);
                grids.push(Grid { spacing, points, columns });
            }
        }
        grids
    }
}
