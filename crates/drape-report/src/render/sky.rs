//! Light of a uniform sky: ambient occlusion.
//!
//! The irradiance at a corner with the normal `$n$` is
//! `$\frac1\pi\int V(\omega)\,(n\cdot\omega)\, \mathrm{d}\omega$` over the upper half sphere, with
//! the visibility `$V$` of the sky in the direction `$\omega$`; it is 1 where an upward normal sees
//! all of the sky. The integral is a sum over evenly distributed directions, each with a shadow
//! map. `shade` interpolates the result over the facets.

use rayon::prelude::*;

use super::shadow_map::ShadowMap;
use super::tessellation::{Facet, Tessellation};
use super::vector::{dot, scale};

/// Number of directions of the sky. With fewer, steps show in the shade; more cost time.
const DIRECTIONS: usize = 64;

/// Texels along the side of the shadow map of one direction.
///
/// A texel is 0.3 % of the width of the scene: smaller ones would only sharpen single directions of
/// a light that is soft.
const TEXELS: usize = 320;

/// Angle from one direction of the sky to the next, in rad, which distributes them evenly.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// Irradiance at the corners of a facet, on its front and on its back.
pub(crate) type FacetLight = [[f64; 3]; 2];

/// Returns for each facet the irradiance of a uniform sky at its corners, on its front and on its
/// back.
pub(crate) fn sky_light(scene: &Tessellation) -> Vec<FacetLight> {
    let directions = (0..DIRECTIONS).into_par_iter();
    let parts: Vec<Vec<FacetLight>> = directions
        .map(|k| {
            // Equal areas of the half sphere, rotated by the golden angle from one to the next.
            let rise = (k as f64 + 0.5) / DIRECTIONS as f64;
            let level = (1.0 - rise * rise).sqrt();
            let (sine, cosine) = (k as f64 * GOLDEN_ANGLE).sin_cos();
            let direction = [level * sine, rise, level * cosine];
            let map = ShadowMap::new(scene, direction, TEXELS);
            let facets = scene.facets.iter();
            facets.map(|facet| directional_light(&map, facet)).collect()
        })
        .collect();
    let mut light = vec![[[0.0; 3]; 2]; scene.facets.len()];
    for part in &parts {
        for (sum, part) in light.as_flattened_mut().iter_mut().zip(part.as_flattened()) {
            for (sum, part) in sum.iter_mut().zip(part) {
                *sum += part;
            }
        }
    }
    light
}

/// Returns the contribution of one direction of the sky.
fn directional_light(map: &ShadowMap, facet: &Facet) -> FacetLight {
    let mut light = [[0.0; 3]; 2];
    for (number, corner) in facet.corners.iter().enumerate() {
        let cosine = dot(corner.normal, map.direction);
        let (side, normal) =
            if cosine > 0.0 { (0, corner.normal) } else { (1, scale(corner.normal, -1.0)) };
        let visibility = map.visibility(corner.position, normal, 0);
        light[side][number] = 2.0 * cosine.abs() * visibility / DIRECTIONS as f64;
    }
    light
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::tessellation::samples::{disc, scene};

    #[test]
    fn the_open_sky_lights_a_level_plate_fully_and_its_underside_not_at_all() {
        let facets = disc(1.0, 0.0, 40);
        for [front, back] in sky_light(&scene(facets, [0.0; 3], 1.5)) {
            for (front, back) in front.into_iter().zip(back) {
                assert!((front - 1.0).abs() < 1e-3, "front {front}");
                assert_eq!(back, 0.0);
            }
        }
    }

    #[test]
    fn a_lid_takes_its_view_factor_of_the_sky() {
        // A disc of radius R at the height h hides R²/(R² + h²) of the light below its centre.
        let (radius, height) = (0.5, 0.5);
        let mut facets = disc(0.1, 0.0, 6);
        facets.extend(disc(radius, height, 60));
        let light = sky_light(&scene(facets, [0.0, 0.25, 0.0], 0.7))[0][0][0];
        let expected = 1.0 - radius * radius / (radius * radius + height * height);
        // Of 64 directions some three lie at the rim.
        assert!((light - expected).abs() < 0.04, "{light}, not {expected}");
    }
}
