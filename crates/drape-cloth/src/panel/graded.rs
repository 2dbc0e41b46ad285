//! Graded panels: cells of two, four and eight spacings where the cloth needs no finer ones.
//!
//! ```text
//!    ┌───────┬───────┬───┬───┐
//!    │       │     ╱ ├───┼───┤    Large cells have a grid of their own. Those that touch finer cells are
//!    │       │   ╱───├───┼───┤    cut into triangles, whose corners are nodes of both grids, so that
//!    │       │ ╱   ╲ ├───┼───┤    no node lies within a side.
//!    └───────┴───────┴───┴───┘
//! ```
//!
//! The triangles belong to the rim: traction, shear and bending about their corners are those of the
//! triangles at an outline.

use crate::error::Error;
use crate::panel::fold::{Fold, LineCoordinates};
use crate::panel::grid::Grid;
use crate::panel::lattice::{Cell, Lattice};

/// Largest level. A cell of level `l` has sides of `2^l` spacings.
const LEVEL_MAX: u8 = 3;

/// Distance from a fold within which cells keep their size, in spacings: that over which a fold is
/// rounded, and two more for the connectors of the particles there.
const FOLD_REACH: f64 = 4.0;

/// Tolerance of the areas of a full cell and of a ratio of spacings: rounding.
const ROUNDING_ERROR: f64 = 1e-9;

/// Graded panel, with the numbers that the particles of the finer panel have in it.
#[derive(Debug, Clone, PartialEq)]
pub struct GradedPanel {
    /// Graded panel.
    pub lattice: Lattice,
    /// Number of each particle of the finer panel in the graded one; none where that has no particle.
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
    /// Highest level that it may have.
    limit: u8,
}

/// Block: square of cells that become one, by its first column, its first row and its level.
#[derive(Debug, Clone, Copy)]
struct Block {
    column: usize,
    row: usize,
    level: u8,
}

impl Block {
    /// Number of cells along a side.
    fn side(self) -> usize {
        1 << self.level
    }

    /// Columns and rows of its cells.
    fn cells(self) -> impl Iterator<Item = [usize; 2]> {
        let Self { column, row, .. } = self;
        let side = self.side();
        (row..row + side).flat_map(move |row| (column..column + side).map(move |c| [c, row]))
    }

    /// Points at its corners (u, v) = (0, 0), (1, 0), (1, 1), (0, 1): their columns and rows.
    fn corners(self) -> [[usize; 2]; 4] {
        let (column, row, side) = (self.column, self.row, self.side());
        [[column, row], [column + side, row], [column + side, row + side], [column, row + side]]
    }
}

impl Lattice {
    /// Returns the panel with cells of two, four and eight spacings, nowhere larger than `spacing_max`:
    /// the largest spacing, in m, that is allowed at given material coordinates.
    ///
    /// Cells beside the outline keep their size, so that the outline keeps its nodes, and so do cells
    /// beside a fold. Two cells that touch differ by a factor of two at most. The particles are
    /// numbered grid by grid, the finest first; the nodes of the outline of a panel that was cut
    /// elsewhere follow.
    ///
    /// ```
    /// use drape_cloth::Lattice;
    ///
    /// let fine = Lattice::rectangle(0.3, 0.3, 0.005)?;
    /// // Fine along a diagonal.
    /// let graded = fine.graded(|[u, v]| 0.005 + 0.5 * (u - v).abs())?.lattice;
    /// assert!(graded.coordinates.len() < fine.coordinates.len() / 2);
    /// assert!((graded.area() - 0.09).abs() < 1e-12);
    /// # Ok::<(), drape_cloth::Error>(())
    /// ```
    ///
    /// # Errors
    /// When the panel is graded already.
    pub fn graded(&self, spacing_max: impl Fn([f64; 2]) -> f64) -> Result<GradedPanel, Error> {
        let [grid] = self.grids.as_slice() else { return Err(Error::Graded) };
        let mut levels = Levels::of(self, grid, spacing_max);
        levels.raise();
        levels.balance();
        Ok(self.joined(grid, &levels))
    }

