//! Parts of the cloth to which measures refer: panels, garments, seams, edges, and the measured
//! ranges of the fabrics.

use std::collections::BTreeMap;
use std::ops::Range;

use drape_collide::{Body, Shape};
use drape_scene::{Garment, Material, MeasuredGarment, Scene, Seam, SeamPairs};
use serde::{Deserialize, Serialize};

/// Parts of the cloth of a scene.
#[derive(Debug)]
pub(crate) struct GarmentParts {
    /// Panels, in the order of the scene.
    pub(crate) panels: Vec<PanelSpan>,
    pub(crate) garments: Vec<HungGarment>,
    /// The garments as surfaces whose girths are measured.
    pub(crate) measured: Vec<MeasuredGarment>,
    /// Lowest point of the bodies, in m, if nothing stops a garment below it.
    pub(crate) ground: Option<f64>,
    /// Whether there is a body other than the ground.
    pub(crate) has_bodies: bool,
    /// Particles of the seams.
    pub(crate) seams: SeamPairs,
    /// Seams with their names.
    pub(crate) named_seams: Vec<Seam>,
    /// Edges of panels that are not part of a seam.
    pub(crate) free_edges: Vec<FreeEdge>,
    /// Ranges of the fabrics.
    pub(crate) materials: Vec<MaterialRanges>,
}

/// Ranges in which the laws of a fabric hold.
#[derive(Debug, Clone)]
pub(crate) struct MaterialRanges {
    /// Name of the fabric in the scene.
    pub(crate) name: String,
    /// Thickness, in m.
    pub(crate) thickness: f64,
    /// Largest measured deformation of each law that was measured, by the key of the law.
    pub(crate) measured: BTreeMap<String, f64>,
}

/// Panel and its particles.
#[derive(Debug, Clone)]
pub(crate) struct PanelSpan {
    pub(crate) name: String,
    /// Name of the fabric in the scene.
    pub(crate) fabric: String,
    /// Colour in sRGB that the scene states for the fabric.
    pub(crate) colour: Option<[u8; 3]>,
    /// Direction of the weft in the frame of the panel.
    pub(crate) weft: [f64; 2],
    pub(crate) particles: Range<usize>,
}

/// Garment, or panel that nothing but bodies can hold, and its height range when it began to hang.
#[derive(Debug, Clone)]
pub(crate) struct HungGarment {
    pub(crate) name: String,
    /// Whether it is a garment. A single panel may slide and sink as it likes.
    pub(crate) is_garment: bool,
    particles: Range<usize>,
    /// Height range when the garment began to hang.
    pub(crate) hung: VerticalExtent,
    /// Time at which the garment left its place, in s.
    pub(crate) slid: Option<f64>,
}

/// Height range: lowest and highest point, in m.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct VerticalExtent {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// Edge of a panel that is not part of a seam, such as a hem.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FreeEdge {
    /// Name in the form PANEL.EDGE.
    pub(crate) name: String,
    /// Particles along the edge, in order.
    pub(crate) particles: Vec<u32>,
}

impl GarmentParts {
    /// Returns the parts of `scene`.
    pub(crate) fn new(scene: &Scene) -> Self {
        let panels = scene.panels.iter().map(|panel| PanelSpan {
            name: panel.name.clone(),
            fabric: scene.materials[panel.material].name.clone(),
            colour: scene.materials[panel.material].colour,
            weft: panel.lattice.grain().weft(),
            particles: panel.particles(),
        });
        let start = &scene.start.positions;
        let garments = scene.garments.iter().map(|Garment { name, particles, .. }| {
            HungGarment::new(name, true, particles.clone(), start)
        });
        let garments: Vec<HungGarment> = garments.chain(free_panels(scene)).collect();

        let bodies = scene.bodies.iter().map(|moving| &moving.body);
        let sewing = scene.sewing.as_ref();
        let seams = sewing.map(|sewing| sewing.pairs.clone());
        Self {
            panels: panels.collect(),
            ground: if garments.is_empty() { None } else { lowest(bodies.clone()) },
            garments,
            measured: MeasuredGarment::all(scene),
            has_bodies: bodies.clone().any(|body| !matches!(body.shape, Shape::Plane)),
            seams: seams.unwrap_or_default(),
            named_seams: sewing.map_or_else(Vec::new, |sewing| sewing.seams.clone()),
            free_edges: free_edges(scene),
            materials: scene.materials.iter().map(MaterialRanges::new).collect(),
        }
    }

    /// Describes the garment that left its place first.
    pub(crate) fn first_slide(&self) -> Option<String> {
        let garments = self.garments.iter();
        let slides = garments.filter_map(|garment| Some((garment.slid?, &garment.name)));
        let (time, name) = slides.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(format!("the garment \"{name}\" left its place on the body at {time:.1} s"))
    }

