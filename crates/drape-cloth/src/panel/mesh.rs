use std::collections::BTreeMap;

use crate::lattice::{Cell, PARTICLES_MAX};
use crate::{Error, Grain, Lattice};

/// How far a node of the lattice may lie from its place in the grid, in spacings: rounding.
const EXACT: f64 = 1e-6;

/// A panel that was cut elsewhere: full cells of a grid along the yarns, and triangles between them and the outline.
///
/// Material coordinates are `u` along the weft and `v` along the warp. Nodes of the lattice come first, row by row (a row
/// is along the weft, and rows follow the warp), then those of the outline.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Distance of the nodes of the lattice along the weft and along the warp, in m.
    pub spacing: [f64; 2],
    /// Material coordinates of all nodes, in m.
    pub coordinates: Vec<[f64; 2]>,
    /// Column and row of each node of the lattice. The nodes after them are the outline's.
    pub grid: Vec<[u32; 2]>,
    /// Full cells by their nodes (u, v) = (0, 0), (1, 0), (1, 1), (0, 1).
    pub cells: Vec<[u32; 4]>,
    /// Triangles of the rim by their nodes, anticlockwise.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Columns and rows that its lattice covers, and the lowest of both.
    fn extent(&self) -> ([usize; 2], [u32; 2]) {
        let ends = |k: usize| {
            let all = self.grid.iter().map(|place| place[k]);
            (all.clone().min().unwrap_or(0), all.max().unwrap_or(0))
        };
        let ends = [ends(0), ends(1)];
        (ends.map(|(low, high)| (high - low) as usize + 1), ends.map(|(low, _)| low))
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
        let ([columns, rows], _) = self.extent();
        let particles = (columns as f64 * rows as f64).max(self.coordinates.len() as f64);
        if particles > PARTICLES_MAX {
            let spacing = self.spacing[0].min(self.spacing[1]);
            return Err(Error::TooMany { spacing, particles, limit: PARTICLES_MAX });
        }
        if self.grid.len() > self.coordinates.len() {
            return wrong(
                "node",
                self.coordinates.len(),
                "has a place in the lattice and no coordinates",
            );
        }
        if let Some(node) = self.coordinates.iter().position(|c| !c.iter().all(|x| x.is_finite())) {
            return wrong("node", node, "has a coordinate that is no number");
        }
        let row_major = |pair: &[[u32; 2]]| [pair[0][1], pair[0][0]] >= [pair[1][1], pair[1][0]];
        if let Some(node) = self.grid.windows(2).position(row_major) {
            return wrong("node", node + 1, "of the lattice is out of order; give them row by row");
        }
        let off = |&(place, c): &(&[u32; 2], &[f64; 2])| {
            let steps = |k: usize| f64::from(place[k]) - f64::from(self.grid[0][k]);
            let at = |k: usize| (c[k] - self.coordinates[0][k]) / self.spacing[k] - steps(k);
            at(0).abs().max(at(1).abs()) > EXACT
        };
        let nodes = self.grid.iter().zip(&self.coordinates);
        if let Some((node, _)) = nodes.enumerate().find(|(_, node)| off(node)) {
            return wrong("node", node, "of the lattice is not at its place in the grid");
        }
        for (index, cell) in self.cells.iter().enumerate() {
            let Some(first) = self.grid.get(cell[0] as usize) else {
                return wrong("cell", index, "has a corner that is not of the lattice");
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
    /// A panel that was cut elsewhere, with a rim of triangles or without; its own frame is that of the grain.
    ///
    /// Two nodes of the lattice that are next to each other on a yarn must not have the outline between them.
    ///
    /// # Errors
    /// When indices, areas or the order of the nodes are not as [`Mesh`] says, or a node is part of nothing.
    pub fn from_mesh(mesh: Mesh, grain: Grain) -> Result<Self, Error> {
        mesh.check()?;
        let ([columns, rows], low) = mesh.extent();
        let quarter = 0.25 * mesh.spacing[0] * mesh.spacing[1];
        let mut grid = vec![None; columns * rows];
        for (node, place) in mesh.grid.iter().enumerate() {
            let [column, row] = [0, 1].map(|k| (place[k] - low[k]) as usize);
            grid[row * columns + column] = Some(node as u32);
        }
        let mut cells = mesh.cells;
        cells.sort_unstable();
        let cell = |corners: [u32; 4]| {
            let [column, row] = mesh.grid[corners[0] as usize];
            let even = (column - low[0] + row - low[1]).is_multiple_of(2);
            Cell { corners, quadrants: [quarter; 4], even }
        };
        let places = mesh.coordinates.iter().map(|&coordinates| grain.to_panel(coordinates));
        let mut ends = [[f64::MAX, f64::MIN]; 2];
        for place in places {
            for (end, x) in ends.iter_mut().zip(place) {
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
            grid,
            columns,
        })
    }

    /// Areas that the particles stand for, in m².
    pub(crate) fn areas(&self) -> Vec<f64> {
        let mut areas = vec![0.0; self.coordinates.len()];
        for cell in &self.cells {
            for (corner, area) in cell.corners.into_iter().zip(cell.quadrants) {
                areas[corner as usize] += area;
            }
        }
        for (triangle, area) in self.rim.iter().zip(self.rim_areas()) {
            triangle.iter().for_each(|&node| areas[node as usize] += area / 3.0);
        }
        areas
    }

    /// Areas of the rim's triangles, in m².
    pub(crate) fn rim_areas(&self) -> impl Iterator<Item = f64> {
        let area = |triangle: &[u32; 3]| {
            0.5 * twice_area(triangle.map(|node| self.coordinates[node as usize]))
        };
        self.rim.iter().map(area)
    }

    /// The sides of cells and triangles that lie at no other.
    pub(crate) fn outline(&self) -> Vec<[u32; 2]> {
        let mut count = BTreeMap::new();
        let mut add = |nodes: &[u32]| {
            for (k, &node) in nodes.iter().enumerate() {
                let next = nodes[(k + 1) % nodes.len()];
                *count.entry([node.min(next), node.max(next)]).or_insert(0) += 1;
            }
        };
        self.cells.iter().for_each(|cell| add(&cell.corners));
        self.rim.iter().for_each(|triangle| add(triangle));
        count.into_iter().filter(|&(_, faces)| faces == 1).map(|(side, _)| side).collect()
    }

    /// The particles that share a cell or a triangle with each.
    pub(crate) fn neighbours(&self) -> Vec<Vec<u32>> {
        let mut neighbours = vec![Vec::new(); self.coordinates.len()];
        let mut add = |nodes: &[u32]| {
            for &node in nodes {
                let others = nodes.iter().copied().filter(|&other| other != node);
                neighbours[node as usize].extend(others);
            }
        };
        self.cells.iter().for_each(|cell| add(&cell.corners));
        self.rim.iter().for_each(|triangle| add(triangle));
        for near in &mut neighbours {
            near.sort_unstable();
            near.dedup();
        }
        neighbours
    }
}

/// Twice the area of a triangle, in m²; negative if it runs clockwise.
pub(crate) fn twice_area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
