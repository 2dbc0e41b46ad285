//! Pressure on a garment where it touches its body or itself.

use serde_json::{Value, json};

use crate::measure::vector::distance;
use crate::world::World;

/// Pressure from which a place counts as touched, in Pa: a hundredth of the weight of a light
/// weave.
const TOUCH: f64 = 0.01;

/// Pressure at a particle.
struct Touched {
    /// In Pa.
    pressure: f64,
    /// Area of the particle, in m².
    area: f64,
}

/// Pressure of contact at each particle, in Pa, where surfaces are kept apart.
pub(crate) fn at_particles(world: &mut World, positions: &[f64]) -> Option<Vec<f64>> {
    let surfaces = world.contact.surfaces_mut()?;
    let mut forces = vec![0.0; positions.len()];
    surfaces.contact.add_forces(positions, &mut forces);
    let areas = world.cloth.areas();
    let size = |force: &[f64; 3]| distance(*force, [0.0; 3]);
    let forces = forces.as_chunks::<3>().0.iter().map(size);
    Some(forces.zip(areas).map(|(force, area)| force / area).collect())
}

/// Area that is touched and pressures there, in Pa, where surfaces are kept apart and something
/// touches.
pub(crate) fn pressures(world: &mut World, positions: &[f64]) -> Option<Value> {
    let at_particles = at_particles(world, positions)?;
    let touched = at_particles.into_iter().zip(world.cloth.areas());
    let touched = touched.map(|(pressure, &area)| Touched { pressure, area });
    let mut touched: Vec<Touched> = touched.collect();
    touched.retain(|place| place.pressure > TOUCH);
    touched.sort_by(|a, b| a.pressure.total_cmp(&b.pressure));
    let area: f64 = touched.iter().map(|place| place.area).sum();
    let force: f64 = touched.iter().map(|place| place.pressure * place.area).sum();
    let last = touched.len().checked_sub(1)?;
    Some(json!({
        "area": area,
        "mean": force / area,
        "p99": touched[last * 99 / 100].pressure,
        "max": touched[last].pressure,
    }))
}
