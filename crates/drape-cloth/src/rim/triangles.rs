#![allow(clippy::needless_range_loop, reason = "a lane is a place in many arrays")]

use drape_fabric::{LANES, Lanes};

use crate::field::{Vector, add, dot, lanes, scale, set, subtract};
use crate::rim::Triangles;
use crate::scratch::EDGE_MIN;

/// How a batch of triangles is stretched and sheared.
///
/// The deformation gradient takes the warp to `$p = \sum r_i x_i$` with the material gradient `$r$` along it, and the
/// weft to `$q$` alike [Volino, Magnenat-Thalmann & Faure 2009]: strains are `$|p| - 1$` and `$|q| - 1$`, and the sine
/// of the shear angle is that of the angle by which `$p$` and `$q$` are off a right one.
pub(crate) struct Strain {
    /// Directions of warp and weft.
    pub(crate) units: [[Lanes; 3]; 2],
    /// One over the lengths of `$p$` and `$q$`.
    pub(crate) inverse: [Lanes; 2],
    /// Strains of warp and weft; where there is no triangle, zero.
    pub(crate) strains: [Lanes; 2],
    /// Sines of the shear angles; where there is no triangle, zero.
    pub(crate) sines: Lanes,
}

impl Strain {
    /// The strains of the triangles from a place on.
    #[inline(always)]
    pub(crate) fn of(triangles: &Triangles, start: usize, positions: &[f64]) -> Self {
        let mut sides = [[[0.0; LANES]; 3]; 2];
        for (lane, corners) in triangles.corners[start..start + LANES].iter().enumerate() {
            let [a, b, c] = corners.map(|corner| {
                let position = &positions[3 * corner as usize..][..3];
                [position[0], position[1], position[2]]
            });
            set(&mut sides[0], lane, subtract(b, a));
            set(&mut sides[1], lane, subtract(c, a));
        }
        let gradients = triangles.gradients.from(start);
        let areas = lanes(&triangles.areas, start);
        let mut strain = Self {
            units: [[[0.0; LANES]; 3]; 2],
            inverse: [[0.0; LANES]; 2],
            strains: [[0.0; LANES]; 2],
            sines: [0.0; LANES],
        };
        for direction in 0..2 {
            let [first, second] = [2, 3].map(|k| gradients.0[k - 2 * direction]);
            for lane in 0..LANES {
                let [b, c] = [0, 1].map(|side| at(&sides[side], lane));
                let way = add(scale(b, first[lane]), scale(c, second[lane]));
                let length = dot(way, way).sqrt();
                // Written so that NaN stays NaN.
                let length = if length < EDGE_MIN { EDGE_MIN } else { length };
                let inverse = 1.0 / length;
                strain.inverse[direction][lane] = inverse;
                set(&mut strain.units[direction], lane, scale(way, inverse));
                strain.strains[direction][lane] =
                    if areas[lane] == 0.0 { 0.0 } else { length - 1.0 };
            }
        }
        for lane in 0..LANES {
            let sine = dot(strain.unit(0, lane), strain.unit(1, lane));
            strain.sines[lane] = if areas[lane] == 0.0 { 0.0 } else { sine };
        }
        strain
    }

    /// Direction of the warp or the weft in a lane.
    #[inline(always)]
    pub(crate) fn unit(&self, direction: usize, lane: usize) -> Vector {
        at(&self.units[direction], lane)
    }
}

#[inline(always)]
pub(crate) fn at(vectors: &[Lanes; 3], lane: usize) -> Vector {
    [vectors[0][lane], vectors[1][lane], vectors[2][lane]]
}
