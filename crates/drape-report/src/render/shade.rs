//! Shading: the colour of a facet at a pixel from its material, its lines and the lights.
//!
//! Diffuse light from the sky (`sky`), from a key light with soft shadows (`shadow_map`), from the
//! ground and from the camera; on top of it warp lines, weft lines and the hem, drawn as ink.
//! `raster` calls it once per pixel and visible facet.

use super::camera::{Camera, View};
use super::colour::{Colour, decode};
use super::scene::{Scene, Surface};
use super::screen::ScreenFacet;
use super::shadow_map::ShadowMap;
use super::sky::SkyLight;
use super::tessellation::{FLOOR_HALF_SIDE, Part, Tessellation};
use super::vector::{Bounds, Vector, add, cross, dot, norm, scale, subtract, unit};

// The lights were chosen by eye on a draped cube and a pleated curtain: a surface that faces the
// key light is a little brighter than its colour, the ground of a fold a third as bright.

/// Irradiance of the whole sky on an upward surface; 1 shows a colour as it is given.
const SKY: f64 = 0.62;

/// Irradiance of the key light on a surface that faces it.
const KEY: f64 = 0.62;

/// Irradiance from the ground on a downward surface.
const GROUND: f64 = 0.16;

/// Irradiance of a light at the camera, which keeps the form readable inside folds.
const HEADLIGHT: f64 = 0.1;

/// Elevation of the key light above the horizon, in rad.
const KEY_ELEVATION: f64 = 0.85;

/// Azimuth of the key light to the left of the camera, in rad.
const KEY_AZIMUTH: f64 = 0.95;

/// Texels along the side of the shadow map of the key light, and radius of its filter in texels.
///
/// At the usual size a texel is about a pixel, and the filter hides its steps.
const KEY_TEXELS: usize = 1400;
const KEY_FILTER: i64 = 2;

/// Texels and filter of the shadow map of the floor: larger texels make its shadow softer.
const FLOOR_TEXELS: usize = 200;
const FLOOR_FILTER: i64 = 2;

/// Strength of the shadows on the floor; 1 would be as dark as on a white body.
const FLOOR_SHADE: f64 = 0.75;

/// Colours of the warp lines, the weft lines and the hem.
const INK: [Colour; 3] = [[34, 58, 110], [150, 54, 44], [40, 44, 52]];

/// Opacity of the warp lines, the weft lines and the hem.
const INK_OPACITY: [f64; 3] = [0.72, 0.72, 0.75];

/// Width of a line over the height of the picture; at least a pixel.
const LINE_WIDTH: f64 = 1.6 / 900.0;

/// Distance of lines, in line widths, below which they fade into an even tone.
const LINES_MERGE: f64 = 3.0;

/// Scene with the light of the sky on it.
#[derive(Clone, Copy)]
pub(crate) struct LitScene<'a> {
    pub(crate) scene: &'a Scene<'a>,
    pub(crate) sky: &'a SkyLight,
}

/// Shader of the points of a scene.
pub(crate) struct Shader<'a> {
    scene: &'a Scene<'a>,
    eye: Vector,
    /// Colours of front and back of each cloth and then of each body, in linear light.
    tints: Vec<[Vector; 2]>,
    inks: [Vector; 3],
    sky: &'a SkyLight,
    key: ShadowMap,
    key_on_floor: ShadowMap,
    bounds: Bounds,
    /// Width of lines, in pixels.
    line_width: f64,
}

