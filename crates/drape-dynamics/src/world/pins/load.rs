//! Load of a pin: force and moment of the cloth on it.

use drape_scene::Pin;

/// Load of a pin: the force of the cloth on it, with the weight that hangs there.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PinLoad {
    /// Force of the cloth on the pin, in N.
    pub force: [f64; 3],
    /// Moment of that force about the mean position of the particles of the pin, in N·m.
    pub moment: [f64; 3],
}

impl PinLoad {
    /// Load of a pin from the forces on all particles, in N.
    pub(crate) fn new(pin: &Pin, positions: &[f64], forces: &[f64]) -> Self {
        let vector = |all: &[f64], particle: usize| -> [f64; 3] {
            std::array::from_fn(|axis| all[3 * particle + axis])
        };
        let count = pin.particles.len() as f64;
        let mut middle = [0.0; 3];
        for &particle in &pin.particles {
            let place = vector(positions, particle);
            (0..3).for_each(|axis| middle[axis] += place[axis] / count);
        }
        let mut load = Self::default();
        for &particle in &pin.particles {
            let (place, force) = (vector(positions, particle), vector(forces, particle));
            for axis in 0..3 {
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                load.force[axis] += force[axis];
                load.moment[axis] +=
                    (place[j] - middle[j]) * force[k] - (place[k] - middle[k]) * force[j];
            }
        }
        load
    }
}
