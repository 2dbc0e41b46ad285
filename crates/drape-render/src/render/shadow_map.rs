//! Shadow maps of distant lights.
//!
//! A shadow map holds for each texel the height towards the light of the first surface \[Wil78\]. A
//! point is lit if no surface lies above it. Looking up the texels around it and averaging the
//! answers gives soft edges: percentage-closer filtering \[RSC87\], here with weights that fall
//! linearly to zero, so that the edges show no steps. `sky` looks up many maps with few texels
//! each, `shade` looks up the map of the key light.

use super::tessellation::{Part, Tessellation, Vertex};
use super::triangle::PlaneTriangle;
use super::vector::{Vector, add, dot, perpendiculars, scale};

/// Texels around the shapes that stay empty.
const MARGIN: f64 = 2.0;

/// Normal offset, in texels: distance by which a point is moved out along its normal before the
/// look-up, so that the surface does not shade itself.
const NORMAL_OFFSET: f64 = 1.2;

/// Smallest cosine between normal and light that is used for the slope of a surface in the frame of
/// the light. A grazed surface has a steep slope. With a smaller cosine its look-ups would spread
/// over a depth in which other surfaces lie.
const LEAST_COSINE: f64 = 0.2;

/// Shadow map of one distant light: the height towards the light of the first surface in each
/// texel.
pub(crate) struct ShadowMap {
    /// Unit vector towards the light.
    pub(crate) direction: Vector,
    /// Unit vectors to the right of the map and down.
    axes: [Vector; 2],
    /// Position of the first texel along `axes`, in m.
    origin: [f64; 2],
    /// Side of a texel, in m.
    texel: f64,
    columns: usize,
    rows: usize,
    heights: Vec<f32>,
}

impl ShadowMap {
    /// Renders the map of the cloths and bodies of a `scene` for light from a `direction`, with
    /// `texels` texels along its longer side.
    pub(crate) fn new(scene: &Tessellation, direction: Vector, texels: usize) -> ShadowMap {
        let [right, up] = perpendiculars(scale(direction, -1.0));
        let axes = [right, scale(up, -1.0)];
        let flat = |vertex: &Vertex| axes.map(|axis| dot(vertex.position, axis));
        let (low, high) = scene
            .vertices
            .iter()
            .map(flat)
            .fold(([f64::MAX; 2], [f64::MIN; 2]), |(low, high), p| {
                ([0, 1].map(|k| p[k].min(low[k])), [0, 1].map(|k| p[k].max(high[k])))
            });

        let longest = (high[0] - low[0]).max(high[1] - low[1]).max(f64::MIN_POSITIVE);
        let texel = longest / (texels as f64 - 2.0 * MARGIN);
        let count = |k: usize| ((high[k] - low[k]) / texel + 2.0 * MARGIN).ceil() as usize;
        let [columns, rows] = [count(0), count(1)].map(|count| count.clamp(1, texels));

        let mut map = ShadowMap {
            direction,
            axes,
            origin: low.map(|low| low - MARGIN * texel),
            texel,
            columns,
            rows,
            heights: vec![f32::NEG_INFINITY; columns * rows],
        };
        map.draw(scene);
        map
    }

    /// Draws the facets of a `scene`. Rims cast no shadow.
    fn draw(&mut self, scene: &Tessellation) {
        let places: Vec<Vector> = scene
            .vertices
            .iter()
            .map(|vertex| {
                let [x, y, height] = self.to_light(vertex.position);
                [x, y, height - scene.depth_bias(vertex.part)]
            })
            .collect();

        let solid = scene.facets.iter().filter(|facet| !matches!(facet.part, Part::Rim(_)));
        for facet in solid {
            let corners = facet.corners.map(|corner| places[corner as usize]);
            let Some(triangle) = PlaneTriangle::new(corners.map(|[x, y, _]| [x, y])) else {
                continue;
            };
            let heights = corners.map(|[_, _, height]| height);
            let slope = triangle.slope(heights) as f32;
            triangle.spans(self.columns, triangle.rows(self.rows), |span| {
                let start = span.start(heights) as f32;
                let row = &mut self.heights[span.row * self.columns..][span.columns];
                for (offset, held) in (0_i32..).zip(row) {
                    let height = start + offset as f32 * slope;
                    *held = if height > *held { height } else { *held };
                }
            });
        }
    }

    /// Returns a `point` in the frame of the light: texels to the right and down, and height
    /// towards the light in m.
    fn to_light(&self, point: Vector) -> Vector {
        let place = |k: usize| (dot(point, self.axes[k]) - self.origin[k]) / self.texel;
        [place(0), place(1), dot(point, self.direction)]
    }

