//! Shapes of bodies, in the body's frame.

use super::mesh::Mesh;
use super::primitive;
use super::signed_distance::SignedDistance;
use crate::error::{Error, check};
use crate::vector::Vector;

/// Shape of a body, in the body's frame.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Shape {
    /// Ball about the origin.
    Sphere {
        /// Radius, in m.
        radius: f64,
    },
    /// Box about the origin, with its sides along the axes.
    Box {
        /// Half of the length of each side, in m.
        half_extents: [f64; 3],
        /// Radius to which edges and corners are rounded, in m; 0 gives sharp edges.
        edge_radius: f64,
    },
    /// Cylinder about the origin with its axis along y and with flat ends.
    Cylinder {
        /// Radius, in m.
        radius: f64,
        /// Half of the height, in m.
        half_height: f64,
        /// Radius to which the rims are rounded, in m; 0 gives sharp rims.
        edge_radius: f64,
    },
    /// Half-space of all points with negative y: a floor whose upper side is at y = 0.
    Plane,
    /// Closed triangle surface.
    Mesh(Mesh),
}

impl Shape {
    /// Checks the lengths of this shape. Errors name the body `name`.
    pub(super) fn check(&self, name: &str) -> Result<(), Error> {
        match self {
            Shape::Sphere { radius } => check_length("the radius", name, *radius),
            Shape::Box { half_extents: [x, y, z], edge_radius } => {
                check_length("the half extent along x", name, *x)?;
                check_length("the half extent along y", name, *y)?;
                check_length("the half extent along z", name, *z)?;
                check_edge_radius(name, *edge_radius, x.min(*y).min(*z))
            }

            Shape::Cylinder { radius, half_height, edge_radius } => {
                check_length("the radius", name, *radius)?;
                check_length("the half height", name, *half_height)?;
                check_edge_radius(name, *edge_radius, radius.min(*half_height))
            }
            Shape::Plane | Shape::Mesh(_) => Ok(()),
        }
    }

    /// Returns the [`SignedDistance`] of `point`, which must be finite and in the body's frame.
    pub(super) fn signed_distance(&self, point: Vector) -> SignedDistance {
        match self {
            Shape::Sphere { radius } => primitive::sphere(point, *radius),
            Shape::Box { half_extents, edge_radius } => {
                let core = half_extents.map(|extent| extent - edge_radius);
                primitive::cuboid(point, core, *edge_radius)
            }
            Shape::Cylinder { radius, half_height, edge_radius } => {
                let core = [radius - edge_radius, half_height - edge_radius];
                primitive::cylinder(point, core, *edge_radius)
            }
            Shape::Plane => SignedDistance::flat(point[1], [0.0, 1.0, 0.0]),
            Shape::Mesh(mesh) => mesh.signed_distance(point),
        }
    }
}

/// Checks that `value`, the length `what` of the body `name`, is positive.
fn check_length(what: &str, name: &str, value: f64) -> Result<(), Error> {
    check(format!("{what} of the body `{name}`"), value, "a length above 0 m", value > 0.0)
}

/// Checks that `edge_radius` of the body `name` is at most its `smallest` half extent, in m.
fn check_edge_radius(name: &str, edge_radius: f64, smallest: f64) -> Result<(), Error> {
    check(
        format!("the edge radius of the body `{name}`"),
        edge_radius,
        "a length in m from 0 to the smallest half extent",
        (0.0..=smallest).contains(&edge_radius),
    )
}
