//! Facets as the camera projects them.

use super::camera::{Camera, ScreenPoint};
use super::tessellation::{Facet, Part, Tessellation};
use super::triangle::PlaneTriangle;

/// Number of samples along each side of a pixel.
///
/// With sixteen samples a pixel, edges have sixteen steps, about as many as the eye can tell apart;
/// colours are evaluated only once per pixel and facet.
pub(crate) const SAMPLES: usize = 4;

/// Smallest depth of a corner that is projected, in m.
const NEAREST: f64 = 1e-6;

/// Facet on the screen.
pub(crate) struct ScreenFacet<'a> {
    pub(crate) facet: &'a Facet,
    /// Triangle in pixels.
    pub(crate) pixels: PlaneTriangle,
    /// Triangle in samples.
    pub(crate) samples: PlaneTriangle,
    /// Inverse depths of the corners, in 1/m, for perspective-correct interpolation.
    pub(crate) inverse_depths: [f64; 3],
    /// Inverse depths of the corners with the depth bias, in 1/m, for the depth test.
    pub(crate) biased_depths: [f64; 3],
}

impl<'a> ScreenFacet<'a> {
    /// Projects a facet; `None` if it is not visible.
    pub(crate) fn project(
        scene: &Tessellation,
        facet: &'a Facet,
        camera: &Camera,
    ) -> Option<ScreenFacet<'a>> {
        let corners = facet.corners.map(|corner| camera.project(corner.position));
        // The camera is outside of the framed scene; facets that extend behind it are left out
        // whole.
        if corners.iter().any(|corner| corner.depth <= NEAREST) {
            return None;
        }
        if facet.part == Part::Floor && camera.eye()[1] < facet.corners[0].position[1] {
            // From below the floor would hide the scene.
            return None;
        }
        let bias = scene.depth_bias(facet.part);
        let in_pixels = |corner: ScreenPoint| [corner.x, corner.y];
        let in_samples =
            |corner: ScreenPoint| [corner.x * SAMPLES as f64, corner.y * SAMPLES as f64];
        Some(ScreenFacet {
            facet,
            pixels: PlaneTriangle::new(corners.map(in_pixels))?,
            samples: PlaneTriangle::new(corners.map(in_samples))?,
            inverse_depths: corners.map(|corner| 1.0 / corner.depth),
            biased_depths: corners.map(|corner| 1.0 / (corner.depth + bias)),
        })
    }

    /// Returns the barycentric coordinates in space at a point of the picture, in pixels.
    pub(crate) fn barycentric(&self, x: f64, y: f64) -> [f64; 3] {
        let plane = self.pixels.barycentric(x, y);
        let weighted = [0, 1, 2].map(|k| plane[k] * self.inverse_depths[k]);
        let sum: f64 = weighted.iter().sum();
        weighted.map(|weight| weight / sum)
    }
}
