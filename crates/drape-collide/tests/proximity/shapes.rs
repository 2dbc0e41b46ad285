//! Meshes of the tests, and distances computed in the simplest way.

use crate::support::{Dice, norm, sub};
use drape_collide::ProximityMesh;

pub type Point = [f64; 3];

/// Positions and triangles of a mesh.
#[derive(Debug, Clone)]
pub struct Shape {
    pub positions: Vec<Point>,
    pub triangles: Vec<[u32; 3]>,
}

impl Shape {
    pub fn mesh(&self) -> ProximityMesh {
        ProximityMesh::new(&self.positions, &self.triangles).unwrap()
    }

    pub fn moved(&self, motion: impl Fn(Point) -> Point) -> Shape {
        Shape { positions: self.positions.iter().copied().map(motion).collect(), ..self.clone() }
    }
}

/// A wavy square grid of `side`² vertices with sides of 1 m, near the height 0.
pub fn wavy_grid(side: u32, depth: f64, phase: f64) -> Shape {
    let place = |k: u32| f64::from(k) / f64::from(side - 1);
    let positions = (0..side * side).map(|k| {
        let (x, z) = (place(k % side), place(k / side));
        [x, depth * ((9.0 * x + phase).sin() + (7.0 * z - phase).cos()), z]
    });
    let cells = (0..(side - 1) * (side - 1)).map(|k| k / (side - 1) * side + k % (side - 1));
    Shape {
        positions: positions.collect(),
        triangles: cells
            .flat_map(|a| [[a, a + 1, a + side], [a + 1, a + side + 1, a + side]])
            .collect(),
    }
}

/// `count` triangles of the size 1 m that lie loose in a cube of the half side `room`, with every
/// third degenerate to a sliver.
pub fn loose_triangles(dice: &mut Dice, count: u32, room: f64) -> Shape {
    let mut positions = Vec::new();
    for k in 0..count {
        let middle = dice.point(room);
        let corners = [0; 3].map(|_| dice.point(0.5));
        let thin = if k % 3 == 0 { 1e-4 } else { 1.0 };
        let corner = |c: usize, axis: usize| {
            let along = corners[c][axis] - corners[0][axis];
            let toward = corners[1][axis] - corners[0][axis];
            let reached = if c == 2 { toward * 0.4 + thin * along } else { along };
            middle[axis] + corners[0][axis] + reached
        };
        positions.extend([0, 1, 2].map(|c| [0, 1, 2].map(|axis| corner(c, axis))));
    }
    Shape { positions, triangles: (0..count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect() }
}

/// A turn about a skew axis by `angle`, and a shift.
pub fn turned(point: Point, angle: f64, shift: Point) -> Point {
    let axis = [1.0, -2.0, 0.5].map(|a: f64| a / 5.25_f64.sqrt());
    let (sine, cosine) = angle.sin_cos();
    let across = cross(axis, point);
    let along = dot(axis, point) * (1.0 - cosine);
    [0, 1, 2].map(|k| point[k] * cosine + across[k] * sine + axis[k] * along + shift[k])
}

pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn between(a: Point, b: Point, fraction: f64) -> Point {
    [0, 1, 2].map(|k| (1.0 - fraction) * a[k] + fraction * b[k])
}

pub fn all_between(a: &[Point], b: &[Point], fraction: f64) -> Vec<Point> {
    a.iter().zip(b).map(|(a, b)| between(*a, *b, fraction)).collect()
}

/// Distance of a point from a segment.
pub fn point_segment(point: Point, [a, b]: [Point; 2]) -> f64 {
    let along = sub(b, a);
    let fraction = dot(sub(point, a), along) / dot(along, along);
    norm(sub(point, between(a, b, fraction.clamp(0.0, 1.0))))
}

/// Distance of a point from a triangle: of its foot, if that is inside, else of the sides.
pub fn point_triangle(point: Point, [a, b, c]: [Point; 3]) -> f64 {
    let normal = cross(sub(b, a), sub(c, a));
    let inside = [[a, b], [b, c], [c, a]]
        .iter()
        .all(|[from, to]| dot(cross(normal, sub(*to, *from)), sub(point, *from)) >= 0.0);
    if inside && norm(normal) > 0.0 {
        return dot(sub(point, a), normal).abs() / norm(normal);
    }
    [[a, b], [b, c], [c, a]].map(|side| point_segment(point, side)).into_iter().fold(9e99, f64::min)
}

/// Distance of two segments: of their lines, if the feet are inside, else of the four ends.
pub fn segment_segment([a, b]: [Point; 2], [c, d]: [Point; 2]) -> f64 {
    let (first, second) = (sub(b, a), sub(d, c));
    let normal = cross(first, second);
    let square = dot(normal, normal);
    let s = dot(cross(sub(c, a), second), normal) / square;
    let t = dot(cross(sub(c, a), first), normal) / square;
    if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
        return dot(sub(c, a), normal).abs() / square.sqrt();
    }
    let ends = [point_segment(a, [c, d]), point_segment(b, [c, d])];
    let others = [point_segment(c, [a, b]), point_segment(d, [a, b])];
    ends.into_iter().chain(others).fold(9e99, f64::min)
}

/// Distance of two shapes that do not intersect, over all pairs.
pub fn distance_of_all_pairs(first: &Shape, second: &Shape) -> f64 {
    let corners = |shape: &Shape| -> Vec<[Point; 3]> {
        let place = |corner: u32| shape.positions[corner as usize];
        shape.triangles.iter().map(|corners| corners.map(place)).collect()
    };
    let sides = |[a, b, c]: [Point; 3]| [[a, b], [b, c], [c, a]];
    let mut least = f64::INFINITY;
    for one in corners(first) {
        for two in corners(second) {
            for k in 0..3 {
                least = least.min(point_triangle(one[k], two)).min(point_triangle(two[k], one));
                for side in sides(two) {
                    least = least.min(segment_segment(sides(one)[k], side));
                }
            }
        }
    }
    least
}
