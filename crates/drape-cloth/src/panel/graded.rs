//! Graded panels: cells of two, four and eight spacings where the cloth needs no finer ones.
//!
//! ```text
//!    ┌───────┬───────┬───┬───┐
//!    │       │     ╱ ├───┼───┤    Large cells have a separate grid. Beside finer cells
//!    │       │   ╱───├───┼───┤    they are cut into triangles, whose corners are nodes
//!    │       │ ╱   ╲ ├───┼───┤    of both grids, so that no node lies within a side.
//!    └───────┴───────┴───┴───┘
//! ```
//!
//! The triangles belong to the rim. Their traction and shear, and the bending about their corners,
//! are computed like at an outline.

use crate::error::Error;
use crate::panel::fold::{Fold, LineCoordinates};
use crate::panel::grid::Grid;
use crate::panel::lattice::{Cell, Lattice};
use crate::panel::numbering::Numbering;

/// Largest level. A cell of level `l` has sides of `2^l` spacings.
const LEVEL_MAX: u8 = 3;

/// Distance from a fold within which cells keep their size, in spacings: the distance over which a
/// fold is rounded, and two more for the connectors of the particles there.
const FOLD_REACH: f64 = 4.0;

/// Relative rounding error of the areas of a full cell and of a ratio of spacings.
const ROUNDING_ERROR: f64 = 1e-9;

/// Graded panel, with the numbers in it of the finer panel's particles.
#[derive(Debug, Clone, PartialEq)]
pub struct GradedPanel {
    /// Graded panel.
    pub lattice: Lattice,
    /// Number in the graded panel of each particle of the finer panel, `None` where the graded
    /// panel has no particle.
    pub numbers: Vec<Option<u32>>,
}

/// Levels of the cells of a grid, row by row.
struct Levels {
    columns: usize,
    rows: usize,
    cells: Vec<Option<CellLevel>>,
}

/// Cell of a panel with its level.
#[derive(Debug, Clone, Copy)]
struct CellLevel {
    /// Index among the cells of the panel.
    index: usize,
    level: u8,
    /// Highest level that the cell may have.
    limit: u8,
}

/// Block: square of cells that become one cell, by its first column, its first row and its level.
#[derive(Debug, Clone, Copy)]
struct Block {
    column: usize,
    row: usize,
    level: u8,
}

impl Block {
    /// Returns the number of cells along a side, `2^level`.
    fn side(self) -> usize {
        1 << self.level
    }

    /// Returns the columns and rows of the cells, from `column` and `row` on.
    fn cells(self) -> impl Iterator<Item = [usize; 2]> {
        let Self { column, row, .. } = self;
        let side = self.side();
        (row..row + side).flat_map(move |row| (column..column + side).map(move |c| [c, row]))
    }

    /// Returns the columns and rows of the points at the corners (`u`, `v`) = (0, 0), (1, 0), (1,
    /// 1), (0, 1).
    fn corners(self) -> [[usize; 2]; 4] {
        let (column, row, side) = (self.column, self.row, self.side());
        [[column, row], [column + side, row], [column + side, row + side], [column, row + side]]
    }
}

impl Lattice {
    /// Returns the panel with cells of two, four and eight spacings. No cell is larger than
    /// `spacing_max` allows: the largest spacing, in m, at given material coordinates.
    ///
    /// Cells beside the outline keep their size, so that the outline keeps its nodes. Cells beside
    /// a fold keep their size too. Two cells that touch differ by a factor of two at most. The
    /// particles are numbered grid by grid, the finest first. The nodes of the outline of a panel
    /// that was cut elsewhere follow.
    ///
    /// ```
    /// use drape_cloth::Lattice;
    ///
    /// let fine = Lattice::rectangle(0.3, 0.3, 0.005)?;
    /// // Fine along a diagonal.
    /// let graded = fine.graded(|[u, v]| 0.005 + 0.5 * (u - v).abs())?.lattice;
    /// assert!(graded.particle_count() < fine.particle_count() / 2);
    /// assert!((graded.area() - 0.09).abs() < 1e-12);
    /// # Ok::<(), drape_cloth::Error>(())
    /// ```
    ///
    /// # Errors
    /// The panel is graded already.
    pub fn graded(&self, spacing_max: impl Fn([f64; 2]) -> f64) -> Result<GradedPanel, Error> {
        let [grid] = self.grids.as_slice() else { return Err(Error::Graded) };
        let mut levels = Levels::new(self, grid, spacing_max);
        levels.raise();
        levels.balance();
        Ok(self.joined(grid, &levels))
    }

