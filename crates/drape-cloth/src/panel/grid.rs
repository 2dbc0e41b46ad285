//! Grid of a panel's particles along its yarns.

/// Grid of particles along the yarns, row by row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Grid {
    /// Distance of the points along the weft and along the warp, in m.
    pub(crate) spacing: [f64; 2],
    /// Particle at each point, `columns` to a row. The particles of a grid rise from point to
    /// point.
    pub(crate) points: Vec<Option<u32>>,
    pub(crate) columns: usize,
}

impl Grid {
    /// Returns the particles of the grid, in the order of `points`.
    pub(crate) fn particles(&self) -> impl Iterator<Item = u32> {
        self.points.iter().flatten().copied()
    }

    /// Returns runs of consecutive particles along the yarns: of the warp, then of the weft.
    pub(crate) fn yarns(&self) -> [Vec<Vec<u32>>; 2] {
        let rows = self.points.len() / self.columns;
        let point = |column: usize, row: usize| self.points[row * self.columns + column];
        let warp = (0..self.columns).map(|c| (0..rows).map(|r| point(c, r)).collect());
        let weft = (0..rows).map(|r| (0..self.columns).map(|c| point(c, r)).collect());
        [warp.flat_map(runs).collect(), weft.flat_map(runs).collect()]
    }
}

/// Returns the runs of at least two particles in `line`, which has gaps.
fn runs(line: Vec<Option<u32>>) -> Vec<Vec<u32>> {
    line.split(Option::is_none)
        .filter(|run| run.len() > 1)
        .map(|run| run.iter().flatten().copied().collect())
        .collect()
}
