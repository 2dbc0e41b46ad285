//! Springs of the pins that hold in some directions and leave their particles free in the others.

use drape_implicit::BlockMatrix;
use drape_scene::{HeldParticle, Pin};

/// Stiffness of a spring, in N/m for each particle and direction, as that of a closing spring of a
/// seam. Under a hundredth of a newton, more than the weight that hangs on a particle, it yields by
/// a tenth of a micrometre.
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
    /// Directions in which it is held.
    axes: [bool; 3],
}

/// Work of the springs in a step, in J.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SpringWork {
    /// Work on the cloth with the force at the end of the step, along straight displacements.
    pub(crate) by_force: f64,
    /// Fall of the potential.
    pub(crate) potential_fall: f64,
}

/// Deviation of a held coordinate from its prescribed value.
struct Deviation {
    /// Number of the coordinate in the flat array of all positions.
    number: usize,
    /// Deviation, in m.
    value: f64,
}

impl PinSprings {
    /// Springs of a pin at a time on the clock of motions, in s.
    pub(crate) fn of(pin: &Pin, time: f64) -> Self {
        let mut own = Self::default();
        own.add(pin, time);
        own
    }

    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// Adds the springs of a pin at a time on the clock of motions, in s.
    pub(crate) fn add(&mut self, pin: &Pin, time: f64) {
        let spring =
            |HeldParticle { particle, position }| Spring { particle, position, axes: pin.axes };
        self.0.extend(pin.positions(time).map(spring));
    }

    pub(crate) fn add_forces(&self, positions: &[f64], forces: &mut [f64]) {
        for Deviation { number, value } in self.deviations(positions) {
            forces[number] -= STIFFNESS * value;
        }
    }

    /// Forces of the cloth on the springs, three numbers for each particle, in N.
    pub(crate) fn reactions(&self, positions: &[f64]) -> Vec<f64> {
        let mut reactions = vec![0.0; positions.len()];
        for Deviation { number, value } in self.deviations(positions) {
            reactions[number] += STIFFNESS * value;
        }
        reactions
    }

    pub(crate) fn potential(&self, positions: &[f64]) -> f64 {
        let squares = self.deviations(positions).map(|deviation| deviation.value * deviation.value);
        0.5 * STIFFNESS * squares.sum::<f64>()
    }

    /// Work of the springs in a step.
    pub(crate) fn work(&self, start: &[f64], end: &[f64]) -> SpringWork {
        let powers = self
            .deviations(end)
            .map(|Deviation { number, value }| value * (end[number] - start[number]));
        let by_force = -STIFFNESS * powers.sum::<f64>();
        SpringWork { by_force, potential_fall: self.potential(start) - self.potential(end) }
    }

    pub(crate) fn add_stiffness(&self, matrix: &mut BlockMatrix) {
        for &Spring { particle, axes, .. } in &self.0 {
            let block =
                std::array::from_fn(|k| if k % 4 == 0 && axes[k / 4] { STIFFNESS } else { 0.0 });
            matrix.add(particle, particle, &block);
        }
    }

    /// Deviations of all coordinates that are held.
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
