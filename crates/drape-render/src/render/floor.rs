//! Floor: a level plane that shows only shadows, on the ground of the picture.
//!
//! The light of the sky is known on a grid that is finer in the middle. The shadow of the key light
//! on a plane is a separate picture: the shapes are projected along the light and blurred, since
//! the lamp has a size.

use super::tessellation::{Part, Tessellation, Vertex};
use super::triangle::PlaneTriangle;
use super::vector::{Bounds, Vector};

/// Number of cells of the grid along each side.
const CELLS: usize = 56;

/// Half of the side of the floor, over the radius of the scene.
const HALF_SIDE: f64 = 2.2;

/// Size of the cells in the middle, over their mean size.
const MIDDLE: f64 = 0.3;

/// Number of texels of the shadow along the radius of the scene.
const TEXELS: f64 = 200.0;
/// Width of the blur of the shadow, in texels.
const BLUR: usize = 5;
/// Number of times that the shadow is blurred.
const BLURS: usize = 3;

/// Level plane below a scene.
pub(crate) struct Floor {
    height: f64,
    /// Centre of the scene, along x and z.
    center: [f64; 2],
    radius: f64,
}

impl Floor {
    /// Returns the floor at a `height` below a scene with `bounds`.
    pub(crate) fn new(height: f64, bounds: Bounds) -> Floor {
        let Bounds { center: [x, _, z], radius } = bounds;
        Floor { height, center: [x, z], radius }
    }

    /// Returns the points of the grid, row by row, each as [`Vector`].
    pub(crate) fn points(&self) -> Vec<Vector> {
        let place = |k: usize| {
            let part = 2.0 * k as f64 / CELLS as f64 - 1.0;
            HALF_SIDE * self.radius * part * (MIDDLE + (1.0 - MIDDLE) * part.abs())
        };
        let [x, z] = self.center;
        let point = |j: usize, i: usize| [x + place(i), self.height, z + place(j)];
        (0..=CELLS)
            .flat_map(|j| (0..=CELLS).map(move |i| (j, i)))
            .map(|(j, i)| point(j, i))
            .collect()
    }

    /// Returns the point of the floor, along x and z, that a ray meets which starts at `from` in a
    /// `direction`. Returns `None` for a ray from below.
    pub(crate) fn met(&self, from: Vector, direction: Vector) -> Option<[f64; 2]> {
        let distance = (self.height - from[1]) / direction[1];
        // Seen from below the floor would hide the scene.
        let is_seen = direction[1] < 0.0 && distance > 0.0;
        is_seen.then(|| [0, 2].map(|k| from[k] + distance * direction[k]))
    }

    /// Returns the distance of the point `x`, `z` from the middle: 0 in the middle, 1 where the
    /// floor ends.
    pub(crate) fn away(&self, [x, z]: [f64; 2]) -> f64 {
        (x - self.center[0]).hypot(z - self.center[1]) / (HALF_SIDE * self.radius)
    }

    /// Returns the value at a `point` of the floor, interpolated between the values of `grid`.
    pub(crate) fn value(&self, grid: &[f32], point: [f64; 2]) -> f64 {
        let place = |k: usize| {
            let part = (point[k] - self.center[k]) / (HALF_SIDE * self.radius);
            let (size, bend) = (part.abs(), 1.0 - MIDDLE);
            let root = ((MIDDLE * MIDDLE + 4.0 * bend * size).sqrt() - MIDDLE) / (2.0 * bend);
            0.5 * CELLS as f64 * (1.0 + root.copysign(part))
        };
        bilinear([place(0), place(1)], [CELLS + 1; 2], |column, row| {
            grid[row * (CELLS + 1) + column]
        })
    }
}

/// Shadow of the key light on a floor.
pub(crate) struct FloorShadow {
    /// Position of the first texel, along x and z, in m.
    origin: [f64; 2],
    texel: f64,
    columns: usize,
    rows: usize,
    /// Shadow at each texel, 0 to 1.
    shade: Vec<f32>,
}

impl FloorShadow {
    /// Returns the shadow of a `scene` on a `floor` in the light from a `direction`.
    pub(crate) fn new(floor: &Floor, scene: &Tessellation, direction: Vector) -> FloorShadow {
        let texel = (floor.radius / TEXELS).max(f64::MIN_POSITIVE);
        let fall = |vertex: &Vertex| {
            let [x, y, z] = vertex.position;
            let drop = (y - floor.height) / direction[1];
            [x - drop * direction[0], z - drop * direction[2]]
        };

        let limit = HALF_SIDE * floor.radius;
        let places: Vec<[f64; 2]> = scene.vertices.iter().map(fall).collect();
        let margin = (BLURS * BLUR / 2 + 1) as f64 * texel;
        let extreme = |k: usize, start: f64, choose: fn(f64, f64) -> f64| {
            let most = places.iter().map(|place| place[k]).fold(start, choose);
            most.clamp(floor.center[k] - limit, floor.center[k] + limit)
        };
        let low = [0, 1].map(|k| extreme(k, f64::MAX, f64::min) - margin);
        let high = [0, 1].map(|k| extreme(k, f64::MIN, f64::max) + margin);
        let count = |k: usize| (((high[k] - low[k]) / texel).ceil() as usize).clamp(1, 4096);
        let (columns, rows) = (count(0), count(1));

        let mut shade = vec![0.0; columns * rows];
        for facet in scene.facets.iter().filter(|facet| !matches!(facet.part, Part::Rim(_))) {
            let corners = facet.corners.map(|corner| places[corner as usize]);
            let corners = corners.map(|place| [0, 1].map(|k| (place[k] - low[k]) / texel));
            let Some(triangle) = PlaneTriangle::new(corners) else { continue };
            triangle.spans(columns, triangle.rows(rows), |span| {
                shade[span.row * columns..][span.columns].fill(1.0);
            });
        }

        // Repeated box filters approximate a Gaussian filter.
        for _ in 0..BLURS {
            shade = blurred_across(&shade, columns, rows);
            shade = blurred_across(&shade, rows, columns);
        }
        FloorShadow { origin: low, texel, columns, rows, shade }
    }

