use drape_scene::{Scene, Stitching};
use serde_json::{Map, Value, json};

use crate::simulation::Simulation;

/// Pressure from which a place counts as touched, in Pa: a hundredth of what a light weave weighs.
const TOUCH: f64 = 0.01;

/// An edge of a panel that is not sewn, such as a hem.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FreeEdge {
    /// PANEL.EDGE.
    pub(crate) name: String,
    /// Its particles in their order.
    pub(crate) particles: Vec<u32>,
}

/// The edges of panels whose particles between the ends are not sewn.
pub(crate) fn free_edges(scene: &Scene) -> Vec<FreeEdge> {
    let mut sewn = vec![false; scene.cloth.particles()];
    for Stitching { pairs, ties } in scene.sewing.iter().map(|sewing| &sewing.stitching) {
        pairs.iter().flatten().for_each(|&particle| sewn[particle as usize] = true);
        ties.iter().for_each(|tie| sewn[tie.particle as usize] = true);
    }
    let edges = scene.panels.iter().flat_map(|panel| {
        panel.edges.iter().map(move |(name, particles)| FreeEdge {
            name: format!("{}.{name}", panel.name),
            particles: particles.iter().map(|particle| panel.first as u32 + particle).collect(),
        })
    });
    let inner = |edge: &FreeEdge| {
        let count = edge.particles.len();
        count > 2 && edge.particles[1..count - 1].iter().all(|&particle| !sewn[particle as usize])
    };
    edges.filter(inner).collect()
}

impl Simulation {
    /// What a tailor asks of a garment: whether its seams are closed, how its hems hang, how it presses.
    pub(crate) fn measure(&mut self) -> Map<String, Value> {
        let mut measures = Map::new();
        if self.sewn.is_empty() {
            return measures;
        }
        let positions = self.frame().positions;
        let place = |particle: u32| -> [f64; 3] {
            std::array::from_fn(|axis| positions[3 * particle as usize + axis])
        };
        let gap = self.sewn.gaps(&positions).fold(0.0, f64::max);
        measures.insert("seam_gap_max".into(), json!(gap));
        let heights = positions.iter().skip(1).step_by(3);
        measures.insert("lowest".into(), json!(heights.fold(f64::INFINITY, |a, b| a.min(*b))));
        let edges: Vec<Value> = self
            .free_edges
            .iter()
            .map(|edge| {
                let places: Vec<[f64; 3]> = edge.particles.iter().map(|&p| place(p)).collect();
                let heights = || places.iter().map(|place| place[1]);
                let lengths = places.windows(2).map(|pair| distance(pair[0], pair[1]));
                json!({
                    "edge": edge.name,
                    "height_mean": heights().sum::<f64>() / places.len() as f64,
                    "height_min": heights().fold(f64::INFINITY, f64::min),
                    "height_max": heights().fold(f64::NEG_INFINITY, f64::max),
                    "length": lengths.sum::<f64>(),
                })
            })
            .collect();
        measures.insert("free_edges".into(), json!(edges));
        measures.insert("openings".into(), self.opening_measures(&positions));
        measures.insert("strain".into(), self.strain_measures());
        if let Some(pressures) = self.pressures(&positions) {
            measures.insert("pressure".into(), pressures);
        }
        measures
    }

    /// How hard the garment is pressed where it touches, by its body or by itself, in Pa.
    fn pressures(&mut self, positions: &[f64]) -> Option<Value> {
        let surfaces = self.world.surfaces.as_mut()?;
        let mut forces = vec![0.0; positions.len()];
        surfaces.contact.add_forces(positions, &mut forces);
        let areas = self.world.cloth.areas();
        let forces =
            forces.chunks_exact(3).map(|force| distance([force[0], force[1], force[2]], [0.0; 3]));
        let mut touched: Vec<(f64, f64)> =
            forces.zip(areas).map(|(force, &area)| (force / area, area)).collect();
        touched.retain(|(pressure, _)| *pressure > TOUCH);
        touched.sort_by(|a, b| a.0.total_cmp(&b.0));
        let area: f64 = touched.iter().map(|(_, area)| area).sum();
        let force: f64 = touched.iter().map(|(pressure, area)| pressure * area).sum();
        let last = touched.len().checked_sub(1)?;
        Some(json!({
            "area": area,
            "mean": force / area,
            "p99": touched[last * 99 / 100].0,
            "max": touched[last].0,
        }))
    }
}

pub(crate) fn distance<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}
