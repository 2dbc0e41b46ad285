//! Light of a uniform sky: ambient occlusion.
//!
//! The irradiance at a corner with the normal `$n$` is
//! `$\frac1\pi\int V(\omega)\,(n\cdot\omega)\, \mathrm{d}\omega$` over the upper half sphere, with
//! the visibility `$V$` of the sky in the direction `$\omega$`; it is 1 where an upward normal sees
//! all of the sky. The integral is a sum over evenly distributed directions, each with a shadow
//! map. `shade` interpolates the result over the facets.

use rayon::prelude::*;

use super::scene::Scene;
use super::shadow_map::ShadowMap;
use super::tessellation::{Facet, LitPoint, Tessellation};
use super::vector::{dot, scale};
use crate::error::Error;

/// Number of directions of the sky. With fewer, steps show in the shade; more cost time.
const DIRECTIONS: usize = 64;

/// Texels along the side of the shadow map of one direction.
///
/// A texel is 0.3 % of the width of the scene: smaller ones would only sharpen single directions of
/// a light that is soft.
const TEXELS: usize = 320;

/// Angle from one direction of the sky to the next, in rad, which distributes them evenly.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// Number of directions whose contributions are held at the same time, which bounds the memory.
const GROUP: usize = 8;

/// Light of a uniform sky on the surfaces of a scene, for all pictures of them.
///
/// It does not depend on the view or on colours: pictures of the same shapes share it.
#[derive(Debug, Clone)]
pub struct SkyLight {
    /// Irradiance at each lit point of the tessellation, on its front and on its back.
    points: Vec<[f64; 2]>,
}

impl SkyLight {
    /// Computes the light on a scene.
    ///
    /// # Errors
    /// A scene that cannot be drawn.
    pub fn new(scene: &Scene) -> Result<SkyLight, Error> {
        scene.check()?;
        Ok(SkyLight::on(&Tessellation::new(scene)))
    }

    /// Computes the light on a tessellation.
    pub(crate) fn on(scene: &Tessellation) -> SkyLight {
        let mut points = vec![[0.0; 2]; scene.lit_points.len()];
        for first in (0..DIRECTIONS).step_by(GROUP) {
            let group = first..(first + GROUP).min(DIRECTIONS);
            let parts: Vec<Vec<f64>> =
                group.into_par_iter().map(|number| directional_light(scene, number)).collect();
            for part in &parts {
                for (sum, part) in points.iter_mut().zip(part) {
                    sum[usize::from(*part < 0.0)] += part.abs();
                }
            }
        }
        SkyLight { points }
    }

    /// Number of lit points.
    pub(crate) fn len(&self) -> usize {
        self.points.len()
    }

    /// Returns the irradiance at the corners of a facet, on its front or on its back.
    pub(crate) fn at(&self, facet: &Facet, front: bool) -> [f64; 3] {
        facet.corners.map(|corner| self.points[corner.lit_point as usize][usize::from(!front)])
    }
}

/// Returns the contribution of one direction of the sky to each lit point: above 0 on its front,
/// below on its back.
fn directional_light(scene: &Tessellation, number: usize) -> Vec<f64> {
    // Equal areas of the half sphere, rotated by the golden angle from one to the next.
    let rise = (number as f64 + 0.5) / DIRECTIONS as f64;
    let level = (1.0 - rise * rise).sqrt();
    let (sine, cosine) = (number as f64 * GOLDEN_ANGLE).sin_cos();
    let direction = [level * sine, rise, level * cosine];
    let map = ShadowMap::new(scene, direction, TEXELS);
    let light = |point: &LitPoint| {
        let cosine = dot(point.normal, direction);
        let normal = if cosine > 0.0 { point.normal } else { scale(point.normal, -1.0) };
        2.0 * cosine * map.visibility(point.position, normal, 0) / DIRECTIONS as f64
    };
    scene.lit_points.iter().map(light).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::tessellation::samples::{disc, scene};

    #[test]
    fn the_open_sky_lights_a_level_plate_fully_and_its_underside_not_at_all() {
        let facets = disc(1.0, 0.0, 40);
        for [front, back] in SkyLight::on(&scene(facets, [0.0; 3], 1.5)).points {
            assert!((front - 1.0).abs() < 1e-3, "front {front}");
            assert_eq!(back, 0.0);
        }
    }

    #[test]
    fn a_lid_takes_its_view_factor_of_the_sky() {
        // A disc of radius R at the height h hides R²/(R² + h²) of the light below its centre.
        let (radius, height) = (0.5, 0.5);
        let mut facets = disc(0.1, 0.0, 6);
        facets.extend(disc(radius, height, 60));
        let scene = scene(facets, [0.0, 0.25, 0.0], 0.7);
        let light = SkyLight::on(&scene).at(&scene.facets[0], true)[0];
        let expected = 1.0 - radius * radius / (radius * radius + height * height);
        // Of 64 directions some three lie at the rim.
        assert!((light - expected).abs() < 0.04, "{light}, not {expected}");
    }
}
