//! Rectangles, discs and rings, cut from a grid along the yarns.

use crate::error::Error;
use crate::panel::clip::area_within;
use crate::panel::grain::Grain;
use crate::panel::grid::Grid;
use crate::panel::lattice::{Cell, Lattice};

/// Largest number of particles of one panel. More particles point to a spacing in the wrong unit.
pub(crate) const PARTICLES_MAX: f64 = 4e6;

/// Least fraction of a cell that must lie inside the outline for the cell to be kept.
///
/// Smaller slivers would be particles of nearly no mass. Their area goes to the nearest cell that
/// is kept, so the total is exact. Larger values make the sides more ragged.
const CELL_PART_MIN: f64 = 0.1;

/// Least fraction of a cell's area that each of its corners gets.
///
/// Where the outline cuts a quadrant off a cell, its corner would be a particle without mass or, by
/// rounding, of negative mass. Larger values carry more mass outwards. The cell's area is exact in
/// any case.
const QUADRANT_PART_MIN: f64 = 0.05;

/// Numbers of the kept cells of a grid, row by row; `None` for a cell that is not kept.
struct KeptCells {
    /// Number of cells in a row.
    across: usize,
    numbers: Vec<Option<usize>>,
}

impl KeptCells {
    /// Returns the kept cell that is nearest to the cell in `column` and `row`. Of several, it is
    /// the one with the lowest number.
    fn nearest(&self, column: usize, row: usize) -> Option<usize> {
        let along = self.numbers.len() / self.across.max(1);
        let mut best: Option<(usize, usize)> = None;
        // Square rings around the cell. A cell of the next ring is no nearer than its number.
        for ring in 0..self.across.max(along) {
            if best.is_some_and(|(square, _)| square < ring * ring) {
                break;
            }
            for r in row.saturating_sub(ring)..(row + ring + 1).min(along) {
                let is_side = r.abs_diff(row) == ring;
                let step = if is_side || ring == 0 { 1 } else { 2 * ring };
                let first = (column as isize) - ring as isize;
                let columns = (first..=(column + ring) as isize).step_by(step);
                for c in columns.filter_map(|c| usize::try_from(c).ok()) {
                    if c >= self.across {
                        continue;
                    }
                    let Some(number) = self.numbers[r * self.across + c] else { continue };
                    let square = c.abs_diff(column).pow(2) + r.abs_diff(row).pow(2);
                    if best.is_none_or(|best| (square, number) < best) {
                        best = Some((square, number));
                    }
                }
            }
        }
        best.map(|(_, number)| number)
    }
}

impl Lattice {
    /// Returns a rectangle of `width` along the weft and `height` along the warp, with particles at
    /// the distance `spacing`, all in m.
    ///
    /// # Errors
    /// As for [`Lattice::rectangle_at`].
    pub fn rectangle(width: f64, height: f64, spacing: f64) -> Result<Self, Error> {
        Self::rectangle_at(Grain::default(), [0.0; 2], [width, height], spacing)
    }

    /// Returns a rectangle with the width and height `size`, in m, with its yarns at the angle of
    /// `grain`. Its material coordinates start from its lower left corner.
    ///
    /// Where the yarns are parallel to its sides, `spacing` is stretched a little so that both
    /// sides are multiples of it. Otherwise the cells belong to a grid with a particle at the
    /// material coordinates `grid` from the middle of the rectangle, in m. The sides are then
    /// ragged by up to one spacing, and mass and connectors have the exact area of the rectangle in
    /// every cell.
    ///
    /// # Errors
    /// A length is not positive, or fewer than 3 particles would lie across the rectangle.
    pub fn rectangle_at(
        grain: Grain,
        grid: [f64; 2],
        size: [f64; 2],
        spacing: f64,
    ) -> Result<Self, Error> {
        let [width, height] = size;
        check("the width", width)?;
        check("the height", height)?;
        check("the spacing", spacing)?;
        let cells = size.map(|side| (side / spacing).round());
        if cells.iter().any(|cells| *cells < 2.0) {
            return Err(Error::Spacing { spacing, size: width.min(height) });
        }

        let corners = [[0.0, 0.0], [width, 0.0], size, [0.0, height]];
        let outline = corners.map(|corner| grain.to_material(corner));
        if !grain.is_straight() {
            let lattice = Self::ragged(&outline, on_grid(grid, spacing)?, spacing)?;
            return Ok(lattice.with_size(grain, size));
        }

        // Yarns parallel to the sides: the grid is stretched to fit.
        let (cells, sides) = (grain.exchanged(cells), grain.exchanged(size));
        let spacing = [sides[0] / cells[0], sides[1] / cells[1]];
        let quarter = 0.25 * spacing[0] * spacing[1];
        let start = [0, 1].map(|axis| lowest(&outline, axis));
        let lattice = Self::cut(spacing, start, cells, |_, _| [quarter; 4])?;
        let sides = [cells[0] * spacing[0], cells[1] * spacing[1]];
        Ok(lattice.with_size(grain, grain.exchanged(sides)))
    }

