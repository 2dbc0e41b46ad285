//! A running simulation that a program steers: pins, gravity, wind, and a reset in memory.

#![allow(clippy::unwrap_used)]

mod certificate;
mod environment;
mod garment;
mod pins;
mod reset;
mod top_speed;
mod vertices;

use drape_dynamics::{Energy, Scheme, Simulation};
use drape_fabric::samples;
use drape_implicit::Settings;
use drape_input::Document;
use drape_scene::Scene;

/// Length of a step, in s.
pub const STEP: f64 = 0.002;

/// Number of particles of the sheet.
pub const PARTICLES: usize = 49;

/// Mass of the sheet, in kg.
pub const MASS: f64 = 0.15 * 0.12 * 0.12;

/// Pin of a corner of the sheet.
pub const CORNER: &str = "[[pin]]\npanel = \"cloth\"\npoints = [[0, 0.12]]\n";

/// Pin of the upper edge of the sheet.
pub const EDGE: &str = "[[pin]]\npanel = \"cloth\"\nedge = \"top\"\n";

/// Ball below the sheet.
pub const BALL: &str = "[[collider.sphere]]\nname = \"ball\"\nradius = 0.03\ncenter = [0, -0.032, 0]\nfriction = 0.3\n";

/// Returns the scene of a level sheet of 7 × 7 particles in a vacuum, with further `keys` and
/// `tables`.
pub fn scene(keys: &str, tables: &str) -> Scene {
    let air = if keys.contains("air.") { "" } else { "air.density = 0" };
    let time = if keys.contains("time") { "" } else { "time = { step = 0.002, end = 10 }" };
    let text = format!(
        "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n{time}\n{air}\n{keys}\n[[panel]]\n\
         name = \"cloth\"\nfabric = \"plain\"\nrectangle = [0.12, 0.12]\nturn = [-90, 0, 0]\n{tables}"
    );
    let fabric = Document::new("plain.toml", samples::PLAIN_WEAVE_WITH_FRICTION);
    Scene::from_documents(&Document::new("scene.toml", text), &[fabric]).unwrap()
}

/// Returns the simulation of [`scene`].
pub fn simulation(keys: &str, tables: &str) -> Simulation {
    Simulation::new(scene(keys, tables)).unwrap()
}

/// Returns the simulation of [`scene`] that computes each entry of the energy balance independently
/// in each sub-step.
pub fn balanced(keys: &str, tables: &str) -> Simulation {
    let settings = Settings { tolerance: 1e-7, energy_balance: true, ..Settings::default() };
    Simulation::with_scheme(scene(keys, tables), Scheme::Implicit(settings)).unwrap()
}

/// Checks that the entries of the energy balance agree to a millionth of the energy that `energy`
/// shows to be exchanged, as they do without steering.
pub fn assert_closed(energy: &Energy) {
    let exchanged = energy.kinetic + energy.work_in.abs() + energy.gravity.abs() + energy.elastic;
    assert!(energy.residual.abs() <= 1e-6 * exchanged, "{energy:?}");
}

/// Returns the position of `particle`, in m.
pub fn position(simulation: &Simulation, particle: usize) -> [f64; 3] {
    std::array::from_fn(|axis| simulation.positions()[3 * particle + axis])
}

/// Returns the mean of three numbers for each particle, weighted with the masses of a sheet of 7 ×
/// 7 particles: half and quarter at the edges.
pub fn mean(values: &[f64]) -> [f64; 3] {
    let weight = |k: usize| if k == 0 || k == 6 { 0.5 } else { 1.0 };
    let mut mean = [0.0; 3];
    for (particle, value) in values.chunks_exact(3).enumerate() {
        let share = weight(particle % 7) * weight(particle / 7) / 36.0;
        (0..3).for_each(|axis| mean[axis] += share * value[axis]);
    }
    mean
}

/// Returns the length of the difference of two vectors.
pub fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}
