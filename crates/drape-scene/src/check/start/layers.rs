//! Order of layers at the start: a panel of a higher layer has to start outside all panels of lower
//! layers.
//!
//! A particle is inside a panel if the straight line from it to the nearest point of a body passes
//! through the panel.

use drape_collide::Shape;

use crate::check::checker::Checker;
use crate::scene::Scene;
use crate::scene::panel::Panel;

/// Height of the slabs in which triangles are looked for, in m: some edges of usual spacings.
const SLAB: f64 = 0.05;

/// Refuses panels of `scene` that start between the body and a panel of a lower layer. Returns
/// notes on panels of which only the smaller area starts there.
pub(crate) fn check_layers(checker: &mut Checker<'_>, scene: &Scene) -> Vec<String> {
    let lowest = scene.panels.iter().map(|panel| panel.layer).min();
    let higher = scene.panels.iter().filter(|panel| Some(panel.layer) > lowest);
    let higher: Vec<&Panel> = higher.collect();
    let mut notes = Vec::new();
    if higher.is_empty() {
        return notes;
    }
    let lines = (0..scene.cloth.particle_count()).map(|particle| line_to_body(scene, particle));
    let lines: Vec<Option<Line>> = lines.collect();
    for panel in higher {
        let order = Order::new(panel, &lines, scene);
        let Some(Hidden { panel: below, place: [x, y, z] }) = order.hidden_by else { continue };
        let fault = format!(
            "\"{}\" of layer {} starts inside \"{}\" of layer {}, between it and the body, near ({x:.4}, {y:.4}, {z:.4}) m",
            panel.name, panel.layer, below.name, below.layer
        );
        let help = "what is of a higher layer starts outside: raise its layer or its wrap, move it outwards, or swap the \
                    layers";
        if order.inside > order.outside {
            let garment = scene.garment_of(panel).unwrap_or(0);
            checker.fail(&format!("garment[{garment}].layer"), fault, help);
        } else {
            notes.push(format!("{fault}: is that meant? {help}"));
        }
    }
    notes
}

/// Order of one panel relative to the panels of lower layers.
struct Order<'a> {
    /// Area of lower layers that lies outside the panel, in m².
    inside: f64,
    /// Area of the panel that lies outside a lower layer, in m².
    outside: f64,
    /// Panel of a lower layer inside which most of the panel lies.
    hidden_by: Option<Hidden<'a>>,
}

/// Panel that hides another one.
struct Hidden<'a> {
    panel: &'a Panel,
    /// A place of it, in m.
    place: [f64; 3],
}

impl<'a> Order<'a> {
    fn new(panel: &Panel, lines: &[Option<Line>], scene: &'a Scene) -> Self {
        let lower = || scene.panels.iter().filter(|other| other.layer < panel.layer);
        let of_panel = Slabs::new(scene, |particle| panel.particles().contains(&particle));
        let is_below = |particle| lower().any(|lower| lower.particles().contains(&particle));
        let below = Slabs::new(scene, is_below);
        let passes = |particle: usize, slabs: &Slabs| {
            lines[particle].is_some_and(|line| slabs.are_crossed(line))
        };
        let mut order = Self { inside: 0.0, outside: 0.0, hidden_by: None };
        let mut most = 0.0;
        for other in lower() {
            let hidden = other.particles().filter(|&particle| passes(particle, &of_panel));
            let hidden: Vec<usize> = hidden.collect();
            let area = hidden.iter().map(|&particle| scene.cloth.areas()[particle]).sum();
            order.inside += area;
            if let (true, Some(&middle)) = (area > most, hidden.get(hidden.len() / 2)) {
                most = area;
                order.hidden_by = Some(Hidden { panel: other, place: place(scene, middle) });
            }
        }
        if order.hidden_by.is_some() {
            let covers = panel.particles().filter(|&particle| passes(particle, &below));
            order.outside = covers.map(|particle| scene.cloth.areas()[particle]).sum();
        }
        order
    }
}

/// Straight line between two points, in m.
#[derive(Debug, Clone, Copy)]
struct Line {
    from: [f64; 3],
    to: [f64; 3],
}