    /// Returns the cells of a grid that lie, at least in part, in the rectangle with the corners
    /// `outline`. `grid` is the position of a particle from the middle of the rectangle, in m.
    fn ragged(outline: &[[f64; 2]; 4], grid: [f64; 2], spacing: f64) -> Result<Self, Error> {
        let middle = [0, 1].map(|axis| 0.5 * (outline[0][axis] + outline[2][axis]));
        let extent = [0, 1].map(|axis| middle[axis] - lowest(outline, axis));
        let half = extent.map(|extent| (extent / spacing + 0.5).ceil());
        let start = [0, 1].map(|axis| middle[axis] + grid[axis] - half[axis] * spacing);
        Self::cut([spacing; 2], start, half.map(|half| 2.0 * half), |column, row| {
            [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]].map(|quadrant| {
                let [low, high] = [0.0, 0.5].map(|extent| {
                    let [u, v] = quadrant.map(|offset| offset + extent);
                    [start[0] + (column + u) * spacing, start[1] + (row + v) * spacing]
                });
                area_within(outline, low, high)
            })
        })
    }

    /// Returns the panel as a rectangle with the sides `size` along `grain`'s frame, in m.
    fn with_size(self, grain: Grain, size: [f64; 2]) -> Self {
        Self { grain, middle: size.map(|side| 0.5 * side), size: Some(size), ..self }
    }

    /// Returns a disc of `radius`, in m, with a particle at its centre.
    ///
    /// # Errors
    /// As for [`Lattice::disc_on`].
    pub fn disc(radius: f64, spacing: f64) -> Result<Self, Error> {
        Self::disc_on([0.0; 2], radius, spacing)
    }

    /// Returns a disc of `radius`, in m, cut from a grid with a particle at the point `grid` from
    /// its centre, in m.
    ///
    /// The outline follows the cells of the grid, so it is ragged by up to one spacing. Mass and
    /// connectors have the exact area of the disc in every cell.
    ///
    /// # Errors
    /// A length is not positive, or fewer than 3 particles would lie across the disc.
    pub fn disc_on(grid: [f64; 2], radius: f64, spacing: f64) -> Result<Self, Error> {
        check("the radius", radius)?;
        check("the spacing", spacing)?;
        if radius < spacing {
            return Err(Error::Spacing { spacing, size: 2.0 * radius });
        }
        Self::round(grid, [0.0, radius], spacing)
    }

    /// Returns a ring with the inner and outer `radii`, in m, cut from a grid like a
    /// [disc](Lattice::disc_on).
    ///
    /// # Errors
    /// A length is not positive, or fewer than 3 particles would lie across the ring.
    pub fn ring_on(grid: [f64; 2], radii: [f64; 2], spacing: f64) -> Result<Self, Error> {
        let [hole, radius] = radii;
        check("the radius of the hole", hole)?;
        check("the radius", radius)?;
        check("the spacing", spacing)?;
        if radius - hole < 2.0 * spacing {
            return Err(Error::Spacing { spacing, size: radius - hole });
        }
        Self::round(grid, radii, spacing)
    }

    /// Returns the cells of a grid that lie, at least in part, between the circles of radius `hole`
    /// and `radius`.
    fn round(grid: [f64; 2], [hole, radius]: [f64; 2], spacing: f64) -> Result<Self, Error> {
        let grid = on_grid(grid, spacing)?;
        let half = (radius / spacing + 0.5).ceil();
        let start = grid.map(|x| x - half * spacing);
        Self::cut([spacing; 2], start, [2.0 * half; 2], |column, row| {
            let [u0, um, u1] = [0.0, 0.5, 1.0].map(|k| start[0] + (column + k) * spacing);
            let [v0, vm, v1] = [0.0, 0.5, 1.0].map(|k| start[1] + (row + k) * spacing);
            [[u0, v0, um, vm], [um, v0, u1, vm], [um, vm, u1, v1], [u0, vm, um, v1]]
                .map(|corners| ring_area([hole, radius], corners))
        })
    }

    /// Returns the panel with its yarns at the angle of `grain` in its frame, for discs and rings.
    #[must_use]
    pub fn with_grain(self, grain: Grain) -> Self {
        Self { grain, ..self }
    }

    /// Cuts a grid of `cells`, their numbers along both yarns, from the point `start` on.
    /// `quadrants` returns the areas of the four quadrants of a cell for its column and row, in m².
    fn cut(
        spacing: [f64; 2],
        start: [f64; 2],
        cells: [f64; 2],
        quadrants: impl Fn(f64, f64) -> [f64; 4],
    ) -> Result<Self, Error> {
        let particles = (cells[0] + 1.0) * (cells[1] + 1.0);
        if particles > PARTICLES_MAX {
            let spacing = spacing[0].min(spacing[1]);
            return Err(Error::TooMany { spacing, particles, limit: PARTICLES_MAX });
        }

        // Cells that lie inside only by a sliver give their area to the nearest kept cell.
        let [across, along] = cells.map(|n| n as usize);
        let columns = across + 1;
        let full = spacing[0] * spacing[1];
        let mut kept: Vec<(usize, usize, [f64; 4])> = Vec::new();
        let mut slivers = Vec::new();
        for row in 0..along {
            for column in 0..across {
                let areas = quadrants(column as f64, row as f64);
                let area: f64 = areas.iter().sum();
                if area >= CELL_PART_MIN * full {
                    kept.push((column, row, areas));
                } else if area > 0.0 {
                    slivers.push((column, row, areas));
                }
            }
        }
        let mut numbers = vec![None; across * along];
        for (number, (column, row, _)) in kept.iter().enumerate() {
            numbers[row * across + column] = Some(number);
        }
        let cells = KeptCells { across, numbers };
        for (column, row, areas) in slivers {
            if let Some(nearest) = cells.nearest(column, row) {
                kept[nearest].2.iter_mut().zip(areas).for_each(|(a, sliver)| *a += sliver);
            }
        }

        // Particles are the grid points at the corners of kept cells.
        let mut used = vec![false; columns * (along + 1)];
        let corners = |column: usize, row: usize| {
            let first = row * columns + column;
            [first, first + 1, first + columns + 1, first + columns]
        };
        for &(column, row, _) in &kept {
            for point in corners(column, row) {
                used[point] = true;
            }
        }
        let mut coordinates = Vec::new();
        let mut grid = vec![None; used.len()];
        for point in (0..used.len()).filter(|&point| used[point]) {
            grid[point] = Some(coordinates.len() as u32);
            let index = [point % columns, point / columns];
            coordinates.push([0, 1].map(|axis| start[axis] + index[axis] as f64 * spacing[axis]));
        }

        let cells = kept
            .into_iter()
            .map(|(column, row, areas)| (column, row, with_least_quadrants(areas)))
            .map(|(column, row, quadrants)| Cell {
                corners: corners(column, row)
                    .map(|point| grid[point].expect("the corners of kept cells are particles")),
                quadrants,
                even: (column + row) % 2 == 0,
            })
            .collect();
        Ok(Self {
            spacing,
            coordinates,
            grain: Grain::default(),
            middle: [0.0; 2],
            size: None,
            cells,
            rim: Vec::new(),
            folds: Vec::new(),
            allowances: Vec::new(),
            grids: vec![Grid { spacing, points: grid, columns }],
        })
    }
}

