//! Shading: the colour of a facet at a pixel from its material, its lines and the lights.
//!
//! Diffuse light comes from the sky (`sky`), from a key light with soft shadows (`shadow_map`),
//! from the ground and from the camera. Warp lines, weft lines, hem and seams are drawn on top as
//! ink. `raster` calls the shader once per pixel and visible facet.

use super::camera::Camera;
use super::floor::{Floor, FloorShadow};
use super::scene::{Scene, Surface};
use super::screen::ScreenFacet;
use super::shadow_map::ShadowMap;
use super::sky::SkyLight;
use super::smooth::{Border, bulged};
use super::tessellation::{Facet, Part, Tessellation, Vertex};
use super::vector::{Vector, add, cross, dot, scale, subtract, unit};
use crate::picture::{Colour, decode};

// The lights were chosen by eye on a draped cube and a pleated curtain. A surface that faces the
// key light is a little brighter than its colour, and the ground of a fold is a third as bright.

/// Irradiance of the whole sky on an upward surface. With 1 a surface shows its exact colour.
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

/// Texels along the shadow map of the key light, over the longer side of the picture. A texel is
/// about a pixel.
const KEY_TEXELS: f64 = 1.0;
/// Smallest and largest number of texels along the shadow map of the key light.
const KEY_TEXELS_WITHIN: [f64; 2] = [900.0, 3000.0];

/// Radius of the filter of the shadow map of the key light, in texels.
const KEY_FILTER: i32 = 1;

/// Strength of the shadows on the floor. With 1 they would be as dark as on a white body.
const FLOOR_SHADE: f64 = 0.75;

/// Distance from the middle of the floor, over its size, where its shadows begin to fade.
const FLOOR_FADE: f64 = 0.55;

/// Colours of the warp lines, the weft lines, the hem and the seams.
const INK: [Colour; 4] = [[34, 58, 110], [150, 54, 44], [40, 44, 52], [40, 44, 52]];

/// Opacity of the warp lines, the weft lines, the hem and the seams.
const INK_OPACITY: [f64; 4] = [0.72, 0.72, 0.5, 0.75];

/// Linear light above which light is compressed.
const SHOULDER: f64 = 0.6;
/// Range of linear light into which brighter light is compressed.
const SHOULDER_ROOM: f64 = 1.0 - SHOULDER;

/// Fraction of white in the colour of a rim.
const RIM_WHITE: f64 = 0.25;

/// Width of a line over the height of the picture. A line is at least a pixel wide.
const LINE_WIDTH: f64 = 1.6 / 900.0;

/// Distance of lines, in line widths, below which they fade into an even tone.
const LINES_MERGE: f64 = 3.0;

/// Shapes of a scene with the light of the sky on them.
pub(crate) struct Lit<'a> {
    pub(crate) tessellation: &'a Tessellation,
    pub(crate) sky: &'a SkyLight,
    pub(crate) floor: Option<&'a Floor>,
}

/// Shader of the points of a picture.
pub(crate) struct Shader<'a> {
    scene: &'a Scene<'a>,
    tessellation: &'a Tessellation,
    camera: &'a Camera,
    /// Colours of front and back of each cloth and then of each body, in linear light.
    colours: Vec<[Vector; 2]>,
    /// Colours of front and back of each triangle, in linear light, for each cloth and then for
    /// each body. Empty for a surface without them.
    sides: Vec<Vec<[Vector; 2]>>,
    /// Linear light of the colour of each vertex, where some surface has one per vertex.
    tints: Vec<[f32; 3]>,
    /// Material coordinates of each vertex, where some surface has them, in m.
    coordinates: Vec<[f64; 2]>,
    inks: [Vector; 4],
    sky: &'a SkyLight,
    key: ShadowMap,
    floor: Option<(&'a Floor, FloorShadow)>,
    /// Linear light of the ground at the top and at the bottom.
    ground: [Vector; 2],
    /// Width of lines, in pixels.
    line_width: f64,
}

impl<'a> Shader<'a> {
    /// Prepares the lights of a `scene` for a `camera`.
    pub(crate) fn new(lit: &Lit<'a>, scene: &'a Scene<'a>, camera: &'a Camera) -> Shader<'a> {
        let (sine, cosine) = KEY_AZIMUTH.sin_cos();
        // Horizontal directions from the scene to the camera and to the left of it.
        let right = camera.right();
        let towards = unit(cross(right, [0.0, 1.0, 0.0]));
        let level = subtract(scale(towards, cosine), scale(right, sine));
        let (rise, flat) = KEY_ELEVATION.sin_cos();
        let direction = add(scale(level, flat), [0.0, rise, 0.0]);

