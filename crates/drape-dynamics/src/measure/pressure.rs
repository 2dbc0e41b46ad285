//! Pressure on a garment where it touches its body or itself.

use serde_json::{Value, json};

use crate::measure::vector::distance;
use crate::world::{ALL_PARTICLES, World};

/// Pressure above which a particle counts as touched, in Pa: a hundredth of the weight of a light
/// weave.
const TOUCH: f64 = 0.01;

/// Particle that something touches.
struct Touched {
    /// Pressure, in Pa.
    pressure: f64,
    /// Area of the particle, in m².
    area: f64,
}

/// Returns the contact pressure at each particle of `world` at `positions`, in Pa, if surfaces are
/// kept apart.
pub(crate) fn at_particles(world: &mut World, positions: &[f64]) -> Option<Vec<f64>> {
    let surfaces = world.contact.surfaces_mut()?;
    let mut forces = vec![0.0; positions.len()];
    let mut energy = surfaces.contact.energy(positions).expect(ALL_PARTICLES);
    energy.add_forces(&mut forces).expect(ALL_PARTICLES);
    let areas = world.cloth.areas();
    let sizes = forces.as_chunks::<3>().0.iter().map(|force| distance(*force, [0.0; 3]));
    Some(sizes.zip(areas).map(|(size, area)| size / area).collect())
}

/// Returns the touched area of `world` at `positions` and the pressures there, in Pa. Returns
/// `None` if nothing touches or surfaces are not kept apart.
pub(crate) fn pressures(world: &mut World, positions: &[f64]) -> Option<Value> {
    let at_particles = at_particles(world, positions)?;
    summary(&at_particles, world.cloth.areas())
}

/// Returns the summary of `pressures`, in Pa, at particles with `areas`, in m².
fn summary(pressures: &[f64], areas: &[f64]) -> Option<Value> {
    let touched = pressures.iter().zip(areas);
    let touched = touched.map(|(&pressure, &area)| Touched { pressure, area });
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_is_the_force_over_the_area_and_one_of_a_hundred_is_above_the_99th() {
        // Pressures of 1 to 200 Pa, the larger ones on twice the area, and particles that nothing
        // touches.
        let pressures: Vec<f64> = (1..=200).map(f64::from).chain([0.0, 0.0]).collect();
        let areas: Vec<f64> = (1..=202).map(|k| if k > 100 { 2e-4 } else { 1e-4 }).collect();
        let found = summary(&pressures, &areas).unwrap();
        let number = |key: &str| found[key].as_f64().unwrap();
        assert!((number("area") - 0.03).abs() < 1e-12);
        assert!((number("mean") - (5050.0 + 2.0 * 15050.0) / 300.0).abs() < 1e-9);
        assert_eq!((number("p99"), number("max")), (198.0, 200.0));
        assert!(summary(&[0.0; 3], &[1e-4; 3]).is_none());
    }
}