/// Returns `areas`, the quadrants of a cell, with none below [`QUADRANT_PART_MIN`] of the cell and
/// with an unchanged sum.
fn with_least_quadrants(areas: [f64; 4]) -> [f64; 4] {
    let whole: f64 = areas.iter().sum();
    let least = QUADRANT_PART_MIN * whole;
    let [lacking, above] = areas.iter().fold([0.0, 0.0], |[lacking, above], area| {
        [lacking + (least - area).max(0.0), above + (area - least).max(0.0)]
    });
    areas.map(
        |area| {
            if area < least { least } else { least + (area - least) * (1.0 - lacking / above) }
        },
    )
}

/// Returns the position of the particle nearest to the origin of a grid with a particle at `grid`.
fn on_grid(grid: [f64; 2], spacing: f64) -> Result<[f64; 2], Error> {
    let grid = grid.map(|x| x - spacing * (x / spacing).round());
    let not_finite = grid.into_iter().find(|x| !x.is_finite());
    not_finite.map_or(Ok(grid), |value| Err(Error::Length { what: "the place of the grid", value }))
}

fn lowest(outline: &[[f64; 2]; 4], axis: usize) -> f64 {
    outline.iter().map(|corner| corner[axis]).fold(f64::INFINITY, f64::min)
}

