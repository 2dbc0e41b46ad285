//! Panels that were cut elsewhere: a grid of full cells and a rim of triangles, checked once.

use crate::error::Error;
use crate::panel::cut::PARTICLES_MAX;
use crate::panel::grain::Grain;
use crate::panel::grid::Grid;
use crate::panel::lattice::{Cell, Lattice};
use crate::panel::triangle::twice_area;

/// Tolerance of a node's distance from its grid point, in spacings: rounding.
const ROUNDING_ERROR: f64 = 1e-6;

/// Panel that was cut elsewhere: full cells of a grid along the yarns, and triangles between them
/// and the outline.
///
/// Material coordinates are `u` along the weft and `v` along the warp. Nodes of the grid come
/// first, row by row (a row runs along the weft, and rows follow the warp), then those of the
/// outline.
///
/// ```
/// use drape_cloth::{Grain, Lattice, Mesh};
///
/// // One cell of 10 mm with a triangle on top.
/// let mesh = Mesh {
///     spacing: [0.01; 2],
///     coordinates: vec![[0.0, 0.0], [0.01, 0.0], [0.0, 0.01], [0.01, 0.01], [0.005, 0.018]],
///     grid: vec![[0, 0], [1, 0], [0, 1], [1, 1]],
///     cells: vec![[0, 1, 3, 2]],
///     triangles: vec![[2, 3, 4]],
/// };
/// let panel = Lattice::from_mesh(mesh, Grain::default())?;
/// assert!((panel.area() - (0.01 * 0.01 + 0.5 * 0.01 * 0.008)).abs() < 1e-18);
/// # Ok::<(), drape_cloth::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Distance of the nodes of the grid along the weft and along the warp, in m.
    pub spacing: [f64; 2],
    /// Material coordinates of all nodes, in m.
    pub coordinates: Vec<[f64; 2]>,
    /// Column and row of each node of the grid. The nodes after them are those of the outline.
    pub grid: Vec<[u32; 2]>,
    /// Full cells by their nodes (u, v) = (0, 0), (1, 0), (1, 1), (0, 1).
    pub cells: Vec<[u32; 4]>,
    /// Triangles of the rim by their nodes, anticlockwise.
    pub triangles: Vec<[u32; 3]>,
}

/// Extent of the grid of a [`Mesh`].
struct Extent {
    columns: usize,
    rows: usize,
    /// Lowest column and lowest row.
    low: [u32; 2],
}

impl Mesh {
    fn extent(&self) -> Extent {
        let ends = |k: usize| {
            let all = self.grid.iter().map(|point| point[k]);
            [all.clone().min().unwrap_or(0), all.max().unwrap_or(0)]
        };
        let ends = [ends(0), ends(1)];
        let [columns, rows] = ends.map(|[low, high]| (high - low) as usize + 1);
        Extent { columns, rows, low: ends.map(|[low, _]| low) }
    }