    /// Returns the shadow at a `point` of the floor, 0 to 1.
    pub(crate) fn at(&self, point: [f64; 2]) -> f64 {
        let place = [0, 1].map(|k| (point[k] - self.origin[k]) / self.texel - 0.5);
        let (columns, rows) = (self.columns, self.rows);
        let ends = [columns as f64, rows as f64];
        // The shadow ends at the border of its texels.
        if !(0..2).all(|k| place[k] >= 0.0 && place[k] <= ends[k] - 1.0) {
            return 0.0;
        }
        bilinear(place, [columns, rows], |column, row| self.shade[row * columns + column])
    }
}

/// Returns a `table` of rows in which each value is the mean over [`BLUR`] cells of its row. The
/// result is transposed.
fn blurred_across(table: &[f32], columns: usize, rows: usize) -> Vec<f32> {
    let half = BLUR / 2;
    let mut blurred = vec![0.0; table.len()];
    for (number, row) in table.chunks_exact(columns).enumerate() {
        let mut sum: f32 = row[..half.min(columns)].iter().sum();
        for column in 0..columns {
            sum += row.get(column + half).unwrap_or(&0.0);
            blurred[column * rows + number] = sum / BLUR as f32;
            sum -= column.checked_sub(half).map_or(0.0, |before| row[before]);
        }
    }
    blurred
}

/// Returns the value at a `place` between the entries of a table with `counts` columns and rows.
/// Beyond the ends the entry at the end counts.
fn bilinear(place: [f64; 2], counts: [usize; 2], value: impl Fn(usize, usize) -> f32) -> f64 {
    let cell = |k: usize| {
        let last = counts[k] - 1;
        let at = place[k].clamp(0.0, last as f64);
        let whole = (at as usize).min(last.saturating_sub(1));
        (whole, (whole + 1).min(last), at - whole as f64)
    };
    let ((left, right, x), (above, below, y)) = (cell(0), cell(1));
    let along =
        |row: usize| (1.0 - x) * f64::from(value(left, row)) + x * f64::from(value(right, row));
    (1.0 - y) * along(above) + y * along(below)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::tessellation::samples::{Disc, scene};

    #[test]
    fn a_value_comes_back_at_the_points_of_the_grid_and_between_them() {
        let floor = Floor::new(0.5, Bounds { center: [1.0, 2.0, -1.0], radius: 0.7 });
        let points = floor.points();
        // Linear in x and z, so that interpolation is exact.
        let linear = |[x, z]: [f64; 2]| 0.3 * x - 0.2 * z;
        let grid: Vec<f32> = points.iter().map(|p| linear([p[0], p[2]]) as f32).collect();
        for place in points.iter().map(|p| [p[0], p[2]]).chain([[1.0, -1.0], [0.83, -0.9]]) {
            let miss = (floor.value(&grid, place) - linear(place)).abs();
            assert!(miss < 3e-4, "{miss} at {place:?}");
        }
        let end = HALF_SIDE * 0.7;
        assert_eq!(floor.away([1.0, -1.0]), 0.0);
        assert!((floor.away([1.0 + 0.6 * end, -1.0 - 0.8 * end]) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_shadow_of_a_disc_is_a_disc_with_a_smooth_edge() {
        let disc = Disc { radius: 0.5, height: 1.0, pieces: 200 };
        let scene = scene(&[disc], [0.0, 0.5, 0.0], 0.75);
        let floor = Floor::new(0.0, scene.bounds);
        let shadow = FloorShadow::new(&floor, &scene, [0.6, 0.8, 0.0]);
        // The light from +x throws it by 0.75 to −x.
        for (x, expected) in [(-0.75, 1.0), (-0.22, 0.0), (-0.28, 1.0), (-1.22, 1.0), (-1.28, 0.0)]
        {
            let shade = shadow.at([x, 0.0]);
            assert!((shade - expected).abs() < 1e-3, "{shade} at {x}");
        }
        let shades: Vec<f64> =
            (0..400).map(|k| shadow.at([-0.28 + 1.5e-4 * f64::from(k), 0.03])).collect();
        let steps = shades.windows(2).map(|pair| pair[0] - pair[1]);
        assert!(steps.clone().all(|step| (-1e-6..0.02).contains(&step)), "{shades:?}");
        assert_eq!(floor.met([0.0, 1.0, 0.0], [0.0, -1.0, 0.5]), Some([0.0, 0.5]));
        assert_eq!(floor.met([0.0, -1.0, 0.0], [0.0, -1.0, 0.5]), None);
    }
}
