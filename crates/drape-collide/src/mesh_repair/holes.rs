//! Holes of a triangulation, and their closing.

use crate::mesh_io::Triangulation;
use crate::vector::{Vector, add, cross, dot, norm, scale, subtract};

use super::edges::Edges;

/// Hole of a mesh: a closed line of edges with a triangle on one side.
#[derive(Debug, Clone, PartialEq)]
pub struct Hole {
    /// Numbers of the vertices, in the direction in which new triangles run along them; of vertices at one
    /// position the first one counts.
    pub vertices: Vec<u32>,
    /// Length of the line, in m.
    pub length: f64,
    /// Mean of the vertices, in m.
    pub place: [f64; 3],
}

/// Returns the holes, the longest first.
pub(crate) fn find_holes(mesh: &Triangulation, edges: &Edges) -> Vec<Hole> {
    // New triangles run against the triangle that is there.
    let mut next: Vec<Vec<u32>> = vec![Vec::new(); mesh.vertices.len()];
    for ([low, high], sides) in edges.iter() {
        if let [side] = sides {
            let (from, to) = if side.rises { (high, low) } else { (low, high) };
            next[from as usize].push(to);
        }
    }
    let mut holes = Vec::new();
    for start in 0..next.len() as u32 {
        while let Some(first) = next[start as usize].pop() {
            let (mut vertices, mut at) = (vec![start], first);
            while at != start {
                vertices.push(at);
                let Some(following) = next[at as usize].pop() else { break };
                at = following;
            }
            // A line that does not close ends where triangles disagree; it is no hole to close.
            holes.push(hole(mesh, vertices));
        }
    }
    holes.sort_by(|a, b| b.length.total_cmp(&a.length));
    holes
}

fn hole(mesh: &Triangulation, vertices: Vec<u32>) -> Hole {
    let point = |k: usize| mesh.vertices[vertices[k % vertices.len()] as usize];
    let count = vertices.len();
    let length = (0..count).map(|k| norm(subtract(point(k + 1), point(k)))).sum();
    let sum = (0..count).map(point).fold([0.0; 3], add);
    let place = scale(sum, 1.0 / count as f64);
    Hole { vertices, length, place }
}

/// Returns triangles that close a hole: ears of the line, the one with the best angle first.
///
/// An ear is a triangle of three successive vertices; one is cut off at a time, the one whose
/// angle against the plane of the hole is the sharpest convex one.
pub(crate) fn close(mesh: &Triangulation, hole: &Hole) -> Vec<[u32; 3]> {
    let mut line = hole.vertices.clone();
    let point = |vertex: u32| mesh.vertices[vertex as usize];
    let normal = normal(&line, point, hole.place);
    let mut triangles = Vec::new();
    while line.len() > 3 {
        let ear = (0..line.len())
            .map(|k| (k, angle(&line, k, point, normal)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .map_or(0, |(k, _)| k);
        triangles.push(corners(&line, ear));
        line.remove(ear);
    }
    if line.len() == 3 {
        triangles.push([line[0], line[1], line[2]]);
    }
    triangles
}

/// Returns the vertex at a place of a closed line, with its neighbours.
fn corners(line: &[u32], k: usize) -> [u32; 3] {
    let count = line.len();
    [line[(k + count - 1) % count], line[k], line[(k + 1) % count]]
}

/// Returns the sum of the normals of the triangles between a line and a point, with their areas.
fn normal(line: &[u32], point: impl Fn(u32) -> Vector, center: Vector) -> Vector {
    let spoke = |k: usize| subtract(point(line[k % line.len()]), center);
    (0..line.len()).map(|k| cross(spoke(k), spoke(k + 1))).fold([0.0; 3], add)
}

/// Returns the angle inside the line at a vertex, 0 to 2 π, seen against a normal.
fn angle(line: &[u32], k: usize, point: impl Fn(u32) -> Vector, normal: Vector) -> f64 {
    let [a, b, c] = corners(line, k).map(point);
    let (back, on) = (subtract(a, b), subtract(c, b));
    let turn = cross(on, back);
    let angle = norm(turn).atan2(dot(on, back));
    if dot(turn, normal) >= 0.0 { angle } else { std::f64::consts::TAU - angle }
}