impl<'a> Shader<'a> {
    /// Prepares the lights of a scene for a camera.
    pub(crate) fn new(
        lit: LitScene<'a>,
        tessellation: &Tessellation,
        camera: &Camera,
        view: &View,
    ) -> Shader<'a> {
        let LitScene { scene, sky } = lit;
        let (sine, cosine) = KEY_AZIMUTH.sin_cos();
        // Horizontal directions from the scene to the camera and to the left of it.
        let right = camera.right();
        let towards = unit(cross(right, [0.0, 1.0, 0.0]));
        let level = subtract(scale(towards, cosine), scale(right, sine));
        let (rise, flat) = KEY_ELEVATION.sin_cos();
        let direction = add(scale(level, flat), [0.0, rise, 0.0]);
        let surfaces = scene.cloths.iter().chain(&scene.bodies);
        Shader {
            tints: surfaces
                .map(|surface| [surface.front, surface.back].map(|c| c.map(decode)))
                .collect(),
            inks: INK.map(|ink| ink.map(decode)),
            scene,
            eye: camera.eye(),
            sky,
            key: ShadowMap::new(tessellation, direction, KEY_TEXELS),
            key_on_floor: ShadowMap::new(tessellation, direction, FLOOR_TEXELS),
            bounds: tessellation.bounds,
            line_width: (LINE_WIDTH * f64::from(view.height)).max(1.0),
        }
    }

    /// Returns the linear colour of a facet at a point of the picture, in pixels.
    pub(crate) fn colour(&self, item: &ScreenFacet, x: f64, y: f64) -> Vector {
        let facet = item.facet;
        let weights = item.barycentric(x, y);
        let mix = |values: [Vector; 3]| -> Vector {
            std::array::from_fn(|k| (0..3).map(|c| weights[c] * values[c][k]).sum())
        };
        let position = mix(facet.corners.map(|corner| corner.position));
        let to_eye = unit(subtract(self.eye, position));
        let smooth = unit(mix(facet.corners.map(|corner| corner.normal)));
        let front = dot(facet.area_normal(), to_eye) >= 0.0;
        let normal = if front { smooth } else { scale(smooth, -1.0) };
        let sky = self.sky.at(facet, front);
        let sky = (0..3).map(|c| weights[c] * sky[c]).sum::<f64>();
        let cosine = dot(normal, self.key.direction).max(0.0);
        let (map, filter) = match facet.part {
            Part::Floor => (&self.key_on_floor, FLOOR_FILTER),
            _ => (&self.key, KEY_FILTER),
        };
        let key =
            if cosine > 0.0 { cosine * map.visibility(position, normal, filter) } else { 0.0 };

        if facet.part == Part::Floor {
            let full = SKY + KEY * cosine;
            let shade = 1.0 - (SKY * sky + KEY * key) / full;
            let Bounds { center, radius } = self.bounds;
            let away = norm([position[0] - center[0], 0.0, position[2] - center[2]]);
            let fade = (1.0 - away / (0.95 * FLOOR_HALF_SIDE * radius)).clamp(0.0, 1.0);
            let fade = fade.min(0.4) / 0.4;
            return [1.0 - FLOOR_SHADE * shade * fade; 3];
        }
        let light = SKY * sky
            + KEY * key
            + GROUND * 0.5 * (1.0 - normal[1])
            + HEADLIGHT * dot(normal, to_eye).max(0.0);
        let (surface, tints) = match facet.part {
            Part::Cloth(k) => (&self.scene.cloths[k], self.tints[k]),
            Part::Body(k) => (&self.scene.bodies[k], self.tints[self.scene.cloths.len() + k]),
            Part::Floor => return [1.0; 3],
        };
        let base = match surface.tints {
            Some(_) => mix(facet.corners.map(|corner| corner.tint)),
            None => tints[usize::from(!front)],
        };
        let ink = self.ink(item, surface, [x, y]);
        let own = self.inks.iter().zip(ink).fold(base, |below, (ink, cover)| {
            std::array::from_fn(|k| below[k] + cover * (ink[k] - below[k]))
        });
        own.map(|channel| channel * light)
    }

    /// Returns the coverage of a point by the warp lines, the weft lines and the hem, 0 to 1.
    fn ink(&self, item: &ScreenFacet, surface: &Surface, [x, y]: [f64; 2]) -> [f64; 3] {
        let Part::Cloth(_) = item.facet.part else {
            return [0.0; 3];
        };
        // Values at the point and one pixel to the right and down give the gradient in the picture.
        let [here, right, down] =
            [[x, y], [x + 1.0, y], [x, y + 1.0]].map(|[x, y]| item.barycentric(x, y));
        let with_slope = |value: &dyn Fn([f64; 3]) -> f64| {
            let here = value(here);
            (here, (value(right) - here).hypot(value(down) - here))
        };
        let half = 0.5 * self.line_width;
        let cover = |pixels: f64| (half + 0.5 - pixels).clamp(0.0, 1.0);
        let mut ink = [0.0; 3];
        if surface.coordinates.is_some() {
            for (axis, ink) in ink.iter_mut().take(2).enumerate() {
                let along = |weights: [f64; 3]| {
                    (0..3)
                        .map(|c| weights[c] * item.facet.corners[c].coordinates[axis])
                        .sum::<f64>()
                        / surface.line_spacing
                };
                let (coordinate, slope) = with_slope(&along);
                // Lines that are too close merge into a tone of the same mean coverage, up to a
                // limit.
                let apart = 1.0 / (slope * self.line_width);
                let sharp = (apart / LINES_MERGE - 1.0).clamp(0.0, 1.0);
                let line = cover((coordinate - coordinate.round()).abs() / slope);
                *ink = sharp * line + (1.0 - sharp) / apart.max(LINES_MERGE);
            }
        }
        for corner in 0..3 {
            if item.facet.hems[corner] {
                let (height, slope) = with_slope(&|weights: [f64; 3]| weights[corner]);
                ink[2] = cover(height / slope - half).max(ink[2]);
            }
            if item.facet.corners[corner].on_hem {
                // A dot closes the line where only a corner of this facet touches the hem.
                let [cx, cy] = item.pixels.corners[corner];
                ink[2] = cover((x - cx).hypot(y - cy) - half).max(ink[2]);
            }
        }
        [0, 1, 2].map(|k| INK_OPACITY[k] * ink[k])
    }
}
