use std::ops::Range;

use drape_collide::{
    ContactDistances, Error, Surface, SurfaceContact, SurfaceParts, SurfaceSettings,
};
use drape_fabric::Fabric;

use crate::course::Course;
use crate::panel::Panel;
use crate::scene::Scene;
use crate::stitching::Stitching;

/// Part of a fabric's thickness under pressure that its surfaces keep between them under any load.
const CRUSHED: f64 = 0.5;

/// Largest part of its thickness that a fabric has under pressure, for its contact: one that is not compressed at all
/// would have contact without end.
const PRESSED: f64 = 0.95;

/// The surfaces of a scene's panels and bodies at its start.
#[derive(Debug)]
pub struct StartSurfaces {
    /// Their contact, with bodies as small as they start.
    pub contact: SurfaceContact,
    /// Names of the panels and, behind them, of the bodies: of the groups of the surface.
    pub names: Vec<String>,
    /// Which vertices, among those of all bodies, are each body's.
    pub vertices: Vec<Range<usize>>,
    /// Where the vertices of the bodies belong, in m.
    pub bodies: Vec<f64>,
    /// How far inside of there each vertex starts where bodies grow, as vectors, in m.
    pub inward: Vec<f64>,
    /// Half of the least distance that two surfaces keep, in m.
    pub separation: f64,
}

impl StartSurfaces {
    /// Makes the surfaces of a scene.
    ///
    /// # Errors
    /// Settings or surfaces that are none.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        let Scene { panels, materials, cloth, bodies, contact, .. } = scene;
        let fabric = |panel: &Panel| &materials[panel.material].fabric;
        let skin = |fabric: &Fabric| ContactDistances {
            activation_distance: 0.5 * fabric.thickness,
            min_separation: 0.5 * CRUSHED * fabric.thickness_under_pressure(),
        };
        let skins = panels.iter().map(|panel| skin(fabric(panel)));
        let thinnest = skins.min_by(|a, b| a.activation_distance.total_cmp(&b.activation_distance));
        let thinnest =
            thinnest.unwrap_or(ContactDistances { activation_distance: 0.0, min_separation: 0.0 });
        let sewn = scene.sewing.as_ref().map(|sewing| &sewing.stitching);
        let mut surface = SurfaceParts {
            rest_positions: cloth.coordinates().iter().flat_map(|[u, v]| [*u, *v, 0.0]).collect(),
            triangles: cloth.triangles().to_vec(),
            areas: cloth.areas().to_vec(),
            groups: Vec::new(),
            distances: Vec::new(),
            free_vertices: cloth.particles(),
            seam_pairs: sewn.map_or_else(Vec::new, |sewn| sewn.pairs.clone()),
            ties: sewn.map_or_else(Vec::new, Stitching::triples),
        };
        let mut frictions = Vec::new();
        for (index, panel) in panels.iter().enumerate() {
            surface
                .groups
                .extend(std::iter::repeat_n(index as u32, panel.lattice.coordinates.len()));
            surface.distances.push(skin(fabric(panel)));
            frictions.push(Err(fabric(panel).surface_friction));
        }
        let (mut start, mut inward) = (Vec::new(), Vec::new());
        let mut vertices = Vec::new();
        for moving in bodies {
            let outline = moving.body.triangulate()?;
            let first = surface.groups.len();
            let count = outline.vertices.len();
            vertices.push(start.len() / 3..start.len() / 3 + count);
            start.extend(outline.vertices.iter().flatten());
            // What goes from frame to frame has its size from there.
            let grows = !matches!(moving.course, Some(Course::Shapes(_)));
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
            frictions.push(Ok(moving.body.friction));
        }
        surface.rest_positions.extend(&start);
        let pair = |a: &Result<f64, f64>, b: &Result<f64, f64>| match (a, b) {
            // Of two fabrics the geometric mean; a body's coefficient is that with cloth.
            (Err(a), Err(b)) => (a * b).sqrt(),
            (Ok(body), _) | (_, Ok(body)) => *body,
        };
        let friction = frictions.iter().flat_map(|a| frictions.iter().map(move |b| pair(a, b)));
        let settings = SurfaceSettings {
            stiffness: contact.stiffness.unwrap_or_else(|| {
                panels.iter().map(|panel| stiffness(fabric(panel))).fold(0.0, f64::max)
            }),
            sticking_displacement: contact.stick,
            friction_coefficients: friction.collect(),
            pinch: contact.pinch,
        };
        let at_start: Vec<f64> = match contact.inflation {
            Some(_) => start.iter().zip(&inward).map(|(place, way)| place + way).collect(),
            None => start.clone(),
        };
        let contact = SurfaceContact::new(Surface::new(surface)?, settings, at_start)?;
        let names = panels.iter().map(|panel| &panel.name);
        let names = names.chain(bodies.iter().map(|moving| &moving.body.name)).cloned().collect();
        let separation = thinnest.min_separation;
        Ok(Self { contact, names, vertices, bodies: start, inward, separation })
    }
}

/// Stiffness of contact that presses two layers of a fabric as its compression test does, in N/m³.
fn stiffness(fabric: &Fabric) -> f64 {
    let pressed = fabric.thickness_under_pressure();
    let distance = pressed.min(PRESSED * fabric.thickness);
    let of_pair = ContactDistances {
        activation_distance: fabric.thickness,
        min_separation: CRUSHED * pressed,
    };
    SurfaceSettings::stiffness_for_pressure(Fabric::PRESSURE, distance, of_pair)
}
