//! Bilinear interpolation from the nodes of a coarse grid over each sheet to its particles.

use core::ops::Range;
use std::collections::BTreeMap;

use crate::linear::block_matrix::BlockMatrix;
use crate::linear::lanes::Columns;
use crate::system::MaterialPoint;

/// Particles along a side of a cell, where all of a sheet's bounding box is cloth.
///
/// At 40 000 particles cells of 5 took 1.15 times the time of cells of 12, with a tenth fewer
/// iterations; cells of 8 took 1.09 times.
const CELL: f64 = 12.0;

/// Cell of a grid.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    /// Nodes at the corners (0, 0), (1, 0), (0, 1) and (1, 1).
    pub nodes: [u32; 4],
    /// Points in it.
    pub points: Range<usize>,
}

/// Particle in a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub particle: u32,
    row: u32,
    /// Weights of the nodes of the cell; zeros while the particle is held.
    pub weights: [f64; 4],
    bilinear: [f64; 4],
}

/// Interpolation: the cells with their points, those of a cell one after the other.
#[derive(Debug)]
pub(super) struct Interpolation {
    /// Number of nodes.
    pub nodes: usize,
    pub cells: Vec<Cell>,
    pub points: Vec<Point>,
}

/// Grid over a sheet.
struct Grid {
    low: [f64; 2],
    extent: [f64; 2],
    /// Numbers of cells along the two coordinates.
    cells: [usize; 2],
}

/// Place in a grid.
struct Place {
    cell: [usize; 2],
    weights: [f64; 4],
}

impl Interpolation {
    pub(super) fn new(row_of: &[u32], material_points: &[MaterialPoint]) -> Self {
        let mut sheets: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (particle, point) in material_points.iter().enumerate() {
            sheets.entry(point.sheet).or_default().push(particle);
        }
        let mut all = Self { nodes: 0, cells: Vec::new(), points: Vec::new() };
        for particles in sheets.into_values() {
            all.add_sheet(&particles, row_of, material_points);
        }
        all
    }

    fn add_sheet(&mut self, particles: &[usize], row_of: &[u32], all: &[MaterialPoint]) {
        let grid = Grid::around(particles.iter().map(|&particle| all[particle].coordinates));
        let mut cells: BTreeMap<[usize; 2], Vec<Point>> = BTreeMap::new();
        for &particle in particles {
            let Place { cell: [u, v], weights } = grid.place(all[particle].coordinates);
            let (particle, row) = (particle as u32, row_of[particle]);
            let point = Point { particle, row, weights, bilinear: weights };
            cells.entry([v, u]).or_default().push(point);
        }
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

    /// Takes the weights of held particles away, and gives others theirs back.
    pub(super) fn hold(&mut self, matrix: &BlockMatrix) {
        for point in &mut self.points {
            let held = matrix.is_held(point.particle as usize);
            point.weights = if held { [0.0; 4] } else { point.bilinear };
        }
    }

    /// Sums numbers of the particles, weighted, at the nodes.
    #[inline(always)]
    pub(super) fn restrict(&self, numbers: &Columns<f64>, sums: &mut [f64]) {
        sums.fill(0.0);
        for Cell { nodes, points } in &self.cells {
            let mut cell = [[0.0; 4]; 3];
            for point in &self.points[points.clone()] {
                for (sums, number) in cell.iter_mut().zip(numbers.at(point.row as usize)) {
                    for (sum, weight) in sums.iter_mut().zip(point.weights) {
                        *sum += weight * number;
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

    /// Adds numbers of the nodes, interpolated, to those of the particles.
    #[inline(always)]
    pub(super) fn add(&self, numbers: &[f64], image: &mut Columns<f32>) {
        for Cell { nodes, points } in &self.cells {
            let corners = nodes.map(|node| &numbers[3 * node as usize..][..3]);
            for Point { row, weights: [a, b, c, d], .. } in &self.points[points.clone()] {
                for (axis, column) in image.0.iter_mut().enumerate() {
                    let [x, y, z, w] = corners.map(|corner| corner[axis]);
                    column[*row as usize] += (a * x + b * y + c * z + d * w) as f32;
                }
            }
        }
    }
}

impl Grid {
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
        // That of the particles, were the bounding box full of them.
        let spacing = (extent[0] * extent[1] / count).sqrt();
        let cells = extent.map(|extent| (extent / (CELL * spacing)).round().max(1.0) as usize);
        Self { low, extent, cells }
    }

    fn place(&self, coordinates: [f64; 2]) -> Place {
        let scaled = [0, 1].map(|axis| {
            let part = (coordinates[axis] - self.low[axis]) / self.extent[axis];
            part * self.cells[axis] as f64
        });
        let cell = [0, 1].map(|axis| (scaled[axis] as usize).min(self.cells[axis] - 1));
        let [x, y] = [0, 1].map(|axis| scaled[axis] - cell[axis] as f64);
        let weights = [(1.0 - x) * (1.0 - y), x * (1.0 - y), (1.0 - x) * y, x * y];
        Place { cell, weights }
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
            let place = grid.place(points[own.particle as usize].coordinates);
            for (corner, &node) in cell.nodes.iter().enumerate() {
                let at = [0, 1].map(|axis| {
                    let cells = (place.cell[axis] + (corner >> axis & 1)) as f64;
                    grid.low[axis] + grid.extent[axis] * cells / grid.cells[axis] as f64
                });
                places[node as usize] = [1.0, at[0], at[1]];
            }
        }
        let mut image = Columns::new(4000);
        interpolation.add(places.as_flattened(), &mut image);
        for (k, MaterialPoint { coordinates: [u, v], .. }) in points.iter().enumerate() {
            let found = image.at(rows[k] as usize);
            for (found, expected) in found.into_iter().zip([1.0, *u, *v]) {
                assert!((f64::from(found) - expected).abs() < 1e-5, "{found} for {expected}");
            }
        }
    }
}
