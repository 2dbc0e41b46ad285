//! Openings of garments, such as a waist or a hem: how wide they are, how much of that is ease, and in
//! how many folds they hang.

use drape_collide::section::{SectionPlane, convex_hull, encloses, perimeter};
use drape_collide::{Shape, equivalence_classes};
use serde_json::{Value, json};

use crate::measure::garment_parts::{FreeEdge, GarmentParts};
use crate::world::World;

/// Least depth of a hollow between two folds, from the convex hull of the opening, in m; nodes of a
/// drapemeter's specimen are counted by the same prominence.
const HOLLOW: f64 = 3e-3;

/// Closed row of free edges, such as a waist or a hem.
#[derive(Debug, Clone, PartialEq)]
struct Opening {
    /// PANEL.EDGE of each.
    edges: Vec<String>,
    /// Its particles in their order, the first not repeated.
    particles: Vec<u32>,
    /// Its length before deformation, in m.
    relaxed: f64,
}

/// Measures of the openings of a world: their heights and lengths, and the girth of the body
/// inside.
pub(crate) fn measures(parts: &GarmentParts, world: &World) -> Value {
    let positions = &world.state.positions;
    let place = |particle: &u32| -> [f64; 3] {
        std::array::from_fn(|axis| positions[3 * *particle as usize + axis])
    };
    let bodies = world.contact.bodies().iter().zip(world.contact.triangulations());
    let bodies: Vec<_> = bodies.filter(|(body, _)| !matches!(body.shape, Shape::Plane)).collect();
    let measure = |opening: &Opening| {
        let places: Vec<[f64; 3]> = opening.particles.iter().map(place).collect();
        let length = perimeter(&places);
        let plane = SectionPlane::through(&places)?;
        let ring: Vec<[f64; 2]> = places.iter().map(|&place| plane.flat(place)).collect();
        let cuts = bodies.iter().flat_map(|(_, outline)| {
            outline.triangles.iter().flat_map(|triangle| {
                plane.cuts(triangle.map(|corner| outline.vertices[corner as usize]))
            })
        });
        let inside: Vec<[f64; 2]> = cuts.filter(|&point| encloses(&ring, point)).collect();
        let girth = (inside.len() > 2).then(|| perimeter(&convex_hull(inside)));
        let heights = places.iter().map(|place| place[1]);
        Some(json!({
            "edges": opening.edges,
            "height_mean": heights.sum::<f64>() / places.len() as f64,
            "length": length,
            "relaxed": opening.relaxed,
            "body": girth,
            "folds": folds(&ring),
            "ease": girth.map(|girth| length - girth),
        }))
    };
    Value::Array(openings(parts, world).iter().filter_map(measure).collect())
}

/// Returns the number of folds of a closed curve: that of the hollows between them, in each of which it
/// is deeper than [`HOLLOW`] within its convex hull.
fn folds(ring: &[[f64; 2]]) -> usize {
    let hull = convex_hull(ring.to_vec());
    let depth = |&[x, y]: &[f64; 2]| {
        let sides = hull.iter().zip(hull.iter().cycle().skip(1));
        let distances = sides.map(|([ax, ay], [bx, by])| {
            let (u, v) = (bx - ax, by - ay);
            // The hull runs anticlockwise: its inside is on the left.
            (u * (y - ay) - v * (x - ax)) / u.hypot(v)
        });
        distances.fold(f64::INFINITY, f64::min)
    };
    let is_hollow: Vec<bool> = ring.iter().map(|point| depth(point) > HOLLOW).collect();
    let before = is_hollow.iter().cycle().skip(is_hollow.len().saturating_sub(1));
    is_hollow.iter().zip(before).filter(|(here, before)| **here && !**before).count()
}

/// Free edges in closed rows.
fn openings(parts: &GarmentParts, world: &World) -> Vec<Opening> {
    let class = equivalence_classes(world.cloth.particles(), &parts.seams.pairs);
    let ends = |edge: &FreeEdge| {
        let ends = [edge.particles[0], edge.particles[edge.particles.len() - 1]];
        ends.map(|particle| class[particle as usize])
    };
    let coordinates = world.cloth.coordinates();
    let relaxed = |edge: &FreeEdge| -> f64 {
        let places = edge.particles.windows(2).map(|pair| {
            let [[a, b], [c, d]] = [pair[0], pair[1]].map(|p| coordinates[p as usize]);
            (c - a).hypot(d - b)
        });
        places.sum()
    };
    let mut left: Vec<&FreeEdge> = parts.free_edges.iter().collect();
    let mut openings = Vec::new();
    while !left.is_empty() {
        let first = left.remove(0);
        let [start, mut end] = ends(first);
        let mut opening = Opening {
            edges: vec![first.name.clone()],
            particles: first.particles.clone(),
            relaxed: relaxed(first),
        };
        while end != start
            && let Some(next) = left.iter().position(|edge| ends(edge).contains(&end))
        {
            let edge = left.remove(next);
            let [one, other] = ends(edge);
            let onwards = one == end;
            end = if onwards { other } else { one };
            let mut particles = edge.particles.clone();
            if !onwards {
                particles.reverse();
            }
            opening.edges.push(edge.name.clone());
            opening.particles.extend(&particles[1..]);
            opening.relaxed += relaxed(edge);
        }
        if end == start {
            opening.particles.pop();
            openings.push(opening);
        }
    }
    openings
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
