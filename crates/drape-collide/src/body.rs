use crate::error::{Error, check};
use crate::mesh::Mesh;
use crate::pose::{Frame, Pose};
use crate::primitive;
use crate::proximity::SignedDistance;
use crate::vector::Vector;

/// The form of a body in its own frame.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Shape {
    /// A ball about the origin.
    Sphere {
        /// Radius, in m.
        radius: f64,
    },
    /// A box about the origin with its sides along the axes.
    Box {
        /// Half of the length of each side, in m.
        half_extents: [f64; 3],
        /// Radius to which edges and corners are rounded, in m; 0 for sharp ones.
        edge_radius: f64,
    },
    /// A cylinder about the origin with its axis along y and flat ends.
    Cylinder {
        /// Radius, in m.
        radius: f64,
        /// Half of the height, in m.
        half_height: f64,
        /// Radius to which the rims are rounded, in m; 0 for sharp ones.
        edge_radius: f64,
    },
    /// All points with negative y: a floor whose upper side is the surface.
    Plane,
    /// A closed triangle surface.
    Mesh(Mesh),
}

/// A rigid body that cloth can touch.
#[derive(Debug, Clone)]
pub struct Body {
    /// What the body is called in messages.
    pub name: String,
    /// Its form.
    pub shape: Shape,
    /// Where it is.
    pub pose: Pose,
    /// Coulomb coefficient `$\mu$` of friction between this body and the cloth.
    pub friction: f64,
}

impl Body {
    /// A body at a pose, without friction.
    pub fn new(name: impl Into<String>, shape: Shape, pose: Pose) -> Body {
        Body { name: name.into(), shape, pose, friction: 0.0 }
    }

    /// The same body with a coefficient of friction.
    pub fn with_friction(self, friction: f64) -> Body {
        Body { friction, ..self }
    }

    /// How a point in m lies to the surface of the body.
    ///
    /// Exact to rounding for all shapes, inside and outside; where several points of the surface
    /// are equally near, the normal is that of one of them. A point that is not finite gets an
    /// answer of NaN throughout. The body is checked each time: for many points use
    /// [`ParticleContact`](crate::ParticleContact).
    pub fn signed_distance(&self, point: [f64; 3]) -> Result<SignedDistance, Error> {
        Ok(Solid::new(self)?.signed_distance(point))
    }

    pub(crate) fn check(&self) -> Result<Frame, Error> {
        let name = &self.name;
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
        match &self.shape {
            Shape::Sphere { radius } => length("the radius", *radius)?,
            Shape::Box { half_extents: [x, y, z], edge_radius } => {
                length("the half extent along x", *x)?;
                length("the half extent along y", *y)?;
                length("the half extent along z", *z)?;
                rounding(*edge_radius, x.min(*y).min(*z))?;
            }
            Shape::Cylinder { radius, half_height, edge_radius } => {
                length("the radius", *radius)?;
                length("the half height", *half_height)?;
                rounding(*edge_radius, radius.min(*half_height))?;
            }
            Shape::Plane | Shape::Mesh(_) => {}
        }
        check(
            format!("the friction coefficient of the body `{name}`"),
            self.friction,
            "0 or more",
            self.friction >= 0.0,
        )?;
        Frame::new(&self.pose, name)
    }
}

/// A body that has been checked.
#[derive(Debug, Clone)]
pub(crate) struct Solid {
    pub(crate) shape: Shape,
    pub(crate) frame: Frame,
    pub(crate) friction: f64,
}

/// Whether a particle can touch a body.
pub(crate) enum Reach {
    Near(SignedDistance),
    /// Farther off than asked, and at least this far, in m.
    Clear(f64),
}

impl Solid {
    pub(crate) fn new(body: &Body) -> Result<Solid, Error> {
        Ok(Solid { frame: body.check()?, shape: body.shape.clone(), friction: body.friction })
    }

    pub(crate) fn is_mesh(&self) -> bool {
        matches!(self.shape, Shape::Mesh(_))
    }

    pub(crate) fn signed_distance(&self, point: Vector) -> SignedDistance {
        // Comparisons and `max` would lose a NaN on the way.
        if !point.iter().all(|value| value.is_finite()) {
            return SignedDistance::UNKNOWN;
        }
        let local = self.frame.to_local(point);
        let proximity = match &self.shape {
            Shape::Sphere { radius } => primitive::sphere(local, *radius),
            Shape::Box { half_extents, edge_radius } => {
                let core = half_extents.map(|extent| extent - edge_radius);
                primitive::cuboid(local, core, *edge_radius)
            }
            Shape::Cylinder { radius, half_height, edge_radius } => {
                let core = [radius - edge_radius, half_height - edge_radius];
                primitive::cylinder(local, core, *edge_radius)
            }
            Shape::Plane => SignedDistance::flat(local[1], [0.0, 1.0, 0.0]),
            Shape::Mesh(mesh) => mesh.signed_distance(local),
        };
        proximity.to_world(&self.frame)
    }

    /// The proximity if the distance is below `activation_distance`, else how far off the body surely is.
    pub(crate) fn distance_within(&self, point: Vector, activation_distance: f64) -> Reach {
        let finite = point.iter().all(|value| value.is_finite());
        if let (Shape::Mesh(mesh), true) = (&self.shape, finite) {
            let bound = mesh.distance_to_box(self.frame.to_local(point));
            if bound >= activation_distance {
                return Reach::Clear(bound);
            }
        }
        let proximity = self.signed_distance(point);
        // Written so that NaN counts as near.
        if proximity.distance >= activation_distance {
            Reach::Clear(proximity.distance)
        } else {
            Reach::Near(proximity)
        }
    }
}
