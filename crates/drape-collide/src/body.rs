//! Rigid bodies and the signed distance of a point from them.
//!
//! A body is a shape (ball, box, cylinder, half-space or closed mesh) at a pose. Its signed
//! distance `$d$` is positive outside; with it come the normal `$n = \nabla d$` and the second
//! derivative `$\nabla^2 d$`. All are in closed form; a mesh takes them at the nearest point of its
//! surface.
//!
//! A scene builds the bodies. The chapter [`particle`](crate::particle) asks bodies for distances,
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

pub(crate) use pose::BodyFrame;
pub(crate) use solid::{DistanceBound, Solid};

use crate::error::{Error, check};
use crate::mesh_io::Triangulation;

/// Rigid body that cloth can touch.
#[derive(Debug, Clone)]
pub struct Body {
    /// Name in messages.
    pub name: String,
    /// Shape, in the body's frame.
    pub shape: Shape,
    /// Position and rotation of the body's frame in the world.
    pub pose: Pose,
    /// Coulomb coefficient `$\mu$` of friction between this body and cloth.
    pub friction: f64,
}

impl Body {
    /// Returns a body named `name` with `shape` at `pose`, without friction.
    pub fn new(name: impl Into<String>, shape: Shape, pose: Pose) -> Body {
        Body { name: name.into(), shape, pose, friction: 0.0 }
    }

    /// Returns this body with `friction` as its Coulomb coefficient.
    #[must_use]
    pub fn with_friction(self, friction: f64) -> Body {
        Body { friction, ..self }
    }

    /// Returns the signed distance of `point`, in m, from the surface of this body.
    ///
    /// The distance is exact to rounding for all shapes, inside and outside. Where several points
    /// of the surface are equally near, the normal belongs to one of them. A `point` that is not
    /// finite has a distance of NaN. Every call checks the body: for many points use
    /// [`ParticleContact`](crate::ParticleContact).
    ///
    /// # Errors
    /// A length, a coefficient or a pose is out of range.
    pub fn signed_distance(&self, point: [f64; 3]) -> Result<SignedDistance, Error> {
        Ok(self.solid()?.signed_distance(point))
    }

    /// Returns the surface as a [`Triangulation`] at the body's pose, in m, for a picture or a
    /// scene.
    ///
    /// A mesh keeps its triangles. Curved surfaces are inscribed: their vertices lie on the body. A
    /// plane is a square of 4 m about the body's position.
    ///
    /// # Errors
    /// A length, a coefficient or a pose is out of range.
    pub fn triangulate(&self) -> Result<Triangulation, Error> {
        let frame = self.check()?;
        let mut mesh = inscribed::triangulate(&self.shape)?;
        mesh.vertices.iter_mut().for_each(|vertex| *vertex = frame.to_world(*vertex));
        Ok(mesh)
    }

    /// Checks this body and returns it as a [`Solid`].
    pub(crate) fn solid(&self) -> Result<Solid, Error> {
        Ok(Solid { frame: self.check()?, shape: self.shape.clone(), friction: self.friction })
    }

    /// Checks the shape, the friction coefficient and the pose. Returns the body's [`BodyFrame`].
    pub(crate) fn check(&self) -> Result<BodyFrame, Error> {
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

    /// Checks the pose and returns the body's [`BodyFrame`].
    pub(crate) fn frame(&self) -> Result<BodyFrame, Error> {
        BodyFrame::new(&self.pose, &self.name)
    }
}
