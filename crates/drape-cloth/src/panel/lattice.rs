//! The panel before deformation: its particles, cells and outline.

use std::collections::{BTreeMap, BTreeSet};

use crate::panel::fold::Fold;
use crate::panel::grain::Grain;
use crate::panel::grid::Grid;
use crate::panel::triangle::twice_area;

/// Panel before deformation: particles on a grid along the yarns, and the cells between them.
///
/// The material coordinates of a particle are `u` along the weft and `v` along the warp. Every cell
/// has four corners and the area of the panel in each of its four quadrants, from which the masses
/// and the areas of all connectors follow.
///
/// ```
/// use drape_cloth::Lattice;
///
/// let lattice = Lattice::rectangle(0.2, 0.3, 0.01)?;
/// assert_eq!(lattice.coordinates.len(), 21 * 31);
/// assert!((lattice.area() - 0.2 * 0.3).abs() < 1e-12);
/// // A disc is cut from the same grid, with the exact area in every cell.
/// let disc = Lattice::disc(0.1, 0.01)?;
/// assert!((disc.area() / (std::f64::consts::PI * 0.01) - 1.0).abs() < 1e-12);
/// # Ok::<(), drape_cloth::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Lattice {
    /// Distance of the particles along the weft and along the warp, in m; of the finest
    /// grid in a [graded](Lattice::graded) panel.
    pub spacing: [f64; 2],
    /// Material coordinates of the particles, in m.
    pub coordinates: Vec<[f64; 2]>,
    /// Rotation between the panel's own frame and its yarns.
    pub grain: Grain,
    /// Middle of the panel in its own frame, in m: [0, 0] for a disc, that of the bounding box for
    /// a panel that was cut elsewhere.
    pub middle: [f64; 2],
    /// Width and height of a rectangle, in m.
    pub(crate) size: Option<[f64; 2]>,
    /// Cells, row by row along the warp.
    pub cells: Vec<Cell>,
    /// Triangles between the cells and the outline, and between cells of two sizes, anticlockwise;
    /// empty in panels without a rim.
    pub rim: Vec<[u32; 3]>,
    /// Lines along which the panel is folded at rest.
    pub(crate) folds: Vec<Fold>,
    /// Area of cloth that lies along the outline at each particle, in m²; empty without allowances.
    pub(crate) allowances: Vec<f64>,
    /// Grids of the particles: one, or in a [graded](Lattice::graded) panel several, the finest first.
    pub(crate) grids: Vec<Grid>,
}

/// Cell of a [`Lattice`].
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// Particles at the corners (u, v) = (0, 0), (1, 0), (1, 1), (0, 1).
    pub corners: [u32; 4],
    /// Area of the panel in the quadrant at each corner, in m².
    pub quadrants: [f64; 4],
    /// Whether the column and the row of the cell add up to an even number.
    pub even: bool,
}

impl Lattice {
    /// Points of the particles in the panel's own frame, in m: from the lower left corner of a
    /// rectangle, from the middle of a disc, as given for a panel that was cut elsewhere.
    #[must_use]
    pub fn panel_coordinates(&self) -> Vec<[f64; 2]> {
        self.coordinates.iter().map(|&coordinates| self.grain.to_panel(coordinates)).collect()
    }

    /// Distance of each particle from a side of the panel, in spacings: 0 on it, negative beyond
    /// it.
    ///
    /// The side is that at the low (−1) or the high end (1) of an axis of the panel's own frame;
    /// panels other than rectangles have their outermost particles there.
    #[must_use]
    pub fn depths(&self, axis: usize, end: f64) -> Vec<f64> {
        let points = self.panel_coordinates();
        let outermost = || points.iter().map(|point| end * point[axis]).fold(f64::MIN, f64::max);
        let side =
            self.size.map_or_else(outermost, |size| if end > 0.0 { size[axis] } else { 0.0 });
        let spacing = self.grain.exchanged(self.spacing)[axis];
        points.iter().map(|point| (side - end * point[axis]) / spacing).collect()
    }

    /// Lines along which the panel is folded at rest.
    #[must_use]
    pub fn folds(&self) -> &[Fold] {
        &self.folds
    }

    /// Area of the panel, in m².
    #[must_use]
    pub fn area(&self) -> f64 {
        self.cells.iter().flat_map(|cell| cell.quadrants).chain(self.rim_areas()).sum()
    }

    /// Triangles for pictures and contact: every cell halved, with diagonals that alternate like
    /// the fields of a chessboard, then the rim.
    #[must_use]
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let halves = |cell: &Cell| {
            let [a, b, c, d] = cell.corners;
            if cell.even { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
        };
        self.cells.iter().flat_map(halves).chain(self.rim.iter().copied()).collect()
    }

    /// Runs of consecutive particles along the yarns: of the warp, then of the weft.
    pub(crate) fn yarns(&self) -> [Vec<Vec<u32>>; 2] {
        let mut all = [Vec::new(), Vec::new()];
        for grid in &self.grids {
            all.iter_mut().zip(grid.yarns()).for_each(|(all, own)| all.extend(own));
        }
        all
    }

    /// Largest distance of neighbouring particles along the weft and along the warp, in m.
    #[must_use]
    pub fn spacing_max(&self) -> [f64; 2] {
        self.grids.last().map_or(self.spacing, |grid| grid.spacing)
    }

    /// Spacing of the grid of each particle, the geometric mean along weft and warp, in m; that of the
    /// finest grid for nodes of the outline.
    pub(crate) fn spacings(&self) -> Vec<f64> {
        let mean = |[across, along]: [f64; 2]| (across * along).sqrt();
        let mut spacings = vec![mean(self.spacing); self.coordinates.len()];
        for grid in &self.grids {
            grid.particles().for_each(|node| spacings[node as usize] = mean(grid.spacing));
        }
        spacings
    }

    /// Areas of the particles, in m².
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

    /// Areas of the triangles of the rim, in m².
    pub(crate) fn rim_areas(&self) -> impl Iterator<Item = f64> {
        let area = |triangle: &[u32; 3]| {
            0.5 * twice_area(triangle.map(|node| self.coordinates[node as usize]))
        };
        self.rim.iter().map(area)
    }

    /// Sides of cells and triangles that belong to no other cell or triangle.
    pub(crate) fn outline(&self) -> BTreeSet<[u32; 2]> {
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

    /// Particles that share a cell or a triangle with each particle.
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
        for others in &mut neighbours {
            others.sort_unstable();
            others.dedup();
        }
        neighbours
    }
}
