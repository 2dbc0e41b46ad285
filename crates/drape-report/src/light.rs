use crate::facets::{Facet, Part, Stage};
use crate::triangle::Flat;
use crate::vector::{Vector, add, dot, frame, scale, subtract};
use rayon::prelude::*;

/// Directions of the sky. Fewer show as steps in the shade, more cost time.
const SKY_DIRECTIONS: usize = 64;

/// Texels along the side of the map of one sky direction.
///
/// Its texels are 0.3 % of the scene wide: finer ones would only sharpen single
/// directions of a light that is soft.
const SKY_TEXELS: usize = 320;

/// Half of the side of a map as a share of the scene's half diagonal: its border stays empty.
const MARGIN: f64 = 1.02;

/// Turn from one direction of the sky to the next, in rad, which spreads them evenly.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// Distance in texels by which a point is moved out along its normal before it looks for light,
/// lest its own facet shade it.
///
/// Over a blur of `n` texels a tilted facet rises by up to the `n`-fold, which comes on top.
const LIFT: f64 = 1.5;

/// What one distant light sees: the height towards it of the first surface in each texel.
pub(crate) struct LightMap {
    /// Unit vector towards the light.
    pub(crate) direction: Vector,
    axes: [Vector; 2],
    center: Vector,
    texel: f64,
    side: usize,
    heights: Vec<f32>,
}

impl LightMap {
    /// The map of all but the floor.
    pub(crate) fn new(stage: &Stage, direction: Vector, side: usize) -> LightMap {
        let mut map = LightMap {
            direction,
            axes: frame(scale(direction, -1.0)),
            center: stage.center,
            texel: 2.0 * MARGIN * stage.reach / side as f64,
            side,
            heights: vec![f32::NEG_INFINITY; side * side],
        };
        let solid = |facet: &&Facet| facet.part != Part::Floor;
        for facet in stage.facets.iter().filter(solid) {
            let corners = facet.corners.map(|corner| map.place(corner.position));
            let Some(flat) = Flat::new(corners.map(|[x, y, _]| [x, y])) else {
                continue;
            };
            let heights = corners.map(|[_, _, height]| height - stage.setback(facet.part));
            flat.cover([side, side], |x, y, shares| {
                let height = (0..3).map(|k| shares[k] * heights[k]).sum::<f64>() as f32;
                let held = &mut map.heights[y * side + x];
                *held = held.max(height);
            });
        }
        map
    }

    /// Texels to the right and down, and height towards the light in m.
    fn place(&self, point: Vector) -> Vector {
        let from_center = subtract(point, self.center);
        let half = 0.5 * self.side as f64;
        [
            half + dot(from_center, self.axes[0]) / self.texel,
            half - dot(from_center, self.axes[1]) / self.texel,
            dot(from_center, self.direction),
        ]
    }

    /// Share of the light that reaches a point of a surface, blurred over a square of texels.
    pub(crate) fn reaches(&self, point: Vector, normal: Vector, blur: i64) -> f64 {
        let lift = (LIFT + blur as f64) * self.texel;
        let [x, y, height] = self.place(add(point, scale(normal, lift)));
        let (column, row) = ((x - 0.5).floor(), (y - 0.5).floor());
        let (right, down) = (x - 0.5 - column, y - 0.5 - row);
        // Beyond its border the map is as empty as on it.
        let within = |k: i64| k.clamp(0, self.side as i64 - 1) as usize;
        let lit = |column: i64, row: i64| -> f64 {
            let seen = self.heights[within(row) * self.side + within(column)];
            f64::from(u8::from(f64::from(seen) <= height))
        };
        // A box of whole texels, whose borders move with the point: bilinear at both ends.
        let weight = |k: i64, part: f64| match k {
            k if k == -blur => 1.0 - part,
            k if k == blur + 1 => part,
            _ => 1.0,
        };
        let mut sum = 0.0;
        for j in -blur..=blur + 1 {
            for i in -blur..=blur + 1 {
                sum += weight(i, right) * weight(j, down) * lit(column as i64 + i, row as i64 + j);
            }
        }
        sum / ((2 * blur + 1) * (2 * blur + 1)) as f64
    }

