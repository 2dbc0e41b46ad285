//! Springs of pins that hold their particles in some directions only.

use drape_implicit::BlockMatrix;
use drape_scene::{HeldParticle, Pin};

/// Stiffness of a spring, in N/m for each particle and direction. A force of a hundredth of a
/// newton, more than the weight that hangs from a particle, stretches the spring by a tenth of a
/// micrometre.
const STIFFNESS: f64 = 1e5;

/// Springs between particles at `$x$` and their prescribed positions `$\bar x$` at the end of the
/// step.
///
/// Their energy is `$\frac k2\sum(x_a-\bar x_a)^2$`, summed over the directions `$a$` that are
/// held; force and stiffness are exact. A particle that is held in all directions has no spring:
/// the solver leaves it out.
#[derive(Debug, Clone, Default)]
pub(crate) struct PinSprings(Vec<Spring>);

/// Spring of a particle.
#[derive(Debug, Clone, Copy)]
struct Spring {
    particle: usize,
    /// Prescribed position, in m.
    position: [f64; 3],
    /// Directions in which the particle is held.
    axes: [bool; 3],
}

/// Work of the springs in a step, in J.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SpringWork {
    /// Work on the cloth with the force at the end of the step along straight displacements.
    pub(crate) by_force: f64,
    /// Decrease of the potential.
    pub(crate) potential_fall: f64,
}

/// Deviation of a held coordinate from its prescribed value.
struct Deviation {
    /// Index of the coordinate in the flat array of all positions.
    number: usize,
    /// Deviation, in m.
    value: f64,
}

impl PinSprings {
    /// Returns the springs of `pin` at `time` on the motion clock, in s.
    pub(crate) fn new(pin: &Pin, time: f64) -> Self {
        let mut springs = Self::default();
        springs.add(pin, time);
        springs
    }

    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// Adds the springs of `pin` at `time` on the motion clock, in s.
    pub(crate) fn add(&mut self, pin: &Pin, time: f64) {
        for HeldParticle { particle, position } in pin.positions(time) {
            self.0.push(Spring { particle, position, axes: pin.axes });
        }
    }

    /// Adds the forces of the springs at `positions` to `forces`, in N.
    pub(crate) fn add_forces(&self, positions: &[f64], forces: &mut [f64]) {
        for Deviation { number, value } in self.deviations(positions) {
            forces[number] -= STIFFNESS * value;
        }
    }

    /// Returns the forces of the cloth at `positions` on the springs, three numbers for each
    /// particle, in N.
    pub(crate) fn reactions(&self, positions: &[f64]) -> Vec<f64> {
        let mut reactions = vec![0.0; positions.len()];
        for Deviation { number, value } in self.deviations(positions) {
            reactions[number] += STIFFNESS * value;
        }
        reactions
    }

    /// Returns the potential of the springs at `positions`, in J.
    pub(crate) fn potential(&self, positions: &[f64]) -> f64 {
        let squares = self.deviations(positions).map(|deviation| deviation.value * deviation.value);
        0.5 * STIFFNESS * squares.sum::<f64>()
    }

    /// Returns the work of the springs in a step from the positions `start` to `end`, in m.
    pub(crate) fn work(&self, start: &[f64], end: &[f64]) -> SpringWork {
        let powers = self
            .deviations(end)
            .map(|Deviation { number, value }| value * (end[number] - start[number]));
        let by_force = -STIFFNESS * powers.sum::<f64>();
        SpringWork { by_force, potential_fall: self.potential(start) - self.potential(end) }
    }

    /// Adds the stiffness of the springs to `matrix`.
    pub(crate) fn add_stiffness(&self, matrix: &mut BlockMatrix) {
        for &Spring { particle, axes, .. } in &self.0 {
            let block =
                std::array::from_fn(|k| if k % 4 == 0 && axes[k / 4] { STIFFNESS } else { 0.0 });
            matrix.add(particle, particle, &block);
        }
    }

    /// Returns the deviations of all held coordinates at `positions`.
    fn deviations(&self, positions: &[f64]) -> impl Iterator<Item = Deviation> {
        self.0.iter().flat_map(move |&Spring { particle, position, axes }| {
            let held = (0..3).filter(move |&axis| axes[axis]);
            held.map(move |axis| {
                let number = 3 * particle + axis;
                Deviation { number, value: positions[number] - position[axis] }
            })
        })
    }
}
