//! Interpolation from the particles of a panel to the particles of another grid of the panel.

use crate::error::{Error, check_length};
use crate::panel::lattice::Lattice;
use crate::panel::triangle::twice_area;

/// Limit of the extrapolation: no barycentric coordinate is farther below 0.
const OUTSIDE_MAX: f64 = 0.5;

/// Largest number of bins along a side of the panel, for spacings that do not suit their triangles.
const BINS_MAX: f64 = 2000.0;

/// Interpolation from the particles of a panel to the particles of another grid of the panel. It is
/// linear on the triangles of the first grid.
///
/// ```
/// use drape_cloth::{Interpolation, Lattice};
///
/// let [coarse, fine] = [Lattice::disc(0.1, 0.02)?, Lattice::disc(0.1, 0.007)?];
/// let flat = |lattice: &Lattice| -> Vec<f64> {
///     lattice.coordinates().iter().flat_map(|&[u, v]| [u, 0.5 * v, 1.0]).collect()
/// };
/// let values = Interpolation::new(&coarse, &fine).apply(&flat(&coarse))?;
/// assert!(values.iter().zip(flat(&fine)).all(|(a, b)| (a - b).abs() < 1e-12));
/// # Ok::<(), drape_cloth::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Interpolation {
    /// For each particle, the corners of a triangle and their weights.
    rows: Vec<([u32; 3], [f64; 3])>,
    /// Number of particles of the first grid.
    particles: usize,
}

/// Triangles of a panel in square bins, each triangle in all bins that its bounding box meets.
struct TriangleBins<'a> {
    coordinates: &'a [[f64; 2]],
    triangles: Vec<[u32; 3]>,
    low: [f64; 2],
    size: f64,
    counts: [usize; 2],
    /// Indices of the triangles in each bin. Bins are stored row by row.
    members: Vec<Vec<u32>>,
}

impl Interpolation {
    /// Prepares the interpolation from the grid `from` to the grid `to` of one panel.
    ///
    /// A particle outside all triangles, such as one between a curved edge and its chord, takes
    /// extrapolated values of the nearest triangle.
    #[must_use]
    pub fn new(from: &Lattice, to: &Lattice) -> Self {
        let bins = TriangleBins::new(from);
        let rows = to.coordinates.iter().map(|&point| bins.locate(point)).collect();
        Self { rows, particles: from.coordinates.len() }
    }

    /// Returns the values at the particles of the second grid, three numbers each, from `values` at
    /// the particles of the first.
    ///
    /// # Errors
    /// There are not three `values` for every particle of the first grid.
    pub fn apply(&self, values: &[f64]) -> Result<Vec<f64>, Error> {
        check_length("values", 3 * self.particles, values.len())?;
        let interpolated = self.rows.iter().flat_map(|&(corners, weights)| {
            [0, 1, 2].map(|axis| {
                corners
                    .iter()
                    .zip(weights)
                    .map(|(&corner, weight)| weight * values[3 * corner as usize + axis])
                    .sum::<f64>()
            })
        });
        Ok(interpolated.collect())
    }
}

impl<'a> TriangleBins<'a> {
    /// Sorts the triangles of `lattice` into bins with the size of its spacing.
    fn new(lattice: &'a Lattice) -> Self {
        let coordinates = lattice.coordinates.as_slice();
        let size = lattice.spacing[0].max(lattice.spacing[1]);
        let mut low = coordinates.first().copied().unwrap_or([0.0; 2]);
        let mut high = low;
        for point in coordinates {
            low = [0, 1].map(|axis| low[axis].min(point[axis]));
            high = [0, 1].map(|axis| high[axis].max(point[axis]));
        }
        let extent = (high[0] - low[0]).max(high[1] - low[1]);
        let size = size.max(extent / BINS_MAX);
        let counts = [0, 1].map(|axis| ((high[axis] - low[axis]) / size) as usize + 1);

        // A triangle belongs to all bins between the ends of its bounding box.
        let mut bins = Self {
            coordinates,
            triangles: lattice.triangles(),
            low,
            size,
            counts,
            members: vec![Vec::new(); counts[0] * counts[1]],
        };
        for (index, triangle) in bins.triangles.iter().enumerate() {
            let corners = triangle.map(|corner| bins.coordinates[corner as usize]);
            let ends = [f64::min, f64::max].map(|pick| {
                [0, 1].map(|axis| corners.iter().map(|c| c[axis]).fold(corners[0][axis], pick))
            });
            let [first, last] = ends.map(|point| bins.bin(point));
            for row in first[1]..=last[1] {
                for column in first[0]..=last[0] {
                    bins.members[row * counts[0] + column].push(index as u32);
                }
            }
        }
        bins
    }

