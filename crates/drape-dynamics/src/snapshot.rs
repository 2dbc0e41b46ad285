use drape_cloth::TriangleStrain;
use drape_collide::{Shape, Triangulation};

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
    /// How each of them is stretched and sheared.
    pub strains: Vec<TriangleStrain>,
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
        let bodies = self.contact().bodies().iter().zip(self.outlines());
        let bodies = bodies.filter(|(body, _)| !matches!(body.shape, Shape::Plane));
        Snapshot {
            positions: self.frame().positions,
            coordinates: self.coordinates().to_vec(),
            triangles: self.triangles().to_vec(),
            strains: self.strains(),
            bodies: bodies
                .map(|(_, outline)| Body {
                    positions: outline.vertices.concat(),
                    triangles: outline.triangles,
                })
                .collect(),
            spacing: self.spacing(),
        }
    }

    /// The bodies as triangles, where they are now. Surfaces move their vertices along; otherwise poses do.
    pub(crate) fn outlines(&self) -> Vec<Triangulation> {
        let bodies = self.contact().bodies().iter();
        let outlines = bodies.map(|body| body.triangulate().expect("contact has checked it"));
        let mut outlines: Vec<Triangulation> = outlines.collect();
        if let Some(surfaces) = &self.world.surfaces {
            let mut places = surfaces.contact.body_positions().as_chunks::<3>().0.iter();
            let vertices = outlines.iter_mut().flat_map(|outline| &mut outline.vertices);
            vertices.zip(&mut places).for_each(|(vertex, place)| *vertex = *place);
        }
        outlines
    }
}
