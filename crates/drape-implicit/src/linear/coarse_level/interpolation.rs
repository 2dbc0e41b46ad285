//! Bilinear interpolation from the nodes of a coarse grid over each sheet to its particles.

use core::ops::Range;
use std::collections::BTreeMap;

use crate::linear::block_matrix::BlockMatrix;
use crate::linear::lanes::Columns;
use crate::system::MaterialPoint;

/// Number of particles along a side of a cell, if cloth fills the bounding box of the sheet.
///
/// With 40 000 particles, cells of 5 particles took 1.15 times the time of cells of 12, with a
/// tenth fewer iterations. Cells of 8 took 1.09 times the time.
const CELL_SIDE: f64 = 12.0;

/// Cell of a grid.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    /// Nodes at the corners (0, 0), (1, 0), (0, 1) and (1, 1).
    pub nodes: [u32; 4],
    /// Points in the cell.
    pub points: Range<usize>,
}

/// Particle in a cell.
///
/// Weights are in single precision, because reading the weights takes most of the time.
/// Restriction, interpolation and projection use equal weights.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub particle: u32,
    row: u32,
    /// Weights of the nodes of the cell; zeros while the particle is held.
    pub weights: [f32; 4],
}

/// Cell of a row's particle and the weights in the cell. The weights are zeros in a row without a
/// particle.
#[derive(Clone, Copy, Debug, Default)]
struct RowPoint {
    cell: u32,
    weights: [f32; 4],
}

/// Interpolation: cells, and points ordered by cell.
#[derive(Debug)]
pub(super) struct Interpolation {
    /// Number of nodes.
    pub nodes: usize,
    pub cells: Vec<Cell>,
    pub points: Vec<Point>,
    /// Weights of the points as long as their particles are free.
    bilinear: Vec<[f32; 4]>,
    by_row: Vec<RowPoint>,
}

/// Grid over a sheet.
struct Grid {
    /// Least coordinates, in m.
    low: [f64; 2],
    /// Extent of the bounding box, in m.
    extent: [f64; 2],
    /// Numbers of cells along the two coordinates.
    cells: [usize; 2],
}

/// Cell of a point in a grid, and the weights of the cell's corners.
struct CellWeights {
    cell: [usize; 2],
    weights: [f32; 4],
}

impl Interpolation {
    /// Returns the interpolation for particles in the rows `row_of` at `material_points`, with one
    /// grid per sheet.
    pub(super) fn new(row_of: &[u32], material_points: &[MaterialPoint]) -> Self {
        let mut sheets: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (particle, point) in material_points.iter().enumerate() {
            sheets.entry(point.sheet).or_default().push(particle);
        }

        let mut interpolation = Self {
            nodes: 0,
            cells: Vec::new(),
            points: Vec::new(),
            bilinear: Vec::new(),
            by_row: Vec::new(),
        };
        for particles in sheets.into_values() {
            interpolation.add_sheet(&particles, row_of, material_points);
        }
        let weights = interpolation.points.iter().map(|point| point.weights).collect();
        interpolation.bilinear = weights;

        // Rows lead to cells and weights too, for a sweep over consecutive rows.
        let rows = row_of.iter().max().map_or(0, |&last| last as usize + 1);
        interpolation.by_row = vec![RowPoint::default(); rows];
        for (cell, Cell { points, .. }) in interpolation.cells.iter().enumerate() {
            for &Point { row, weights, .. } in &interpolation.points[points.clone()] {
                interpolation.by_row[row as usize] = RowPoint { cell: cell as u32, weights };
            }
        }
        interpolation
    }

    /// Adds the cells and points of one sheet with the given `particles`.
    fn add_sheet(&mut self, particles: &[usize], row_of: &[u32], points: &[MaterialPoint]) {
        let grid = Grid::around(particles.iter().map(|&particle| points[particle].coordinates));
        let mut cells: BTreeMap<[usize; 2], Vec<Point>> = BTreeMap::new();
        for &particle in particles {
            let CellWeights { cell: [u, v], weights } = grid.locate(points[particle].coordinates);
            let (particle, row) = (particle as u32, row_of[particle]);
            let point = Point { particle, row, weights };
            cells.entry([v, u]).or_default().push(point);
        }

        // Only corners of cells with particles become nodes.
        let mut nodes: BTreeMap<[usize; 2], u32> = BTreeMap::new();
        for ([v, u], points) in cells {
            let corners = [[v, u], [v, u + 1], [v + 1, u], [v + 1, u + 1]];
            let nodes = corners.map(|corner| {
                let number = (self.nodes + nodes.len()) as u32;
                *nodes.entry(corner).or_insert(number)
            });
            let first = self.points.len();
            self.points.extend(points);
            self.cells.push(Cell { nodes, points: first..self.points.len() });
        }
        self.nodes += nodes.len();
    }

    /// Returns the nodes of the sixteen pairs of corners of two `cells`: each corner of the first
    /// cell with each corner of the second.
    pub(super) fn corner_pairs(&self, cells: [usize; 2]) -> [[usize; 2]; 16] {
        let [first, second] = cells.map(|cell| self.cells[cell].nodes);
        core::array::from_fn(|k| [first[k / 4] as usize, second[k % 4] as usize])
    }

    /// Sets the weights of particles that `matrix` holds to zero, and restores all other weights.
    pub(super) fn hold(&mut self, matrix: &BlockMatrix) {
        let Self { points, bilinear, by_row, .. } = self;
        for (point, bilinear) in points.iter_mut().zip(bilinear) {
            let held = matrix.is_held(point.particle as usize);
            point.weights = if held { [0.0; 4] } else { *bilinear };
            by_row[point.row as usize].weights = point.weights;
        }
    }

