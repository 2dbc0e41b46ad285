//! Parts of the cloth that measures refer to: panels, garments, seams, edges, and the fabrics'
//! measured ranges.

use std::collections::BTreeMap;
use std::ops::Range;

use drape_collide::{Body, Shape};
use drape_scene::{Garment, Material, MeasuredGarment, Panel, Scene, Seam, SeamPairs};
use serde::{Deserialize, Serialize};

/// Parts of the cloth of a scene.
#[derive(Debug)]
pub(crate) struct GarmentParts {
    /// Panels, in the order of the scene.
    pub(crate) panels: Vec<PanelSpan>,
    pub(crate) garments: Vec<HungGarment>,
    /// The garments as surfaces that girths are measured of.
    pub(crate) measured: Vec<MeasuredGarment>,
    /// Lowest point of the bodies, in m, if a garment that is below it falls for ever.
    pub(crate) ground: Option<f64>,
    /// Whether there is a body but the ground.
    pub(crate) has_bodies: bool,
    /// Particles of the seams.
    pub(crate) seams: SeamPairs,
    /// The seams one by one.
    pub(crate) named_seams: Vec<Seam>,
    /// Edges of panels that are not sewn.
    pub(crate) free_edges: Vec<FreeEdge>,
    /// Largest deformation to which each law of each fabric was measured, by the names of fabrics
    /// and the keys of laws.
    pub(crate) measured_ranges: BTreeMap<String, BTreeMap<String, f64>>,
}

/// Particles of a panel.
#[derive(Debug, Clone)]
pub(crate) struct PanelSpan {
    pub(crate) name: String,
    /// Name of its fabric in the scene.
    pub(crate) fabric: String,
    /// Colour in sRGB that the scene states for its fabric.
    pub(crate) colour: Option<[u8; 3]>,
    /// Direction of its weft in its own frame.
    pub(crate) weft: [f64; 2],
    pub(crate) particles: Range<usize>,
}

/// Garment, and where it was when it began to hang.
#[derive(Debug, Clone)]
pub(crate) struct HungGarment {
    pub(crate) name: String,
    particles: Range<usize>,
    /// Its extent when it began to hang.
    pub(crate) hung: VerticalExtent,
    /// Time at which it left its place, in s, if it did.
    pub(crate) slid: Option<f64>,
}

/// Lowest and highest point, in m.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct VerticalExtent {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// Edge of a panel that is not sewn, such as a hem.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FreeEdge {
    /// PANEL.EDGE.
    pub(crate) name: String,
    /// Its particles in their order.
    pub(crate) particles: Vec<u32>,
}

impl GarmentParts {
    /// Parts of a scene.
    pub(crate) fn new(scene: &Scene) -> Self {
        let span = |panel: &Panel| PanelSpan {
            name: panel.name.clone(),
            fabric: scene.materials[panel.material].name.clone(),
            colour: scene.materials[panel.material].colour,
            weft: panel.lattice.grain.weft(),
            particles: panel.particles(),
        };
        let hung = |garment: &Garment| HungGarment::new(garment, &scene.start.positions);
        let garments: Vec<HungGarment> = scene.garments.iter().map(hung).collect();
        let bodies = scene.bodies.iter().map(|moving| &moving.body);
        let seams = scene.sewing.as_ref().map(|sewing| sewing.pairs.clone());
        Self {
            panels: scene.panels.iter().map(span).collect(),
            ground: if garments.is_empty() { None } else { lowest(bodies.clone()) },
            garments,
            measured: MeasuredGarment::all(scene),
            has_bodies: bodies.clone().any(|body| !matches!(body.shape, Shape::Plane)),
            seams: seams.unwrap_or_default(),
            named_seams: scene.sewing.as_ref().map_or_else(Vec::new, |own| own.seams.clone()),
            free_edges: free_edges(scene),
            measured_ranges: measured_ranges(&scene.materials),
        }
    }

    /// Garment that left its place first, in words.
    pub(crate) fn first_slide(&self) -> Option<String> {
        let slid = self.garments.iter().filter_map(|own| Some((own.slid?, &own.name)));
        let (time, name) = slid.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(format!("the garment \"{name}\" left its place on the body at {time:.1} s"))
    }

