//! Rectangles, discs and rings, cut from a grid along the yarns.

use crate::error::Error;
use crate::panel::clip::area_within;
use crate::panel::grain::Grain;
use crate::panel::grid::Grid;
use crate::panel::lattice::{Cell, Lattice};

/// Largest number of particles of one panel; more points to a spacing in the wrong unit.
pub(crate) const PARTICLES_MAX: f64 = 4e6;

/// Least part of a cell that must lie inside the outline for the cell to be kept.
///
/// Smaller slivers would be particles of nearly no mass; their area is given to the nearest cell
/// that is kept, so that the total is exact. Larger values make the sides more ragged.
const CELL_PART_MIN: f64 = 0.1;

/// Least part of a cell's area that each of its corners gets.
///
/// Where the outline cuts a quadrant off a cell, its corner would be a particle without mass, or,
/// by rounding, of negative mass. Larger values carry more mass outwards; the cell's area is exact
/// in any case.
const QUADRANT_PART_MIN: f64 = 0.05;

impl Lattice {
    /// Returns a rectangle, `width` along the weft and `height` along the warp, in m.
    ///
    /// # Errors
    /// As for [`Lattice::rectangle_at`].
    pub fn rectangle(width: f64, height: f64, spacing: f64) -> Result<Self, Error> {
        Self::rectangle_at(Grain::default(), [0.0; 2], [width, height], spacing)
    }

    /// Returns a rectangle of a width and a height, in m, with its yarns at an angle; its material
    /// coordinates start from its lower left corner.
    ///
    /// Where the yarns are parallel to its sides, the spacing is stretched a little so that both
    /// sides are multiples of it. Otherwise the cells are those of a grid with a particle at the
    /// material coordinates `grid` from the middle of the rectangle, in m; the sides are ragged by
    /// up to one spacing, and mass and connectors have the exact area of the rectangle in every
    /// cell.
    ///
    /// # Errors
    /// When a length is not positive, or fewer than 3 particles would lie across the rectangle.
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
            return Ok(lattice.of_size(grain, size));
        }
        let (cells, sides) = (grain.exchanged(cells), grain.exchanged(size));
        let spacing = [sides[0] / cells[0], sides[1] / cells[1]];
        let quarter = 0.25 * spacing[0] * spacing[1];
        let start = [0, 1].map(|axis| lowest(&outline, axis));
        let lattice = Self::cut(spacing, start, cells, |_, _| [quarter; 4])?;
        let sides = [cells[0] * spacing[0], cells[1] * spacing[1]];
        Ok(lattice.of_size(grain, grain.exchanged(sides)))
    }

    /// Returns the cells of a grid that lie, at least in part, in a rectangle with the given
    /// corners; `grid` is the point of a particle from its middle.
    fn ragged(outline: &[[f64; 2]; 4], grid: [f64; 2], spacing: f64) -> Result<Self, Error> {
        let middle = [0, 1].map(|axis| 0.5 * (outline[0][axis] + outline[2][axis]));
        let extent = [0, 1].map(|axis| middle[axis] - lowest(outline, axis));
        let half = extent.map(|extent| (extent / spacing + 0.5).ceil());
        let start = [0, 1].map(|axis| middle[axis] + grid[axis] - half[axis] * spacing);
        Self::cut([spacing; 2], start, half.map(|half| 2.0 * half), |column, row| {
            let at = |[u, v]: [f64; 2]| {
                [start[0] + (column + u) * spacing, start[1] + (row + v) * spacing]
            };
            let quadrants = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];
            quadrants.map(|[u, v]| area_within(outline, at([u, v]), at([u + 0.5, v + 0.5])))
        })
    }

    fn of_size(self, grain: Grain, size: [f64; 2]) -> Self {
        Self { grain, middle: size.map(|side| 0.5 * side), size: Some(size), ..self }
    }

    /// Returns a disc of the given radius, in m, with a particle at its centre.
    ///
    /// # Errors
    /// As for [`Lattice::disc_on`].
    pub fn disc(radius: f64, spacing: f64) -> Result<Self, Error> {
        Self::disc_on([0.0; 2], radius, spacing)
    }

    /// Returns a disc of the given radius, in m, cut from a grid with a particle at the point
    /// `grid` from its centre, in m.
    ///
    /// The cells are those of the grid, so the outline is ragged by up to one spacing; mass and
    /// connectors have the exact area of the disc in every cell.
    ///
    /// # Errors
    /// When a length is not positive, or fewer than 3 particles would lie across the disc.
    pub fn disc_on(grid: [f64; 2], radius: f64, spacing: f64) -> Result<Self, Error> {
        check("the radius", radius)?;
        check("the spacing", spacing)?;
        if radius < spacing {
            return Err(Error::Spacing { spacing, size: 2.0 * radius });
        }
        Self::round(grid, [0.0, radius], spacing)
    }

    /// Returns a ring of the given radii, the inner one first, in m, cut from a grid as a
    /// [disc](Lattice::disc_on) is.
    ///
    /// # Errors
    /// When a length is not positive, or fewer than 3 particles would lie across the ring.
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

    /// Returns the cells of a grid that lie, at least in part, between two circles.
    fn round(grid: [f64; 2], [hole, radius]: [f64; 2], spacing: f64) -> Result<Self, Error> {
        let grid = on_grid(grid, spacing)?;
        let half = (radius / spacing + 0.5).ceil();
        let start = grid.map(|x| x - half * spacing);
        let area = |u0: f64, v0: f64, u1: f64, v1: f64| {
            let corner =
                |u: f64, v: f64| disc_corner_area(radius, u, v) - disc_corner_area(hole, u, v);
            corner(u1, v1) - corner(u0, v1) - corner(u1, v0) + corner(u0, v0)
        };
        Self::cut([spacing; 2], start, [2.0 * half; 2], |column, row| {
            let at = |axis: usize, index: f64| start[axis] + index * spacing;
            let (u0, um, u1) = (at(0, column), at(0, column + 0.5), at(0, column + 1.0));
            let (v0, vm, v1) = (at(1, row), at(1, row + 0.5), at(1, row + 1.0));
            [area(u0, v0, um, vm), area(um, v0, u1, vm), area(um, vm, u1, v1), area(u0, vm, um, v1)]
        })
    }

    /// Returns the panel with its yarns at an angle in its own frame, for discs and rings.
    #[must_use]
    pub fn with_grain(self, grain: Grain) -> Self {
        Self { grain, ..self }
    }

    /// Cuts a grid of cells; `quadrants` returns the areas of the four quadrants of a cell for its
    /// column and row.
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
        let [across, along] = cells.map(|n| n as usize);
        let columns = across + 1;
        let full = spacing[0] * spacing[1];
        let mut kept = Vec::new();
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
        for (column, row, areas) in slivers {
            let distance = |&(c, r, _): &(usize, usize, [f64; 4])| {
                c.abs_diff(column).pow(2) + r.abs_diff(row).pow(2)
            };
            let nearest = (0..kept.len()).min_by_key(|&k| distance(&kept[k]));
            if let Some(nearest) = nearest {
                kept[nearest].2.iter_mut().zip(areas).for_each(|(a, sliver)| *a += sliver);
            }
        }

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
            let place = |axis: usize, index: usize| start[axis] + index as f64 * spacing[axis];
            coordinates.push([place(0, point % columns), place(1, point / columns)]);
        }
        let cells = kept
            .into_iter()
            .map(|(column, row, areas)| (column, row, levelled(areas)))
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