fn check(what: &'static str, value: f64) -> Result<(), Error> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(Error::Length { what, value }) }
}

/// Returns the area of the ring between the radii `hole` and `radius` about the origin, within the
/// rectangle from (`u0`, `v0`) to (`u1`, `v1`).
fn ring_area([hole, radius]: [f64; 2], [u0, v0, u1, v1]: [f64; 4]) -> f64 {
    let corner = |u: f64, v: f64| disc_corner_area(radius, u, v) - disc_corner_area(hole, u, v);
    corner(u1, v1) - corner(u0, v1) - corner(u1, v0) + corner(u0, v0)
}

/// Returns the signed area of the disc of `radius` about the origin within the rectangle from (0,
/// 0) to (`u`, `v`).
fn disc_corner_area(radius: f64, u: f64, v: f64) -> f64 {
    let (a, b) = (u.abs().min(radius), v.abs().min(radius));
    let meets = half_chord(radius, b);
    let area = if a <= meets {
        a * b
    } else {
        b * meets + half_segment(radius, a) - half_segment(radius, meets)
    };
    area * u.signum() * v.signum()
}

/// Returns half of the chord of a circle of `radius` at the distance `x` from its centre.
///
/// Near the circle an arc sine would lose half of the digits.
fn half_chord(radius: f64, x: f64) -> f64 {
    ((radius - x) * (radius + x)).max(0.0).sqrt()
}

