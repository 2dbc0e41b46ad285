//! Pieces of cloth that lie wholly inside a body: no triangle of theirs meets one of its.
//!
//! `verdict` asks for them in each frame. A piece that intersects no surface of a body is inside of it
//! if one of its vertices is.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use serde::Serialize;

use crate::joints::Joints;
use crate::mesh::Mesh;

type Point = [f64; 3];

/// Piece of cloth inside a body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct EnclosedPiece {
    /// Number of the panel of its first vertex.
    pub panel: usize,
    /// Number of the body.
    pub body: usize,
    /// Position of its first vertex, in m.
    #[serde(rename = "place")]
    pub point: [f64; 3],
}

/// Returns the pieces of cloth, joined as in the frame, whose first vertex is inside a body.
///
/// Of a body without an inside, which is neither closed nor flat, nothing is found.
pub(crate) fn enclosed(mesh: &Mesh, joints: &Joints, positions: &[Point]) -> Vec<EnclosedPiece> {
    let firsts = first_vertices(mesh, joints);
    let mut found = Vec::new();
    for (body, triangles) in mesh.bodies().enumerate() {
        if !has_inside(triangles, positions) {
            continue;
        }
        for &(panel, vertex) in &firsts {
            let point = positions[vertex];
            let from = |corner: u32| [0, 1, 2].map(|k| positions[corner as usize][k] - point[k]);
            let angle: f64 = triangles.iter().map(|t| solid_angle(t.map(from))).sum();
            // A closed body fills the whole sphere of directions from inside, a floor half of it from below.
            if angle > PI {
                found.push(EnclosedPiece { panel, body, point });
            }
        }
    }
    found
}

/// Returns the panel and the number of the first vertex of each piece of cloth.
fn first_vertices(mesh: &Mesh, joints: &Joints) -> Vec<(usize, usize)> {
    let vertices = mesh.cloth_vertices();
    let mut piece: Vec<usize> = (0..vertices).map(|vertex| joints.class(vertex)).collect();
    loop {
        let mut settled = true;
        for corners in mesh.cloth_triangles() {
            let own = corners.map(|corner| joints.class(corner as usize));
            let least = own.map(|class| piece[class]).into_iter().min().unwrap_or_default();
            // A shortcut: the piece of a piece is no larger.
            let least = piece[least];
            for class in own {
                settled &= piece[class] == least;
                piece[class] = least;
            }
        }
        if settled {
            break;
        }
    }
    let used = mesh.cloth_triangles().iter().map(|corners| {
        let vertex = corners[0] as usize;
        (piece[joints.class(vertex)], vertex)
    });
    let mut first = BTreeMap::new();
    used.for_each(|(piece, vertex)| {
        first.entry(piece).or_insert(vertex);
    });
    first.into_values().map(|vertex| (mesh.panel_of_vertex(vertex), vertex)).collect()
}

/// Returns whether a body is closed, so that each edge is passed once in both directions, or flat.
fn has_inside(triangles: &[[u32; 3]], positions: &[Point]) -> bool {
    let mut edges: BTreeMap<[u32; 2], [usize; 2]> = BTreeMap::new();
    for [a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            edges.entry([*from.min(to), *from.max(to)]).or_default()[usize::from(from > to)] += 1;
        }
    }
    edges.values().all(|ways| ways[0] == ways[1]) || is_flat(triangles, positions)
}

/// Returns whether all vertices of a body have one height.
fn is_flat(triangles: &[[u32; 3]], positions: &[Point]) -> bool {
    let mut heights = triangles.iter().flatten().map(|&corner| positions[corner as usize][1]);
    let first = heights.next();
    heights.all(|height| Some(height) == first)
}

/// Returns the solid angle of a triangle seen from the origin, in sr, with the sign of its orientation
/// \[VOS83\].
fn solid_angle([a, b, c]: [Point; 3]) -> f64 {
    let dot = |u: Point, v: Point| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let length = |u: Point| dot(u, u).sqrt();
    let normal = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
    let (la, lb, lc) = (length(a), length(b), length(c));
    let full = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    2.0 * dot(a, normal).atan2(full)
}
