//! Topology: the data that all frames share, stored once.

use drape_collide::ContactDistances;
use serde::Serialize;

use crate::measure::garment_parts::GarmentParts;
use crate::world::World;

/// Format of a folder of frames, which `drape-frames` describes.
const FORMAT: u64 = 2;

/// Data that all frames of a run share: the content of `surfaces.json`, and arrays.
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
    pub panels: Vec<SurfacePart>,
    /// Bodies, in the order of their vertices.
    pub bodies: Vec<SurfacePart>,
    /// Fraction of the distance between cloth and bodies that is kept where bodies pinch the cloth.
    #[serde(rename = "thinned", skip_serializing_if = "is_whole")]
    thinned_fraction: f64,
    /// Pairs of the cloth's vertices that are sewn together.
    #[serde(rename = "twins", skip_serializing_if = "Vec::is_empty")]
    pub seam_pairs: Vec<[u32; 2]>,
    /// Vertices of the cloth that are sewn to a point between two others. Each entry has the tied
    /// vertex and the two others.
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

/// Panel or body, with its numbers of vertices and triangles.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct SurfacePart {
    /// Name.
    pub name: String,
    /// Number of vertices.
    pub vertices: usize,
    /// Number of triangles.
    pub triangles: usize,
    /// Half of the activation distance to another part, in m; 0 where surfaces are not kept apart.
    #[serde(rename = "reach")]
    pub half_activation_distance: f64,
    /// Half of the minimum separation from another part, in m; 0 where surfaces are not kept apart.
    #[serde(rename = "separation")]
    pub half_min_separation: f64,
    /// Data that only a panel has.
    #[serde(flatten)]
    pub panel: Option<PanelData>,
}

/// Data of a panel that a body does not have.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PanelData {
    /// Name of the fabric in the scene.
    pub fabric: String,
    /// Colour that the scene states for the fabric, as `#rrggbb` in sRGB.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<String>,
    /// Direction of the weft in the frame of the panel.
    pub weft: [f64; 2],
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for it so")]
fn is_whole(fraction: &f64) -> bool {
    *fraction == 1.0
}

impl SurfacePart {
    /// Returns this part with half of the `distances` of its group, if it has any.
    fn with_distances(self, distances: Option<&ContactDistances>) -> Self {
        let Some(distances) = distances else { return self };
        Self {
            half_activation_distance: distances.activation_distance,
            half_min_separation: distances.min_separation,
            ..self
        }
    }
}

impl Topology {
    /// Returns the topology of `world` and `parts`.
    pub(crate) fn new(world: &World, parts: &GarmentParts) -> Self {
        let cloth = &world.cloth;
        let surfaces = world.contact.surfaces();
        let distances = surfaces.map(|surfaces| surfaces.contact.surface().group_distances());

        // The groups of the surface are the panels and then the bodies.
        let panels = parts.panels.iter().enumerate().map(|(group, panel)| {
            let first_corners = cloth.triangles().iter().map(|triangle| triangle[0] as usize);
            let triangles = first_corners.filter(|corner| panel.particles.contains(corner)).count();
            let colour =
                panel.colour.map(|[red, green, blue]| format!("#{red:02x}{green:02x}{blue:02x}"));
            let data = PanelData { fabric: panel.fabric.clone(), colour, weft: panel.weft };
            let part = SurfacePart {
                name: panel.name.clone(),
                vertices: panel.particles.len(),
                triangles,
                panel: Some(data),
                ..SurfacePart::default()
            };
            part.with_distances(distances.and_then(|distances| distances.get(group)))
        });
        let panels: Vec<SurfacePart> = panels.collect();

        let (mut bodies, mut body_triangles) = (Vec::new(), Vec::new());
        let mut first = 0;
        for (body, outline) in world.contact.bodies().iter().zip(world.contact.triangulations()) {
            let group = panels.len() + bodies.len();
            let part = SurfacePart {
                name: body.name.clone(),
                vertices: outline.vertices.len(),
                triangles: outline.triangles.len(),
                ..SurfacePart::default()
            };
            bodies.push(part.with_distances(distances.and_then(|distances| distances.get(group))));
            let triangles = outline.triangles.iter();
            body_triangles.extend(triangles.map(|corners| corners.map(|corner| corner + first)));
            first += outline.vertices.len() as u32;
        }

        Self {
            format: FORMAT,
            units: "m",
            up: "y",
            keeps_surfaces_apart: surfaces.is_some(),
            panels,
            bodies,
            thinned_fraction: surfaces
                .map_or(1.0, |surfaces| surfaces.contact.state().thinned_fraction()),
            seam_pairs: parts.seams.pairs.clone(),
            ties: parts.seams.tied_triples(),
            coordinates: cloth.coordinates().to_vec(),
            triangles: cloth.triangles().to_vec(),
            body_triangles,
        }
    }
}
