//! Placement of a panel at the start.

use drape_cloth::Lattice;
use drape_input::figure;

use crate::check::checker::Checker;
use crate::check::panel::noise::Noise;
use crate::scene::motion::rotate;
use crate::spec::panel::{PanelSpec, RippleSpec, StackSpec};

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
    ripple: Option<RippleSpec>,
    noise: Option<Noise>,
}

impl Placement {
    /// Checks the placement of `panel`, whose table has the key path `key`.
    pub(crate) fn check(checker: &mut Checker<'_>, key: &str, panel: &PanelSpec) -> Self {
        let far = |x: &f64| !(x.abs() <= FAR);
        if let Some(x) = panel.center.iter().find(|x| far(x)) {
            let message = format!("{} m is too far out", figure(*x));
            checker.fail(&format!("{key}.center"), message, "up to 10 km: is the unit right?");
        }
        Self {
            center: panel.center,
            turn: panel.turn,
            velocity: panel.velocity,
            spin: panel.spin.map(f64::to_radians),
            ripple: panel.ripple,
            noise: panel.noise.as_ref().map(Noise::new),
        }
    }

    /// Returns the placement of the panel's copy with the number `copy` in `stack`. Its noise has
    /// another seed.
    pub(crate) fn copied(&self, copy: usize, stack: Option<&StackSpec>) -> Self {
        let Some(stack) = stack else { return self.clone() };
        let nth = |axis: usize| copy as f64 * stack.step[axis];
        let center = std::array::from_fn(|axis| self.center[axis] + nth(axis));
        let angle = |axis: usize| copy as f64 * stack.turn[axis];
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
        let middle = lattice.middle();
        let mut noise = self.noise.clone();
        let mut positions = Vec::with_capacity(3 * lattice.coordinates().len());
        for [x, y] in places {
            let mut height = 0.0;
            if let Some(RippleSpec { amplitude, wavelength }) = self.ripple {
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
