//! Openings of garments, such as a waist or a hem: how wide they are, and how much of that is ease.

use drape_collide::{Shape, equivalence_classes};
use serde_json::{Value, json};

use crate::measure::garment_parts::{FreeEdge, GarmentParts};
use crate::measure::vector::{cross, distance, dot, subtract, unit};
use crate::world::World;

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

/// Plane through an opening, and directions in it.
struct Plane {
    middle: [f64; 3],
    normal: [f64; 3],
    axes: [[f64; 3]; 2],
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
        let length = around(&places);
        let plane = Plane::through(&places)?;
        let ring: Vec<[f64; 2]> = places.iter().map(|&place| plane.flat(place)).collect();
        let cuts = bodies.iter().flat_map(|(_, outline)| {
            outline.triangles.iter().flat_map(|triangle| {
                plane.cuts(triangle.map(|corner| outline.vertices[corner as usize]))
            })
        });
        let inside: Vec<[f64; 2]> = cuts.filter(|&point| encloses(&ring, point)).collect();
        let girth = (inside.len() > 2).then(|| around(&hull(inside)));
        let heights = places.iter().map(|place| place[1]);
        Some(json!({
            "edges": opening.edges,
            "height_mean": heights.sum::<f64>() / places.len() as f64,
            "length": length,
            "relaxed": opening.relaxed,
            "body": girth,
            "ease": girth.map(|girth| length - girth),
        }))
    };
    Value::Array(openings(parts, world).iter().filter_map(measure).collect())
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

impl Plane {
    /// The plane through the middle of a closed line, across the area that it encloses, if that is
    /// any.
    fn through(places: &[[f64; 3]]) -> Option<Self> {
        let count = places.len() as f64;
        let middle =
            std::array::from_fn(|axis| places.iter().map(|place| place[axis]).sum::<f64>() / count);
        let mut area = [0.0; 3];
        for (k, place) in places.iter().enumerate() {
            let next = places[(k + 1) % places.len()];
            let turn = cross(subtract(*place, middle), subtract(next, middle));
            (0..3).for_each(|axis| area[axis] += turn[axis]);
        }
        let normal = unit(area)?;
        let axis = (0..3).min_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()))?;
        let across: [f64; 3] = std::array::from_fn(|k| f64::from(u8::from(k == axis)));
        let first = unit(cross(across, normal))?;
        Some(Self { middle, normal, axes: [first, cross(normal, first)] })
    }

    /// The place of a point's foot in the plane.
    fn flat(&self, point: [f64; 3]) -> [f64; 2] {
        self.axes.map(|axis| dot(axis, subtract(point, self.middle)))
    }

    /// Points where the plane cuts the sides of a triangle.
    fn cuts(&self, corners: [[f64; 3]; 3]) -> Vec<[f64; 2]> {
        let heights = corners.map(|corner| dot(self.normal, subtract(corner, self.middle)));
        let cut = |k: usize| {
            let (a, b) = (k, (k + 1) % 3);
            ((heights[a] < 0.0) != (heights[b] < 0.0)).then(|| {
                let part = heights[a] / (heights[a] - heights[b]);
                self.flat(std::array::from_fn(|axis| {
                    corners[a][axis] + part * (corners[b][axis] - corners[a][axis])
                }))
            })
        };
        (0..3).filter_map(cut).collect()
    }
}

/// Length of a closed line.
fn around<const N: usize>(places: &[[f64; N]]) -> f64 {
    let next = places.iter().cycle().skip(1);
    places.iter().zip(next).map(|(&a, &b)| distance(a, b)).sum()
}

/// Whether a closed line in a plane goes round a point.
fn encloses(ring: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let sides = ring.iter().zip(ring.iter().cycle().skip(1));
    let crossed = sides.filter(|([ax, ay], [bx, by])| {
        (*ay > y) != (*by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)
    });
    crossed.count() % 2 == 1
}

/// Corners of the convex hull of points, in their order \[And79\].
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let chain = |points: &mut dyn Iterator<Item = &[f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for &[x, y] in points {
            while let [.., [ax, ay], [bx, by]] = chain[..]
                && (bx - ax) * (y - ay) <= (by - ay) * (x - ax)
            {
                chain.pop();
            }
            chain.push([x, y]);
        }
        chain.pop();
        chain
    };
    [chain(&mut points.iter()), chain(&mut points.iter().rev())].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A circle of a radius about a point at a height, tilted about x by a slope.
    fn circle(radius: f64, slope: f64) -> Vec<[f64; 3]> {
        let place = |k: i32| {
            let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 400.0).sin_cos();
            [1.0 + radius * cos, 2.0 + slope * radius * sin, radius * sin]
        };
        (0..400).map(place).collect()
    }

    #[test]
    fn a_plane_through_a_tilted_circle_sees_it_in_its_true_size() {
        let tilted: Vec<[f64; 3]> = circle(0.2, 0.75);
        let plane = Plane::through(&tilted).expect("it has an area");
        // The middle is the circle's, and the normal is across its slope of 3 in 4.
        assert!(distance(plane.middle, [1.0, 2.0, 0.0]) < 1e-12);
        let slope = [plane.normal[1].abs(), plane.normal[2].abs()];
        assert!((slope[0] - 0.8).abs() < 1e-9 && (slope[1] - 0.6).abs() < 1e-9, "{slope:?}");
        let flat: Vec<[f64; 2]> = tilted.iter().map(|&place| plane.flat(place)).collect();
        assert!((around(&flat) - around(&tilted)).abs() < 1e-12);
        assert!(encloses(&flat, [0.0, 0.1]) && !encloses(&flat, [0.26, 0.0]));
        // A triangle across it is cut twice, one beside it never.
        let across = [[0.9, 1.9, 0.0], [1.1, 1.9, 0.0], [1.0, 2.2, 0.0]];
        assert_eq!(plane.cuts(across).len(), 2);
        assert!(plane.cuts(across.map(|[x, y, z]| [x, y + 1.0, z])).is_empty());
        assert!(Plane::through(&[[0.0; 3], [1.0, 0.0, 0.0]]).is_none());
    }

    #[test]
    fn a_hull_leaves_out_what_is_hollow_or_inside() {
        let star = vec![
            [0.0, 0.0],
            [2.0, 0.0],
            [1.0, 0.5],
            [2.0, 2.0],
            [0.0, 2.0],
            [0.2, 1.0],
            [1.0, 0.0],
        ];
        let corners = hull(star);
        assert_eq!(corners, [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
        assert!((around(&corners) - 8.0).abs() < 1e-12);
    }
}
