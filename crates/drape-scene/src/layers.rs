use drape_collide::Shape;
use drape_pattern::Placement;

use crate::file::SceneFile;
use crate::panel::Panel;
use crate::reader::Reader;
use crate::scene::Scene;

/// How much farther from the body what is of a layer starts than it would on the layer below, in m.
const STEP: f64 = 0.02;

/// The highest layer.
const HIGHEST: u32 = 20;

/// Height of the slabs in which triangles are looked for, in m: some edges of usual spacings.
const SLAB: f64 = 0.05;

/// Where a panel of a layer starts: farther out by so many steps. One that is bent to a cylinder has it grow about its axis,
/// one that is flat is moved to its right side.
pub(crate) fn worn_at(placement: Placement, layer: u32) -> Placement {
    let mut placement = placement;
    let way = STEP * f64::from(layer);
    // The axis of a cylinder with a negative radius is on the right side, and so is the body.
    let way = if placement.wrap.is_some_and(|radius| radius < 0.0) { -way } else { way };
    if let Some(radius) = &mut placement.wrap {
        *radius += way;
    }
    for axis in 0..3 {
        placement.translation[axis] += way * placement.rotation[axis][2];
    }
    placement
}

impl Reader<'_> {
    /// A layer, if one is given.
    pub(crate) fn layer(&mut self, key: &str, layer: Option<i64>, file: &SceneFile) -> Option<u32> {
        let layer = layer?;
        if !(0..=i64::from(HIGHEST)).contains(&layer) {
            let help = "a whole number: 0 is next to the body, and higher is outside";
            self.fail(key, format!("{layer} is not between 0 and {HIGHEST}"), help);
        } else if layer > 0 && !file.keeps_apart() {
            let message = "cloth does not meet cloth in this scene".into();
            self.fail(key, message, "leave it out, or keep surfaces apart (contact.surfaces)");
        }
        u32::try_from(layer).ok().filter(|layer| *layer <= HIGHEST)
    }

    /// Refuses panels that start between the body and what is of a lower layer; a panel of which a smaller part does so than
    /// is in order is told of.
    pub(crate) fn layers_are_in_order(&mut self, scene: &Scene) -> Vec<String> {
        let lowest = scene.panels.iter().map(|panel| panel.layer).min();
        let higher = scene.panels.iter().filter(|panel| Some(panel.layer) > lowest);
        let higher: Vec<&Panel> = higher.collect();
        let mut notes = Vec::new();
        if higher.is_empty() {
            return notes;
        }
        let ways = (0..scene.cloth.particles()).map(|particle| way_to(scene, particle));
        let ways: Vec<Option<Way>> = ways.collect();
        for panel in higher {
            let order = Order::of(panel, &ways, scene);
            let Some((below, [x, y, z])) = order.hidden_by else { continue };
            let fault = format!(
                "\"{}\" of layer {} starts inside \"{}\" of layer {}, between it and the body, near ({x:.4}, {y:.4}, {z:.4}) m",
                panel.name, panel.layer, below.name, below.layer
            );
            let help = "what is of a higher layer starts outside: raise its layer or its wrap, move it outwards, or swap the \
                        layers";
            if order.inside > order.outside {
                let garment = scene.garment_of(panel).unwrap_or(0);
                self.fail(&format!("garment[{garment}].layer"), fault, help);
            } else {
                notes.push(format!("{fault}: is that meant? {help}"));
            }
        }
        notes
    }
}

/// How a panel lies to those of lower layers.
struct Order<'a> {
    /// Area of lower layers that it is between and the body, and area of its own that a lower layer is between and the body,
    /// in m².
    inside: f64,
    outside: f64,
    /// The panel of a lower layer that most of it is inside of, and a place there, in m.
    hidden_by: Option<(&'a Panel, [f64; 3])>,
}

impl<'a> Order<'a> {
    fn of(panel: &Panel, ways: &[Option<Way>], scene: &'a Scene) -> Self {
        let lower = || scene.panels.iter().filter(|other| other.layer < panel.layer);
        let own = Slabs::of(scene, |particle| panel.particles().contains(&particle));
        let is_below = |particle| lower().any(|lower| lower.particles().contains(&particle));
        let below = Slabs::of(scene, is_below);
        let passes = |particle: usize, slabs: &Slabs| {
            ways[particle].is_some_and(|way| slabs.are_crossed(way))
        };
        let mut order = Self { inside: 0.0, outside: 0.0, hidden_by: None };
        let mut most = 0.0;
        for other in lower() {
            let hidden = other.particles().filter(|&particle| passes(particle, &own));
            let hidden: Vec<usize> = hidden.collect();
            let area = hidden.iter().map(|&particle| scene.cloth.areas()[particle]).sum();
            order.inside += area;
            if let (true, Some(&middle)) = (area > most, hidden.get(hidden.len() / 2)) {
                (most, order.hidden_by) = (area, Some((other, place(scene, middle))));
            }
        }
        if order.hidden_by.is_some() {
            let covers = panel.particles().filter(|&particle| passes(particle, &below));
            order.outside = covers.map(|particle| scene.cloth.areas()[particle]).sum();
        }
        order
    }
}

/// A straight way, by its ends, in m.
type Way = [[f64; 3]; 2];

fn place(scene: &Scene, particle: usize) -> [f64; 3] {
    [0, 1, 2].map(|axis| scene.positions[3 * particle + axis])
}