    /// Returns the panel with the cells of `grid` joined by their `levels`.
    fn joined(&self, grid: &Grid, levels: &Levels) -> GradedPanel {
        let mut numbering = Numbering {
            lattice: self,
            grid,
            coordinates: Vec::new(),
            numbers: vec![None; self.coordinates.len()],
        };
        let grids = numbering.number_grids(LEVEL_MAX, |point| levels.at_point(point));

        // The nodes of an outline that was cut elsewhere lie on no grid.
        let in_grid = grid.particles().count();
        (in_grid..self.coordinates.len()).for_each(|node| {
            numbering.keep(node as u32);
        });

        // A block with nodes at its corners alone is a cell, another one becomes triangles.
        let mut cells = Vec::new();
        let mut rim: Vec<[u32; 3]> = self
            .rim
            .iter()
            .map(|nodes| nodes.map(|node| numbering.number(node).unwrap_or_default()))
            .collect();
        for block in levels.blocks() {
            let Block { column, row, level } = block;
            let Some(cell) = levels.cell(column, row).map(|cell| &self.cells[cell.index]) else {
                continue;
            };
            let points = block.corners();
            let corners = points.map(|point| numbering.at_point(point).unwrap_or_default());
            let even = ((column >> level) + (row >> level)).is_multiple_of(2);
            if points.iter().all(|&point| levels.at_point(point) == Some(level)) {
                let parts = (block.side() * block.side()) as f64;
                let quadrants = cell.quadrants.map(|area| parts * area);
                cells.push(Cell { corners, quadrants, even });
            } else {
                let middles = [0, 1, 2, 3].map(|side| {
                    let (from, to) = (points[side], points[(side + 1) % 4]);
                    numbering.at_point([0, 1].map(|k| (from[k] + to[k]) / 2))
                });
                rim.extend(triangulate(corners, middles, even));
            }
        }

        let Numbering { coordinates, numbers, .. } = numbering;
        let mut allowances =
            vec![0.0; if self.allowances.is_empty() { 0 } else { coordinates.len() }];
        for (number, &area) in numbers.iter().zip(&self.allowances) {
            if let Some(number) = number {
                allowances[*number as usize] = area;
            }
        }
        let lattice = Self { coordinates, cells, rim, allowances, grids, ..self.clone() };
        GradedPanel { lattice, numbers }
    }

    /// Returns whether `point` is so near a fold that cells keep their size.
    fn is_beside_fold(&self, point: [f64; 2]) -> bool {
        let reach = FOLD_REACH * self.spacing[0].max(self.spacing[1]);
        self.folds.iter().any(|fold: &Fold| {
            let LineCoordinates { along, left } = fold.coordinates(point);
            left.abs() < reach && (-reach..fold.length() + reach).contains(&along)
        })
    }
}

impl Levels {
    /// Returns the cells of `grid`, all of level 0, with the limits that `spacing_max` sets.
    fn new(lattice: &Lattice, grid: &Grid, spacing_max: impl Fn([f64; 2]) -> f64) -> Self {
        let [columns, rows] = [grid.columns - 1, grid.points.len() / grid.columns - 1];
        let mut points = vec![0; lattice.coordinates.len()];
        for (point, particle) in grid.points.iter().enumerate() {
            particle.iter().for_each(|&particle| points[particle as usize] = point);
        }

        let quarter = 0.25 * grid.spacing[0] * grid.spacing[1];
        let finest = grid.spacing[0].max(grid.spacing[1]);
        let mut cells = vec![None; columns * rows];
        for (index, cell) in lattice.cells.iter().enumerate() {
            // The smallest spacing at the corners decides.
            let allowed = cell.corners.map(|node| spacing_max(lattice.coordinates[node as usize]));
            let ratio = allowed.into_iter().fold(f64::MAX, f64::min) / finest;
            let spacing_limit = (1..=LEVEL_MAX)
                .take_while(|level| ratio >= f64::from(1_u32 << level) * (1.0 - ROUNDING_ERROR))
                .last()
                .unwrap_or(0);

            // Only full cells away from folds become larger.
            let is_full = cell
                .quadrants
                .iter()
                .all(|&area| (area - quarter).abs() <= ROUNDING_ERROR * quarter);
            let may_grow = is_full
                && spacing_limit > 0
                && !cell
                    .corners
                    .iter()
                    .any(|&node| lattice.is_beside_fold(lattice.coordinates[node as usize]));
            let limit = if may_grow { spacing_limit } else { 0 };
            let point = points[cell.corners[0] as usize];
            cells[point / grid.columns * columns + point % grid.columns] =
                Some(CellLevel { index, level: 0, limit });
        }
        Self { columns, rows, cells }
    }

