//! Strains of a triangle of the surface, for pictures and warnings.

use crate::measure::vector::{Vector, dot};

/// Deformation of one triangle of the surface.
///
/// Within a triangle, positions are linear in the material coordinates. The strains are the lengths
/// of the derivatives along warp and weft, less one. The shear is the angle by which the two
/// derivatives deviate from a right angle \[VMF09, §3\].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TriangleStrain {
    /// Strain along the warp, a ratio.
    pub warp: f64,
    /// Strain along the weft, a ratio.
    pub weft: f64,
    /// Shear angle, positive where the yarns cross at less than a right angle, in rad.
    pub shear: f64,
    /// Area of the triangle before deformation, in m².
    pub area: f64,
}

impl TriangleStrain {
    /// Returns the strain of a triangle with `coordinates`, the material coordinates of its
    /// corners, and with its corners at `positions`, all in m.
    pub(crate) fn new(coordinates: [[f64; 2]; 3], positions: [Vector; 3]) -> Self {
        let [start, second, third] = coordinates;
        let [[u1, v1], [u2, v2]] =
            [second, third].map(|end| [end[0] - start[0], end[1] - start[1]]);
        let twice = u1 * v2 - u2 * v1;
        let [origin, b, c] = positions;
        let [to_b, to_c] =
            [b, c].map(|end| -> Vector { std::array::from_fn(|axis| end[axis] - origin[axis]) });

        // Derivatives of the position along weft and warp.
        let [weft, warp] = [[v2, -v1], [-u2, u1]].map(|[by_b, by_c]| -> Vector {
            std::array::from_fn(|axis| (by_b * to_b[axis] + by_c * to_c[axis]) / twice)
        });
        let [length_weft, length_warp] = [weft, warp].map(|vector| dot(vector, vector).sqrt());
        let sine = dot(weft, warp) / (length_weft * length_warp);
        Self {
            warp: length_warp - 1.0,
            weft: length_weft - 1.0,
            shear: sine.clamp(-1.0, 1.0).asin(),
            area: 0.5 * twice.abs(),
        }
    }
}
