//! Rigid bodies and the signed distance of a point from them.
//!
//! A body is a shape (ball, box, cylinder, half-space or closed mesh) at a pose. Its signed
//! distance `$d$` is positive outside; with it come the normal `$n = \nabla d$` and the second
//! derivative `$\nabla^2 d$`, all in closed form, for meshes at the nearest point of the surface.
//!
//! A scene makes the bodies. The chapter [`particle`](crate::particle) takes distances from here,
//! and [`surface`](crate::surface) takes bodies as triangles ([`Body::triangulate`]). This chapter
//! uses [`mesh_io`](crate::mesh_io), vectors and errors.

mod inscribed;
mod mesh;
mod nearest_surface;
mod pose;
mod primitive;
mod shape;
mod signed_distance;
mod solid;

pub use mesh::Mesh;
pub use nearest_surface::NearestSurface;
pub use pose::Pose;
pub use shape::Shape;
pub use signed_distance::SignedDistance;

pub(crate) use pose::Frame;
pub(crate) use solid::{DistanceBound, Solid};

use crate::error::{Error, check};
use crate::mesh_io::Triangulation;

/// Rigid body that cloth can touch.
#[derive(Debug, Clone)]
pub struct Body {
    /// Name in messages.
    pub name: String,
    /// Shape in the body's own frame.
    pub shape: Shape,
    /// Position and rotation.
    pub pose: Pose,
    /// Coulomb coefficient `$\mu$` of friction between this body and cloth.
    pub friction: f64,
}

impl Body {
    /// Makes a body at a pose, without friction.
    pub fn new(name: impl Into<String>, shape: Shape, pose: Pose) -> Body {
        Body { name: name.into(), shape, pose, friction: 0.0 }
    }

    /// Returns the body with a coefficient of friction.
    #[must_use]
    pub fn with_friction(self, friction: f64) -> Body {
        Body { friction, ..self }
    }

    /// Returns the signed distance of a point, in m, from the surface of the body.
    ///
    /// It is exact to rounding for all shapes, inside and outside; where several points of the
    /// surface are equally near, the normal is that of one of them. A point that is not finite has
    /// a distance of NaN. The body is checked each time: for many points use
    /// [`ParticleContact`](crate::ParticleContact).
    ///
    /// # Errors
    /// A length, a coefficient or a pose out of range.
    pub fn signed_distance(&self, point: [f64; 3]) -> Result<SignedDistance, Error> {
        Ok(self.solid()?.signed_distance(point))
    }

    /// Returns the surface as triangles at the body's pose, for a picture or a scene.
    ///
    /// A mesh has its own triangles. Curved surfaces are inscribed: their vertices lie on the
    /// body. A plane is a square of 4 m about the body's position.
    ///
    /// # Errors
    /// A length, a coefficient or a pose out of range.
    pub fn triangulate(&self) -> Result<Triangulation, Error> {
        let frame = self.check()?;
        let mut mesh = inscribed::triangulate(&self.shape)?;
        mesh.vertices.iter_mut().for_each(|vertex| *vertex = frame.to_world(*vertex));
        Ok(mesh)
    }

    /// Checks the body.
    pub(crate) fn solid(&self) -> Result<Solid, Error> {
        Ok(Solid { frame: self.check()?, shape: self.shape.clone(), friction: self.friction })
    }

    /// Checks the body and returns its frame.
    pub(crate) fn check(&self) -> Result<Frame, Error> {
        let name = &self.name;
        self.shape.check(name)?;
        check(
            format!("the friction coefficient of the body `{name}`"),
            self.friction,
            "0 or more",
            self.friction >= 0.0,
        )?;
        self.frame()
    }

    /// Checks the pose and returns its frame.
    pub(crate) fn frame(&self) -> Result<Frame, Error> {
        Frame::new(&self.pose, &self.name)
    }
}