    /// Light of this direction of the sky at the corners of a facet, on its front and its back.
    fn share(&self, facet: &Facet) -> [[f64; 3]; 2] {
        let mut light = [[0.0; 3]; 2];
        for (corner, place) in facet.corners.iter().enumerate() {
            let slant = dot(place.normal, self.direction);
            let (side, normal) =
                if slant > 0.0 { (0, place.normal) } else { (1, scale(place.normal, -1.0)) };
            let part = self.reaches(place.position, normal, 0);
            light[side][corner] = 2.0 * slant.abs() * part / SKY_DIRECTIONS as f64;
        }
        light
    }
}

/// For each facet the light of an even sky at its corners, on its front and on its back.
///
/// 1 is the light of the whole sky on a level surface.
pub(crate) fn sky(stage: &Stage) -> Vec<[[f64; 3]; 2]> {
    let directions = (0..SKY_DIRECTIONS).into_par_iter();
    let shares: Vec<Vec<[[f64; 3]; 2]>> = directions
        .map(|k| {
            // Equal areas of the half sphere, turned by the golden angle from one to the next.
            let rise = (k as f64 + 0.5) / SKY_DIRECTIONS as f64;
            let level = (1.0 - rise * rise).sqrt();
            let (sine, cosine) = (k as f64 * GOLDEN_ANGLE).sin_cos();
            let direction = [level * sine, rise, level * cosine];
            let map = LightMap::new(stage, direction, SKY_TEXELS);
            let facets = stage.facets.iter();
            facets.map(|facet| map.share(facet)).collect()
        })
        .collect();
    let mut light = vec![[[0.0; 3]; 2]; stage.facets.len()];
    for share in &shares {
        for (sum, part) in light.as_flattened_mut().iter_mut().zip(share.as_flattened()) {
            for (sum, part) in sum.iter_mut().zip(part) {
                *sum += part;
            }
        }
    }
    light
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::facets::Corner;

    fn stage(facets: Vec<Facet>, center: Vector, reach: f64) -> Stage {
        Stage { facets, center, reach, setback: 0.0 }
    }

    /// A fan of triangles around the y axis, facing up, as a disc.
    fn disc(radius: f64, height: f64, pieces: usize) -> Vec<Facet> {
        let corner = |radius: f64, k: usize| {
            let (sine, cosine) = (k as f64 * std::f64::consts::TAU / pieces as f64).sin_cos();
            Corner {
                position: [radius * sine, height, radius * cosine],
                normal: [0.0, 1.0, 0.0],
                coordinates: [0.0; 2],
                tint: [0.0; 3],
                on_hem: false,
            }
        };
        let piece = |k| Facet {
            part: Part::Body(0),
            corners: [corner(0.0, 0), corner(radius, k), corner(radius, k + 1)],
            hems: [false; 3],
        };
        (0..pieces).map(piece).collect()
    }

    #[test]
    fn the_open_sky_lights_a_level_plate_fully_and_its_underside_not_at_all() {
        let facets = disc(1.0, 0.0, 40);
        for [front, back] in sky(&stage(facets, [0.0; 3], 1.5)) {
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
        let light = sky(&stage(facets, [0.0, 0.25, 0.0], 0.7))[0][0][0];
        let expected = 1.0 - radius * radius / (radius * radius + height * height);
        // Of 64 directions some three lie at the rim.
        assert!((light - expected).abs() < 0.04, "{light}, not {expected}");
    }

    #[test]
    fn a_shadow_ends_where_the_ray_past_the_edge_ends() {
        let facets = disc(0.5, 1.0, 200);
        let direction = [0.6, 0.8, 0.0];
        let map = LightMap::new(&stage(facets, [0.0, 1.0, 0.0], 0.8), direction, 1000);
        // On the level below by 1 the shadow is the disc moved by 0.75 away from the light.
        for (x, lit) in [(-1.27, 1.0), (-1.23, 0.0), (-0.27, 0.0), (-0.23, 1.0)] {
            let part = map.reaches([x, 0.0, 0.0], [0.0, 1.0, 0.0], 2);
            assert_eq!(part, lit, "at {x}");
        }
    }
}
