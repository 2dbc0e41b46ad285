//! Facets as the camera projects them.

use super::camera::{Camera, ScreenPoint};
use super::tessellation::{Facet, Tessellation};
use super::triangle::PlaneTriangle;

/// Number of samples along each side of a pixel.
///
/// With sixteen samples a pixel, edges have sixteen steps, about as many as the eye can
/// distinguish. Colours are evaluated only once per pixel and facet.
pub(crate) const SAMPLES: usize = 4;

/// Smallest depth of a corner that is projected, in m.
const NEAREST: f64 = 1e-6;

/// Facet on the screen.
pub(crate) struct ScreenFacet {
    /// Number of the facet.
    pub(crate) number: u32,
    /// Triangle in pixels.
    pub(crate) pixels: PlaneTriangle,
    /// Inverse depths of the corners, in 1/m, for perspective-correct interpolation.
    inverse_depths: [f64; 3],
    /// Depth bias, in m.
    bias: f64,
}

impl ScreenFacet {
    /// Projects the facets of a `scene` with a `camera`. Facets that cannot be seen are left out.
    pub(crate) fn all(scene: &Tessellation, camera: &Camera) -> Vec<ScreenFacet> {
        let points: Vec<ScreenPoint> =
            scene.vertices.iter().map(|vertex| camera.project(vertex.position)).collect();
        let project = |(facet, number): (&Facet, u32)| {
            let corners = facet.corners.map(|corner| points[corner as usize]);
            // The camera is outside the framed scene. Facets that extend behind the camera are left
            // out whole.
            if corners.iter().any(|corner| corner.depth <= NEAREST) {
                return None;
            }
            Some(ScreenFacet {
                number,
                pixels: PlaneTriangle::new(corners.map(|corner| [corner.x, corner.y]))?,
                inverse_depths: corners.map(|corner| 1.0 / corner.depth),
                bias: scene.depth_bias(facet.part),
            })
        };
        scene.facets.iter().zip(0..).filter_map(project).collect()
    }

    /// Returns the triangle in samples. Returns `None` if the triangle has no area there.
    pub(crate) fn samples(&self) -> Option<PlaneTriangle> {
        PlaneTriangle::new(self.pixels.corners.map(|corner| corner.map(|x| x * SAMPLES as f64)))
    }

    /// Returns the inverse depths of the corners with the depth `bias`, in 1/m, for the depth test.
    pub(crate) fn biased_depths(&self) -> [f64; 3] {
        self.inverse_depths.map(|inverse| inverse / (1.0 + self.bias * inverse))
    }

    /// Returns the barycentric coordinates in space at the point `x`, `y` of the picture, in
    /// pixels.
    pub(crate) fn barycentric(&self, x: f64, y: f64) -> [f64; 3] {
        let plane = self.pixels.barycentric(x, y);
        let weighted = [0, 1, 2].map(|k| plane[k] * self.inverse_depths[k]);
        let sum: f64 = weighted.iter().sum();
        weighted.map(|weight| weight / sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_depth_bias_is_added_to_the_depths() {
        let facet = ScreenFacet {
            number: 0,
            pixels: PlaneTriangle::new([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]).unwrap(),
            inverse_depths: [2.0, 4.0, 5.0].map(|depth: f64| 1.0 / depth),
            bias: 0.25,
        };
        let depths = facet.biased_depths().map(|inverse| 1.0 / inverse);
        let misses = [2.25, 4.25, 5.25].iter().zip(depths).map(|(a, b)| (a - b).abs());
        assert!(misses.fold(0.0, f64::max) < 1e-12, "{depths:?}");
        // Half way between two corners in the picture is nearer to the nearer corner in space.
        let [a, b, c] = facet.barycentric(0.5, 0.0);
        assert!((a - 2.0 / 3.0).abs() < 1e-12 && (b - 1.0 / 3.0).abs() < 1e-12 && c.abs() < 1e-12);
    }
}