    /// Returns the panel with the cells of its grid joined by their levels.
    fn joined(&self, grid: &Grid, levels: &Levels) -> GradedPanel {
        let node = |[column, row]: [usize; 2]| grid.points[row * grid.columns + column];
        let mut numbers = vec![None; self.coordinates.len()];
        let mut coordinates = Vec::new();
        let mut keep = |node: u32| {
            let number = coordinates.len() as u32;
            coordinates.push(self.coordinates[node as usize]);
            numbers[node as usize] = Some(number);
            number
        };
        let mut grids = Vec::new();
        for level in 0..=LEVEL_MAX {
            let step = 1 << level;
            let columns = grid.columns.div_ceil(step);
            let rows = (grid.points.len() / grid.columns).div_ceil(step);
            let places =
                (0..rows).flat_map(|row| (0..columns).map(move |c| [step * c, step * row]));
            let own = |&place: &[usize; 2]| levels.at_point(place) == Some(level);
            let points: Vec<_> =
                places.map(|place| Some(place).filter(own).and_then(node).map(&mut keep)).collect();
            if points.iter().any(Option::is_some) {
                let spacing = grid.spacing.map(|spacing| step as f64 * spacing);
                grids.push(Grid { spacing, points, columns });
            }
        }
        let in_grid = grid.particles().count();
        (in_grid..self.coordinates.len()).for_each(|node| {
            keep(node as u32);
        });

        let number = |node: u32| numbers[node as usize];
        let at = |place: [usize; 2]| node(place).and_then(number);
        let mut cells = Vec::new();
        let all = |nodes: [u32; 3]| nodes.map(|node| number(node).unwrap_or_default());
        let mut rim: Vec<[u32; 3]> = self.rim.iter().map(|&triangle| all(triangle)).collect();
        for block in levels.blocks() {
            let Block { column, row, level } = block;
            let Some(cell) = levels.cell(column, row).map(|own| &self.cells[own.index]) else {
                continue;
            };
            let places = block.corners();
            let corners = places.map(|place| at(place).unwrap_or_default());
            let even = ((column >> level) + (row >> level)).is_multiple_of(2);
            if places.iter().all(|&place| levels.at_point(place) == Some(level)) {
                let parts = (block.side() * block.side()) as f64;
                let quadrants = cell.quadrants.map(|area| parts * area);
                cells.push(Cell { corners, quadrants, even });
            } else {
                let middles = [0, 1, 2, 3].map(|side| {
                    let (from, to) = (places[side], places[(side + 1) % 4]);
                    at([0, 1].map(|k| (from[k] + to[k]) / 2))
                });
                rim.extend(triangulated(corners, middles, even));
            }
        }
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

    /// Returns whether a point is so near a fold that cells keep their size.
    fn is_beside_fold(&self, point: [f64; 2]) -> bool {
        let reach = FOLD_REACH * self.spacing[0].max(self.spacing[1]);
        let is_beside = |fold: &Fold| {
            let LineCoordinates { along, left } = fold.coordinates(point);
            left.abs() < reach && (-reach..fold.length() + reach).contains(&along)
        };
        self.folds.iter().any(is_beside)
    }
}

impl Levels {
    /// Returns the cells of a panel, all of level 0, with their limits.
    fn of(lattice: &Lattice, grid: &Grid, spacing_max: impl Fn([f64; 2]) -> f64) -> Self {
        let [columns, rows] = [grid.columns - 1, grid.points.len() / grid.columns - 1];
        let mut places = vec![0; lattice.coordinates.len()];
        for (point, particle) in grid.points.iter().enumerate() {
            particle.iter().for_each(|&particle| places[particle as usize] = point);
        }
        let quarter = 0.25 * grid.spacing[0] * grid.spacing[1];
        let finest = grid.spacing[0].max(grid.spacing[1]);
        let mut cells = vec![None; columns * rows];
        for (index, cell) in lattice.cells.iter().enumerate() {
            let is_full = |&area: &f64| (area - quarter).abs() <= ROUNDING_ERROR * quarter;
            let allowed = cell.corners.map(|node| spacing_max(lattice.coordinates[node as usize]));
            let ratio = allowed.into_iter().fold(f64::MAX, f64::min) / finest;
            let fits = |level: &u8| ratio >= f64::from(1_u32 << level) * (1.0 - ROUNDING_ERROR);
            let limit = (1..=LEVEL_MAX).take_while(fits).last().unwrap_or(0);
            let beside_fold = || {
                cell.corners
                    .iter()
                    .any(|&node| lattice.is_beside_fold(lattice.coordinates[node as usize]))
            };
            let may = cell.quadrants.iter().all(is_full) && (limit == 0 || !beside_fold());
            let limit = if may { limit } else { 0 };
            let point = places[cell.corners[0] as usize];
            cells[point / grid.columns * columns + point % grid.columns] =
                Some(CellLevel { index, level: 0, limit });
        }
        Self { columns, rows, cells }
    }

