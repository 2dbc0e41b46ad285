use drape_collide::Shape;

use crate::Simulation;

/// What a picture of a scene needs: the cloth and the bodies at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Positions of the particles, three numbers each, in m.
    pub positions: Vec<f64>,
    /// Material coordinates of the particles, in m.
    pub coordinates: Vec<[f64; 2]>,
    /// Triangles of the cloth.
    pub triangles: Vec<[u32; 3]>,
    /// The bodies but planes, which have no end.
    pub bodies: Vec<Body>,
    /// Smallest distance of particles before deformation, in m.
    pub spacing: f64,
}

/// The surface of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Positions of its corners, three numbers each, in m.
    pub positions: Vec<f64>,
    /// Its triangles.
    pub triangles: Vec<[u32; 3]>,
}

impl Simulation {
    /// Cloth and bodies now.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot {
        let bodies = self.contact().bodies().iter();
        let outlines = bodies.filter(|body| !matches!(body.shape, Shape::Plane));
        let outlines = outlines.filter_map(|body| body.triangulate().ok());
        Snapshot {
            positions: self.frame().positions,
            coordinates: self.coordinates().to_vec(),
            triangles: self.triangles().to_vec(),
            bodies: outlines
                .map(|outline| Body {
                    positions: outline.vertices.concat(),
                    triangles: outline.triangles,
                })
                .collect(),
            spacing: self.spacing(),
        }
    }
}
