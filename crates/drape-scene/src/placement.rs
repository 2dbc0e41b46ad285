use drape_cloth::Lattice;

use crate::file::{PanelFile, RippleFile, StackFile};
use crate::noise::Noise;

/// Where a panel is before the simulation begins, in m.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Placement {
    pub(crate) center: [f64; 3],
    pub(crate) turn: [f64; 3],
    /// Velocity of the middle, in m/s, and spin about the world's axes, in rad/s.
    velocity: [f64; 3],
    spin: [f64; 3],
    ripple: Option<(f64, f64)>,
    noise: Option<Noise>,
}

impl Placement {
    pub(crate) fn new(panel: &PanelFile, noise: Option<Noise>, unit: f64) -> Self {
        let ripple = |r: &RippleFile| (r.amplitude * unit, r.wavelength * unit);
        Self {
            center: panel.center.map(|x| x * unit),
            turn: panel.turn,
            velocity: panel.velocity.map(|v| v * unit),
            spin: panel.spin.map(f64::to_radians),
            ripple: panel.ripple.as_ref().map(ripple),
            noise,
        }
    }

    /// The placement of a panel's copy of some number; another seed makes it noise of its own.
    pub(crate) fn copied(&self, copy: usize, (stack, unit): (Option<&StackFile>, f64)) -> Self {
        let Some(stack) = stack else { return self.clone() };
        let along = |from: [f64; 3], step: [f64; 3], unit: f64| {
            std::array::from_fn(|axis| from[axis] + copy as f64 * step[axis] * unit)
        };
        Self {
            center: along(self.center, stack.step, unit),
            turn: along(self.turn, stack.turn, 1.0),
            noise: self.noise.as_ref().map(|noise| noise.copied(copy as u64)),
            ..self.clone()
        }
    }

    /// Positions of a panel's particles: in the panel's own frame the width is x, the height y and the
    /// right side z; the middle of the panel is turned and brought to the centre.
    pub(crate) fn positions(&self, lattice: &Lattice) -> Vec<f64> {
        let places = lattice.panel_coordinates();
        let left = places.iter().map(|place| place[0]).fold(f64::INFINITY, f64::min);
        let middle = lattice.middle;
        let mut noise = self.noise.clone();
        let mut positions = Vec::with_capacity(3 * lattice.coordinates.len());
        for [x, y] in places {
            let mut height = 0.0;
            if let Some((amplitude, wavelength)) = self.ripple {
                height += amplitude * (std::f64::consts::TAU * (x - left) / wavelength).sin();
            }
            let place = [x - middle[0], y - middle[1]];
            height += noise.as_mut().map_or(0.0, |noise| noise.height(place));
            let turned = turned([place[0], place[1], height], self.turn);
            positions.extend((0..3).map(|axis| turned[axis] + self.center[axis]));
        }
        positions
    }

    /// Velocities of particles that start at positions: those of a rigid body.
    pub(crate) fn velocities(&self, positions: &[f64]) -> Vec<f64> {
        let mut velocities = Vec::with_capacity(positions.len());
        for place in positions.chunks_exact(3) {
            let arm: [f64; 3] = std::array::from_fn(|axis| place[axis] - self.center[axis]);
            velocities.extend((0..3).map(|axis| {
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                self.velocity[axis] + self.spin[j] * arm[k] - self.spin[k] * arm[j]
            }));
        }
        velocities
    }
}

/// A point turned about the x, y and z axes, one after the other, by angles in degrees.
pub(crate) fn turned(point: [f64; 3], degrees: [f64; 3]) -> [f64; 3] {
    let mut point = point;
    for (axis, angle) in degrees.into_iter().enumerate() {
        let (sin, cos) = angle.to_radians().sin_cos();
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        (point[i], point[j]) = (cos * point[i] - sin * point[j], sin * point[i] + cos * point[j]);
    }
    point
}
