//! Strain of a triangle along warp and weft, and shear.

use drape_frames::vector::{dot, length};

/// Component of the strain of a triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum StrainComponent {
    /// Strain along the warp, in %.
    Warp,
    /// Strain along the weft, in %.
    Weft,
    /// Difference of the angle between warp and weft from a right angle, in °.
    Shear,
}

/// Triangle before deformation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RestTriangle {
    pub(super) corners: [u32; 3],
    /// Edges from the first corner to the other two, in m, as weft and warp coordinates.
    edges: [[f64; 2]; 2],
    /// Area, in m².
    pub(super) area: f64,
}

impl RestTriangle {
    /// Returns the triangle with `corners`. `material` has the material coordinates of all
    /// vertices.
    pub(super) fn new(corners: [u32; 3], material: &[[f64; 2]]) -> RestTriangle {
        let [start, second, third] = corners.map(|corner| material[corner as usize]);
        let edges = [second, third].map(|end| [end[0] - start[0], end[1] - start[1]]);
        let [[u1, v1], [u2, v2]] = edges;
        RestTriangle { corners, edges, area: 0.5 * (u1 * v2 - u2 * v1).abs() }
    }

    /// Returns a component of the strain at `positions`, which are the positions of all vertices,
    /// in m; 0 for a triangle without area.
    ///
    /// The strains are the lengths of the derivatives of the position along warp and weft, less
    /// one. The shear is the sine of the angle between these derivatives, as an angle.
    pub(super) fn strain(&self, positions: &[[f64; 3]], component: StrainComponent) -> f64 {
        let [[u1, v1], [u2, v2]] = self.edges;
        let twice = u1 * v2 - u2 * v1;
        let [start, second, third] = self.corners.map(|corner| positions[corner as usize]);
        let [weft, warp]: [[f64; 3]; 2] = [(v2, -v1), (-u2, u1)].map(|(a, b)| {
            std::array::from_fn(|k| {
                (a * (second[k] - start[k]) + b * (third[k] - start[k])) / twice
            })
        });
        let value = match component {
            StrainComponent::Warp => 100.0 * (length(warp) - 1.0),
            StrainComponent::Weft => 100.0 * (length(weft) - 1.0),
            StrainComponent::Shear => {
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
            for (of, expected) in [
                (StrainComponent::Weft, 10.0),
                (StrainComponent::Warp, -5.0),
                (StrainComponent::Shear, 6.0),
            ] {
                let strain = triangle.strain(&positions, of);
                assert!((strain - expected).abs() < 1e-9, "{corners:?} {of:?}: {strain}");
            }
        }
        let flat = RestTriangle::new([0, 1, 1], &material);
        assert_eq!((flat.area, flat.strain(&positions, StrainComponent::Shear)), (0.0, 0.0));
    }
}
