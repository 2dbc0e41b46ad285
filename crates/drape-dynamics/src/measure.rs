//! Measures of garments at the end of a run, and warnings about its result.
//!
//! A garment is measured as by a tailor: whether its seams are closed, how its hems hang, how wide
//! its openings are and how much ease they have, how the cloth is strained, and how hard the
//! garment presses. Warnings name garments that slid, and fabrics that were deformed beyond their
//! measured ranges. Measures read the world and change nothing on which a further step depends.

mod fall;
pub(crate) mod garment_parts;
mod girths;
pub(crate) mod open_seam;
mod openings;
mod pressure;
mod strain;
mod vector;

use serde_json::{Map, Value, json};

use crate::world::World;

use self::garment_parts::{FreeEdge, GarmentParts};
use self::vector::{distance, point_of};

pub(crate) use self::fall::{fallen, note_slides};
pub(crate) use self::pressure::at_particles;

/// Returns the measures of the garments of `world`, by key. Returns no measures if `parts` has no
/// seams.
pub(crate) fn measures(parts: &GarmentParts, world: &mut World) -> Map<String, Value> {
    let mut measures = Map::new();
    if parts.seams.is_empty() {
        return measures;
    }
    let positions = world.state.positions.clone();
    let gap = parts.seams.gaps(&positions).fold(0.0, f64::max);
    measures.insert("seam_gap_max".into(), json!(gap));
    let heights = positions.iter().skip(1).step_by(3);
    measures.insert("lowest".into(), json!(heights.fold(f64::INFINITY, |a, b| a.min(*b))));
    let edges: Vec<Value> =
        parts.free_edges.iter().map(|edge| edge_measures(edge, &positions)).collect();
    measures.insert("free_edges".into(), json!(edges));

    measures.insert("openings".into(), openings::measures(parts, world));
    measures.insert("girths".into(), girths::measures(parts, world));
    measures.insert("strain".into(), strain::measures(world));
    if let Some(pressures) = pressure::pressures(world, &positions) {
        measures.insert("pressure".into(), pressures);
    }
    measures
}

/// Returns the heights and the length of `edge` with the particles at `positions`, in m.
fn edge_measures(edge: &FreeEdge, positions: &[f64]) -> Value {
    let points: Vec<[f64; 3]> =
        edge.particles.iter().map(|&particle| point_of(positions, particle)).collect();
    let heights = points.iter().map(|point| point[1]);
    let lengths = points.windows(2).map(|pair| distance(pair[0], pair[1]));
    json!({
        "edge": edge.name,
        "height_mean": heights.clone().sum::<f64>() / points.len() as f64,
        "height_min": heights.clone().fold(f64::INFINITY, f64::min),
        "height_max": heights.fold(f64::NEG_INFINITY, f64::max),
        "length": lengths.sum::<f64>(),
    })
}

/// Returns the warnings about the result of a run: garments of `parts` that slid, and cloth that is
/// deformed beyond the measured range of its fabric.
pub(crate) fn warnings(parts: &GarmentParts, world: &World) -> Vec<String> {
    [fall::sunk(parts, &world.state.positions), strain::extrapolated(parts, world)].concat()
}
