use crate::camera::Camera;
use crate::facets::{FLOOR_REACH, Part, Stage};
use crate::light::{LightMap, sky};
use crate::render::Projected;
use crate::scene::{Colour, Scene, Surface};
use crate::vector::{Vector, add, cross, dot, norm, scale, subtract, unit};
use crate::view::View;

// The lights, chosen by eye on a draped cube and a pleated curtain: a surface that faces the main
// light is a little brighter than its colour, the ground of a fold a third as bright.

/// Light of the whole sky on a level surface; 1 shows a colour as it is given.
const SKY: f64 = 0.62;

/// Light of the main light on a surface that faces it.
const SUN: f64 = 0.62;

/// Light from below on a surface that faces down.
const BOUNCE: f64 = 0.16;

/// Light from the eye, which keeps the form readable inside folds.
const HEAD: f64 = 0.1;

/// Height of the main light over the horizon, in rad.
const SUN_RISE: f64 = 0.85;

/// Direction of the main light to the left of the eye, in rad.
const SUN_LEFT: f64 = 0.95;

/// Texels along the side of the map of the main light, and those by which it is blurred: at the
/// usual size a texel is about a pixel, and the blur hides its steps.
const SUN_TEXELS: usize = 1400;
const SUN_BLUR: i64 = 2;

/// The same for the shadow on the floor: softer, as the floor is no more than a hint.
const FLOOR_TEXELS: usize = 200;
const FLOOR_BLUR: i64 = 2;

/// Strength of the shadows on the floor; 1 would be as dark as on a white body.
const FLOOR_SHADE: f64 = 0.75;

/// Colours of the warp lines, the weft lines and the hem.
const INK: [Colour; 3] = [[34, 58, 110], [150, 54, 44], [40, 44, 52]];

/// How far a line covers the cloth below it.
const INK_COVER: [f64; 3] = [0.72, 0.72, 0.75];

/// Width of a line as a share of the picture's height; a pixel at least.
const LINE_WIDTH: f64 = 1.6 / 900.0;

/// A distance of lines in line widths below which they fade into an even tone.
const LINES_MERGE: f64 = 3.0;

/// All that colours a point.
pub(crate) struct Shader<'a> {
    scene: &'a Scene<'a>,
    eye: Vector,
    /// Front and back of each cloth and then of each body, in linear light.
    tints: Vec<[Vector; 2]>,
    inks: [Vector; 3],
    sky: Vec<[[f64; 3]; 2]>,
    sun: LightMap,
    sun_on_floor: LightMap,
    center: Vector,
    reach: f64,
    line_width: f64,
}

