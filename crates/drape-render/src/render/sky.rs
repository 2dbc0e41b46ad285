//! Light of a uniform sky: ambient occlusion.
//!
//! The irradiance at a vertex with the normal `$n$` is `$\frac1\pi\int V(\omega)\,(n\cdot\omega)\,
//! \mathrm{d}\omega$` over the upper half sphere, with the visibility `$V$` of the sky in the
//! direction `$\omega$`. It is 1 where an upward normal sees all of the sky. The integral is a sum
//! over evenly distributed directions, each with a shadow map. `shade` interpolates the result over
//! the facets, `floor` over its grid.

use rayon::prelude::*;

use super::floor::Floor;
use super::shadow_map::ShadowMap;
use super::tessellation::{Facet, Tessellation, Vertex};
use super::vector::{Vector, dot, scale};

/// Number of directions of the sky. With fewer directions the shade shows steps. More directions
/// cost time.
const DIRECTIONS: usize = 64;

/// Texels along the longer side of the shadow map of one direction.
///
/// A texel is 0.5 % of the width of the scene. Smaller texels would only sharpen single directions
/// of a soft light.
const TEXELS: usize = 200;

/// Angle between successive directions of the sky, in rad, which distributes them evenly.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// Number of directions whose contributions are held at the same time, which bounds the memory.
const GROUP: usize = 8;

/// Light of a uniform sky on the surfaces of a scene and on its floor.
///
/// The light does not depend on the view or on colours, so pictures of one set of shapes share it.
#[derive(Debug, Clone)]
pub(crate) struct SkyLight {
    /// Irradiance at each vertex, on its front and on its back.
    vertices: Vec<[f32; 2]>,
    /// Irradiance at each point of the floor.
    pub(crate) floor: Vec<f32>,
}

impl SkyLight {
    /// Computes the light on the tessellation `scene` and on a `floor`.
    pub(crate) fn on(scene: &Tessellation, floor: Option<&Floor>) -> SkyLight {
        let below = floor.map_or_else(Vec::new, Floor::points);
        let mut vertices = vec![[0.0; 2]; scene.vertices.len()];
        let mut of_floor = vec![0.0; below.len()];
        for first in (0..DIRECTIONS).step_by(GROUP) {
            let group = first..(first + GROUP).min(DIRECTIONS);
            let parts: Vec<Vec<f32>> = group
                .into_par_iter()
                .map(|number| directional_light(scene, &below, number))
                .collect();
            for part in &parts {
                let (on_vertices, on_floor) = part.split_at(vertices.len());
                for (sum, part) in vertices.iter_mut().zip(on_vertices) {
                    sum[usize::from(*part < 0.0)] += part.abs();
                }
                of_floor.iter_mut().zip(on_floor).for_each(|(sum, part)| *sum += part);
            }
        }
        SkyLight { vertices, floor: of_floor }
    }

    /// Returns the irradiance at the corners of a `facet`, on its `front` or on its back.
    pub(crate) fn at(&self, facet: &Facet, front: bool) -> [f64; 3] {
        facet.corners.map(|corner| self.vertices[corner as usize][usize::from(!front)].into())
    }
}

/// Returns the contribution of the direction `number` of the sky to each vertex and then to each
/// point of the `floor`. A contribution is above 0 on the front of a vertex and below 0 on its
/// back.
fn directional_light(scene: &Tessellation, floor: &[Vector], number: usize) -> Vec<f32> {
    // Each direction represents an equal area of the half sphere. The golden angle separates
    // successive directions.
    let rise = (number as f64 + 0.5) / DIRECTIONS as f64;
    let level = (1.0 - rise * rise).sqrt();
    let (sine, cosine) = (number as f64 * GOLDEN_ANGLE).sin_cos();
    let direction = [level * sine, rise, level * cosine];
    let map = ShadowMap::new(scene, direction, TEXELS);
    let light = |position: Vector, normal: Vector| {
        let cosine = dot(normal, direction);
        let normal = if cosine > 0.0 { normal } else { scale(normal, -1.0) };
        (2.0 * cosine * map.visibility(position, normal, 0) / DIRECTIONS as f64) as f32
    };
    let on_vertex = |vertex: &Vertex| light(vertex.position, vertex.normal);
    let on_floor = |point: &Vector| light(*point, [0.0, 1.0, 0.0]);
    scene.vertices.iter().map(on_vertex).chain(floor.iter().map(on_floor)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::tessellation::samples::{Disc, scene};

    #[test]
    fn the_open_sky_lights_a_level_plate_fully_and_its_underside_not_at_all() {
        let disc = Disc { radius: 1.0, height: 0.0, pieces: 40 };
        for [front, back] in SkyLight::on(&scene(&[disc], [0.0; 3], 1.5), None).vertices {
            assert!((front - 1.0).abs() < 1e-3, "front {front}");
            assert_eq!(back, 0.0);
        }
    }

    #[test]
    fn a_lid_takes_its_view_factor_of_the_sky() {
        // A disc of radius R at the height h hides R²/(R² + h²) of the light below its centre.
        let (radius, height) = (0.5, 0.5);
        let discs =
            [Disc { radius: 0.1, height: 0.0, pieces: 6 }, Disc { radius, height, pieces: 60 }];
        let scene = scene(&discs, [0.0, 0.25, 0.0], 0.7);
        let light = SkyLight::on(&scene, None).at(&scene.facets[0], true)[0];
        let expected = 1.0 - radius * radius / (radius * radius + height * height);
        // Of 64 directions some three lie at the rim.
        assert!((light - expected).abs() < 0.04, "{light}, not {expected}");
    }
}
