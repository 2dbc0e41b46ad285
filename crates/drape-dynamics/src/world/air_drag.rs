//! Drag of the air on particles, along the normals of the cloth.
//!
//! The drag grows with the square of the speed of the cloth relative to the air,
//! `$f = -\tfrac12 \rho\, c_d A\, |u|\, u\, n$` with `$u = n \cdot (v - w)$`, the velocity `$v$` of
//! the cloth and the velocity `$w$` of the air. Within a step its coefficient uses the speed at the
//! start of the step, so that the force is linear in the displacement and has a potential.

use drape_cloth::{Cloth, State};
use drape_implicit::BlockMatrix;

/// Air that resists the cloth, or carries it along.
#[derive(Debug)]
pub(crate) struct AirDrag {
    /// Half the density times the drag coefficient, in kg/m³.
    half_density: f64,
    /// Velocity of the air, in m/s.
    velocity: [f64; 3],
    /// Displacement of the air in this step, in m.
    advance: [f64; 3],
    /// Drag coefficient of each particle in this step, in N/m along its normal.
    coefficients: Vec<f64>,
}

/// Energy that the drag exchanges in a step, with the drag at the end of the step, in J.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct DragEnergy {
    /// Energy dissipated by the motion of the cloth relative to the air.
    pub(crate) dissipated: f64,
    /// Work of the moving air on the cloth.
    pub(crate) air_work: f64,
    /// Sum of the coefficients times the squared displacements of the cloth along its normals. Half
    /// of it is the work of the forces at the end of the step less the decrease of the potential.
    pub(crate) squared_path: f64,
}

/// Displacement of a particle in a step along its normal.
struct NormalDisplacement {
    particle: usize,
    /// Drag coefficient of the particle, in N/m.
    coefficient: f64,
    /// Displacement, in m.
    distance: f64,
    /// Displacement relative to the air, in m.
    slip: f64,
    normal: [f64; 3],
}

impl AirDrag {
    /// Returns the drag of still air on `particles` particles. `half_density` is half the density
    /// times the drag coefficient, in kg/m³.
    pub(crate) fn new(half_density: f64, particles: usize) -> Self {
        Self {
            half_density,
            velocity: [0.0; 3],
            advance: [0.0; 3],
            coefficients: vec![0.0; particles],
        }
    }

    /// Returns whether there is air that resists the cloth.
    pub(crate) fn resists(&self) -> bool {
        self.half_density > 0.0
    }

    /// Returns the velocity of the air, in m/s.
    pub(crate) fn velocity(&self) -> [f64; 3] {
        self.velocity
    }

    /// Sets the velocity of the air from the next step on to `velocity`, in m/s.
    pub(crate) fn set_velocity(&mut self, velocity: [f64; 3]) {
        self.velocity = velocity;
    }

    /// Prepares a step of the length `dt`, in s, of `cloth` from `state`.
    pub(crate) fn begin(&mut self, cloth: &Cloth, state: &State, dt: f64) {
        let air = self.velocity;
        self.advance = air.map(|w| dt * w);
        let normals = state.normals().chunks_exact(3);
        let velocities = state.velocities.chunks_exact(3);
        let motion = normals.zip(velocities).zip(cloth.areas());
        for (((normal, velocity), area), coefficient) in motion.zip(&mut self.coefficients) {
            let speeds = normal.iter().zip(velocity).zip(air).map(|((n, v), w)| n * (v - w));
            let speed: f64 = speeds.sum();
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
            let force = moved.coefficient * moved.slip;
            for axis in 0..3 {
                forces[3 * moved.particle + axis] -= force * moved.normal[axis];
            }
        });
    }

    /// Returns the potential of the drag in a step from `state` to `positions`, in J.
    pub(crate) fn potential(&self, state: &State, positions: &[f64]) -> f64 {
        let mut sum = 0.0;
        self.visit(state, positions, |NormalDisplacement { coefficient, slip, .. }| {
            sum += 0.5 * coefficient * slip * slip;
        });
        sum
    }

    /// Returns the energy that the drag exchanges in a step from `state` to `positions`.
    ///
    /// The force `$-c\,s$` along the slip `$s = d - a$` does the work `$-c\,s\,d$` on the cloth,
    /// with the displacements `$d$` of the cloth and `$a$` of the air. The air loses `$c\,s^2$` and
    /// works `$-c\,s\,a$`. The potential `$\tfrac12 c\,s^2$` falls by `$\tfrac12 c\,d^2$` more than
    /// the work.
    pub(crate) fn energy(&self, state: &State, positions: &[f64]) -> DragEnergy {
        let mut energy = DragEnergy::default();
        self.visit(
            state,
            positions,
            |NormalDisplacement { coefficient, distance, slip, .. }| {
                energy.dissipated += coefficient * slip * slip;
                energy.air_work += coefficient * slip * (slip - distance);
                energy.squared_path += coefficient * distance * distance;
            },
        );
        energy
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
                let advance: f64 = (0..3).map(|axis| self.advance[axis] * normal[axis]).sum();
                let slip = distance - advance;
                visit(NormalDisplacement { particle, coefficient, distance, slip, normal });
            }
        }
    }
}
