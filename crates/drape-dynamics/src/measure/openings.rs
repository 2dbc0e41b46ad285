//! Openings of garments, such as a waist or a hem: their lengths, their ease and the number of
//! their folds.

use std::collections::BTreeMap;

use drape_collide::section::{SectionPlane, convex_hull, encloses, perimeter};
use drape_collide::{Shape, equivalence_classes};
use serde_json::{Value, json};

use crate::measure::garment_parts::{FreeEdge, GarmentParts};
use crate::measure::vector::point_of;
use crate::world::World;

/// Smallest depth of a hollow between two folds, measured from the convex hull of the opening, in
/// m. Nodes of a drapemeter's specimen are counted by the same prominence.
const HOLLOW: f64 = 3e-3;

/// Closed row of free edges, such as a waist or a hem.
#[derive(Debug, Clone, PartialEq)]
struct Opening {
    /// Names of the edges in the form PANEL.EDGE.
    edges: Vec<String>,
    /// Particles in order, without a repetition of the first.
    particles: Vec<u32>,
    /// Length before deformation, in m.
    relaxed: f64,
}

/// Returns the measures of the openings of `world`: heights, lengths, folds, and the girth of the
/// body inside.
pub(crate) fn measures(parts: &GarmentParts, world: &World) -> Value {
    let positions = &world.state.positions;
    let bodies = world.contact.bodies().iter().zip(world.contact.triangulations());
    let bodies: Vec<_> = bodies.filter(|(body, _)| !matches!(body.shape, Shape::Plane)).collect();

    let openings = openings(parts, world);
    let measures = openings.iter().filter_map(|opening| {
        let points: Vec<[f64; 3]> =
            opening.particles.iter().map(|&particle| point_of(positions, particle)).collect();
        let length = perimeter(&points);
        let plane = SectionPlane::through(&points)?;
        let ring: Vec<[f64; 2]> = points.iter().map(|&point| plane.flat(point)).collect();

        // The section of the body within the opening is measured along its convex hull.
        let cuts = bodies.iter().flat_map(|(_, outline)| {
            outline.triangles.iter().flat_map(|triangle| {
                plane.cuts(triangle.map(|corner| outline.vertices[corner as usize]))
            })
        });
        let inside: Vec<[f64; 2]> = cuts.filter(|&point| encloses(&ring, point)).collect();
        let girth = (inside.len() > 2).then(|| perimeter(&convex_hull(inside)));
        let heights = points.iter().map(|point| point[1]);
        Some(json!({
            "edges": opening.edges,
            "height_mean": heights.sum::<f64>() / points.len() as f64,
            "length": length,
            "relaxed": opening.relaxed,
            "body": girth,
            "folds": folds(&ring),
            "ease": girth.map(|girth| length - girth),
        }))
    });
    Value::Array(measures.collect())
}

/// Returns the number of folds of the closed curve `ring`. It equals the number of hollows between
/// folds, in which the curve is deeper than [`HOLLOW`] inside its convex hull.
fn folds(ring: &[[f64; 2]]) -> usize {
    let hull = convex_hull(ring.to_vec());
    // A side near one point is often the side near the next.
    let mut near = 0;
    let is_hollow: Vec<bool> = ring
        .iter()
        .map(|&point| match shallow_side(point, &hull, near) {
            Some(side) => {
                near = side;
                false
            }
            None => true,
        })
        .collect();
    let previous = is_hollow.iter().cycle().skip(is_hollow.len().saturating_sub(1));
    is_hollow.iter().zip(previous).filter(|(current, previous)| **current && !**previous).count()
}

/// Returns the number of a side of the convex `hull` from which a point inside the hull is at most
/// [`HOLLOW`] away, or `None` if the point is deeper. The search begins at the side `near`.
fn shallow_side([x, y]: [f64; 2], hull: &[[f64; 2]], near: usize) -> Option<usize> {
    let is_shallow = |side: usize| {
        let ([ax, ay], [bx, by]) = (hull[side], hull[(side + 1) % hull.len()]);
        let (u, v) = (bx - ax, by - ay);
        // The hull runs anticlockwise, so its inside is on the left.
        (u * (y - ay) - v * (x - ax)) / u.hypot(v) <= HOLLOW
    };
    let sides = (near..hull.len()).chain(0..near.min(hull.len()));
    sides.into_iter().find(|&side| is_shallow(side))
}

