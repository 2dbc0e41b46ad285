//! The panel before deformation: its particles, cells and outline.

use std::collections::{BTreeMap, BTreeSet};

use crate::panel::fold::Fold;
use crate::panel::grain::Grain;
use crate::panel::grid::Grid;
use crate::panel::triangle::twice_area;

/// Panel before deformation: particles on a grid along the yarns, and the cells between them.
///
/// The material coordinates of a particle are `u` along the weft and `v` along the warp. Every cell
/// has four corners and the area of the panel in each of its four quadrants. The masses and the
/// areas of all connectors follow from these areas.
///
/// ```
/// use drape_cloth::Lattice;
///
/// let lattice = Lattice::rectangle(0.2, 0.3, 0.01)?;
/// assert_eq!(lattice.coordinates().len(), 21 * 31);
/// assert!((lattice.area() - 0.2 * 0.3).abs() < 1e-12);
/// // A disc is cut from the same grid, with the exact area in every cell.
/// let disc = Lattice::disc(0.1, 0.01)?;
/// assert!((disc.area() / (std::f64::consts::PI * 0.01) - 1.0).abs() < 1e-12);
/// # Ok::<(), drape_cloth::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Lattice {
    /// Distance of the particles along the weft and along the warp, in m. In a
    /// [graded](Lattice::graded) panel it belongs to the finest grid.
    pub(crate) spacing: [f64; 2],
    /// Material coordinates of the particles, in m.
    pub(crate) coordinates: Vec<[f64; 2]>,
    /// Rotation between the panel's frame and its yarns.
    pub(crate) grain: Grain,
    /// Middle of the panel in its frame, in m: [0, 0] for a disc, the middle of the bounding box
    /// for a panel that was cut elsewhere.
    pub(crate) middle: [f64; 2],
    /// Width and height of a rectangle, in m.
    pub(crate) size: Option<[f64; 2]>,
    /// Cells, row by row along the warp.
    pub(crate) cells: Vec<Cell>,
    /// Triangles between the cells and the outline, and between cells of two sizes, anticlockwise.
    /// The list is empty in panels without a rim.
    pub(crate) rim: Vec<[u32; 3]>,
    /// Lines along which the panel is folded at rest.
    pub(crate) folds: Vec<Fold>,
    /// Area of cloth of allowances at each particle, in m², empty without allowances.
    pub(crate) allowances: Vec<f64>,
    /// Grids of the particles: one, or several in a [graded](Lattice::graded) panel, the finest
    /// first.
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
    /// Returns the distance of the particles along the weft and along the warp, in m. In a
    /// [graded](Lattice::graded) panel it belongs to the finest grid.
    #[must_use]
    pub fn spacing(&self) -> [f64; 2] {
        self.spacing
    }

    /// Returns the number of particles.
    #[must_use]
    pub fn particle_count(&self) -> usize {
        self.coordinates.len()
    }

    /// Returns the material coordinates of the particles, in m.
    #[must_use]
    pub fn coordinates(&self) -> &[[f64; 2]] {
        &self.coordinates
    }

    /// Returns the rotation between the panel's frame and its yarns.
    #[must_use]
    pub fn grain(&self) -> Grain {
        self.grain
    }

    /// Returns the middle of the panel in its frame, in m: [0, 0] for a disc, the middle of the
    /// bounding box for a panel that was cut elsewhere.
    #[must_use]
    pub fn middle(&self) -> [f64; 2] {
        self.middle
    }

    /// Returns the panel with another `middle` of its frame, in m.
    #[must_use]
    pub fn with_middle(self, middle: [f64; 2]) -> Self {
        Self { middle, ..self }
    }

    /// Returns the cells, row by row along the warp.
    #[must_use]
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// Returns the triangles between the cells and the outline, and between cells of two sizes,
    /// anticlockwise. Panels without a rim have none.
    #[must_use]
    pub fn rim(&self) -> &[[u32; 3]] {
        &self.rim
    }

    /// Returns the points of the particles in the panel's frame, in m. The frame of a rectangle
    /// starts at its lower left corner, the frame of a disc at its middle. A panel that was cut
    /// elsewhere keeps the frame of its [`Mesh`](crate::Mesh).
    #[must_use]
    pub fn panel_coordinates(&self) -> Vec<[f64; 2]> {
        self.coordinates.iter().map(|&coordinates| self.grain.to_panel(coordinates)).collect()
    }

    /// Returns the distance of each particle from a side of the panel, in spacings: 0 on the side,
    /// negative beyond it.
    ///
    /// The side is at the low (`end` −1) or the high end (`end` 1) of `axis` of the panel's frame:
    /// 0 for the first axis, 1 or more for the second. Panels other than rectangles have their
    /// outermost particles there.
    #[must_use]
    pub fn depths(&self, axis: usize, end: f64) -> Vec<f64> {
        let axis = axis.min(1);
        let points = self.panel_coordinates();
        let side = match self.size {
            Some(size) => {
                if end > 0.0 {
                    size[axis]
                } else {
                    0.0
                }
            }
            None => points.iter().map(|point| end * point[axis]).fold(f64::MIN, f64::max),
        };
        let spacing = self.grain.exchanged(self.spacing)[axis];
        points.iter().map(|point| (side - end * point[axis]) / spacing).collect()
    }

    /// Returns the lines along which the panel is folded at rest, as [`Fold`]s.
    #[must_use]
    pub fn folds(&self) -> &[Fold] {
        &self.folds
    }

    /// Returns the area of the panel, in m², the sum over `cells` and `rim`.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.cells.iter().flat_map(|cell| cell.quadrants).chain(self.rim_areas()).sum()
    }

    /// Returns triangles for pictures and contact: every cell halved, with diagonals that alternate
    /// like the fields of a chessboard, then the `rim`.
    #[must_use]
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let halves = self.cells.iter().flat_map(|cell| {
            let [a, b, c, d] = cell.corners;
            if cell.even { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
        });
        halves.chain(self.rim.iter().copied()).collect()
    }

    /// Returns runs of consecutive particles along the yarns of all `grids`: of the warp, then of
    /// the weft.
    pub(crate) fn yarns(&self) -> [Vec<Vec<u32>>; 2] {
        let mut all = [Vec::new(), Vec::new()];
        for grid in &self.grids {
            all.iter_mut().zip(grid.yarns()).for_each(|(all, yarns)| all.extend(yarns));
        }
        all
    }

    /// Returns the largest distance of neighbouring particles along the weft and along the warp, in
    /// m. In a panel that is not graded it is `spacing`.
    #[must_use]
    pub fn spacing_max(&self) -> [f64; 2] {
        self.grids.last().map_or(self.spacing, |grid| grid.spacing)
    }

    /// Returns for each particle the spacing of its grid, the geometric mean along weft and warp,
    /// in m. Nodes of the outline have the mean of `spacing`.
    pub(crate) fn spacings(&self) -> Vec<f64> {
        let [across, along] = self.spacing;
        let mut spacings = vec![(across * along).sqrt(); self.coordinates.len()];
        for grid in &self.grids {
            let [across, along] = grid.spacing;
            grid.particles().for_each(|node| spacings[node as usize] = (across * along).sqrt());
        }
        spacings
    }

    /// Returns the areas of the particles, in m², from `cells` and `rim`.
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

    /// Returns the areas of the triangles of the `rim`, in m².
    pub(crate) fn rim_areas(&self) -> impl Iterator<Item = f64> {
        self.rim
            .iter()
            .map(|triangle| 0.5 * twice_area(triangle.map(|node| self.coordinates[node as usize])))
    }

    /// Returns the sides that belong to only one of the `cells` and triangles of the `rim`.
    pub(crate) fn outline(&self) -> BTreeSet<[u32; 2]> {
        let mut count = BTreeMap::new();
        for nodes in self.faces() {
            for (k, &node) in nodes.iter().enumerate() {
                let next = nodes[(k + 1) % nodes.len()];
                *count.entry([node.min(next), node.max(next)]).or_insert(0) += 1;
            }
        }
        count.into_iter().filter(|&(_, faces)| faces == 1).map(|(side, _)| side).collect()
    }

    /// Returns for each particle the particles with a common face, one of the `cells` or of the
    /// triangles of the `rim`.
    pub(crate) fn neighbours(&self) -> Vec<Vec<u32>> {
        let mut neighbours = vec![Vec::new(); self.coordinates.len()];
        for nodes in self.faces() {
            for &node in nodes {
                let others = nodes.iter().copied().filter(|&other| other != node);
                neighbours[node as usize].extend(others);
            }
        }
        for list in &mut neighbours {
            list.sort_unstable();
            list.dedup();
        }
        neighbours
    }

    /// Returns the nodes of all `cells`, then of all triangles of the `rim`.
    fn faces(&self) -> impl Iterator<Item = &[u32]> {
        let cells = self.cells.iter().map(|cell| &cell.corners[..]);
        cells.chain(self.rim.iter().map(|triangle| &triangle[..]))
    }
}