    /// Returns the cell at `column` and `row`, or `None` outside the panel.
    fn cell(&self, column: usize, row: usize) -> Option<CellLevel> {
        let inside = column < self.columns && row < self.rows;
        if inside { self.cells[row * self.columns + column] } else { None }
    }

    /// Returns the level of the node at a point, or `None` inside a block that has no node there.
    fn at_point(&self, [column, row]: [usize; 2]) -> Option<u8> {
        let around = [[1, 1], [0, 1], [1, 0], [0, 0]];
        let levels = around.iter().filter_map(|&[left, below]| {
            self.cell(column.checked_sub(left)?, row.checked_sub(below)?).map(|cell| cell.level)
        });
        let level = levels.min().unwrap_or(0);
        let size = 1 << level;
        (column.is_multiple_of(size) && row.is_multiple_of(size)).then_some(level)
    }

    /// Returns each [`Block`] of the panel, row by row.
    fn blocks(&self) -> impl Iterator<Item = Block> {
        let cells =
            (0..self.rows).flat_map(|row| (0..self.columns).map(move |column| [column, row]));
        cells.filter_map(|[column, row]| {
            let level = self.cell(column, row)?.level;
            let size = 1 << level;
            (column.is_multiple_of(size) && row.is_multiple_of(size)).then_some(Block {
                column,
                row,
                level,
            })
        })
    }

    /// Sets the level of all cells of `block` to `level`.
    fn set(&mut self, block: Block, level: u8) {
        for [column, row] in block.cells() {
            if let Some(cell) = &mut self.cells[row * self.columns + column] {
                cell.level = level;
            }
        }
    }

    /// Returns the cells of `block` and around it, `None` for places outside the panel.
    fn around(&self, block: Block) -> impl Iterator<Item = Option<CellLevel>> {
        let side = block.side();
        // Counted from one cell before the block.
        let range = move |first: usize| first..first + side + 2;
        range(block.row).flat_map(move |row| {
            range(block.column)
                .map(move |column| self.cell(column.checked_sub(1)?, row.checked_sub(1)?))
        })
    }

    /// Joins cells, four to one, as far as their `limit` allows and cells lie all around them.
    fn raise(&mut self) {
        for level in 1..=LEVEL_MAX {
            let side = 1 << level;
            for row in (0..=self.rows.saturating_sub(side)).step_by(side) {
                for column in (0..=self.columns.saturating_sub(side)).step_by(side) {
                    let block = Block { column, row, level };
                    let may_join = block.cells().all(|[column, row]| {
                        self.cell(column, row)
                            .is_some_and(|cell| cell.level + 1 == level && cell.limit >= level)
                    });
                    if may_join && self.around(block).all(|cell| cell.is_some()) {
                        self.set(block, level);
                    }
                }
            }
        }
    }

    /// Divides blocks until the sides of two blocks that touch differ by a factor of two at most,
    /// and each [`Block`] has a corner that belongs to no smaller block.
    fn balance(&mut self) {
        loop {
            let divided: Vec<Block> = self
                .blocks()
                .filter(|&block| {
                    let touches_small = self.around(block).any(|cell: Option<CellLevel>| {
                        cell.is_some_and(|cell| cell.level + 1 < block.level)
                    });
                    let has_corner = block
                        .corners()
                        .into_iter()
                        .any(|point| self.at_point(point) == Some(block.level));
                    touches_small || !has_corner
                })
                .collect();
            if divided.is_empty() {
                return;
            }
            divided.into_iter().for_each(|block| self.set(block, block.level - 1));
        }
    }
}

