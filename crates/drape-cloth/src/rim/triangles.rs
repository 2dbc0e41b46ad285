//! Triangles of a rim in batches, and their measures: strains and the sine of the shear angle.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use drape_fabric::{LANES, Lanes};

use crate::kernel::buffers::EDGE_MIN;
use crate::layout::columns::{Columns, VectorLanes, lanes};
use crate::measure::vector::{Vector, add, dot, scale, subtract};
use crate::panel::lattice::Lattice;
use crate::panel::triangle::twice_area;

/// Triangles of a rim, in columns.
#[derive(Debug, Clone)]
pub(crate) struct Triangles {
    /// Particles in rising order.
    pub(crate) corners: Vec<[u32; 3]>,
    /// Weights, in 1/m, of the vectors from the first corner to the second and to the third in the
    /// derivative of the positions along the weft, then along the warp.
    pub(crate) gradients: Columns<4>,
    /// Areas, in m²; zero in the padding.
    pub(crate) areas: Vec<f64>,
    /// Slots of the blocks of the corners 00, 01, 02, 11, 12, 22.
    pub(crate) slots: Vec<[u32; 6]>,
    /// Number of triangles.
    pub(crate) count: usize,
    /// Index of the first triangle among the triangles of the cloth.
    pub(crate) base: usize,
}

impl Triangles {
    /// Lays out the rim of `lattice`, whose first particle is `first`. Its triangles have the index
    /// `base` and later ones in the cloth.
    pub(crate) fn new(lattice: &Lattice, first: u32, base: usize) -> Self {
        let count = lattice.rim.len();
        let length = count.next_multiple_of(LANES);
        let mut gradients = Columns::new(length);
        let mut corners: Vec<[u32; 3]> = lattice.rim.clone();
        corners.iter_mut().for_each(|triangle| triangle.sort_unstable());
        corners.resize(length, corners.last().copied().unwrap_or_default());
        // Sorted corners put every block into the upper half of the matrix.
        for (index, triangle) in corners.iter_mut().enumerate() {
            let [a, b, c] = triangle.map(|node| lattice.coordinates[node as usize]);
            let inverse = 1.0 / twice_area([a, b, c]);
            let [b, c] = [b, c].map(|end| [0, 1].map(|k| (end[k] - a[k]) * inverse));
            gradients.set(index, [c[1], -b[1], -c[0], b[0]]);
            *triangle = triangle.map(|node| first + node);
        }
        let mut areas: Vec<f64> = lattice.rim_areas().collect();
        areas.resize(length, 0.0);
        Self { corners, gradients, areas, slots: Vec::new(), count, base }
    }

    /// Returns the first indices of the batches, multiples of [`LANES`].
    pub(crate) fn batches(&self) -> impl Iterator<Item = usize> + use<> {
        (0..self.areas.len()).step_by(LANES)
    }
}

/// Measures of a batch of triangles.
///
/// The deformation gradient takes the warp to `$p = \sum r_i x_i$` with the material gradient `$r$`
/// along it, and the weft to `$q$` likewise \[VMF09\]. The strains are `$|p| - 1$` and `$|q| - 1$`.
/// The sine belongs to the angle by which `$p$` and `$q$` deviate from a right angle.
pub(crate) struct TriangleMeasures {
    /// Directions of warp and weft.
    pub(crate) units: [VectorLanes; 2],
    /// Inverse lengths of `$p$` and `$q$`.
    pub(crate) inverse: [Lanes; 2],
    /// Strains of warp and weft; zero in the padding.
    pub(crate) strains: [Lanes; 2],
    /// Sines of the shear angles; zero in the padding.
    pub(crate) sines: Lanes,
}

impl TriangleMeasures {
    /// Measures the batch of triangles that begins at `start`, at `positions`.
    #[inline(always)]
    pub(crate) fn new(triangles: &Triangles, start: usize, positions: &[f64]) -> Self {
        let mut sides = [VectorLanes::zero(); 2];
        for (lane, corners) in triangles.corners[start..start + LANES].iter().enumerate() {
            let [a, b, c] = corners.map(|corner| {
                let position = &positions[3 * corner as usize..][..3];
                [position[0], position[1], position[2]]
            });
            sides[0].set(lane, subtract(b, a));
            sides[1].set(lane, subtract(c, a));
        }
        let gradients = triangles.gradients.batch(start);
        let areas = lanes(&triangles.areas, start);
        let mut measures = Self {
            units: [VectorLanes::zero(); 2],
            inverse: [[0.0; LANES]; 2],
            strains: [[0.0; LANES]; 2],
            sines: [0.0; LANES],
        };
        // Lengths and directions of the columns of the deformation gradient.
        for direction in 0..2 {
            let [first, second] = [2, 3].map(|k| gradients.0[k - 2 * direction]);
            for lane in 0..LANES {
                let [b, c] = [0, 1].map(|side| sides[side].vector(lane));
                let image = add(scale(b, first[lane]), scale(c, second[lane]));
                let length = dot(image, image).sqrt();
                // Written so that NaN stays NaN, unlike with `max`.
                let length = if length < EDGE_MIN { EDGE_MIN } else { length };
                let inverse = 1.0 / length;
                measures.inverse[direction][lane] = inverse;
                measures.units[direction].set(lane, scale(image, inverse));
                measures.strains[direction][lane] =
                    if areas[lane] == 0.0 { 0.0 } else { length - 1.0 };
            }
        }
        // Sines of the shear angles.
        for lane in 0..LANES {
            let sine = dot(measures.unit(0, lane), measures.unit(1, lane));
            measures.sines[lane] = if areas[lane] == 0.0 { 0.0 } else { sine };
        }
        measures
    }

    /// Returns the unit vector of the warp (`direction` 0) or the weft in `lane`.
    #[inline(always)]
    pub(crate) fn unit(&self, direction: usize, lane: usize) -> Vector {
        self.units[direction].vector(lane)
    }
}