/// The straight way from a particle to the nearest place of a body, unless it is in one. Floors wear nothing.
fn way_to(scene: &Scene, particle: usize) -> Option<Way> {
    let from = place(scene, particle);
    let solid = scene
        .bodies
        .iter()
        .map(|moving| &moving.body)
        .filter(|body| !matches!(body.shape, Shape::Plane));
    let near = solid.filter_map(|body| body.signed_distance(from).ok());
    let near = near.min_by(|a, b| a.distance.total_cmp(&b.distance))?;
    let to = [0, 1, 2].map(|axis| from[axis] - near.distance * near.normal[axis]);
    (near.distance > 0.0).then_some([from, to])
}

/// Triangles by their heights.
struct Slabs {
    bottom: f64,
    slabs: Vec<Vec<[[f64; 3]; 3]>>,
}

impl Slabs {
    /// Those whose corners are all chosen.
    fn of(scene: &Scene, is_chosen: impl Fn(usize) -> bool) -> Self {
        let chosen = |t: &&[u32; 3]| t.iter().all(|&corner| is_chosen(corner as usize));
        let triangles = scene.cloth.triangles().iter().filter(chosen);
        let places = |t: &[u32; 3]| t.map(|corner| place(scene, corner as usize));
        let triangles: Vec<[[f64; 3]; 3]> = triangles.map(places).collect();
        let heights = triangles.iter().flatten().map(|corner| corner[1]);
        let mut own = Self { bottom: heights.fold(f64::INFINITY, f64::min), slabs: Vec::new() };
        for triangle in triangles {
            let slabs = own.numbers(&triangle);
            own.slabs.resize(own.slabs.len().max(slabs.end), Vec::new());
            own.slabs[slabs].iter_mut().for_each(|slab| slab.push(triangle));
        }
        own
    }

    /// The slabs that some points and what is between them are in.
    fn numbers(&self, points: &[[f64; 3]]) -> std::ops::Range<usize> {
        let heights = points.iter().map(|point| point[1]);
        let [low, high] = heights.fold([f64::MAX, f64::MIN], |[a, b], y| [a.min(y), b.max(y)]);
        let number = |y: f64| ((y - self.bottom) / SLAB) as usize;
        if high < self.bottom { 0..0 } else { number(low)..number(high) + 1 }
    }

    /// Whether a straight way goes through one of them.
    fn are_crossed(&self, way: Way) -> bool {
        let numbers = self.numbers(&way);
        let end = numbers.end.min(self.slabs.len());
        let slabs = self.slabs.get(numbers.start..end).unwrap_or_default();
        slabs.iter().flatten().any(|&triangle| is_crossed(triangle, way))
    }
}

/// Whether a straight way goes through a triangle, by the signs of the volumes that it spans with the sides.
fn is_crossed([a, b, c]: [[f64; 3]; 3], [from, to]: Way) -> bool {
    let volume = |p: [f64; 3], q: [f64; 3], r: [f64; 3], s: [f64; 3]| {
        let [u, v, w] = [q, r, s].map(|x| [0, 1, 2].map(|axis| x[axis] - p[axis]));
        u[0] * (v[1] * w[2] - v[2] * w[1])
            + u[1] * (v[2] * w[0] - v[0] * w[2])
            + u[2] * (v[0] * w[1] - v[1] * w[0])
    };
    let sides = [volume(from, a, b, c) > 0.0, volume(to, a, b, c) > 0.0];
    let around = [(a, b), (b, c), (c, a)].map(|(p, q)| volume(from, to, p, q) > 0.0);
    sides[0] != sides[1] && around[0] == around[1] && around[1] == around[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
        (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
    }

    #[test]
    fn a_layer_lets_the_cylinder_grow_about_its_axis_and_a_flat_panel_stand_off() {
        let flat = Placement::new([0.2, -0.7, 1.1], [0.1, 0.9, 0.2]);
        let [one, three] = [1, 3].map(|layer| worn_at(flat, layer).point([0.13, 0.2]));
        let normal = flat.rotation.map(|row| row[2]);
        let off = |point: [f64; 3]| -> f64 {
            let from = flat.point([0.13, 0.2]);
            (0..3).map(|axis| (point[axis] - from[axis]) * normal[axis]).sum()
        };
        assert!((off(one) - STEP).abs() < 1e-15 && (off(three) - 3.0 * STEP).abs() < 1e-15);
        for radius in [0.15, -0.15] {
            let bent = flat.with_wrap(Some(radius));
            let worn = worn_at(bent, 2);
            let axis = [0, 1, 2].map(|k| flat.point([0.0, 0.2])[k] - radius * normal[k]);
            for x in [-0.2, 0.0, 0.1] {
                let from = apart(worn.point([x, 0.2]), axis);
                assert!((from - 0.15 - 2.0 * STEP).abs() < 1e-14, "{from} m at {radius}");
            }
        }
        assert_eq!(worn_at(flat, 0), flat);
    }

    #[test]
    fn a_way_goes_through_a_triangle_or_past_it_from_either_side() {
        let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.1], [0.0, 1.0, 0.2]];
        let turned = [triangle[0], triangle[2], triangle[1]];
        for triangle in [triangle, turned] {
            for (x, y, through) in
                [(0.2, 0.3, true), (0.6, 0.6, false), (-0.1, 0.5, false), (0.5, -0.1, false)]
            {
                let way = [[x, y, 1.0], [x + 0.05, y, -1.0]];
                assert_eq!(is_crossed(triangle, way), through, "{x}, {y}");
                assert_eq!(is_crossed(triangle, [way[1], way[0]]), through, "{x}, {y}");
                // It ends before it.
                assert!(!is_crossed(triangle, [way[0], [x, y, 0.5]]), "{x}, {y}");
            }
        }
    }
}