/// Returns the closed rows of free edges of `parts`.
fn openings(parts: &GarmentParts, world: &World) -> Vec<Opening> {
    let classes = equivalence_classes(world.cloth.particle_count(), &parts.seams.pairs)
        .expect("pairs name particles");
    let coordinates = world.cloth.coordinates();
    let mut edges = RemainingEdges::new(&parts.free_edges, &classes);
    let mut openings = Vec::new();
    while let Some(first) = edges.take_first() {
        let [start, mut end] = ends(first, &classes);
        let mut opening = Opening {
            edges: vec![first.name.clone()],
            particles: first.particles.clone(),
            relaxed: relaxed_length(first, coordinates),
        };

        // Edges are appended, reversed where necessary, until the row is closed.
        while end != start
            && let Some(edge) = edges.take_at(end)
        {
            let [edge_start, edge_end] = ends(edge, &classes);
            let is_forward = edge_start == end;
            end = if is_forward { edge_end } else { edge_start };
            let mut particles = edge.particles.clone();
            if !is_forward {
                particles.reverse();
            }
            opening.edges.push(edge.name.clone());
            opening.particles.extend(&particles[1..]);
            opening.relaxed += relaxed_length(edge, coordinates);
        }

        if end == start {
            opening.particles.pop();
            openings.push(opening);
        }
    }
    openings
}

/// Free edges that belong to no opening yet.
struct RemainingEdges<'a> {
    edges: &'a [FreeEdge],
    is_taken: Vec<bool>,
    /// Number of the first edge that may remain.
    first: usize,
    /// Numbers of the edges at each class of particles, the last edge first.
    at_class: BTreeMap<u32, Vec<usize>>,
}

impl<'a> RemainingEdges<'a> {
    /// Returns all `edges`, whose particles have `classes`.
    fn new(edges: &'a [FreeEdge], classes: &[u32]) -> Self {
        let mut at_class: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (number, edge) in edges.iter().enumerate().rev() {
            for end in ends(edge, classes) {
                at_class.entry(end).or_default().push(number);
            }
        }
        Self { edges, is_taken: vec![false; edges.len()], first: 0, at_class }
    }

    /// Takes the first edge that remains.
    fn take_first(&mut self) -> Option<&'a FreeEdge> {
        while *self.is_taken.get(self.first)? {
            self.first += 1;
        }
        self.take(self.first)
    }

    /// Takes the first edge that remains and has an end in `class`.
    fn take_at(&mut self, class: u32) -> Option<&'a FreeEdge> {
        loop {
            let number = self.at_class.get_mut(&class)?.pop()?;
            if !self.is_taken[number] {
                return self.take(number);
            }
        }
    }

    /// Takes the edge with a `number`.
    fn take(&mut self, number: usize) -> Option<&'a FreeEdge> {
        self.is_taken[number] = true;
        self.edges.get(number)
    }
}

/// Returns the first and the last particle of `edge`, each as the class of `classes` that it is
/// sewn into.
fn ends(edge: &FreeEdge, classes: &[u32]) -> [u32; 2] {
    let ends = [edge.particles[0], edge.particles[edge.particles.len() - 1]];
    ends.map(|particle| classes[particle as usize])
}

/// Returns the length of `edge` before deformation, in m, from the material `coordinates` of the
/// particles.
fn relaxed_length(edge: &FreeEdge, coordinates: &[[f64; 2]]) -> f64 {
    let lengths = edge.particles.windows(2).map(|pair| {
        let [[a, b], [c, d]] = [pair[0], pair[1]].map(|p| coordinates[p as usize]);
        (c - a).hypot(d - b)
    });
    lengths.sum()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// Closed curve of 400 points with waves of 20 mm about a radius of 300 mm.
    fn waves(count: f64, width: f64) -> Vec<[f64; 2]> {
        let at = |k: usize| {
            let angle = TAU * k as f64 / 400.0;
            let radius = 0.3 + 0.02 * (count * angle).cos();
            [width * radius * angle.cos(), radius * angle.sin()]
        };
        (0..400).map(at).collect()
    }

    #[test]
    fn waves_are_folds_and_an_ellipse_has_none() {
        let counts =
            [0.0, 5.0, 12.0].map(|count| [1.0, 1.6].map(|width| folds(&waves(count, width))));
        assert_eq!(counts, [[0, 0], [5, 5], [12, 12]]);
    }

    #[test]
    fn folds_are_the_same_from_any_first_point_and_in_either_direction() {
        let mut ring = waves(7.0, 1.0);
        for _ in 0..40 {
            ring.rotate_left(11);
            ring.reverse();
            assert_eq!(folds(&ring), 7);
        }
    }
}
