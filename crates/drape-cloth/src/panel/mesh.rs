//! Panels that were cut elsewhere: a grid of full cells and a rim of triangles, checked once.

use crate::error::Error;
use crate::panel::cut::PARTICLES_MAX;
use crate::panel::grain::Grain;
use crate::panel::grid::Grid;
use crate::panel::lattice::{Cell, Lattice};
use crate::panel::triangle::twice_area;

/// Rounding error of a node's distance from its grid point, in spacings.
const ROUNDING_ERROR: f64 = 1e-6;

/// Panel that was cut elsewhere: full cells of a grid along the yarns, and triangles between them
/// and the outline.
///
/// Material coordinates are `u` along the weft and `v` along the warp. Nodes of the grid come
/// first, row by row: a row runs along the weft, and rows follow the warp. Nodes of the outline
/// come last.
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
///
/// A mesh of triangles alone has no grid: `grid` and `cells` are empty, and `spacing` is the size
/// of the triangles. Its cloth has traction and shear in each triangle and bending about each node,
/// and it may have folds, allowances and seams. [`Breen`](crate::Breen) refuses it, as every panel
/// with a rim, and [`Lattice::graded`] has no cells to enlarge.
///
/// ```
/// use drape_cloth::{Cloth, Grain, Lattice, Mesh};
/// use drape_fabric::samples;
///
/// // A hexagon of six triangles about its middle.
/// let corner = |k: u32| {
///     let (sine, cosine) = (std::f64::consts::FRAC_PI_3 * f64::from(k)).sin_cos();
///     [0.02 * cosine, 0.02 * sine]
/// };
/// let mesh = Mesh {
///     spacing: [0.02; 2],
///     coordinates: std::iter::once([0.0; 2]).chain((0..6).map(corner)).collect(),
///     triangles: (0..6).map(|k| [0, k + 1, (k + 1) % 6 + 1]).collect(),
///     ..Mesh::default()
/// };
/// let panel = Lattice::from_mesh(mesh, Grain::default())?;
/// let cloth = Cloth::new(&[(&panel, &samples::plain_weave())])?;
/// let flat: Vec<f64> = cloth.coordinates().iter().flat_map(|&[u, v]| [u, v, 0.0]).collect();
/// let mut state = cloth.state(flat.clone())?;
/// let wide: Vec<f64> = flat.iter().map(|x| 1.01 * x).collect();
/// assert!(cloth.potential(&state, &wide)? > cloth.potential(&state, &flat)?);
/// cloth.commit(&mut state, &wide, &[0.0; 21])?;
/// # Ok::<(), drape_cloth::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Distance of the nodes of the grid along the weft and along the warp, in m.
    pub spacing: [f64; 2],
    /// Material coordinates of all nodes, in m.
    pub coordinates: Vec<[f64; 2]>,
    /// Column and row of each node of the grid. Later nodes belong to the outline.
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

/// Sentence without its subject that says what is wrong with a part of a mesh.
type Problem = (&'static str, usize, &'static str);

impl Mesh {
    /// Returns the extent of `grid`.
    fn extent(&self) -> Extent {
        let ends = [0, 1].map(|k| {
            let all = self.grid.iter().map(|point| point[k]);
            [all.clone().min().unwrap_or(0), all.max().unwrap_or(0)]
        });
        let [columns, rows] = ends.map(|[low, high]| (high - low) as usize + 1);
        Extent { columns, rows, low: ends.map(|[low, _]| low) }
    }

    /// Checks all lists of the mesh. Every later function may rely on them.
    fn check(&self) -> Result<(), Error> {
        self.check_sizes()?;
        self.check_nodes()
            .and_then(|()| self.check_faces())
            .map_err(|(part, index, what)| Error::Mesh { part, index, what })
    }

    /// Checks the spacings and the numbers of cells and particles.
    fn check_sizes(&self) -> Result<(), Error> {
        for (what, value) in [("the spacing along the weft", 0), ("the spacing along the warp", 1)]
        {
            let value = self.spacing[value];
            if !(value > 0.0 && value.is_finite()) {
                return Err(Error::Length { what, value });
            }
        }
        if self.cells.is_empty() && self.triangles.is_empty() {
            let (part, index, what) = ("panel", 0, "has neither cells nor triangles");
            return Err(Error::Mesh { part, index, what });
        }
        let Extent { columns, rows, .. } = self.extent();
        let particles = (columns as f64 * rows as f64).max(self.coordinates.len() as f64);
        if particles > PARTICLES_MAX {
            let spacing = self.spacing[0].min(self.spacing[1]);
            return Err(Error::TooMany { spacing, particles, limit: PARTICLES_MAX });
        }
        Ok(())
    }

