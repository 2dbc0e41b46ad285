use crate::Cloth;
use crate::field::{Vector, dot};

/// How far the cloth is deformed within one triangle of its surface.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TriangleStrain {
    /// Strain along the warp, a ratio.
    pub warp: f64,
    /// Strain along the weft, a ratio.
    pub weft: f64,
    /// Shear angle in rad: by how much the yarns cross at less than a right angle.
    pub shear: f64,
    /// Area of the triangle before deformation, in m².
    pub area: f64,
}

impl Cloth {
    /// The strains of the triangles of the surface, in their order, at positions of the particles (three numbers each,
    /// in m).
    ///
    /// Within a triangle positions follow the material coordinates linearly; strains are the lengths of the derivatives
    /// along warp and weft less one, the shear the angle between them [Volino, Magnenat-Thalmann & Faure 2009, §3].
    ///
    /// # Panics
    /// If positions of some particles are missing.
    #[must_use]
    pub fn triangle_strains(&self, positions: &[f64]) -> Vec<TriangleStrain> {
        let place = |particle: u32| -> Vector {
            std::array::from_fn(|axis| positions[3 * particle as usize + axis])
        };
        let strain = |&[a, b, c]: &[u32; 3]| {
            let [start, one, other] = [a, b, c].map(|p| self.coordinates()[p as usize]);
            let [[u1, v1], [u2, v2]] =
                [one, other].map(|end| [end[0] - start[0], end[1] - start[1]]);
            let twice = u1 * v2 - u2 * v1;
            let [first, second] = [b, c].map(|end| -> Vector {
                std::array::from_fn(|axis| place(end)[axis] - place(a)[axis])
            });
            let along = |[one, other]: [f64; 2]| -> Vector {
                std::array::from_fn(|axis| (one * first[axis] + other * second[axis]) / twice)
            };
            let (weft, warp) = (along([v2, -v1]), along([-u2, u1]));
            let [length_weft, length_warp] = [weft, warp].map(|way| dot(way, way).sqrt());
            let sine = dot(weft, warp) / (length_weft * length_warp);
            TriangleStrain {
                warp: length_warp - 1.0,
                weft: length_weft - 1.0,
                shear: sine.clamp(-1.0, 1.0).asin(),
                area: 0.5 * twice.abs(),
            }
        };
        self.triangles().iter().map(strain).collect()
    }
}