    fn check(&self) -> Result<(), Error> {
        let wrong = |part, index, what| Err(Error::Mesh { part, index, what });
        for (what, value) in [("the spacing along the weft", 0), ("the spacing along the warp", 1)]
        {
            let value = self.spacing[value];
            if !(value > 0.0 && value.is_finite()) {
                return Err(Error::Length { what, value });
            }
        }
        if self.cells.is_empty() && self.triangles.is_empty() {
            return wrong("panel", 0, "has neither cells nor triangles");
        }
        let Extent { columns, rows, .. } = self.extent();
        let particles = (columns as f64 * rows as f64).max(self.coordinates.len() as f64);
        if particles > PARTICLES_MAX {
            let spacing = self.spacing[0].min(self.spacing[1]);
            return Err(Error::TooMany { spacing, particles, limit: PARTICLES_MAX });
        }
        if self.grid.len() > self.coordinates.len() {
            return wrong("node", self.coordinates.len(), "has a grid point and no coordinates");
        }
        if let Some(node) = self.coordinates.iter().position(|c| !c.iter().all(|x| x.is_finite())) {
            return wrong("node", node, "has a coordinate that is no number");
        }
        let row_major = |pair: &[[u32; 2]]| [pair[0][1], pair[0][0]] >= [pair[1][1], pair[1][0]];
        if let Some(node) = self.grid.windows(2).position(row_major) {
            return wrong("node", node + 1, "of the grid is out of order; give them row by row");
        }
        let off = |&(point, c): &(&[u32; 2], &[f64; 2])| {
            let steps = |k: usize| f64::from(point[k]) - f64::from(self.grid[0][k]);
            let at = |k: usize| (c[k] - self.coordinates[0][k]) / self.spacing[k] - steps(k);
            at(0).abs().max(at(1).abs()) > ROUNDING_ERROR
        };
        let nodes = self.grid.iter().zip(&self.coordinates);
        if let Some((node, _)) = nodes.enumerate().find(|(_, node)| off(node)) {
            return wrong("node", node, "of the grid is not at its grid point");
        }
        for (index, cell) in self.cells.iter().enumerate() {
            let Some(first) = self.grid.get(cell[0] as usize) else {
                return wrong("cell", index, "has a corner that is no node of the grid");
            };
            let steps = [[0, 0], [1, 0], [1, 1], [0, 1]];
            let full = cell.iter().zip(steps).all(|(&node, step)| {
                self.grid.get(node as usize) == Some(&[first[0] + step[0], first[1] + step[1]])
            });
            if !full {
                return wrong("cell", index, "is not a full cell of the grid");
            }
        }
        let mut used = vec![false; self.coordinates.len()];
        self.cells.iter().flatten().for_each(|&node| used[node as usize] = true);
        for (index, triangle) in self.triangles.iter().enumerate() {
            if triangle.iter().any(|&node| node as usize >= used.len()) {
                return wrong("triangle", index, "has a corner that does not exist");
            }
            if twice_area(triangle.map(|node| self.coordinates[node as usize])) <= 0.0 {
                return wrong("triangle", index, "has no area, or runs clockwise");
            }
            triangle.iter().for_each(|&node| used[node as usize] = true);
        }
        match used.iter().position(|used| !used) {
            Some(node) => wrong("node", node, "is in no cell and no triangle"),
            None => Ok(()),
        }
    }
}

impl Lattice {
    /// Returns a panel that was cut elsewhere, with or without a rim of triangles; its own frame is
    /// that of the grain.
    ///
    /// Two neighbouring nodes of the grid on a yarn must not have the outline between them.
    ///
    /// # Errors
    /// When indices, areas or the order of the nodes are not as [`Mesh`] says, or a node belongs to
    /// no cell and no triangle.
    pub fn from_mesh(mesh: Mesh, grain: Grain) -> Result<Self, Error> {
        mesh.check()?;
        let Extent { columns, rows, low } = mesh.extent();
        let quarter = 0.25 * mesh.spacing[0] * mesh.spacing[1];
        let mut grid = vec![None; columns * rows];
        for (node, point) in mesh.grid.iter().enumerate() {
            let [column, row] = [0, 1].map(|k| (point[k] - low[k]) as usize);
            grid[row * columns + column] = Some(node as u32);
        }
        let mut cells = mesh.cells;
        cells.sort_unstable();
        let cell = |corners: [u32; 4]| {
            let [column, row] = mesh.grid[corners[0] as usize];
            let even = (column - low[0] + row - low[1]).is_multiple_of(2);
            Cell { corners, quadrants: [quarter; 4], even }
        };
        let points = mesh.coordinates.iter().map(|&coordinates| grain.to_panel(coordinates));
        let mut ends = [[f64::MAX, f64::MIN]; 2];
        for point in points {
            for (end, x) in ends.iter_mut().zip(point) {
                *end = [end[0].min(x), end[1].max(x)];
            }
        }
        Ok(Self {
            spacing: mesh.spacing,
            coordinates: mesh.coordinates,
            grain,
            middle: ends.map(|[low, high]| 0.5 * (low + high)),
            size: None,
            cells: cells.into_iter().map(cell).collect(),
            rim: mesh.triangles,
            folds: Vec::new(),
            allowances: Vec::new(),
            grids: vec![Grid { spacing: mesh.spacing, points: grid, columns }],
        })
    }
}