impl<'a> Shader<'a> {
    pub(crate) fn new(scene: &'a Scene, stage: &Stage, camera: &Camera, view: &View) -> Shader<'a> {
        let (sine, cosine) = SUN_LEFT.sin_cos();
        // Level directions from the scene to the eye and to the left of it.
        let right = camera.right();
        let towards = unit(cross(right, [0.0, 1.0, 0.0]));
        let level = subtract(scale(towards, cosine), scale(right, sine));
        let (rise, flat) = SUN_RISE.sin_cos();
        let direction = add(scale(level, flat), [0.0, rise, 0.0]);
        let surfaces = scene.cloths.iter().chain(&scene.bodies);
        Shader {
            tints: surfaces
                .map(|surface| [surface.front, surface.back].map(|c| c.map(decode)))
                .collect(),
            inks: INK.map(|ink| ink.map(decode)),
            scene,
            eye: camera.eye(),
            sky: sky(stage),
            sun: LightMap::new(stage, direction, SUN_TEXELS),
            sun_on_floor: LightMap::new(stage, direction, FLOOR_TEXELS),
            center: stage.center,
            reach: stage.reach,
            line_width: (LINE_WIDTH * f64::from(view.height)).max(1.0),
        }
    }

    /// Linear colour of a facet at a point of the picture, in pixels.
    pub(crate) fn colour(&self, item: &Projected, x: f64, y: f64) -> Vector {
        let facet = item.facet;
        let shares = shares(item, x, y);
        let mix = |values: [Vector; 3]| -> Vector {
            std::array::from_fn(|k| (0..3).map(|c| shares[c] * values[c][k]).sum())
        };
        let position = mix(facet.corners.map(|corner| corner.position));
        let to_eye = unit(subtract(self.eye, position));
        let smooth = unit(mix(facet.corners.map(|corner| corner.normal)));
        let front = dot(facet.area(), to_eye) >= 0.0;
        let normal = if front { smooth } else { scale(smooth, -1.0) };
        let sky = self.sky[item.index][usize::from(!front)];
        let sky = (0..3).map(|c| shares[c] * sky[c]).sum::<f64>();
        let slant = dot(normal, self.sun.direction).max(0.0);
        let (map, blur) = match facet.part {
            Part::Floor => (&self.sun_on_floor, FLOOR_BLUR),
            _ => (&self.sun, SUN_BLUR),
        };
        let lit = if slant > 0.0 { slant * map.reaches(position, normal, blur) } else { 0.0 };

        if facet.part == Part::Floor {
            let full = SKY + SUN * slant;
            let shade = 1.0 - (SKY * sky + SUN * lit) / full;
            let away = norm([position[0] - self.center[0], 0.0, position[2] - self.center[2]]);
            let fade = (1.0 - away / (0.95 * FLOOR_REACH * self.reach)).clamp(0.0, 1.0);
            let fade = fade.min(0.4) / 0.4;
            return [1.0 - FLOOR_SHADE * shade * fade; 3];
        }
        let light = SKY * sky
            + SUN * lit
            + BOUNCE * 0.5 * (1.0 - normal[1])
            + HEAD * dot(normal, to_eye).max(0.0);
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

    /// How far the warp lines, the weft lines and the hem cover a point.
    fn ink(&self, item: &Projected, surface: &Surface, [x, y]: [f64; 2]) -> [f64; 3] {
        let Part::Cloth(_) = item.facet.part else {
            return [0.0; 3];
        };
        // Values at the point and one pixel to the right and down give the slope in the picture.
        let [here, right, down] =
            [[x, y], [x + 1.0, y], [x, y + 1.0]].map(|[x, y]| shares(item, x, y));
        let steep = |value: &dyn Fn([f64; 3]) -> f64| {
            let here = value(here);
            (here, (value(right) - here).hypot(value(down) - here))
        };
        let half = 0.5 * self.line_width;
        let cover = |pixels: f64| (half + 0.5 - pixels).clamp(0.0, 1.0);
        let mut ink = [0.0; 3];
        if surface.coordinates.is_some() {
            for (axis, ink) in ink.iter_mut().take(2).enumerate() {
                let along = |shares: [f64; 3]| {
                    (0..3).map(|c| shares[c] * item.facet.corners[c].coordinates[axis]).sum::<f64>()
                        / surface.line_spacing
                };
                let (place, slope) = steep(&along);
                // Lines that are too close leave their share of ink, within measure.
                let apart = 1.0 / (slope * self.line_width);
                let sharp = (apart / LINES_MERGE - 1.0).clamp(0.0, 1.0);
                let line = cover((place - place.round()).abs() / slope);
                *ink = sharp * line + (1.0 - sharp) / apart.max(LINES_MERGE);
            }
        }
        for corner in 0..3 {
            if item.facet.hems[corner] {
                let (share, slope) = steep(&|shares: [f64; 3]| shares[corner]);
                ink[2] = cover(share / slope - half).max(ink[2]);
            }
            if item.facet.corners[corner].on_hem {
                // A dot closes the line where only a tip of this facet touches the hem.
                let [cx, cy] = item.flat.corners[corner];
                ink[2] = cover((x - cx).hypot(y - cy) - half).max(ink[2]);
            }
        }
        [0, 1, 2].map(|k| INK_COVER[k] * ink[k])
    }
}

/// Shares of the corners at a point of the picture, as they are in space.
fn shares(item: &Projected, x: f64, y: f64) -> [f64; 3] {
    let flat = item.flat.shares(x, y);
    let near = [0, 1, 2].map(|k| flat[k] * item.nearness[k]);
    let sum: f64 = near.iter().sum();
    near.map(|n| n / sum)
}

/// Linear light of an sRGB value (IEC 61966-2-1).
pub(crate) fn decode(value: u8) -> f64 {
    let value = f64::from(value) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// The nearest sRGB value of linear light.
pub(crate) fn encode(light: f64) -> u8 {
    let light = light.clamp(0.0, 1.0);
    let value =
        if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
    (255.0 * value).round() as u8
}
