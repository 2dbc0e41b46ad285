use serde::Serialize;

use crate::Simulation;
use crate::simulation::PanelSpan;

/// Format of a folder of frames, which `drape-verify` describes.
const FORMAT: u64 = 1;

/// What all frames of a run have in common: the content of `surfaces.json`, and the triangles.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Topology {
    /// Format of the folder.
    format: u64,
    /// Whether surfaces are kept apart.
    pub guarded: bool,
    /// The panels, in the order of the cloth's vertices.
    pub panels: Vec<Part>,
    /// The bodies, in the order of their vertices.
    pub bodies: Vec<Part>,
    /// Part of the distance between cloth and bodies that is kept wherever bodies pinch the cloth.
    #[serde(skip_serializing_if = "is_whole")]
    thinned: f64,
    /// Pairs of the cloth's vertices that are sewn together.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub twins: Vec<[u32; 2]>,
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

/// A panel or a body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Part {
    /// What it is called.
    pub name: String,
    /// Number of its vertices.
    pub vertices: usize,
    /// Number of its triangles.
    pub triangles: usize,
    /// Half of the distance below which it and another part push each other, in m; 0 where surfaces are not kept apart.
    pub reach: f64,
    /// Half of the distance that it and another part keep, in m; likewise.
    pub separation: f64,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for it so")]
fn is_whole(part: &f64) -> bool {
    *part == 1.0
}

impl Simulation {
    /// What all frames have in common.
    #[must_use]
    pub fn topology(&self) -> Topology {
        let cloth = &self.world.cloth;
        let mut groups = 0..;
        let mut part = |name: &str, [vertices, triangles]: [usize; 2]| {
            let surfaces = self.world.surfaces.as_ref();
            let skins = surfaces.map(|surfaces| surfaces.contact.surface().group_distances());
            let skin = groups.next().and_then(|group: usize| skins?.get(group));
            let [reach, separation] =
                skin.map_or([0.0; 2], |skin| [skin.activation_distance, skin.min_separation]);
            Part { name: name.to_owned(), vertices, triangles, reach, separation }
        };
        let panels = self.panels.iter().map(|PanelSpan { name, particles: own, .. }| {
            let its = |triangle: &&[u32; 3]| own.contains(&(triangle[0] as usize));
            part(name, [own.len(), cloth.triangles().iter().filter(its).count()])
        });
        let panels = panels.collect();
        let (mut bodies, mut body_triangles) = (Vec::new(), Vec::new());
        let mut first = 0;
        for (body, outline) in self.contact().bodies().iter().zip(self.outlines()) {
            bodies.push(part(&body.name, [outline.vertices.len(), outline.triangles.len()]));
            let corners = |triangle: &[u32; 3]| triangle.map(|corner| corner + first);
            body_triangles.extend(outline.triangles.iter().map(corners));
            first += outline.vertices.len() as u32;
        }
        Topology {
            format: FORMAT,
            guarded: self.world.surfaces.is_some(),
            panels,
            bodies,
            thinned: self.world.surfaces.as_ref().map_or(1.0, |s| s.contact.thinned_fraction()),
            twins: self.sewn.pairs.clone(),
            ties: self.sewn.triples(),
            coordinates: cloth.coordinates().to_vec(),
            triangles: cloth.triangles().to_vec(),
            body_triangles,
        }
    }
}
