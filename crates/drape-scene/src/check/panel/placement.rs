//! Placement of a panel at the start.

use drape_cloth::Lattice;
use drape_input::{Given, figure};

use crate::check::checker::Checker;
use crate::check::panel::noise::Noise;
use crate::file::panel::{PanelFile, StackFile};
use crate::scene::motion::rotate;

/// Largest coordinate of the middle of a panel, in m.
const FAR: f64 = 1e4;

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
        for (name, numbers, help) in [
            ("velocity", panel.velocity.map(Given::value), "in the file's unit per second"),
            ("spin", panel.spin.map(Given::value), "in degrees per second"),
            ("turn", panel.turn.map(Given::value), "degrees about x, y and z"),
        ] {
            if numbers.iter().any(|x| !x.is_finite()) {
                checker.fail(&format!("{key}.{name}"), "is not finite", help);
            }
        }
        let far = |x: &f64| !(x.abs() <= FAR);
        if let Some(x) = panel.center.map(|x| x * unit).iter().find(|x| far(x)) {
            let message = format!("{} m is too far out", figure(*x));
            checker.fail(&format!("{key}.center"), message, "up to 10 km: is the unit right?");
        }
        if let Some(ripple) = &panel.ripple {
            let wavelength = ripple.wavelength.number();
            if !(wavelength > 0.0 && wavelength.is_finite()) {
                let message = format!("{} is no length", figure(wavelength));
                let help = "the distance from crest to crest, in the file's unit";
                checker.fail(&format!("{key}.ripple.wavelength"), message, help);
            }
            if !ripple.amplitude.number().is_finite() {
                let help = "the greatest height, in the file's unit";
                checker.fail(&format!("{key}.ripple.amplitude"), "is not finite", help);
            }
        }
        Self {
            center: panel.center.map(|x| x * unit),
            turn: panel.turn.map(Given::value),
            velocity: panel.velocity.map(|v| v * unit),
            spin: panel.spin.map(|spin| spin.value().to_radians()),
            ripple: panel.ripple.as_ref().map(|ripple| Ripple {
                amplitude: ripple.amplitude * unit,
                wavelength: ripple.wavelength * unit,
            }),
            noise,
        }
    }

    /// Placement of a panel's copy of some number in a stack, with lengths in a unit, in m; its
    /// noise has another seed.
    pub(crate) fn copied(&self, copy: usize, stack: Option<&StackFile>, unit: f64) -> Self {
        let Some(stack) = stack else { return self.clone() };
        let nth = |axis: usize| copy as f64 * stack.step[axis] * unit;
        let center = std::array::from_fn(|axis| self.center[axis] + nth(axis));
        let angle = |axis: usize| copy as f64 * stack.turn[axis].value();
        let turn = std::array::from_fn(|axis| self.turn[axis] + angle(axis));
        Self {
            center,
            turn,
            noise: self.noise.as_ref().map(|noise| noise.copied(copy as u64)),
            ..self.clone()
        }
    }

    /// Positions of a panel's particles, in m: in the panel's own frame the width is x, the height
    /// y and the right side z; its middle is rotated and brought to the centre.
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

    /// Returns the velocities of particles at `positions` that move as one rigid body, in m/s.
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