    /// Returns the fraction of the light that arrives at a `point` of a surface that faces the
    /// light, 0 to 1, filtered over a square with a `radius` in texels.
    pub(crate) fn visibility(&self, point: Vector, normal: Vector, radius: i32) -> f64 {
        let offset = NORMAL_OFFSET * self.texel;
        let [x, y, height] = self.to_light(add(point, scale(normal, offset)));
        let (x, y) = (x - 0.5, y - 0.5);
        // Positions are rounded down. The casts round towards 0, and saturate in a scene without
        // extent, in which texels have no size.
        let whole = |at: f64| (at as i64).saturating_sub(i64::from(at < 0.0));
        let (column, row) = (whole(x), whole(y));
        let (right, down) = ((x - column as f64) as f32, (y - row as f64) as f32);
        // Slopes of the plane of the surface, from one texel to the next.
        let cosine = dot(normal, self.direction).max(LEAST_COSINE);
        let slope = |k: usize| (-self.texel * dot(normal, self.axes[k]) / cosine) as f32;
        let [across, along] = [slope(0), slope(1)];
        // Beyond its border the map is empty, as on its border.
        let height = height as f32;
        let within = |at: i64, offset: i32, count: usize| {
            at.saturating_add(offset.into()).clamp(0, count as i64 - 1) as usize
        };

        let reach = (radius + 1) as f32;
        let (mut sum, mut whole) = (0.0, 0.0);
        for j in -radius..=radius + 1 {
            let away = j as f32 - down;
            let (of_row, base) = (reach - away.abs(), height + along * away);
            let heights = &self.heights[within(row, j, self.rows) * self.columns..];
            for i in -radius..=radius + 1 {
                let away = i as f32 - right;
                let weight = of_row * (reach - away.abs());
                let is_lit = heights[within(column, i, self.columns)] <= base + across * away;
                whole += weight;
                sum += if is_lit { weight } else { 0.0 };
            }
        }
        f64::from(sum / whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::tessellation::samples::{Disc, scene};

    #[test]
    fn a_shadow_ends_where_the_ray_past_the_edge_ends() {
        let disc = Disc { radius: 0.5, height: 1.0, pieces: 200 };
        let direction = [0.6, 0.8, 0.0];
        let map = ShadowMap::new(&scene(&[disc], [0.0, 1.0, 0.0], 0.8), direction, 1000);
        // On the level below by 1 the shadow is the disc moved by 0.75 away from the light.
        for (x, lit) in [(-1.27, 1.0), (-1.23, 0.0), (-0.27, 0.0), (-0.23, 1.0)] {
            let lit_fraction = map.visibility([x, 0.0, 0.0], [0.0, 1.0, 0.0], 2);
            assert_eq!(lit_fraction, lit, "at {x}");
        }
    }

    #[test]
    fn the_edge_of_a_shadow_is_a_ramp_without_steps() {
        let disc = Disc { radius: 0.5, height: 1.0, pieces: 200 };
        let direction = [0.6, 0.8, 0.0];
        let map = ShadowMap::new(&scene(&[disc], [0.0, 1.0, 0.0], 0.8), direction, 400);
        let places = (0..=250).map(|k| -1.27 + 2e-4 * f64::from(k));
        let lit: Vec<f64> =
            places.map(|x| map.visibility([x, 0.0, 0.1], [0.0, 1.0, 0.0], 2)).collect();
        let steps: Vec<f64> = lit.windows(2).map(|pair| pair[0] - pair[1]).collect();
        let largest = steps.iter().fold(0.0, |most: f64, step| most.max(*step));
        assert!(steps.iter().all(|step| *step >= -1e-6), "it falls");
        // The edge is some 15 mm wide; a step of 0.2 mm is a seventieth of it, at most twice in the
        // middle.
        assert!(largest < 0.05, "a step of {largest}");
        assert!(lit[0] > 0.99 && lit[250] < 0.01, "from {} to {}", lit[0], lit[250]);
    }

    #[test]
    fn half_of_the_light_arrives_at_every_edge_of_a_shadow() {
        let disc = Disc { radius: 0.5, height: 1.0, pieces: 200 };
        let map = ShadowMap::new(&scene(&[disc], [0.0, 1.0, 0.0], 0.8), [0.0, 1.0, 0.0], 400);
        for turn in 0..8 {
            let (sine, cosine) = (0.125 * std::f64::consts::TAU * f64::from(turn)).sin_cos();
            let lit = map.visibility([0.5 * cosine, 0.0, 0.5 * sine], [0.0, 1.0, 0.0], 2);
            assert!((lit - 0.5).abs() < 0.2, "turn {turn}: {lit}");
        }
    }

    #[test]
    fn a_tilted_plane_does_not_shade_itself() {
        let disc = Disc { radius: 0.5, height: 0.0, pieces: 60 };
        for sine in [0.99, 0.97, 0.7, 0.1] {
            let direction = [sine, (1.0f64 - sine * sine).sqrt(), 0.0];
            let map =
                ShadowMap::new(&scene(std::slice::from_ref(&disc), [0.0; 3], 0.8), direction, 300);
            for k in 0..40 {
                let place = [0.02 * f64::from(k) - 0.4, 0.0, 0.011 * f64::from(k) - 0.2];
                let lit = map.visibility(place, [0.0, 1.0, 0.0], 2);
                assert_eq!(lit, 1.0, "at {place:?} with {direction:?}");
            }
        }
    }
}
