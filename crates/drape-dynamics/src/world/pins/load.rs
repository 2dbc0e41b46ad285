//! Load of a pin: force and moment of the cloth on it.

use drape_scene::Pin;

/// Force and moment of the cloth on a pin, including the weight that hangs from the pin.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PinLoad {
    /// Force of the cloth on the pin, in N.
    pub force: [f64; 3],
    /// Moment of `force` about the mean position of the particles of the pin, in N·m.
    pub moment: [f64; 3],
}

impl PinLoad {
    /// Returns the load of `pin` from the positions of all particles, in m, and the forces on all
    /// particles, in N.
    pub(crate) fn new(pin: &Pin, positions: &[f64], forces: &[f64]) -> Self {
        let count = pin.particles.len() as f64;
        let mut middle = [0.0; 3];
        for &particle in &pin.particles {
            let position = vector(positions, particle);
            (0..3).for_each(|axis| middle[axis] += position[axis] / count);
        }

        let mut load = Self::default();
        for &particle in &pin.particles {
            let (position, force) = (vector(positions, particle), vector(forces, particle));
            for axis in 0..3 {
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                load.force[axis] += force[axis];
                load.moment[axis] +=
                    (position[j] - middle[j]) * force[k] - (position[k] - middle[k]) * force[j];
            }
        }
        load
    }
}

/// Returns the three components of `particle` in `values`.
fn vector(values: &[f64], particle: usize) -> [f64; 3] {
    std::array::from_fn(|axis| values[3 * particle + axis])
}
