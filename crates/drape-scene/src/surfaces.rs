//! Surfaces of a scene at its start, for checks and for the simulation.
//!
//! Every panel and every body is a group of the surface, with contact distances of its own: of a
//! panel half of its fabric's thickness, as half of the distance between two layers.

use std::ops::Range;

use drape_collide::{
    ContactDistances, Error, Surface, SurfaceContact, SurfaceParts, SurfaceSettings,
};
use drape_fabric::Fabric;

use crate::contact_stiffness::min_separation;
use crate::scene::Scene;
use crate::scene::motion::BodyMotion;
use crate::scene::panel::Panel;
use crate::scene::seam::SeamPairs;

/// Surfaces of a scene's panels and bodies at its start.
#[derive(Debug)]
pub struct StartSurfaces {
    /// Contact of the surfaces, with bodies as small as they start and seams open.
    pub contact: SurfaceContact,
    /// Names of the panels and, behind them, of the bodies: of the groups of the surface.
    pub names: Vec<String>,
    /// Vertices of each body among the vertices of all bodies.
    pub vertices: Vec<Range<usize>>,
    /// Positions at which the vertices of the bodies belong, in m.
    pub bodies: Vec<f64>,
    /// Displacements from there to where the vertices start, in m: inward where bodies grow.
    pub inward: Vec<f64>,
    /// Half of the smallest minimum separation, in m.
    pub min_separation: f64,
}

/// Coefficient of friction of a group of the surface.
#[derive(Debug, Clone, Copy)]
enum Friction {
    /// Of a fabric with itself.
    Fabric(f64),
    /// Of a body with cloth.
    Body(f64),
}

impl Friction {
    /// Returns the coefficient of a pair of groups: the geometric mean for two fabrics, and the
    /// coefficient of the body for a fabric and a body.
    fn pair(self, other: Self) -> f64 {
        match (self, other) {
            (Self::Fabric(a), Self::Fabric(b)) => (a * b).sqrt(),
            (Self::Body(body), _) | (_, Self::Body(body)) => body,
        }
    }
}

impl StartSurfaces {
    /// Makes the surfaces of a scene.
    ///
    /// # Errors
    /// Settings or bodies that make no contact.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        let Scene { panels, materials, cloth, bodies, contact, .. } = scene;
        let fabric = |panel: &Panel| &materials[panel.material].fabric;
        let distances = |fabric: &Fabric| ContactDistances {
            activation_distance: 0.5 * fabric.thickness,
            min_separation: 0.5 * min_separation(fabric),
        };
        let all = panels.iter().map(|panel| distances(fabric(panel)));
        let thinnest = all.min_by(|a, b| a.activation_distance.total_cmp(&b.activation_distance));
        let thinnest =
            thinnest.unwrap_or(ContactDistances { activation_distance: 0.0, min_separation: 0.0 });
        let sewn = scene.sewing.as_ref().map(|sewing| &sewing.pairs);
        let mut surface = SurfaceParts {
            rest_positions: cloth.coordinates().iter().flat_map(|[u, v]| [*u, *v, 0.0]).collect(),
            triangles: cloth.triangles().to_vec(),
            areas: cloth.areas().to_vec(),
            groups: Vec::new(),
            distances: Vec::new(),
            free_vertices: cloth.particle_count(),
            seam_pairs: sewn.map_or_else(Vec::new, |sewn| sewn.pairs.clone()),
            ties: sewn.map_or_else(Vec::new, SeamPairs::tied_triples),
        };
        let mut frictions = Vec::new();
        for (index, panel) in panels.iter().enumerate() {
            surface
                .groups
                .extend(std::iter::repeat_n(index as u32, panel.lattice.coordinates().len()));
            surface.distances.push(distances(fabric(panel)));
            frictions.push(Friction::Fabric(fabric(panel).surface_friction));
        }
        let (mut start, mut inward) = (Vec::new(), Vec::new());
        let mut vertices = Vec::new();
        for moving in bodies {
            let outline = moving.body.triangulate()?;
            let first = surface.groups.len();
            let count = outline.vertices.len();
            vertices.push(start.len() / 3..start.len() / 3 + count);
            start.extend(outline.vertices.iter().flatten());
            // A body that changes its shape has its size from its frames.
            let grows = !matches!(moving.motion, Some(BodyMotion::Shapes(_)));
            let depth = contact
                .inflation
                .map_or(0.0, |inflation| if grows { inflation.depth } else { 0.0 });
            inward.extend(outline.normals().iter().flatten().map(|n| -depth * n));
            let corners = |t: &[u32; 3]| t.map(|corner| corner + first as u32);
            surface.triangles.extend(outline.triangles.iter().map(corners));
            surface.areas.extend(std::iter::repeat_n(0.0, count));
            surface.groups.extend(std::iter::repeat_n(surface.distances.len() as u32, count));
            // Half of the cloth's thickness is its own.
            let half = thinnest.activation_distance;
            let activation_distance = (contact.particles.activation_distance - half).max(half);
            surface.distances.push(ContactDistances { activation_distance, ..thinnest });
            frictions.push(Friction::Body(moving.body.friction));
        }
        surface.rest_positions.extend(&start);
        let friction = frictions.iter().flat_map(|a| frictions.iter().map(|b| a.pair(*b)));
        let settings = SurfaceSettings {
            stiffness: scene.contact_stiffness(),
            sticking_displacement: contact.sticking_displacement,
            friction_coefficients: friction.collect(),
            pinch: contact.pinch,
        };
        let at_start: Vec<f64> = match contact.inflation {
            Some(_) => start.iter().zip(&inward).map(|(place, inward)| place + inward).collect(),
            None => start.clone(),
        };
        let mut contact = SurfaceContact::new(Surface::new(surface)?, settings, at_start)?;
        if let Some(seams) = sewn {
            let positions = &scene.start.positions;
            contact.setup()?.open_seams(&seams.gaps_at_particles(positions), positions)?;
        }
        let names = panels.iter().map(|panel| &panel.name);
        let names = names.chain(bodies.iter().map(|moving| &moving.body.name)).cloned().collect();
        let min_separation = thinnest.min_separation;
        Ok(Self { contact, names, vertices, bodies: start, inward, min_separation })
    }
}