/// Returns the triangles of a square with `corners`, anticlockwise. `middles` are the nodes in the
/// middles of its sides, where smaller cells have some. `even` chooses the diagonal without them.
fn triangulate(corners: [u32; 4], middles: [Option<u32>; 4], even: bool) -> Vec<[u32; 3]> {
    // Corners between two middles are cut off.
    let mut triangles = Vec::new();
    let mut polygon = Vec::new();
    for (k, corner) in corners.into_iter().enumerate() {
        match (middles[(k + 3) % 4], middles[k]) {
            (Some(before), Some(after)) => triangles.push([before, corner, after]),
            _ => polygon.push(corner),
        }
        polygon.extend(middles[k]);
    }
    // The fan starts at a middle, or at a corner where there is none: no three nodes lie on a line.
    let about = middles.iter().flatten().next().or(corners.get(usize::from(!even)));
    let start = polygon.iter().position(|node| Some(node) == about).unwrap_or(0);
    polygon.rotate_left(start);
    let fan = polygon[1..].windows(2).map(|pair| [polygon[0], pair[0], pair[1]]);
    triangles.extend(fan);
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Allowance;
    use crate::layout::connectors::BendingConnectors;
    use crate::panel::triangle::twice_area;
    use crate::rim::fits::PanelFits;
    use crate::rim::neighbourhood::Neighbourhoods;

    fn disc() -> Lattice {
        Lattice::disc(0.15, 0.005).expect("a disc")
    }

    fn graded(fine: &Lattice, spacing_max: impl Fn([f64; 2]) -> f64) -> Lattice {
        fine.graded(spacing_max).expect("it was not graded").lattice
    }

    /// Coordinates of the ends of all sides of an outline.
    fn outline(lattice: &Lattice) -> Vec<[[f64; 2]; 2]> {
        let ends = lattice.outline().into_iter();
        let mut sides: Vec<_> = ends
            .map(|side| {
                let mut ends = side.map(|node| lattice.coordinates[node as usize]);
                ends.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
                ends
            })
            .collect();
        sides.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
        sides
    }

    #[test]
    fn the_outline_and_the_area_stay_and_no_side_has_a_node_within() {
        let fine = disc();
        for slope in [0.1, 0.3, 1.0, 10.0] {
            let graded = graded(&fine, |[u, v]| 0.004 + slope * (u - v).abs());
            assert!(graded.coordinates.len() < fine.coordinates.len(), "{slope}");
            assert!((graded.area() / fine.area() - 1.0).abs() < 1e-12, "{slope}");
            // A node within a side would leave it to one triangle, as the outline is.
            assert_eq!(outline(&graded), outline(&fine), "{slope}");
        }
        let grids = graded(&fine, |_| 1.0).grids;
        let spacings: Vec<f64> = grids.iter().map(|grid| (1e3 * grid.spacing[0]).round()).collect();
        assert_eq!(spacings, [5.0, 10.0, 20.0, 40.0]);
    }

    #[test]
    fn the_spacing_is_nowhere_larger_than_allowed() {
        let allowed = |[u, v]: [f64; 2]| 0.005 + 0.4 * (u - 0.5 * v).abs();
        let graded = graded(&disc(), allowed);
        for triangle in graded.triangles() {
            let points = triangle.map(|node| graded.coordinates[node as usize]);
            let side = [0, 1].map(|axis| {
                let all = points.map(|point| point[axis]);
                all.into_iter().fold(f64::MIN, f64::max) - all.into_iter().fold(f64::MAX, f64::min)
            });
            for point in points {
                assert!(side[0].max(side[1]) <= allowed(point) + 1e-12, "{points:?}");
            }
        }
    }

    #[test]
    fn what_is_fine_everywhere_stays_as_it_is_and_a_graded_panel_is_refused() {
        let fine = disc();
        assert_eq!(graded(&fine, |_| 0.009), fine);
        assert_eq!(graded(&fine, |_| 1.0).graded(|_| 1.0), Err(Error::Graded));
    }

    #[test]
    fn particles_keep_their_places_and_allowances_under_their_new_numbers() {
        let fine = disc();
        let side = fine.outline().pop_first().expect("a side");
        let hem = Allowance { line: side.to_vec(), width: 0.02 };
        let fine = fine.with_allowances(&[hem]).expect("it lies along the outline");
        let GradedPanel { lattice, numbers } = fine.graded(|_| 1.0).expect("it was not graded");
        let mut found = vec![0; lattice.coordinates.len()];
        for (before, number) in numbers.iter().enumerate() {
            let Some(number) = number.map(|number| number as usize) else { continue };
            assert_eq!(lattice.coordinates[number], fine.coordinates[before]);
            assert_eq!(lattice.allowances[number], fine.allowances[before]);
            found[number] += 1;
        }
        assert!(found.iter().all(|&count| count == 1) && found.len() < numbers.len());
        assert_eq!(lattice.allowances.iter().filter(|area| **area > 0.0).count(), 2);
    }

    /// Rest curvatures that count as none: their rounding, where a fold of 1 rad has 200 1/m.
    const NO_CURVATURE: f64 = 1e-9;

    #[test]
    fn a_fold_keeps_its_rest_curvatures() {
        for ends in [[[-0.2, 0.0], [0.2, 0.0]], [[-0.2, -0.05], [0.2, 0.13]]] {
            let fold = Fold { ends, angle: 1.0 };
            let fine = disc().with_folds(&[fold]).expect("it crosses the disc");
            let GradedPanel { lattice, numbers } = fine.graded(|_| 1.0).expect("it was not graded");
            assert!(lattice.coordinates.len() < fine.coordinates.len() * 3 / 4);
            let mut folded = 0;
            for direction in [0, 1] {
                let [before, after] = [&fine, &lattice]
                    .map(|own| own.fold_curvatures(&own.yarns()[direction], direction));
                for (before, number) in before.iter().zip(&numbers) {
                    let after = number.map_or(0.0, |number| after[number as usize]);
                    assert!((after - before).abs() < NO_CURVATURE, "{after} 1/m, {before} before");
                    folded += usize::from(after.abs() > NO_CURVATURE);
                }
            }
            assert!(folded > 50, "{folded} connectors are folded");
            let without_shear = |own: &Lattice| {
                let areas = own.shear_areas();
                areas.iter().flatten().filter(|area| **area == 0.0).count()
            };
            assert_eq!(without_shear(&lattice), without_shear(&fine));

            // Between cells of two sizes no stencil is folded.
            let bending = BendingConnectors::along_yarns(&lattice, &lattice.areas(), true);
            let neighbourhoods = Neighbourhoods::new(&lattice).expect("it has a rim");
            let fits = PanelFits::new(&lattice, &neighbourhoods, &bending);
            let inside = fits.stencils.iter().filter(|stencil| {
                let [u, v] = lattice.coordinates[stencil.middle as usize];
                u.hypot(v) < 0.13
            });
            let curvatures: Vec<f64> = inside.flat_map(|stencil| stencil.folds).collect();
            assert!(curvatures.len() > 50, "{} curvatures of stencils", curvatures.len());
            assert!(curvatures.iter().all(|curvature| curvature.abs() < NO_CURVATURE));
        }
    }

    #[test]
    fn a_corner_between_two_divided_sides_has_one_triangle_of_half_a_small_cell() {
        // A square with sides of 2, by its corners 0 to 3 and the middles 4 to 7 of its sides.
        let points = [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1]]
            .map(|point| point.map(f64::from));
        let twice = |triangle: &[u32; 3]| twice_area(triangle.map(|node| points[node as usize]));
        for (divided, even) in (0..16_u32).flat_map(|divided| [(divided, true), (divided, false)]) {
            let middles = [0, 1, 2, 3].map(|side| (divided >> side & 1 == 1).then_some(4 + side));
            let triangles = triangulate([0, 1, 2, 3], middles, even);
            assert!(triangles.iter().all(|triangle| twice(triangle) > 0.0), "{triangles:?}");
            assert_eq!(triangles.iter().map(twice).sum::<f64>(), 8.0, "{triangles:?}");
            for corner in 0..4 {
                if let [Some(_), Some(_)] = [middles[(corner + 3) % 4], middles[corner]] {
                    let own = triangles.iter().filter(|nodes| nodes.contains(&(corner as u32)));
                    assert_eq!(own.map(twice).collect::<Vec<_>>(), [1.0], "{triangles:?}");
                }
            }
        }
    }
}
