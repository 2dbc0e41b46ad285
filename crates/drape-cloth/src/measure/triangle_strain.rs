//! Strains of a triangle of the surface, for pictures and warnings.

use crate::measure::vector::{Vector, dot};

/// Deformation of one triangle of the surface.
///
/// Within a triangle positions are linear in the material coordinates. The strains are the lengths
/// of the derivatives along warp and weft less one; the shear is the angle by which these two are
/// off a right one \[VMF09, §3\].
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
    /// Returns the strain of a triangle from the material coordinates of its corners, in m, and
    /// their positions, in m.
    pub(crate) fn of(coordinates: [[f64; 2]; 3], positions: [Vector; 3]) -> Self {
        let [start, one, other] = coordinates;
        let [[u1, v1], [u2, v2]] = [one, other].map(|end| [end[0] - start[0], end[1] - start[1]]);
        let twice = u1 * v2 - u2 * v1;
        let [origin, b, c] = positions;
        let [first, second] =
            [b, c].map(|end| -> Vector { std::array::from_fn(|axis| end[axis] - origin[axis]) });
        let along = |[one, other]: [f64; 2]| -> Vector {
            std::array::from_fn(|axis| (one * first[axis] + other * second[axis]) / twice)
        };
        let (weft, warp) = (along([v2, -v1]), along([-u2, u1]));
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