        let surfaces = || scene.cloths.iter().chain(&scene.bodies);
        let tessellation = lit.tessellation;
        let side = f64::from(camera.width().max(camera.height()));
        let texels = (KEY_TEXELS * side).clamp(KEY_TEXELS_WITHIN[0], KEY_TEXELS_WITHIN[1]);

        // Colours and coordinates are computed only if some surface has them.
        let is_tinted = surfaces().any(|surface| surface.tints.is_some());
        let has_lines = surfaces().any(|surface| surface.coordinates.is_some());
        let vertices = &tessellation.vertices;
        let tint = |vertex: &Vertex| {
            let surface = surface(scene, vertex.part);
            surface.tints.map_or([0.0; 3], |tints| {
                let tint = |corner: usize| tints[corner].map(decode);
                vertex.source.value(surface.triangles, tint).map(|light| light as f32)
            })
        };
        let place = |vertex: &Vertex| {
            let surface = surface(scene, vertex.part);
            surface.coordinates.map_or([0.0; 2], |all| {
                let place = |corner: usize| [all[2 * corner], all[2 * corner + 1]];
                vertex.source.value(surface.triangles, place)
            })
        };
        let sides = |surface: &Surface<'_>| {
            let all = surface.sides.unwrap_or_default().iter();
            all.map(|sides| sides.map(|colour| colour.map(decode))).collect()
        };

        Shader {
            scene,
            tessellation,
            camera,
            colours: surfaces().map(|s| [s.front, s.back].map(|c| c.map(decode))).collect(),
            sides: surfaces().map(sides).collect(),
            tints: if is_tinted { vertices.iter().map(tint).collect() } else { Vec::new() },
            coordinates: if has_lines { vertices.iter().map(place).collect() } else { Vec::new() },
            inks: INK.map(|ink| ink.map(decode)),
            sky: lit.sky,
            key: ShadowMap::new(tessellation, direction, texels as usize),
            floor: lit.floor.map(|floor| (floor, FloorShadow::new(floor, tessellation, direction))),
            ground: [scene.ground.top, scene.ground.bottom].map(|colour| colour.map(decode)),
            line_width: (LINE_WIDTH * f64::from(camera.height())).max(1.0),
        }
    }

    /// Returns the linear colour of the ground at the point `at` of the picture, in pixels.
    pub(crate) fn ground(&self, at: [f64; 2]) -> Vector {
        let part = at[1] / f64::from(self.camera.height());
        let [top, bottom] = self.ground;
        let colour = add(scale(top, 1.0 - part), scale(bottom, part));
        let floor = self.floor.as_ref().and_then(|(floor, shadow)| {
            let point = floor.met(self.camera.eye(), self.camera.ray(at))?;
            let fade = ((1.0 - floor.away(point)) / (1.0 - FLOOR_FADE)).clamp(0.0, 1.0);
            (fade > 0.0).then_some((floor, shadow, point, fade))
        });
        let Some((floor, shadow, point, fade)) = floor else { return colour };
        let cosine = self.key.direction[1];
        let lost =
            SKY * (1.0 - floor.value(&self.sky.floor, point)) + KEY * cosine * shadow.at(point);
        scale(colour, 1.0 - FLOOR_SHADE * fade * lost / (SKY + KEY * cosine))
    }

    /// Returns the linear colour of the facet `item` at the point `at` of the picture, in pixels.
    pub(crate) fn colour(&self, item: &ScreenFacet, at: [f64; 2]) -> Vector {
        let facet = &self.tessellation.facets[item.number as usize];
        let corners = self.tessellation.corners(facet);
        let weights = item.barycentric(at[0], at[1]);
        let mix = |values: [Vector; 3]| -> Vector {
            std::array::from_fn(|k| (0..3).map(|c| weights[c] * values[c][k]).sum())
        };

        let position = mix(corners.map(|corner| corner.position));
        let to_eye = unit(subtract(self.camera.eye(), position));
        let smooth = unit(mix(corners.map(|corner| corner.normal)));
        let front = dot(self.tessellation.area_vector(facet), to_eye) >= 0.0;
        let side = match facet.part {
            Part::Rim(_) => dot(smooth, to_eye).signum(),
            _ if front => 1.0,
            _ => -1.0,
        };
        let normal = scale(smooth, side);

        // Light that arrives at the point.
        let sky = self.sky.at(facet, side > 0.0);
        let sky = (0..3).map(|c| weights[c] * sky[c]).sum::<f64>();
        let cosine = dot(normal, self.key.direction).max(0.0);
        let key = if cosine > 0.0 {
            let curved = corners.map(|corner| (corner.position, scale(corner.normal, side)));
            let place = bulged(position, curved, weights);
            cosine * self.key.visibility(place, normal, KEY_FILTER)
        } else {
            0.0
        };
        let light = SKY * sky
            + KEY * key
            + GROUND * 0.5 * (1.0 - normal[1])
            + HEADLIGHT * dot(normal, to_eye).max(0.0);

        // Colour of the material, with ink on cloth.
        let surface = surface(self.scene, facet.part);
        let part = match facet.part {
            Part::Cloth(k) | Part::Rim(k) => k,
            Part::Body(k) => self.scene.cloths.len() + k,
        };
        let [of_front, of_back] = match self.sides[part].get(corners[0].source.triangle as usize) {
            Some(sides) => *sides,
            None => self.colours[part],
        };
        let base = match (surface.tints, facet.part) {
            (Some(_), _) => {
                mix(facet.corners.map(|corner| self.tints[corner as usize].map(f64::from)))
            }
            (None, Part::Rim(_)) => of_front,
            (None, _) if front => of_front,
            (None, _) => of_back,
        };
        let base = match facet.part {
            Part::Rim(_) => base.map(|channel| channel + RIM_WHITE * (1.0 - channel)),
            _ => base,
        };
        let material = match facet.part {
            Part::Cloth(_) => {
                let ink = self.ink(item, facet, at);
                self.inks.iter().zip(ink).fold(base, |below, (ink, cover)| {
                    std::array::from_fn(|k| below[k] + cover * (ink[k] - below[k]))
                })
            }
            _ => base,
        };
        material.map(|channel| compressed(channel * light))
    }

    /// Returns the opacity of the warp lines, the weft lines, the hem and the seams at the point
    /// `x`, `y` of the `facet`, 0 to 1.
    fn ink(&self, item: &ScreenFacet, facet: &Facet, [x, y]: [f64; 2]) -> [f64; 4] {
        let surface = surface(self.scene, facet.part);
        let corners = self.tessellation.corners(facet);
        // Values at the point and one pixel to the right and down give the gradient in the picture.
        let [here, right, down] =
            [[x, y], [x + 1.0, y], [x, y + 1.0]].map(|[x, y]| item.barycentric(x, y));
        let with_slope = |values: [f64; 3]| {
            let value = |weights: [f64; 3]| (0..3).map(|c| weights[c] * values[c]).sum::<f64>();
            let here = value(here);
            let [across, along] = [right, down].map(|there| value(there) - here);
            (here, (across * across + along * along).sqrt())
        };

        let half = 0.5 * self.line_width;
        let cover = |pixels: f64| (half + 0.5 - pixels).clamp(0.0, 1.0);
        let mut ink = [0.0; 4];
        if surface.coordinates.is_some() {
            for (axis, ink) in ink.iter_mut().take(2).enumerate() {
                let places = facet.corners.map(|corner| self.coordinates[corner as usize][axis]);
                let (coordinate, slope) =
                    with_slope(places.map(|place| place / surface.line_spacing));
                // Lines that are too close merge into a tone of equal mean coverage, up to a limit.
                let apart = 1.0 / (slope * self.line_width);
                let sharp = (apart / LINES_MERGE - 1.0).clamp(0.0, 1.0);
                let line = cover((coordinate - coordinate.round()).abs() / slope);
                *ink = sharp * line + (1.0 - sharp) / apart.max(LINES_MERGE);
            }
        }

        let number = |border: Border| match border {
            Border::None => None,
            Border::Hem => Some(2),
            Border::Seam => Some(3),
        };
        for corner in 0..3 {
            if let Some(line) = number(facet.borders[corner]) {
                let mut weight = [0.0; 3];
                weight[corner] = 1.0;
                let (height, slope) = with_slope(weight);
                ink[line] = cover(height / slope - half).max(ink[line]);
            }
            if let Some(line) = number(corners[corner].border) {
                // A dot closes the line where only a corner of this facet touches the border.
                let [cx, cy] = item.pixels.corners[corner];
                let away = ((x - cx) * (x - cx) + (y - cy) * (y - cy)).sqrt();
                ink[line] = cover(away - half).max(ink[line]);
            }
        }
        [0, 1, 2, 3].map(|k| INK_OPACITY[k] * ink[k])
    }
}

/// Returns linear `light` as a picture can show it. Bright light is compressed, so that folds of
/// white cloth are seen.
fn compressed(light: f64) -> f64 {
    let above = light - SHOULDER;
    if above > 0.0 { 1.0 - SHOULDER_ROOM * (-above / SHOULDER_ROOM).exp() } else { light }
}

/// Returns the surface of the `scene` that a `part` belongs to.
fn surface<'a>(scene: &'a Scene<'a>, part: Part) -> &'a Surface<'a> {
    match part {
        Part::Cloth(k) | Part::Rim(k) => &scene.cloths[k],
        Part::Body(k) => &scene.bodies[k],
    }
}
