//! Placement of a panel at the start.

use drape_cloth::Lattice;

use crate::check::checker::Checker;
use crate::check::panel::noise::Noise;
use crate::file::panel::{PanelFile, StackFile};
use crate::scene::motion::rotate;

/// Place and velocity of a panel at the start.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Placement {
    /// Position of the middle, in m.
    center: [f64; 3],
    /// Rotations about x, y and z, in degrees.
    turn: [f64; 3],
    /// Velocity of the middle, in m/s.
    velocity: [f64; 3],
    /// Angular velocity about the world's axes, in rad/s.
    spin: [f64; 3],
    ripple: Option<Ripple>,
    noise: Option<Noise>,
}

/// Sine wave across the width of a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ripple {
    /// Amplitude, in m.
    amplitude: f64,
    /// Wavelength, in m.
    wavelength: f64,
}

impl Placement {
    /// Checks the placement of a panel with a noise.
    pub(crate) fn check(
        checker: &mut Checker<'_>,
        key: &str,
        panel: &PanelFile,
        noise: Option<Noise>,
    ) -> Self {
        let unit = checker.unit;
        if panel.velocity.iter().chain(&panel.spin).any(|x| !x.is_finite()) {
            let help = "velocity in the file's unit per second, spin in degrees per second";
            checker.fail(&format!("{key}.velocity"), "is not finite", help);
        }
        if panel.center.iter().chain(&panel.turn).any(|x| !x.is_finite()) {
            checker.fail(&format!("{key}.center"), "is not finite", "in the file's unit");
        }
        Self {
            center: panel.center.map(|x| x * unit),
            turn: panel.turn,
            velocity: panel.velocity.map(|v| v * unit),
            spin: panel.spin.map(f64::to_radians),
            ripple: panel.ripple.as_ref().map(|ripple| Ripple {
                amplitude: ripple.amplitude * unit,
                wavelength: ripple.wavelength * unit,
            }),
            noise,
        }
    }

    /// Placement of a panel's copy of some number in a stack, with lengths in a unit, in m; its noise has another seed.
    pub(crate) fn copied(&self, copy: usize, stack: Option<&StackFile>, unit: f64) -> Self {
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

    /// Positions of a panel's particles, in m: in the panel's own frame the width is x, the height y and the right side z;
    /// its middle is rotated and brought to the centre.
    pub(crate) fn positions(&self, lattice: &Lattice) -> Vec<f64> {
        let places = lattice.panel_coordinates();
        let left = places.iter().map(|place| place[0]).fold(f64::INFINITY, f64::min);
        let middle = lattice.middle;
        let mut noise = self.noise.clone();
        let mut positions = Vec::with_capacity(3 * lattice.coordinates.len());
        for [x, y] in places {
            let mut height = 0.0;
            if let Some(Ripple { amplitude, wavelength }) = self.ripple {
                height += amplitude * (std::f64::consts::TAU * (x - left) / wavelength).sin();
            }
            let place = [x - middle[0], y - middle[1]];
            height += noise.as_mut().map_or(0.0, |noise| noise.height(place));
            let rotated = rotate([place[0], place[1], height], self.turn);
            positions.extend((0..3).map(|axis| rotated[axis] + self.center[axis]));
        }
        positions
    }

    /// Velocities of particles at positions, those of a rigid body, in m/s.
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