    /// Checks the coordinates of all nodes, and the order and places of the nodes of `grid`.
    fn check_nodes(&self) -> Result<(), Problem> {
        if self.grid.len() > self.coordinates.len() {
            let node = self.coordinates.len();
            return Err(("node", node, "has a grid point and no coordinates"));
        }
        if let Some(node) = self.coordinates.iter().position(|c| !c.iter().all(|x| x.is_finite())) {
            return Err(("node", node, "has a coordinate that is no number"));
        }

        // Nodes of the grid come first, row by row, each at its grid point.
        let unordered = self.grid.windows(2).position(|p| [p[0][1], p[0][0]] >= [p[1][1], p[1][0]]);
        if let Some(node) = unordered {
            return Err(("node", node + 1, "of the grid is out of order; give them row by row"));
        }
        let misplaced = self.grid.iter().zip(&self.coordinates).position(|(point, c)| {
            let offsets = [0, 1].map(|k| {
                let steps = f64::from(point[k]) - f64::from(self.grid[0][k]);
                (c[k] - self.coordinates[0][k]) / self.spacing[k] - steps
            });
            offsets[0].abs().max(offsets[1].abs()) > ROUNDING_ERROR
        });
        match misplaced {
            Some(node) => Err(("node", node, "of the grid is not at its grid point")),
            None => Ok(()),
        }
    }

    /// Checks `cells` and `triangles`, and that each node belongs to one of them.
    fn check_faces(&self) -> Result<(), Problem> {
        for (index, cell) in self.cells.iter().enumerate() {
            let Some(first) = self.grid.get(cell[0] as usize) else {
                return Err(("cell", index, "has a corner that is no node of the grid"));
            };
            let steps = [[0_u32, 0], [1, 0], [1, 1], [0, 1]];
            let is_full = cell.iter().zip(steps).all(|(&node, step)| {
                let point = [0, 1].map(|k| first[k].checked_add(step[k]));
                let point_of_node = self.grid.get(node as usize);
                point_of_node.is_some_and(|of_node| of_node.map(Some) == point)
            });
            if !is_full {
                return Err(("cell", index, "is not a full cell of the grid"));
            }
        }

        let mut used = vec![false; self.coordinates.len()];
        self.cells.iter().flatten().for_each(|&node| used[node as usize] = true);
        for (index, triangle) in self.triangles.iter().enumerate() {
            if triangle.iter().any(|&node| node as usize >= used.len()) {
                return Err(("triangle", index, "has a corner that does not exist"));
            }
            let area = twice_area(triangle.map(|node| self.coordinates[node as usize]));
            if !(area > 0.0 && area.is_finite()) {
                return Err(("triangle", index, "has no area, or runs clockwise"));
            }
            triangle.iter().for_each(|&node| used[node as usize] = true);
        }
        match used.iter().position(|used| !used) {
            Some(node) => Err(("node", node, "is in no cell and no triangle")),
            None => Ok(()),
        }
    }
}

impl Lattice {
    /// Returns the panel of `mesh`, with or without a rim of triangles. Its frame is the frame of
    /// `grain`.
    ///
    /// Two neighbouring nodes of the grid on a yarn must not have the outline between them.
    ///
    /// # Errors
    /// Indices, areas or the order of the nodes are not as [`Mesh`] says, or a node belongs to no
    /// cell and no triangle.
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
        let cells = cells
            .into_iter()
            .map(|corners| {
                let [column, row] = mesh.grid[corners[0] as usize];
                let even = (column - low[0] + row - low[1]).is_multiple_of(2);
                Cell { corners, quadrants: [quarter; 4], even }
            })
            .collect();

        // The middle is the middle of the bounding box in the panel's frame.
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
            cells,
            rim: mesh.triangles,
            folds: Vec::new(),
            allowances: Vec::new(),
            grids: vec![Grid { spacing: mesh.spacing, points: grid, columns }],
        })
    }
}
