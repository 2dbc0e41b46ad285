//! Shapes of bodies, in the body's own frame.

use super::mesh::Mesh;
use super::primitive;
use super::signed_distance::SignedDistance;
use crate::error::{Error, check};
use crate::vector::Vector;

/// Shape of a body in its own frame.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Shape {
    /// Ball about the origin.
    Sphere {
        /// Radius, in m.
        radius: f64,
    },
    /// Box about the origin with its sides along the axes.
    Box {
        /// Half of the length of each side, in m.
        half_extents: [f64; 3],
        /// Radius to which edges and corners are rounded, in m; 0 for sharp ones.
        edge_radius: f64,
    },
    /// Cylinder about the origin with its axis along y and flat ends.
    Cylinder {
        /// Radius, in m.
        radius: f64,
        /// Half of the height, in m.
        half_height: f64,
        /// Radius to which the rims are rounded, in m; 0 for sharp ones.
        edge_radius: f64,
    },
    /// Half-space of all points with negative y: a floor whose upper side is the surface.
    Plane,
    /// Closed triangle surface.
    Mesh(Mesh),
}

impl Shape {
    /// Checks the lengths of the shape of a body with a name.
    pub(super) fn check(&self, name: &str) -> Result<(), Error> {
        let length = |what: &str, value: f64| {
            check(format!("{what} of the body `{name}`"), value, "a length above 0 m", value > 0.0)
        };
        let rounding = |value: f64, smallest: f64| {
            check(
                format!("the edge radius of the body `{name}`"),
                value,
                "a length in m from 0 to the smallest half extent",
                (0.0..=smallest).contains(&value),
            )
        };
        match self {
            Shape::Sphere { radius } => length("the radius", *radius),
            Shape::Box { half_extents: [x, y, z], edge_radius } => {
                length("the half extent along x", *x)?;
                length("the half extent along y", *y)?;
                length("the half extent along z", *z)?;
                rounding(*edge_radius, x.min(*y).min(*z))
            }
            Shape::Cylinder { radius, half_height, edge_radius } => {
                length("the radius", *radius)?;
                length("the half height", *half_height)?;
                rounding(*edge_radius, radius.min(*half_height))
            }
            Shape::Plane | Shape::Mesh(_) => Ok(()),
        }
    }

    /// Returns the signed distance of a finite point of the body's own frame.
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
