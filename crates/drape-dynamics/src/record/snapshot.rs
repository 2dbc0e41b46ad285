//! Snapshot: the cloth and bodies that a picture shows.

use drape_cloth::TriangleStrain;
use drape_collide::Shape;

use crate::measure::garment_parts::{GarmentParts, PanelSpan};
use crate::world::{ALL_PARTICLES, World};

/// Cloth and bodies at one time, for a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Positions of the particles, three numbers each, in m.
    pub positions: Vec<f64>,
    /// Material coordinates of the particles, in m.
    pub coordinates: Vec<[f64; 2]>,
    /// Triangles of the cloth.
    pub triangles: Vec<[u32; 3]>,
    /// Number of the fabric of each triangle.
    pub triangle_fabrics: Vec<usize>,
    /// Fabrics of the cloth, in the order of their first panels.
    pub fabrics: Vec<ShownFabric>,
    /// Stretch and shear of each triangle.
    pub strains: Vec<TriangleStrain>,
    /// Bodies without planes, which have no end.
    pub bodies: Vec<Body>,
    /// Smallest distance of particles before deformation, in m.
    pub spacing: f64,
}

/// Fabric of a cloth, as a picture shows it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ShownFabric {
    /// Name in the scene.
    pub name: String,
    /// Colour in sRGB that the scene states.
    pub colour: Option<[u8; 3]>,
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
    /// Returns the snapshot of a world with the panels `parts`, whose particles are `spacing`
    /// apart, in m.
    pub(crate) fn new(world: &World, parts: &GarmentParts, spacing: f64) -> Self {
        let positions = &world.state.positions;
        // Fabrics, and the number of the fabric of each panel.
        let mut fabrics: Vec<ShownFabric> = Vec::new();
        let mut panel_fabrics = Vec::new();
        for PanelSpan { fabric, colour, .. } in &parts.panels {
            let known = fabrics.iter().position(|shown| shown.name == *fabric);
            panel_fabrics.push(known.unwrap_or(fabrics.len()));
            if known.is_none() {
                fabrics.push(ShownFabric { name: fabric.clone(), colour: *colour });
            }
        }

        // A triangle lies in one panel, and panels follow each other in the list of particles.
        let triangle_fabrics = world.cloth.triangles().iter().map(|corners| {
            let first = corners[0] as usize;
            let panel = parts.panels.partition_point(|panel| panel.particles.end <= first);
            panel_fabrics[panel]
        });
        let bodies = world.contact.bodies().iter().zip(world.contact.triangulations());
        let bodies = bodies.filter(|(body, _)| !matches!(body.shape, Shape::Plane));
        Self {
            positions: positions.clone(),
            coordinates: world.cloth.coordinates().to_vec(),
            triangles: world.cloth.triangles().to_vec(),
            triangle_fabrics: triangle_fabrics.collect(),
            fabrics,
            strains: world.cloth.triangle_strains(positions).expect(ALL_PARTICLES),
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