/// Returns the areas of the quadrants of a cell with none below [`QUADRANT_PART_MIN`] of the cell,
/// and the same sum.
fn levelled(areas: [f64; 4]) -> [f64; 4] {
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

/// Returns the point of the particle nearest to the origin of a grid.
fn on_grid(grid: [f64; 2], spacing: f64) -> Result<[f64; 2], Error> {
    let grid = grid.map(|x| x - spacing * (x / spacing).round());
    let lost = grid.into_iter().find(|x| !x.is_finite());
    lost.map_or(Ok(grid), |value| Err(Error::Length { what: "the place of the grid", value }))
}

fn lowest(outline: &[[f64; 2]; 4], axis: usize) -> f64 {
    outline.iter().map(|corner| corner[axis]).fold(f64::INFINITY, f64::min)
}

fn check(what: &'static str, value: f64) -> Result<(), Error> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(Error::Length { what, value }) }
}

/// Returns the signed area of the disc about the origin in the rectangle with the corners (0, 0)
/// and (u, v).
fn disc_corner_area(radius: f64, u: f64, v: f64) -> f64 {
    let (a, b) = (u.abs().min(radius), v.abs().min(radius));
    // Near the circle the arc sine would lose half of the digits.
    let chord = |x: f64| ((radius - x) * (radius + x)).max(0.0).sqrt();
    let segment = |x: f64| 0.5 * (x * chord(x) + radius * radius * x.atan2(chord(x)));
    let meets = chord(b);
    let area = if a <= meets { a * b } else { b * meets + segment(a) - segment(meets) };
    area * u.signum() * v.signum()
}

#[cfg(test)]
mod tests {
    use super::*;

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
