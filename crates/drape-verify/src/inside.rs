//! Pieces of cloth that lie wholly inside a body, so that no triangle of the piece intersects the
//! body.
//!
//! `verdict` searches for such pieces in each frame. A piece that does not intersect the surface of
//! a body lies inside the body if one vertex of the piece does.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use serde::Serialize;

use crate::joints::Joints;
use crate::mesh::Mesh;

type Point = [f64; 3];

/// Piece of cloth that lies inside a body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct EnclosedPiece {
    /// Number of the panel to which the first vertex of the piece belongs.
    pub panel: usize,
    /// Number of the body.
    pub body: usize,
    /// Position of the first vertex of the piece, in m.
    #[serde(rename = "place")]
    pub point: [f64; 3],
}

/// Returns the pieces of cloth whose first vertex is inside a body, or below a flat body.
///
/// `joints` are the joints in the frame, and `positions` are the positions of all vertices, in m. A
/// body that is neither closed nor flat has no inside.
pub(crate) fn enclosed(mesh: &Mesh, joints: &Joints, positions: &[Point]) -> Vec<EnclosedPiece> {
    let firsts = first_vertices(mesh, joints);
    let mut pieces = Vec::new();
    for (body, triangles) in mesh.bodies().enumerate() {
        if !has_inside(triangles, positions) {
            continue;
        }
        for &(panel, vertex) in &firsts {
            let point = positions[vertex];
            let mut angle: f64 = 0.0;
            for corners in triangles {
                let positions = corners.map(|corner| positions[corner as usize]);
                angle += solid_angle(positions.map(|x| [0, 1, 2].map(|k| x[k] - point[k])));
            }

            // From inside, a closed body covers the solid angle 4π. From below, a floor covers
            // nearly 2π.
            if angle > PI {
                pieces.push(EnclosedPiece { panel, body, point });
            }
        }
    }
    pieces
}

/// Returns the panel and the number of the first vertex of each piece of cloth in `mesh`. A piece
/// is a set of triangles that are connected through `joints`.
fn first_vertices(mesh: &Mesh, joints: &Joints) -> Vec<(usize, usize)> {
    // The piece of a class is the least class that is connected to it.
    let mut piece: Vec<usize> =
        (0..mesh.cloth_vertex_count()).map(|vertex| joints.class(vertex)).collect();
    loop {
        let mut settled = true;
        for corners in mesh.cloth_triangles() {
            let classes = corners.map(|corner| joints.class(corner as usize));
            let least = classes.map(|class| piece[class]).into_iter().min().unwrap_or_default();
            // The piece of a piece is at most as large, which shortens the iteration.
            let least = piece[least];
            for class in classes {
                settled &= piece[class] == least;
                piece[class] = least;
            }
        }
        if settled {
            break;
        }
    }

    let mut first = BTreeMap::new();
    for corners in mesh.cloth_triangles() {
        let vertex = corners[0] as usize;
        first.entry(piece[joints.class(vertex)]).or_insert(vertex);
    }
    first.into_values().map(|vertex| (mesh.panel_of_vertex(vertex), vertex)).collect()
}

/// Returns whether the body with the given `triangles` is closed or flat. A body is closed if its
/// triangles pass each edge equally often in both directions.
fn has_inside(triangles: &[[u32; 3]], positions: &[Point]) -> bool {
    let mut passes: BTreeMap<[u32; 2], [usize; 2]> = BTreeMap::new();
    for [a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            passes.entry([*from.min(to), *from.max(to)]).or_default()[usize::from(from > to)] += 1;
        }
    }
    passes.values().all(|[forward, backward]| forward == backward) || is_flat(triangles, positions)
}

/// Returns whether all corners of `triangles` have one height.
fn is_flat(triangles: &[[u32; 3]], positions: &[Point]) -> bool {
    let mut heights = triangles.iter().flatten().map(|&corner| positions[corner as usize][1]);
    let first = heights.next();
    heights.all(|height| Some(height) == first)
}

/// Returns the solid angle of the triangle with the corners `a`, `b` and `c`, seen from the origin,
/// in sr. The sign is the sign of the orientation of the triangle \[VOS83\].
fn solid_angle([a, b, c]: [Point; 3]) -> f64 {
    let normal = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
    let [la, lb, lc] = [a, b, c].map(|corner| dot(corner, corner).sqrt());
    let full = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    2.0 * dot(a, normal).atan2(full)
}

/// Returns the scalar product of `u` and `v`.
fn dot(u: Point, v: Point) -> f64 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}