    /// Name of the seam that sews two particles to each other.
    pub(crate) fn seam_of(&self, ends: [u32; 2]) -> &str {
        let sews = |seam: &&Seam| {
            let tie = |particle| seam.pairs.ties.iter().any(|tie| tie.particle == particle);
            seam.pairs.pairs.contains(&ends) || tie(ends[0])
        };
        self.named_seams.iter().find(sews).map_or("", |seam| &seam.name)
    }

    /// Name of the panel of a particle.
    pub(crate) fn panel_of(&self, particle: usize) -> &str {
        let mut panels = self.panels.iter();
        panels.find(|panel| panel.particles.contains(&particle)).map_or("", |panel| &panel.name)
    }
}

impl HungGarment {
    fn new(garment: &Garment, positions: &[f64]) -> Self {
        let Garment { name, particles, .. } = garment.clone();
        let hung = VerticalExtent { low: 0.0, high: 0.0 };
        let mut own = Self { name, particles, hung, slid: None };
        own.hang(positions);
        own
    }

    /// Notes its extent as that with which it begins to hang.
    pub(crate) fn hang(&mut self, positions: &[f64]) {
        self.hung = self.extent(positions);
    }

    /// Its extent at some positions.
    pub(crate) fn extent(&self, positions: &[f64]) -> VerticalExtent {
        let heights = positions.iter().skip(1).step_by(3);
        let heights = heights.skip(self.particles.start).take(self.particles.len());
        let none = VerticalExtent { low: f64::INFINITY, high: f64::NEG_INFINITY };
        heights.fold(none, |extent, &height| VerticalExtent {
            low: extent.low.min(height),
            high: extent.high.max(height),
        })
    }
}

/// Lowest point of bodies, in m, where nothing below them could catch a garment.
fn lowest<'a>(bodies: impl Iterator<Item = &'a Body> + Clone) -> Option<f64> {
    if bodies.clone().any(|body| matches!(body.shape, Shape::Plane)) {
        return None;
    }
    let outlines = bodies.filter_map(|body| body.triangulate().ok());
    let heights = outlines.flat_map(|outline| outline.vertices).map(|[_, height, _]| height);
    heights.reduce(f64::min)
}

/// Edges of panels whose particles between the ends are not sewn.
fn free_edges(scene: &Scene) -> Vec<FreeEdge> {
    let mut sewn = vec![false; scene.cloth.particles()];
    for SeamPairs { pairs, ties } in scene.sewing.iter().map(|sewing| &sewing.pairs) {
        pairs.iter().flatten().for_each(|&particle| sewn[particle as usize] = true);
        ties.iter().for_each(|tie| sewn[tie.particle as usize] = true);
    }
    let edges = scene.panels.iter().flat_map(|panel| {
        panel.edges.iter().map(move |edge| FreeEdge {
            name: format!("{}.{}", panel.name, edge.name),
            particles: edge.nodes.iter().map(|node| panel.first as u32 + node).collect(),
        })
    });
    let inner = |edge: &FreeEdge| {
        let count = edge.particles.len();
        count > 2 && edge.particles[1..count - 1].iter().all(|&particle| !sewn[particle as usize])
    };
    edges.filter(inner).collect()
}

/// Largest measured deformations of the fabrics of a scene, as their files tell; where one
/// direction of the yarns stands for the other, it does so here.
fn measured_ranges(materials: &[Material]) -> BTreeMap<String, BTreeMap<String, f64>> {
    let ranges = |material: &Material| {
        let mut ranges = material.fabric.provenance.as_ref()?.measured_range.clone();
        for [one, other] in [["warp.traction", "weft.traction"], ["weft.traction", "warp.traction"]]
        {
            if let Some(strain) = ranges.get(one).copied() {
                ranges.entry(other.into()).or_insert(strain);
            }
        }
        Some((material.name.clone(), ranges))
    };
    materials.iter().filter_map(ranges).collect()
}
