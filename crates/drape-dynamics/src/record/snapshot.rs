//! Snapshot: what a picture of a scene shows.

use drape_cloth::TriangleStrain;
use drape_collide::Shape;

use crate::world::World;

/// Cloth and bodies at one time, for a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Positions of the particles, three numbers each, in m.
    pub positions: Vec<f64>,
    /// Material coordinates of the particles, in m.
    pub coordinates: Vec<[f64; 2]>,
    /// Triangles of the cloth.
    pub triangles: Vec<[u32; 3]>,
    /// Stretch and shear of each of them.
    pub strains: Vec<TriangleStrain>,
    /// Bodies but planes, which have no end.
    pub bodies: Vec<Body>,
    /// Smallest distance of particles before deformation, in m.
    pub spacing: f64,
}

/// Surface of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Positions of its corners, three numbers each, in m.
    pub positions: Vec<f64>,
    /// Its triangles.
    pub triangles: Vec<[u32; 3]>,
}

impl Snapshot {
    /// Snapshot of a world whose particles are a spacing apart, in m.
    pub(crate) fn new(world: &World, spacing: f64) -> Self {
        let positions = &world.state.positions;
        let bodies = world.contact.bodies().iter().zip(world.contact.triangulations());
        let bodies = bodies.filter(|(body, _)| !matches!(body.shape, Shape::Plane));
        Self {
            positions: positions.clone(),
            coordinates: world.cloth.coordinates().to_vec(),
            triangles: world.cloth.triangles().to_vec(),
            strains: world.cloth.triangle_strains(positions),
            bodies: bodies
                .map(|(_, outline)| Body {
                    positions: outline.vertices.concat(),
                    triangles: outline.triangles,
                })
                .collect(),
            spacing,
        }
    }
}
