//! Triangulation of shapes: vertices on the surface, triangles inside it.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use super::shape::Shape;
use crate::error::Error;
use crate::mesh_io::{Triangulation, merge_coincident_vertices};
use crate::vector::{Vector, norm};

/// Segments per quarter circle of a ball or of a rounded edge. Each segment spans 5.6°.
const QUARTER: usize = 16;

/// Half of the side of the square that represents a plane, in m.
const PLANE_HALF: f64 = 2.0;

/// Returns the surface of `shape` as triangles in the body's frame, in m.
pub(super) fn triangulate(shape: &Shape) -> Result<Triangulation, Error> {
    match shape {
        Shape::Sphere { radius } => cuboid([0.0; 3], *radius),
        Shape::Box { half_extents, edge_radius } => {
            cuboid(half_extents.map(|h| h - edge_radius), *edge_radius)
        }
        Shape::Cylinder { radius, half_height, edge_radius } => {
            cylinder([radius - edge_radius, half_height - edge_radius], *edge_radius)
        }
        Shape::Plane => {
            let h = PLANE_HALF;
            let vertices = vec![[-h, 0.0, -h], [-h, 0.0, h], [h, 0.0, h], [h, 0.0, -h]];
            Ok(Triangulation { vertices, triangles: vec![[0, 1, 2], [0, 2, 3]] })
        }
        Shape::Mesh(mesh) => {
            Ok(Triangulation { vertices: mesh.vertices(), triangles: mesh.triangles().to_vec() })
        }
    }
}

/// Grid line across a side of the box.
#[derive(Clone, Copy)]
struct GridLine {
    /// Coordinate on the core, in m.
    core: f64,
    /// Component of the normal along the side, over its component across the side.
    lean: f64,
}

/// Returns the grid lines across a side, from edge to edge. `extent` is half of the core's length,
/// in m.
fn grid_lines(extent: f64, edge_radius: f64) -> Vec<GridLine> {
    if edge_radius == 0.0 {
        return [-extent, extent].map(|core| GridLine { core, lean: 0.0 }).to_vec();
    }
    let half = QUARTER / 2;
    let low = (0..=half).rev().map(|k| GridLine { core: -extent, lean: 0.0 - line_lean(k, half) });
    let high = (0..=half).map(|k| GridLine { core: extent, lean: line_lean(k, half) });
    low.chain(high).collect()
}

/// Returns the lean of line `k` of a rounded edge, whose line `half` is the end of the side.
///
/// A side ends where its normal leans by 45°. There the value is exact, so neighbouring sides agree
/// to the last bit.
fn line_lean(k: usize, half: usize) -> f64 {
    if k == 0 {
        0.0
    } else if k == half {
        1.0
    } else {
        (FRAC_PI_4 * k as f64 / half as f64).tan()
    }
}

/// Returns a box with rounded edges as a grid on each of its six sides. `core` holds the half
/// extents of the core, in m. A core that is a point gives a ball.
fn cuboid(core: Vector, edge_radius: f64) -> Result<Triangulation, Error> {
    let mut vertices: Vec<Vector> = Vec::new();
    let mut triangles = Vec::new();
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let across = grid_lines(core[u], edge_radius);
        let along = grid_lines(core[v], edge_radius);

        for sign in [1.0, -1.0] {
            let first = vertices.len() as u32;

            // Each vertex lies at the edge radius from its centre on the core, along the normal.
            for &GridLine { core: at_u, lean: lean_u } in &across {
                for &GridLine { core: at_v, lean: lean_v } in &along {
                    let mut center = [0.0; 3];
                    let mut lean = [0.0; 3];
                    [center[axis], center[u], center[v]] = [sign * core[axis], at_u, at_v];
                    [lean[axis], lean[u], lean[v]] = [sign, lean_u, lean_v];
                    let length = norm(lean);
                    vertices
                        .push(std::array::from_fn(|k| center[k] + edge_radius * lean[k] / length));
                }
            }
            triangles.extend(grid_triangles(first, across.len(), along.len(), sign > 0.0));
        }
    }

    // The six grids share vertices along the edges of the box.
    Ok(merge_coincident_vertices(&vertices, &triangles)?.mesh)
}

/// Returns a cylinder: a profile in the plane of radius and height, revolved about y. `core` holds
/// radius and half height of the core, in m.
fn cylinder(core: [f64; 2], edge_radius: f64) -> Result<Triangulation, Error> {
    // Half of the profile: the quarter circle from the cap to the wall, or one corner.
    let last = if edge_radius > 0.0 { QUARTER } else { 0 };
    let rim: Vec<(f64, f64)> = (0..=last)
        .map(|k| {
            let (sine, cosine) = (FRAC_PI_2 * k as f64 / QUARTER as f64).sin_cos();
            (core[0] + edge_radius * sine, core[1] + edge_radius * cosine)
        })
        .collect();
    let mut profile = vec![(0.0, core[1] + edge_radius)];
    profile.extend(&rim);
    profile.extend(rim.iter().rev().map(|&(r, y)| (r, -y)));
    profile.push((0.0, -core[1] - edge_radius));

    let around = 4 * QUARTER;
    let mut vertices: Vec<Vector> = Vec::new();
    for &(radius, height) in &profile {
        for k in 0..=around {
            let (sine, cosine) = (TAU * (k % around) as f64 / around as f64).sin_cos();
            vertices.push([radius * sine, height, radius * cosine]);
        }
    }
    let triangles = grid_triangles(0, profile.len(), around + 1, true);
    Ok(merge_coincident_vertices(&vertices, &triangles)?.mesh)
}

/// Returns two triangles for each cell of a grid of `rows` × `columns` vertices, stored row by row
/// from vertex `first` on. `flipped` reverses the triangles.
fn grid_triangles(first: u32, rows: usize, columns: usize, flipped: bool) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let a = first + (row * columns + column) as u32;
            let (b, c, d) = (a + columns as u32, a + columns as u32 + 1, a + 1);
            let halves = [[a, b, c], [a, c, d]];
            triangles.extend(halves.map(|[a, b, c]| if flipped { [a, b, c] } else { [a, c, b] }));
        }
    }
    triangles
}
