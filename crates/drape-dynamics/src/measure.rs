//! Measures of garments at the end of a run, and warnings about its result.
//!
//! A garment is measured as a tailor does: whether its seams are closed, how its hems hang, how
//! wide its openings are and how much of that is ease, how it is strained and how hard it presses.
//! Warnings name garments that slid and fabrics that were deformed beyond their measurements.
//! Measures read the world; they change nothing that a further step would use.

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

use self::garment_parts::GarmentParts;
use self::vector::distance;

pub(crate) use self::fall::{fallen, note_slides};
pub(crate) use self::pressure::at_particles;

/// Measures of the garments of a world, if it has seams.
pub(crate) fn measures(parts: &GarmentParts, world: &mut World) -> Map<String, Value> {
    let mut measures = Map::new();
    if parts.seams.is_empty() {
        return measures;
    }
    let positions = world.state.positions.clone();
    let place = |particle: u32| -> [f64; 3] {
        std::array::from_fn(|axis| positions[3 * particle as usize + axis])
    };
    let gap = parts.seams.gaps(&positions).fold(0.0, f64::max);
    measures.insert("seam_gap_max".into(), json!(gap));
    let heights = positions.iter().skip(1).step_by(3);
    measures.insert("lowest".into(), json!(heights.fold(f64::INFINITY, |a, b| a.min(*b))));
    let edges: Vec<Value> = parts
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
    measures.insert("openings".into(), openings::measures(parts, world));
    measures.insert("girths".into(), girths::measures(parts, world));
    measures.insert("strain".into(), strain::measures(world));
    if let Some(pressures) = pressure::pressures(world, &positions) {
        measures.insert("pressure".into(), pressures);
    }
    measures
}

/// Warnings about the result of a run: garments that slid, and cloth that is deformed beyond its
/// fabric's measurements.
pub(crate) fn warnings(parts: &GarmentParts, world: &World) -> Vec<String> {
    [fall::sunk(parts, &world.state.positions), strain::extrapolated(parts, world)].concat()
}