fn place(scene: &Scene, particle: usize) -> [f64; 3] {
    [0, 1, 2].map(|axis| scene.start.positions[3 * particle + axis])
}

/// Returns the line from `particle` to the nearest point of a body, or `None` if the particle is
/// inside a body. Nobody wears cloth on a floor, so floors do not count.
fn line_to_body(scene: &Scene, particle: usize) -> Option<Line> {
    let from = place(scene, particle);
    let bodies = scene.bodies.iter().map(|moving| &moving.body);
    let solid = bodies.filter(|body| !matches!(body.shape, Shape::Plane));
    let near = solid.filter_map(|body| body.signed_distance(from).ok());
    let near = near.min_by(|a, b| a.distance.total_cmp(&b.distance))?;
    let to = [0, 1, 2].map(|axis| from[axis] - near.distance * near.normal[axis]);
    (near.distance > 0.0).then_some(Line { from, to })
}

/// Triangles by their heights.
struct Slabs {
    bottom: f64,
    slabs: Vec<Vec<[[f64; 3]; 3]>>,
}

impl Slabs {
    /// Returns the triangles of `scene` whose corners all pass `is_chosen`.
    fn new(scene: &Scene, is_chosen: impl Fn(usize) -> bool) -> Self {
        let chosen = |t: &&[u32; 3]| t.iter().all(|&corner| is_chosen(corner as usize));
        let triangles = scene.cloth.triangles().iter().filter(chosen);
        let places = |t: &[u32; 3]| t.map(|corner| place(scene, corner as usize));
        let triangles: Vec<[[f64; 3]; 3]> = triangles.map(places).collect();
        let heights = triangles.iter().flatten().map(|corner| corner[1]);
        let mut sorted = Self { bottom: heights.fold(f64::INFINITY, f64::min), slabs: Vec::new() };
        for triangle in triangles {
            let slabs = sorted.numbers(&triangle);
            sorted.slabs.resize(sorted.slabs.len().max(slabs.end), Vec::new());
            sorted.slabs[slabs].iter_mut().for_each(|slab| slab.push(triangle));
        }
        sorted
    }

    /// Returns the numbers of the slabs between the lowest and the highest of `points`.
    fn numbers(&self, points: &[[f64; 3]]) -> std::ops::Range<usize> {
        let heights = points.iter().map(|point| point[1]);
        let [low, high] = heights.fold([f64::MAX, f64::MIN], |[a, b], y| [a.min(y), b.max(y)]);
        let number = |y: f64| ((y - self.bottom) / SLAB) as usize;
        if high < self.bottom { 0..0 } else { number(low)..number(high) + 1 }
    }

    /// Returns whether `line` goes through one of the triangles.
    fn are_crossed(&self, line: Line) -> bool {
        let numbers = self.numbers(&[line.from, line.to]);
        let end = numbers.end.min(self.slabs.len());
        let slabs = self.slabs.get(numbers.start..end).unwrap_or_default();
        slabs.iter().flatten().any(|&triangle| is_crossed(triangle, line))
    }
}

/// Returns whether the line goes through the triangle `a`, `b`, `c`, by the signs of the volumes
/// that the line spans with the sides.
fn is_crossed([a, b, c]: [[f64; 3]; 3], Line { from, to }: Line) -> bool {
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

    #[test]
    fn a_line_goes_through_a_triangle_or_past_it_from_either_side() {
        let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.1], [0.0, 1.0, 0.2]];
        let turned = [triangle[0], triangle[2], triangle[1]];
        for triangle in [triangle, turned] {
            for (x, y, through) in
                [(0.2, 0.3, true), (0.6, 0.6, false), (-0.1, 0.5, false), (0.5, -0.1, false)]
            {
                let [from, to] = [[x, y, 1.0], [x + 0.05, y, -1.0]];
                assert_eq!(is_crossed(triangle, Line { from, to }), through, "{x}, {y}");
                assert_eq!(is_crossed(triangle, Line { from: to, to: from }), through, "{x}, {y}");
                // It ends before it.
                assert!(!is_crossed(triangle, Line { from, to: [x, y, 0.5] }), "{x}, {y}");
            }
        }
    }
}