/// Returns the area under a circle of `radius` about the origin between 0 and `x`.
fn half_segment(radius: f64, x: f64) -> f64 {
    0.5 * (x * half_chord(radius, x) + radius * radius * x.atan2(half_chord(radius, x)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_kept_cell_is_the_one_that_a_search_of_all_finds() {
        let (across, along) = (9, 7);
        for pattern in 1..60_u32 {
            let mut kept = Vec::new();
            let mut numbers = vec![None; across * along];
            for (cell, number) in numbers.iter_mut().enumerate() {
                // Few cells, scattered in another way for each pattern.
                if (cell as u32 * 7919 + pattern * 104_729) % 11 < pattern % 4 {
                    *number = Some(kept.len());
                    kept.push([cell % across, cell / across]);
                }
            }
            let cells = KeptCells { across, numbers };
            for cell in 0..across * along {
                let [column, row] = [cell % across, cell / across];
                let nearest = (0..kept.len()).min_by_key(|&k| {
                    kept[k][0].abs_diff(column).pow(2) + kept[k][1].abs_diff(row).pow(2)
                });
                assert_eq!(cells.nearest(column, row), nearest, "{pattern}: {column}, {row}");
            }
        }
    }

    #[test]
    fn a_rectangle_is_a_pure_grid_of_its_own_area() {
        let lattice = Lattice::rectangle(1.0, 0.6, 0.021).expect("a rectangle");
        assert_eq!(lattice.coordinates.len(), 49 * 30);
        assert_eq!(lattice.triangles().len(), 2 * 48 * 29);
        assert!((lattice.area() - 0.6).abs() < 1e-12);
        assert!((lattice.coordinates[49 * 30 - 1][1] - 0.6).abs() < 1e-15);
    }

    #[test]
    fn a_ring_has_its_own_area_and_no_particle_well_inside_its_hole() {
        for (grid, spacing) in [([0.0; 2], 0.03), ([0.004, -0.003], 0.01), ([0.0; 2], 0.007)] {
            let lattice = Lattice::ring_on(grid, [0.08, 0.15], spacing).expect("a ring");
            let exact = std::f64::consts::PI * (0.15 * 0.15 - 0.08 * 0.08);
            let area = lattice.area();
            assert!((area / exact - 1.0).abs() < 1e-12, "{spacing}: {area} against {exact}");
            let innermost = lattice.coordinates.iter().map(|[u, v]| u.hypot(*v));
            let innermost = innermost.fold(f64::INFINITY, f64::min);
            assert!((0.08 - 1.5 * spacing..0.08).contains(&innermost), "{spacing}: {innermost}");
        }
        for radii in [[0.0, 0.1], [0.1, 0.1], [0.2, 0.1], [0.09, 0.1], [f64::NAN, 0.1]] {
            assert!(Lattice::ring_on([0.0; 2], radii, 0.01).is_err(), "{radii:?}");
        }
    }

    #[test]
    fn a_disc_has_its_own_area_at_every_spacing() {
        for spacing in [0.1, 0.03, 0.01, 0.007] {
            let lattice = Lattice::disc(0.15, spacing).expect("a disc");
            let exact = std::f64::consts::PI * 0.15 * 0.15;
            let area = lattice.area();
            assert!((area / exact - 1.0).abs() < 1e-12, "{spacing}: {area} against {exact}");
            let quadrants = lattice.cells.iter().flat_map(|c| c.quadrants);
            assert!(quadrants.into_iter().all(|q| q >= -1e-15));
        }
    }

    #[test]
    fn no_particle_of_a_disc_is_without_area() {
        for (tenths, hundredths) in (5..30).flat_map(|r| [50, 77, 100].map(|h| (r, h))) {
            let (radius, spacing) = (0.01 * f64::from(tenths), 1e-4 * f64::from(hundredths));
            let lattice = Lattice::disc(radius, spacing).expect("a disc");
            let mut areas = vec![0.0; lattice.coordinates.len()];
            for cell in &lattice.cells {
                for (corner, quadrant) in cell.corners.iter().zip(cell.quadrants) {
                    areas[*corner as usize] += quadrant;
                }
            }
            let least = areas.iter().fold(f64::INFINITY, |least, area| least.min(*area));
            let part = least / (spacing * spacing);
            assert!(part > 0.004, "{part} of a cell for radius {radius}, spacing {spacing}");
        }
    }

    #[test]
    fn sizes_that_make_no_panel_are_refused() {
        assert!(matches!(Lattice::rectangle(-1.0, 1.0, 0.1), Err(Error::Length { .. })));
        assert!(matches!(Lattice::rectangle(1.0, 1.0, f64::NAN), Err(Error::Length { .. })));
        assert!(matches!(Lattice::rectangle(1.0, 1.0, 3.0), Err(Error::Spacing { .. })));
        assert!(matches!(Lattice::rectangle(1.0, 1.0, 1e-5), Err(Error::TooMany { .. })));
        assert!(matches!(Lattice::disc(0.1, 0.2), Err(Error::Spacing { .. })));
    }

    #[test]
    fn slivers_of_a_disc_stay_in_their_quarter() {
        for (radius, spacing) in [(0.15, 0.03), (0.15, 0.01), (0.1, 0.007), (0.21, 0.02)] {
            let lattice = Lattice::disc(radius, spacing).expect("a disc");
            let mut quarters = [0.0; 4];
            for cell in &lattice.cells {
                // The middle of the disc is a particle, so that each cell is in one quarter.
                let [u, v] =
                    lattice.coordinates[cell.corners[0] as usize].map(|x| x > -0.5 * spacing);
                quarters[2 * usize::from(u) + usize::from(v)] += cell.quadrants.iter().sum::<f64>();
            }
            let exact = 0.25 * std::f64::consts::PI * radius * radius;
            for area in quarters {
                assert!((area / exact - 1.0).abs() < 1e-12, "{radius}, {spacing}: {quarters:?}");
            }
        }
    }
}
