//! Drag of the air on particles, along the normals of the cloth.
//!
//! The drag grows with the square of the speed. Within a step its coefficient uses the speed at the
//! start of the step, so that the force is linear in the displacement and has a potential.

use drape_cloth::{Cloth, State};
use drape_implicit::BlockMatrix;

/// Air that resists the cloth.
#[derive(Debug)]
pub(crate) struct AirDrag {
    /// Half the density times the drag coefficient, in kg/m³.
    half_density: f64,
    /// Drag coefficient of each particle in this step, in N/m along its normal.
    coefficients: Vec<f64>,
}

/// Displacement of a particle in a step along its normal.
struct NormalDisplacement {
    particle: usize,
    /// Drag coefficient of the particle, in N/m.
    coefficient: f64,
    /// Displacement, in m.
    distance: f64,
    normal: [f64; 3],
}

impl AirDrag {
    /// Returns the air drag on `particles` particles. `half_density` is half the density times the
    /// drag coefficient, in kg/m³.
    pub(crate) fn new(half_density: f64, particles: usize) -> Self {
        Self { half_density, coefficients: vec![0.0; particles] }
    }

    /// Prepares a step of the length `dt`, in s, of `cloth` from `state`.
    pub(crate) fn begin(&mut self, cloth: &Cloth, state: &State, dt: f64) {
        let normals = state.normals().chunks_exact(3);
        let velocities = state.velocities.chunks_exact(3);
        let motion = normals.zip(velocities).zip(cloth.areas());
        for (((normal, velocity), area), coefficient) in motion.zip(&mut self.coefficients) {
            let speed: f64 = normal.iter().zip(velocity).map(|(n, v)| n * v).sum();
            *coefficient = self.half_density * area * speed.abs() / dt;
        }
    }

    /// Prepares a step without drag.
    pub(crate) fn begin_without(&mut self) {
        self.coefficients.fill(0.0);
    }

    /// Adds the drag of a step from `state` to `positions` to `forces`, in N.
    pub(crate) fn add_forces(&self, state: &State, positions: &[f64], forces: &mut [f64]) {
        self.visit(state, positions, |moved| {
            let force = moved.coefficient * moved.distance;
            for axis in 0..3 {
                forces[3 * moved.particle + axis] -= force * moved.normal[axis];
            }
        });
    }

    /// Returns the potential of the drag in a step from `state` to `positions`, in J.
    pub(crate) fn potential(&self, state: &State, positions: &[f64]) -> f64 {
        let mut sum = 0.0;
        self.visit(state, positions, |NormalDisplacement { coefficient, distance, .. }| {
            sum += 0.5 * coefficient * distance * distance;
        });
        sum
    }

    /// Returns the work against the drag in a step from `state` to `positions`, with the drag at
    /// the end of the step, in J.
    pub(crate) fn loss(&self, state: &State, positions: &[f64]) -> f64 {
        let mut sum = 0.0;
        self.visit(state, positions, |NormalDisplacement { coefficient, distance, .. }| {
            sum += coefficient * distance * distance;
        });
        sum
    }

    /// Adds the stiffness of the drag in a step from `state` to `positions` to `matrix`.
    pub(crate) fn add_stiffness(&self, state: &State, positions: &[f64], matrix: &mut BlockMatrix) {
        self.visit(state, positions, |moved| {
            let NormalDisplacement { particle, coefficient, normal, .. } = moved;
            let block: [f64; 9] =
                std::array::from_fn(|k| coefficient * normal[k / 3] * normal[k % 3]);
            matrix.add_block(matrix.sparsity().row(particle).start, &block);
        });
    }

    /// Calls `visit` with each particle that the air resists in a step from `state` to `positions`.
    fn visit(&self, state: &State, positions: &[f64], mut visit: impl FnMut(NormalDisplacement)) {
        let normals = state.normals().chunks_exact(3);
        let moved = positions.chunks_exact(3).zip(state.positions.chunks_exact(3));
        for (particle, (normal, (now, start))) in normals.zip(moved).enumerate() {
            let coefficient = self.coefficients[particle];
            if coefficient > 0.0 {
                let normal = [normal[0], normal[1], normal[2]];
                let distance = (0..3).map(|axis| (now[axis] - start[axis]) * normal[axis]).sum();
                visit(NormalDisplacement { particle, coefficient, distance, normal });
            }
        }
    }
}
