//! Shadow maps of distant lights.
//!
//! A shadow map holds for each texel the height towards the light of the first surface \[Wil78\]; a
//! point is lit if no surface lies above it. Looking up a square of texels and averaging the
//! answers gives soft edges: percentage-closer filtering \[RSC87\]. `sky` looks up many maps with
//! one texel each, `shade` the map of the key light.

use super::tessellation::{Facet, Part, Tessellation};
use super::triangle::PlaneTriangle;
use super::vector::{Vector, add, dot, perpendiculars, scale, subtract};

/// Half of the side of a map over the radius of the scene: its border stays empty.
const MARGIN: f64 = 1.02;

/// Normal offset: distance by which a point is moved out along its normal before the look-up, in
/// texels, so that its own facet does not shade it.
///
/// Over a filter of `n` texels a tilted facet rises by up to `n` texels more, which are added.
const NORMAL_OFFSET: f64 = 1.5;

/// Shadow map of one distant light: the height towards the light of the first surface in each
/// texel.
pub(crate) struct ShadowMap {
    /// Unit vector towards the light.
    pub(crate) direction: Vector,
    axes: [Vector; 2],
    center: Vector,
    /// Side of a texel, in m.
    texel: f64,
    /// Number of texels along a side.
    side: usize,
    heights: Vec<f32>,
}

impl ShadowMap {
    /// Renders the map of cloths and bodies.
    pub(crate) fn new(scene: &Tessellation, direction: Vector, side: usize) -> ShadowMap {
        let mut map = ShadowMap {
            direction,
            axes: perpendiculars(scale(direction, -1.0)),
            center: scene.bounds.center,
            texel: 2.0 * MARGIN * scene.bounds.radius / side as f64,
            side,
            heights: vec![f32::NEG_INFINITY; side * side],
        };
        let solid = |facet: &&Facet| facet.part != Part::Floor;
        for facet in scene.facets.iter().filter(solid) {
            let corners = facet.corners.map(|corner| map.to_light(corner.position));
            let Some(triangle) = PlaneTriangle::new(corners.map(|[x, y, _]| [x, y])) else {
                continue;
            };
            let heights = corners.map(|[_, _, height]| height - scene.depth_bias(facet.part));
            triangle.rasterize(side, triangle.rows(side), |x, y, coordinates| {
                let height = (0..3).map(|k| coordinates[k] * heights[k]).sum::<f64>() as f32;
                let held = &mut map.heights[y * side + x];
                *held = held.max(height);
            });
        }
        map
    }

    /// Returns a point in the frame of the light: texels to the right and down, and height towards
    /// the light in m.
    fn to_light(&self, point: Vector) -> Vector {
        let from_center = subtract(point, self.center);
        let half = 0.5 * self.side as f64;
        [
            half + dot(from_center, self.axes[0]) / self.texel,
            half - dot(from_center, self.axes[1]) / self.texel,
            dot(from_center, self.direction),
        ]
    }

    /// Returns the fraction of the light that arrives at a point of a surface, filtered over a
    /// square with a radius in texels, 0 to 1.
    pub(crate) fn visibility(&self, point: Vector, normal: Vector, radius: i64) -> f64 {
        let offset = (NORMAL_OFFSET + radius as f64) * self.texel;
        let [x, y, height] = self.to_light(add(point, scale(normal, offset)));
        let (column, row) = ((x - 0.5).floor(), (y - 0.5).floor());
        let (right, down) = (x - 0.5 - column, y - 0.5 - row);
        // Beyond its border the map is as empty as on it. In a scene without extent texels have no
        // size, and the cast below saturates: the sum must saturate too.
        let within = |k: i64| k.clamp(0, self.side as i64 - 1) as usize;
        let lit = |column: i64, row: i64| -> f64 {
            let first = self.heights[within(row) * self.side + within(column)];
            f64::from(u8::from(f64::from(first) <= height))
        };
        // A box of whole texels whose borders move with the point: bilinear at both ends.
        let weight = |k: i64, part: f64| match k {
            k if k == -radius => 1.0 - part,
            k if k == radius + 1 => part,
            _ => 1.0,
        };
        let mut sum = 0.0;
        for j in -radius..=radius + 1 {
            for i in -radius..=radius + 1 {
                let (column, row) = (column as i64, row as i64);
                sum += weight(i, right)
                    * weight(j, down)
                    * lit(column.saturating_add(i), row.saturating_add(j));
            }
        }
        sum / ((2 * radius + 1) * (2 * radius + 1)) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::tessellation::samples::{disc, scene};

    #[test]
    fn a_shadow_ends_where_the_ray_past_the_edge_ends() {
        let facets = disc(0.5, 1.0, 200);
        let direction = [0.6, 0.8, 0.0];
        let map = ShadowMap::new(&scene(facets, [0.0, 1.0, 0.0], 0.8), direction, 1000);
        // On the level below by 1 the shadow is the disc moved by 0.75 away from the light.
        for (x, lit) in [(-1.27, 1.0), (-1.23, 0.0), (-0.27, 0.0), (-0.23, 1.0)] {
            let lit_fraction = map.visibility([x, 0.0, 0.0], [0.0, 1.0, 0.0], 2);
            assert_eq!(lit_fraction, lit, "at {x}");
        }
    }
}