    /// Returns the column and the row of the bin that contains `point`, or of the nearest bin.
    fn bin(&self, point: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|axis| {
            let offset = (point[axis] - self.low[axis]) / self.size;
            (offset.max(0.0) as usize).min(self.counts[axis] - 1)
        })
    }

    /// Returns the triangle that contains `point`, or the nearest one, with the weights of its
    /// corners.
    fn locate(&self, point: [f64; 2]) -> ([u32; 3], [f64; 3]) {
        // Bins are searched in square rings around the bin of the point.
        let [column, row] = self.bin(point);
        let mut best: Option<(f64, u32)> = None;
        for ring in 0..self.counts[0].max(self.counts[1]) {
            let range =
                |at: usize, count: usize| at.saturating_sub(ring)..(at + ring + 1).min(count);
            for row in range(row, self.counts[1]) {
                for column in range(column, self.counts[0]) {
                    for &index in &self.members[row * self.counts[0] + column] {
                        let outside = self.distance(point, index);
                        let is_nearer = best.is_none_or(|(least, nearest)| {
                            outside < least || (outside == least && index < nearest)
                        });
                        if is_nearer {
                            best = Some((outside, index));
                        }
                    }
                }
            }
            // A triangle beyond the ring is farther away than the ring's bins are wide.
            if best.is_some_and(|(least, _)| least <= ring as f64 * self.size) {
                break;
            }
        }
        let triangle = best.map_or(0, |(_, index)| index);
        let corners = self.triangles[triangle as usize];
        (corners, limit_extrapolation(self.weights(point, triangle)))
    }

    /// Returns the barycentric coordinates of `point` in the triangle number `triangle`.
    fn weights(&self, point: [f64; 2], triangle: u32) -> [f64; 3] {
        let corners = self.triangles[triangle as usize];
        let [a, b, c] = corners.map(|corner| self.coordinates[corner as usize]);
        let whole = twice_area([a, b, c]);
        [[point, b, c], [a, point, c], [a, b, point]].map(|part| twice_area(part) / whole)
    }

    /// Returns the distance of `point` from the triangle number `triangle`, 0 inside, in m.
    fn distance(&self, point: [f64; 2], triangle: u32) -> f64 {
        if self.weights(point, triangle).iter().all(|&weight| weight >= -1e-12) {
            return 0.0;
        }
        let corners =
            self.triangles[triangle as usize].map(|corner| self.coordinates[corner as usize]);
        [0, 1, 2]
            .map(|k| distance_from_segment(point, corners[k], corners[(k + 1) % 3]))
            .into_iter()
            .fold(f64::INFINITY, f64::min)
    }
}

/// Returns the distance of `point` from the segment from `a` to `b`, in m.
fn distance_from_segment(point: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let along = [b[0] - a[0], b[1] - a[1]];
    let offset = [point[0] - a[0], point[1] - a[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let t = ((offset[0] * along[0] + offset[1] * along[1]) / square).clamp(0.0, 1.0);
    (offset[0] - t * along[0]).hypot(offset[1] - t * along[1])
}

/// Returns barycentric coordinates limited to at least −[`OUTSIDE_MAX`] and divided by their sum.
fn limit_extrapolation(weights: [f64; 3]) -> [f64; 3] {
    let limited = weights.map(|weight| weight.max(-OUTSIDE_MAX));
    let sum: f64 = limited.iter().sum();
    limited.map(|weight| weight / sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_on_a_curved_edge_are_those_of_the_nearest_triangle() {
        let coarse = Lattice::rectangle(0.2, 0.1, 0.05).expect("a panel");
        let mut fine = Lattice::rectangle(0.2, 0.1, 0.01).expect("a panel");
        // A particle beyond the side, and one far from the panel.
        fine.coordinates[0] = [0.05, -0.002];
        fine.coordinates[1] = [-3.0, 0.05];
        let flat: Vec<f64> =
            coarse.coordinates.iter().flat_map(|&[u, v]| [u, v, 2.0 * u - v]).collect();
        let found = Interpolation::new(&coarse, &fine).apply(&flat).expect("all values");
        let expected = [0.05, -0.002, 0.102];
        assert!(found[..3].iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
        let far = &found[3..6];
        assert!(far[0] > -0.1 && (0.0..0.1).contains(&far[1]), "{far:?}");
        assert!(fine.coordinates.len() == 21 * 11 && found.len() == 3 * fine.coordinates.len());
    }

    #[test]
    fn distances_from_a_triangle_are_those_from_its_nearest_side_or_corner() {
        let lattice = Lattice::rectangle(0.1, 0.1, 0.05).expect("a panel");
        let bins = TriangleBins::new(&lattice);
        // The triangle with the corners (0, 0), (0.05, 0) and (0.05, 0.05).
        let corners = [[0.0, 0.0], [0.05, 0.0], [0.05, 0.05]];
        let is_own = |point: &[f64; 2]| {
            corners.iter().any(|c| (c[0] - point[0]).hypot(c[1] - point[1]) < 1e-12)
        };
        let at = |triangle: &[u32; 3]| triangle.map(|node| lattice.coordinates[node as usize]);
        let own = lattice.triangles().iter().position(|triangle| at(triangle).iter().all(is_own));
        let own = own.expect("the cells are halved") as u32;
        for (point, exact) in [
            ([0.04, 0.01], 0.0),
            ([0.02, -0.01], 0.01),
            ([0.06, 0.02], 0.01),
            // The diagonal, whose nearest point is (0.025, 0.025).
            ([0.01, 0.04], 0.03 / 2.0_f64.sqrt()),
            ([-0.03, -0.04], 0.05),
            ([0.09, -0.03], 0.05),
            ([0.08, 0.09], 0.05),
        ] {
            let found = bins.distance(point, own);
            assert!((found - exact).abs() < 1e-15, "{point:?}: {found}, not {exact}");
        }
    }
}