    /// Returns the name of the seam that sews the particles `ends` to each other, or an empty name.
    pub(crate) fn seam_of(&self, ends: [u32; 2]) -> &str {
        let seam = self.named_seams.iter().find(|Seam { pairs, .. }| {
            pairs.pairs.contains(&ends) || pairs.ties.iter().any(|tie| tie.particle == ends[0])
        });
        seam.map_or("", |seam| &seam.name)
    }

    /// Returns the name of the panel of `particle`, or an empty name.
    pub(crate) fn panel_of(&self, particle: usize) -> &str {
        let number = self.panels.partition_point(|panel| panel.particles.end <= particle);
        self.panels.get(number).map_or("", |panel| &panel.name)
    }
}

impl MaterialRanges {
    /// Returns the ranges of the fabric of `material`, from its file. A missing range of warp or
    /// weft is replaced by the range of the other direction.
    fn new(material: &Material) -> Self {
        let provenance = material.fabric.provenance.as_ref();
        let mut measured =
            provenance.map_or_else(BTreeMap::new, |provenance| provenance.measured_range.clone());
        for [known, missing] in
            [["warp.traction", "weft.traction"], ["weft.traction", "warp.traction"]]
        {
            if let Some(strain) = measured.get(known).copied() {
                measured.entry(missing.into()).or_insert(strain);
            }
        }
        Self { name: material.name.clone(), thickness: material.fabric.thickness, measured }
    }
}

impl HungGarment {
    fn new(name: &str, is_garment: bool, particles: Range<usize>, positions: &[f64]) -> Self {
        let hung = VerticalExtent { low: 0.0, high: 0.0 };
        let name = name.to_owned();
        let mut hung_garment = Self { name, is_garment, particles, hung, slid: None };
        hung_garment.hang(positions);
        hung_garment
    }

    /// Records the current height range, at `positions`. Slides are measured against it.
    pub(crate) fn hang(&mut self, positions: &[f64]) {
        self.hung = self.extent(positions);
    }

    /// Returns the height range of the garment at `positions`, in m.
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

/// Returns the panels of `scene` that nothing but bodies can hold: no pin and no seam has one of
/// their particles. Without weight no panel needs to be held.
fn free_panels(scene: &Scene) -> impl Iterator<Item = HungGarment> {
    let mut held = vec![false; scene.cloth.particle_count()];
    for garment in &scene.garments {
        held[garment.particles.clone()].fill(true);
    }
    scene.pins.iter().flat_map(|pin| &pin.particles).for_each(|particle| held[*particle] = true);
    mark_sewn(scene, &mut held);

    let has_weight = scene.environment.gravity[1] < 0.0;
    scene.panels.iter().filter_map(move |panel| {
        let particles = panel.particles();
        let is_free = has_weight && !held[particles.clone()].contains(&true);
        is_free.then(|| HungGarment::new(&panel.name, false, particles, &scene.start.positions))
    })
}

/// Marks the particles of `scene` that are sewn, in `marks`.
fn mark_sewn(scene: &Scene, marks: &mut [bool]) {
    for SeamPairs { pairs, ties } in scene.sewing.iter().map(|sewing| &sewing.pairs) {
        pairs.iter().flatten().for_each(|&particle| marks[particle as usize] = true);
        ties.iter().for_each(|tie| marks[tie.particle as usize] = true);
    }
}

/// Returns the lowest point of `bodies`, in m, infinite without bodies, or `None` if a plane below
/// could catch a garment.
fn lowest<'a>(bodies: impl Iterator<Item = &'a Body> + Clone) -> Option<f64> {
    if bodies.clone().any(|body| matches!(body.shape, Shape::Plane)) {
        return None;
    }
    let outlines = bodies.filter_map(|body| body.triangulate().ok());
    let heights = outlines.flat_map(|outline| outline.vertices).map(|[_, height, _]| height);
    Some(heights.fold(f64::INFINITY, f64::min))
}

/// Returns the edges of panels of `scene` whose particles between the ends are not sewn.
fn free_edges(scene: &Scene) -> Vec<FreeEdge> {
    let mut sewn = vec![false; scene.cloth.particle_count()];
    mark_sewn(scene, &mut sewn);

    let edges = scene.panels.iter().flat_map(|panel| {
        panel.edges.iter().map(move |edge| FreeEdge {
            name: format!("{}.{}", panel.name, edge.name),
            particles: edge.nodes.iter().map(|node| panel.first as u32 + node).collect(),
        })
    });

    let free_edges = edges.filter(|edge| {
        let count = edge.particles.len();
        count > 2 && edge.particles[1..count - 1].iter().all(|&particle| !sewn[particle as usize])
    });
    free_edges.collect()
}
