//! Holes of a triangulation, and the triangles that close them.

use crate::mesh_io::Triangulation;
use crate::vector::{Vector, add, cross, dot, norm, scale, subtract};

use super::edges::Edges;

/// Hole of a mesh: a closed line of edges that have a triangle on one side only.
#[derive(Debug, Clone, PartialEq)]
pub struct Hole {
    /// Vertex numbers along the line, in the direction of the triangles that would close the hole.
    /// Of vertices at one position the first one counts.
    pub vertices: Vec<u32>,
    /// Length of the line, in m.
    pub length: f64,
    /// Mean of the vertices, in m.
    pub place: [f64; 3],
}

/// Returns the holes of `mesh`, the longest first. `edges` are the edges of `mesh`.
pub(crate) fn find_holes(mesh: &Triangulation, edges: &Edges) -> Vec<Hole> {
    // Closing triangles run along an edge against the triangle on its other side.
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
            // A line that does not close ends where triangles disagree. It stays a hole here, and
            // closing it would make a worse body.
            holes.push(measure_hole(mesh, vertices));
        }
    }
    holes.sort_by(|a, b| b.length.total_cmp(&a.length));
    holes
}

/// Returns the hole along `vertices`, with its length and its mean position.
fn measure_hole(mesh: &Triangulation, vertices: Vec<u32>) -> Hole {
    let count = vertices.len();
    let corners: Vec<Vector> = vertices.iter().map(|vertex| mesh.point(*vertex)).collect();
    let length = (0..count).map(|k| norm(subtract(corners[(k + 1) % count], corners[k]))).sum();
    let sum = corners.iter().copied().fold([0.0; 3], add);
    let place = scale(sum, 1.0 / count as f64);
    Hole { vertices, length, place }
}

/// Returns triangles that close `hole`.
///
/// The line is closed by clipping ears. An ear is a triangle of three successive vertices of the
/// line. Each round clips the ear whose inner angle, seen against the normal of the hole, is the
/// smallest.
pub(crate) fn close(mesh: &Triangulation, hole: &Hole) -> Vec<[u32; 3]> {
    let mut line = hole.vertices.clone();
    let normal = area_normal(mesh, &line, hole.place);
    let mut triangles = Vec::new();
    while line.len() > 3 {
        let ear = (0..line.len())
            .map(|k| (k, inner_angle(mesh, &line, k, normal)))
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

/// Returns vertex `k` of the closed `line`, between its two neighbours.
fn corners(line: &[u32], k: usize) -> [u32; 3] {
    let count = line.len();
    [line[(k + count - 1) % count], line[k], line[(k + 1) % count]]
}

/// Returns the sum of the normals of the triangles between `line` and the point `center`, weighted
/// by twice their areas, in m².
fn area_normal(mesh: &Triangulation, line: &[u32], center: Vector) -> Vector {
    let spokes: Vec<Vector> =
        line.iter().map(|vertex| subtract(mesh.point(*vertex), center)).collect();
    let count = line.len();
    (0..count).map(|k| cross(spokes[k], spokes[(k + 1) % count])).fold([0.0; 3], add)
}

/// Returns the angle inside `line` at its vertex `k`, from 0 to 2 π, seen against `normal`.
fn inner_angle(mesh: &Triangulation, line: &[u32], k: usize, normal: Vector) -> f64 {
    let [a, b, c] = mesh.corners(corners(line, k));
    let (back, on) = (subtract(a, b), subtract(c, b));
    let turn = cross(on, back);
    let angle = norm(turn).atan2(dot(on, back));
    if dot(turn, normal) >= 0.0 { angle } else { std::f64::consts::TAU - angle }
}