    /// Writes the weighted sums of the particles' `numbers` at each node into `sums`, three per
    /// node.
    #[inline(always)]
    pub(super) fn restrict(&self, numbers: &Columns<f64>, sums: &mut [f64]) {
        sums.fill(0.0);
        for Cell { nodes, points } in &self.cells {
            let mut cell = [[0.0; 4]; 3];
            for point in &self.points[points.clone()] {
                for (sums, number) in cell.iter_mut().zip(numbers.at(point.row as usize)) {
                    for (sum, weight) in sums.iter_mut().zip(point.weights) {
                        *sum += f64::from(weight) * number;
                    }
                }
            }
            for (corner, &node) in nodes.iter().enumerate() {
                for (sum, cell) in sums[3 * node as usize..][..3].iter_mut().zip(&cell) {
                    *sum += cell[corner];
                }
            }
        }
    }

    /// Interpolates the `numbers` of the nodes, three per node, and adds the results to consecutive
    /// `rows` from the row `first` on.
    #[inline(always)]
    pub(super) fn add(&self, numbers: &[f64], first: usize, rows: [&mut [f32]; 3]) {
        let Some(points) = self.by_row.get(first..) else { return };
        let [xs, ys, zs] = rows;
        let mut last = u32::MAX;
        let mut corners = [[0.0; 3]; 4];

        for (((RowPoint { cell, weights }, x), y), z) in points.iter().zip(xs).zip(ys).zip(zs) {
            if *cell != last {
                // Neighbouring rows mostly share a cell.
                last = *cell;
                let nodes = self.cells.get(*cell as usize).map_or([0; 4], |cell| cell.nodes);
                corners = nodes.map(|node| {
                    let at = 3 * node as usize;
                    [numbers[at], numbers[at + 1], numbers[at + 2]]
                });
            }

            let mut sums = [0.0; 3];
            for (corner, weight) in corners.iter().zip(weights) {
                for (sum, number) in sums.iter_mut().zip(corner) {
                    *sum += number * f64::from(*weight);
                }
            }
            *x += sums[0] as f32;
            *y += sums[1] as f32;
            *z += sums[2] as f32;
        }
    }
}

impl Grid {
    /// Returns a grid over the bounding box of the points at `coordinates`.
    fn around(coordinates: impl Iterator<Item = [f64; 2]>) -> Self {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        let mut count = 0.0;
        for point in coordinates {
            low = [0, 1].map(|axis| low[axis].min(point[axis]));
            high = [0, 1].map(|axis| high[axis].max(point[axis]));
            count += 1.0;
        }
        let extent = [0, 1].map(|axis| (high[axis] - low[axis]).max(f64::MIN_POSITIVE));
        // The spacing of the particles if they filled the bounding box.
        let spacing = (extent[0] * extent[1] / count).sqrt();
        let cells = extent.map(|extent| (extent / (CELL_SIDE * spacing)).round().max(1.0) as usize);
        Self { low, extent, cells }
    }

    /// Returns the cell and the bilinear weights of a point at `coordinates`.
    fn locate(&self, coordinates: [f64; 2]) -> CellWeights {
        let scaled = [0, 1].map(|axis| {
            let fraction = (coordinates[axis] - self.low[axis]) / self.extent[axis];
            fraction * self.cells[axis] as f64
        });
        let cell = [0, 1].map(|axis| (scaled[axis] as usize).min(self.cells[axis] - 1));
        let [x, y] = [0, 1].map(|axis| scaled[axis] - cell[axis] as f64);
        let weights =
            [(1.0 - x) * (1.0 - y), x * (1.0 - y), (1.0 - x) * y, x * y].map(|w| w as f32);
        CellWeights { cell, weights }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_functions_are_interpolated_exactly_on_each_sheet() {
        let point = |k: usize| {
            let angle = 2.4 * k as f64;
            let radius = (k as f64).sqrt();
            MaterialPoint {
                sheet: (k % 3) as u32,
                coordinates: [radius * angle.cos(), 0.3 * radius * angle.sin()],
                spacing: 1.0,
            }
        };
        let points: Vec<_> = (0..4000).map(point).collect();
        let rows: Vec<u32> = (0..4000).rev().collect();
        let interpolation = Interpolation::new(&rows, &points);
        let mut places = vec![[f64::NAN; 3]; interpolation.nodes];
        for cell in &interpolation.cells {
            assert!(cell.points.len() < 300, "{} points in a cell", cell.points.len());
            let sheet = points[interpolation.points[cell.points.start].particle as usize].sheet;
            let particles = (0..4000).filter(|k| points[*k].sheet == sheet);
            let grid = Grid::around(particles.map(|k| points[k].coordinates));
            let own = &interpolation.points[cell.points.start];
            let place = grid.locate(points[own.particle as usize].coordinates);
            for (corner, &node) in cell.nodes.iter().enumerate() {
                let at = [0, 1].map(|axis| {
                    let cells = (place.cell[axis] + (corner >> axis & 1)) as f64;
                    grid.low[axis] + grid.extent[axis] * cells / grid.cells[axis] as f64
                });
                places[node as usize] = [1.0, at[0], at[1]];
            }
        }
        let mut image = Columns::new(4000);
        interpolation.add(
            places.as_flattened(),
            0,
            image.0.each_mut().map(|column| &mut column[..]),
        );
        for (k, MaterialPoint { coordinates: [u, v], .. }) in points.iter().enumerate() {
            let found = image.at(rows[k] as usize);
            for (found, expected) in found.into_iter().zip([1.0, *u, *v]) {
                assert!((f64::from(found) - expected).abs() < 1e-5, "{found} for {expected}");
            }
        }
    }
}
