//! Strain of a triangle along warp and weft, and its shear.

use drape_frames::vector::{dot, length};

/// Component of a strain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum StrainOf {
    /// Along the warp, in %.
    Warp,
    /// Along the weft, in %.
    Weft,
    /// Angle by which warp and weft are off a right one, in °.
    Shear,
}

/// Triangle before deformation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RestTriangle {
    pub(super) corners: [u32; 3],
    /// Edges from the first corner to the two others, in m: weft and warp.
    edges: [[f64; 2]; 2],
    /// Area, in m².
    pub(super) area: f64,
}

impl RestTriangle {
    /// Returns a triangle from the material coordinates of all vertices.
    pub(super) fn new(corners: [u32; 3], material: &[[f64; 2]]) -> RestTriangle {
        let [start, one, other] = corners.map(|corner| material[corner as usize]);
        let edges = [one, other].map(|end| [end[0] - start[0], end[1] - start[1]]);
        let [[u1, v1], [u2, v2]] = edges;
        RestTriangle { corners, edges, area: 0.5 * (u1 * v2 - u2 * v1).abs() }
    }

    /// Returns a component of the strain at the positions of all vertices: of the derivatives of the
    /// position along warp and weft, their lengths less one, and the angle between them; 0 for a
    /// triangle without area.
    pub(super) fn strain(&self, positions: &[[f64; 3]], of: StrainOf) -> f64 {
        let [[u1, v1], [u2, v2]] = self.edges;
        let twice = u1 * v2 - u2 * v1;
        let [start, one, other] = self.corners.map(|corner| positions[corner as usize]);
        let along = |a: f64, b: f64| -> [f64; 3] {
            std::array::from_fn(|k| (a * (one[k] - start[k]) + b * (other[k] - start[k])) / twice)
        };
        let (weft, warp) = (along(v2, -v1), along(-u2, u1));
        let value = match of {
            StrainOf::Warp => 100.0 * (length(warp) - 1.0),
            StrainOf::Weft => 100.0 * (length(weft) - 1.0),
            StrainOf::Shear => {
                let sine = dot(weft, warp) / (length(weft) * length(warp));
                sine.clamp(-1.0, 1.0).asin().to_degrees()
            }
        };
        if value.is_finite() { value } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_of_any_shape_has_the_strain_of_its_cloth() {
        // Derivatives of the position along weft and warp: 1.1 and 0.95 long, 6° off a right angle.
        let (sine, cosine) = 6_f64.to_radians().sin_cos();
        let place =
            |[u, v]: [f64; 2]| [0.3 + 1.1 * u + 0.95 * sine * v, 0.7, 0.95 * cosine * v - 0.2];
        let material = [[0.5, 0.1], [0.61, 0.13], [0.47, 0.4], [0.2, -0.3]];
        let positions = material.map(place);
        for corners in [[0, 1, 2], [0, 2, 1], [2, 3, 1], [3, 0, 2]] {
            let triangle = RestTriangle::new(corners, &material);
            for (of, expected) in
                [(StrainOf::Weft, 10.0), (StrainOf::Warp, -5.0), (StrainOf::Shear, 6.0)]
            {
                let strain = triangle.strain(&positions, of);
                assert!((strain - expected).abs() < 1e-9, "{corners:?} {of:?}: {strain}");
            }
        }
        let flat = RestTriangle::new([0, 1, 1], &material);
        assert_eq!((flat.area, flat.strain(&positions, StrainOf::Shear)), (0.0, 0.0));
    }
}