    fn cell(&self, column: usize, row: usize) -> Option<CellLevel> {
        let inside = column < self.columns && row < self.rows;
        if inside { self.cells[row * self.columns + column] } else { None }
    }

    /// Returns the level of the node at a point; nothing where a block is that has no node there.
    fn at_point(&self, [column, row]: [usize; 2]) -> Option<u8> {
        let around = [[1, 1], [0, 1], [1, 0], [0, 0]];
        let levels = around.iter().filter_map(|&[left, below]| {
            self.cell(column.checked_sub(left)?, row.checked_sub(below)?).map(|own| own.level)
        });
        let level = levels.min().unwrap_or(0);
        let is_on = |place: usize| place.is_multiple_of(1 << level);
        (is_on(column) && is_on(row)).then_some(level)
    }

    /// Blocks of the panel, row by row.
    fn blocks(&self) -> impl Iterator<Item = Block> {
        let places =
            (0..self.rows).flat_map(|row| (0..self.columns).map(move |column| [column, row]));
        places.filter_map(|[column, row]| {
            let level = self.cell(column, row)?.level;
            let is_on = |place: usize| place.is_multiple_of(1 << level);
            (is_on(column) && is_on(row)).then_some(Block { column, row, level })
        })
    }

    fn set(&mut self, block: Block, level: u8) {
        for [column, row] in block.cells() {
            if let Some(cell) = &mut self.cells[row * self.columns + column] {
                cell.level = level;
            }
        }
    }

    /// Cells of a block and those around it; nothing for one outside of the panel.
    fn around(&self, block: Block) -> impl Iterator<Item = Option<CellLevel>> {
        let side = block.side();
        // Counted from one cell before the block.
        let range = move |first: usize| first..first + side + 2;
        range(block.row).flat_map(move |row| {
            range(block.column)
                .map(move |column| self.cell(column.checked_sub(1)?, row.checked_sub(1)?))
        })
    }

    /// Joins cells, four to one, as far as their limits allow and cells lie all around them.
    fn raise(&mut self) {
        for level in 1..=LEVEL_MAX {
            let side = 1 << level;
            for row in (0..=self.rows.saturating_sub(side)).step_by(side) {
                for column in (0..=self.columns.saturating_sub(side)).step_by(side) {
                    let block = Block { column, row, level };
                    let may = block.cells().all(|[column, row]| {
                        let own = self.cell(column, row);
                        own.is_some_and(|own| own.level + 1 == level && own.limit >= level)
                    });
                    if may && self.around(block).all(|own| own.is_some()) {
                        self.set(block, level);
                    }
                }
            }
        }
    }

    /// Divides blocks until the sides of two that touch differ by a factor of two at most, and each block
    /// has a corner that belongs to no smaller block.
    fn balance(&mut self) {
        loop {
            let divided: Vec<Block> = self
                .blocks()
                .filter(|&block| {
                    let is_small =
                        |own: Option<CellLevel>| own.is_some_and(|own| own.level + 1 < block.level);
                    let is_own = |place| self.at_point(place) == Some(block.level);
                    self.around(block).any(is_small) || !block.corners().into_iter().any(is_own)
                })
                .collect();
            if divided.is_empty() {
                return;
            }
            divided.into_iter().for_each(|block| self.set(block, block.level - 1));
        }
    }
}

/// Returns the triangles of a square with the given corners, anticlockwise, and the nodes in the
/// middles of its sides, where smaller cells have some.
fn triangulated(corners: [u32; 4], middles: [Option<u32>; 4], even: bool) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    let mut polygon = Vec::new();
    for (k, corner) in corners.into_iter().enumerate() {
        match (middles[(k + 3) % 4], middles[k]) {
            (Some(before), Some(after)) => triangles.push([before, corner, after]),
            _ => polygon.push(corner),
        }
        polygon.extend(middles[k]);
    }
    // A fan about a middle, or about a corner where there is none: no three nodes lie on a line.
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
            let bending = BendingConnectors::of(&lattice, &lattice.areas(), true);
            let neighbourhoods = Neighbourhoods::of(&lattice).expect("it has a rim");
            let fits = PanelFits::of(&lattice, &neighbourhoods, &bending);
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
            let triangles = triangulated([0, 1, 2, 3], middles, even);
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
