use crate::body::{Body, Shape};
use crate::error::Error;
use crate::mesh::{Surface, weld};
use crate::vector::{Vector, add, cross, norm, scale, subtract};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

impl Triangulation {
    /// The same with coordinates multiplied by a factor, such as m per unit of a file.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Triangulation {
        self.vertices.iter_mut().flatten().for_each(|value| *value *= factor);
        self
    }

    /// Unit normals of the vertices, outward: of each the mean of those of its triangles, by their area.
    #[must_use]
    pub fn normals(&self) -> Vec<[f64; 3]> {
        let mut sums = vec![[0.0; 3]; self.vertices.len()];
        for corners in &self.triangles {
            let [a, b, c] = corners.map(|corner| self.vertices[corner as usize]);
            let doubled = cross(subtract(b, a), subtract(c, a));
            for &corner in corners {
                sums[corner as usize] = add(sums[corner as usize], doubled);
            }
        }
        let unit = |sum: Vector| if norm(sum) > 0.0 { scale(sum, 1.0 / norm(sum)) } else { sum };
        sums.into_iter().map(unit).collect()
    }
}

/// Pieces of a quarter turn of a ball or a rounded edge; a quarter of a ball then has faces of 6°.
const QUARTER: usize = 16;

/// Half of the side of the square that stands for a plane, in m.
const PLANE_HALF: f64 = 2.0;

/// The surface of a body as triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangulation {
    /// Vertices, in m.
    pub vertices: Vec<[f64; 3]>,
    /// Three vertex numbers each, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Body {
    /// The surface at the body's pose, for a picture or an exported scene.
    ///
    /// A mesh gives its own triangles. Curved surfaces are inscribed: their vertices lie on the
    /// body. Of a plane there is a square of 4 m about the body's position.
    pub fn triangulate(&self) -> Result<Triangulation, Error> {
        let frame = self.check()?;
        let (vertices, triangles) = match &self.shape {
            Shape::Sphere { radius } => cuboid([0.0; 3], *radius)?,
            Shape::Box { half_extents, edge_radius } => {
                cuboid(half_extents.map(|h| h - edge_radius), *edge_radius)?
            }
            Shape::Cylinder { radius, half_height, edge_radius } => {
                cylinder([radius - edge_radius, half_height - edge_radius], *edge_radius)?
            }
            Shape::Plane => {
                let h = PLANE_HALF;
                let corners = [[-h, 0.0, -h], [-h, 0.0, h], [h, 0.0, h], [h, 0.0, -h]];
                (corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]])
            }
            Shape::Mesh(mesh) => (mesh.vertices(), mesh.triangles().to_vec()),
        };
        let placed = vertices.into_iter().map(|v| frame.to_world(v)).collect();
        Ok(Triangulation { vertices: placed, triangles })
    }
}

/// One line across a side of the box: where on the core, and how far the normal leans over.
type Line = (f64, f64);

/// The lines across a side, from edge to edge; `extent` is that of the core.
fn lines(extent: f64, edge_radius: f64) -> Vec<Line> {
    if edge_radius == 0.0 {
        return vec![(-extent, 0.0), (extent, 0.0)];
    }
    let half = QUARTER / 2;
    // The side ends where the normal leans by 45°; there neighbours must agree to the last bit.
    let lean = |k: usize| match k {
        0 => 0.0,
        k if k == half => 1.0,
        k => (FRAC_PI_4 * k as f64 / half as f64).tan(),
    };
    let low = (0..=half).rev().map(|k| (-extent, 0.0 - lean(k)));
    let high = (0..=half).map(|k| (extent, lean(k)));
    low.chain(high).collect()
}

/// A box with rounded edges, or a ball if its core is a point: six sides of a grid each.
fn cuboid(core: Vector, edge_radius: f64) -> Result<Surface, Error> {
    let mut vertices: Vec<Vector> = Vec::new();
    let mut triangles = Vec::new();
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let (across, along) = (lines(core[u], edge_radius), lines(core[v], edge_radius));
        for sign in [1.0, -1.0] {
            let first = vertices.len() as u32;
            for &(at_u, lean_u) in &across {
                for &(at_v, lean_v) in &along {
                    let mut center = [0.0; 3];
                    let mut lean = [0.0; 3];
                    [center[axis], center[u], center[v]] = [sign * core[axis], at_u, at_v];
                    [lean[axis], lean[u], lean[v]] = [sign, lean_u, lean_v];
                    let length = norm(lean);
                    vertices
                        .push(std::array::from_fn(|k| center[k] + edge_radius * lean[k] / length));
                }
            }
            triangles.extend(grid(first, across.len(), along.len(), sign > 0.0));
        }
    }
    weld(&vertices, &triangles)
}

/// A cylinder as a profile in the plane of radius and height, turned about y.
fn cylinder(core: [f64; 2], edge_radius: f64) -> Result<Surface, Error> {
    let rim = |k: usize| {
        let (sine, cosine) = (FRAC_PI_2 * k as f64 / QUARTER as f64).sin_cos();
        (core[0] + edge_radius * sine, core[1] + edge_radius * cosine)
    };
    let last = if edge_radius > 0.0 { QUARTER } else { 0 };
    let mut profile = vec![(0.0, core[1] + edge_radius)];
    profile.extend((0..=last).map(rim));
    profile.extend((0..=last).rev().map(rim).map(|(r, y)| (r, -y)));
    profile.push((0.0, -core[1] - edge_radius));

    let around = 4 * QUARTER;
    let mut vertices: Vec<Vector> = Vec::new();
    for &(radius, height) in &profile {
        for k in 0..=around {
            let (sine, cosine) = (TAU * (k % around) as f64 / around as f64).sin_cos();
            vertices.push([radius * sine, height, radius * cosine]);
        }
    }
    weld(&vertices, &grid(0, profile.len(), around + 1, true))
}

/// Two triangles for each cell of a grid of vertices, stored row by row.
fn grid(first: u32, rows: usize, columns: usize, turned: bool) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let a = first + (row * columns + column) as u32;
            let (b, c, d) = (a + columns as u32, a + columns as u32 + 1, a + 1);
            let halves = [[a, b, c], [a, c, d]];
            triangles.extend(halves.map(|[a, b, c]| if turned { [a, b, c] } else { [a, c, b] }));
        }
    }
    triangles
}
