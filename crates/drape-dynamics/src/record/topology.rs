//! Topology: what all frames have in common, stored once.

use serde::Serialize;

use crate::measure::garment_parts::GarmentParts;
use crate::world::World;

/// Format of a folder of frames, which `drape-frames` describes.
const FORMAT: u64 = 2;

/// Data that all frames of a run have in common: the content of `surfaces.json`, and arrays.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Topology {
    /// Format of the folder.
    format: u64,
    /// Unit of all lengths.
    units: &'static str,
    /// Axis against gravity.
    up: &'static str,
    /// Whether surfaces are kept apart.
    #[serde(rename = "guarded")]
    pub keeps_surfaces_apart: bool,
    /// Panels, in the order of the cloth's vertices.
    pub panels: Vec<Part>,
    /// Bodies, in the order of their vertices.
    pub bodies: Vec<Part>,
    /// Fraction of the distance between cloth and bodies that is kept wherever bodies pinch the
    /// cloth.
    #[serde(rename = "thinned", skip_serializing_if = "is_whole")]
    thinned_fraction: f64,
    /// Pairs of the cloth's vertices that are sewn together.
    #[serde(rename = "twins", skip_serializing_if = "Vec::is_empty")]
    pub seam_pairs: Vec<[u32; 2]>,
    /// Vertices of the cloth that are sewn to a place between two others, and these.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ties: Vec<[u32; 3]>,
    /// Material coordinates of the particles, in m.
    #[serde(skip)]
    pub coordinates: Vec<[f64; 2]>,
    /// Triangles of the cloth.
    #[serde(skip)]
    pub triangles: Vec<[u32; 3]>,
    /// Triangles of the bodies.
    #[serde(skip)]
    pub body_triangles: Vec<[u32; 3]>,
}

/// Panel or body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Part {
    /// Name.
    pub name: String,
    /// Number of its vertices.
    pub vertices: usize,
    /// Number of its triangles.
    pub triangles: usize,
    /// Half of the activation distance to another part, in m; 0 where surfaces are not kept apart.
    #[serde(rename = "reach")]
    pub half_activation_distance: f64,
    /// Half of the minimum separation from another part, in m; likewise.
    #[serde(rename = "separation")]
    pub half_min_separation: f64,
    /// What only a panel has.
    #[serde(flatten)]
    pub panel: Option<PanelData>,
}

/// Data of a panel that a body has not.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PanelData {
    /// Name of its fabric in the scene.
    pub fabric: String,
    /// Colour that the scene states for its fabric, as `#rrggbb` in sRGB.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<String>,
    /// Direction of its weft in its own frame.
    pub weft: [f64; 2],
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for it so")]
fn is_whole(fraction: &f64) -> bool {
    *fraction == 1.0
}

impl Topology {
    /// Topology of a world and the parts of its cloth.
    pub(crate) fn new(world: &World, parts: &GarmentParts) -> Self {
        let cloth = &world.cloth;
        let surfaces = world.contact.surfaces();
        let mut groups = 0..;
        let mut part = |name: &str, vertices: usize, triangles: usize| {
            let distances = surfaces.map(|surfaces| surfaces.contact.surface().group_distances());
            let own = groups.next().and_then(|group: usize| distances?.get(group));
            Part {
                name: name.to_owned(),
                vertices,
                triangles,
                half_activation_distance: own.map_or(0.0, |own| own.activation_distance),
                half_min_separation: own.map_or(0.0, |own| own.min_separation),
                panel: None,
            }
        };
        let panels = parts.panels.iter().map(|panel| {
            let own = |triangle: &&[u32; 3]| panel.particles.contains(&(triangle[0] as usize));
            let triangles = cloth.triangles().iter().filter(own).count();
            let colour =
                panel.colour.map(|[red, green, blue]| format!("#{red:02x}{green:02x}{blue:02x}"));
            let data = PanelData { fabric: panel.fabric.clone(), colour, weft: panel.weft };
            Part { panel: Some(data), ..part(&panel.name, panel.particles.len(), triangles) }
        });
        let panels = panels.collect();
        let (mut bodies, mut body_triangles) = (Vec::new(), Vec::new());
        let mut first = 0;
        for (body, outline) in world.contact.bodies().iter().zip(world.contact.triangulations()) {
            bodies.push(part(&body.name, outline.vertices.len(), outline.triangles.len()));
            let corners = |triangle: &[u32; 3]| triangle.map(|corner| corner + first);
            body_triangles.extend(outline.triangles.iter().map(corners));
            first += outline.vertices.len() as u32;
        }
        Self {
            format: FORMAT,
            units: "m",
            up: "y",
            keeps_surfaces_apart: surfaces.is_some(),
            panels,
            bodies,
            thinned_fraction: surfaces.map_or(1.0, |surfaces| surfaces.contact.thinned_fraction()),
            seam_pairs: parts.seams.pairs.clone(),
            ties: parts.seams.tied_triples(),
            coordinates: cloth.coordinates().to_vec(),
            triangles: cloth.triangles().to_vec(),
            body_triangles,
        }
    }
}
