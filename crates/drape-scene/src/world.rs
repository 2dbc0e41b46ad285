use drape_cloth::{Cloth, State, Workspace};
use drape_collide::Contact;
use drape_implicit::{BlockMatrix, Pattern, Stiffness, System};

use crate::scene::Scene;

/// Cloth, bodies, gravity and air as the system that the integrator moves.
#[derive(Debug)]
pub(crate) struct World {
    pub(crate) cloth: Cloth,
    workspace: Workspace,
    pub(crate) state: State,
    pub(crate) contact: Contact,
    pub(crate) gravity: [f64; 3],
    pub(crate) held: Vec<bool>,
    /// Half the air's density times the drag coefficient, in kg/m³.
    air: f64,
    pattern: Pattern,
    /// Drag of each particle over the length of the step, in N/m along its normal.
    drag: Vec<f64>,
    pub(crate) losses: Losses,
}

/// Energy that has left the cloth for good, in J.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Losses {
    pub(crate) friction: f64,
    pub(crate) air: f64,
}

impl World {
    pub(crate) fn new(scene: Scene) -> Self {
        let Scene { cloth, positions, held, contact, gravity, air, .. } = scene;
        let state = cloth.state(positions).expect("a scene places every particle");
        let offsets = cloth.pattern().offsets.clone();
        let columns = cloth.pattern().columns.iter().map(|&c| c as u32).collect();
        let pattern = Pattern::new(offsets, columns).expect("a cloth's pattern is sorted");
        let drag = vec![0.0; cloth.particles()];
        Self {
            workspace: cloth.workspace(),
            cloth,
            state,
            contact,
            gravity,
            held,
            air,
            pattern,
            drag,
            losses: Losses::default(),
        }
    }

    /// Calls with the particle's way along its normal since the start of the step, for every
    /// particle that the air resists.
    fn each_drag(&self, positions: &[f64], mut visit: impl FnMut(usize, f64, [f64; 3])) {
        let normals = self.state.normals().chunks_exact(3);
        let moved = positions.chunks_exact(3).zip(self.state.positions.chunks_exact(3));
        for (particle, (normal, (now, start))) in normals.zip(moved).enumerate() {
            if self.drag[particle] > 0.0 {
                let normal = [normal[0], normal[1], normal[2]];
                let way = (0..3).map(|axis| (now[axis] - start[axis]) * normal[axis]).sum();
                visit(particle, way, normal);
            }
        }
    }

    pub(crate) fn kinetic(&self) -> f64 {
        let square = |v: &[f64]| v.iter().map(|c| c * c).sum::<f64>();
        let speeds = self.state.velocities.chunks_exact(3).map(square);
        self.cloth.masses().iter().zip(speeds).map(|(mass, square)| 0.5 * mass * square).sum()
    }

    /// Potential energy in the field of gravity, 0 at the origin, in J.
    pub(crate) fn weight_energy(&self, positions: &[f64]) -> f64 {
        let height = |x: &[f64]| -> f64 { x.iter().zip(self.gravity).map(|(x, g)| -x * g).sum() };
        let heights = positions.chunks_exact(3).map(height);
        self.cloth.masses().iter().zip(heights).map(|(mass, height)| mass * height).sum()
    }
}

impl System for World {
    fn particles(&self) -> usize {
        self.cloth.particles()
    }

    fn masses(&self) -> &[f64] {
        self.cloth.masses()
    }

    fn held(&self) -> &[bool] {
        &self.held
    }

    fn begin(&mut self, _end_time: f64, dt: f64, start: &[f64], _target: &mut [f64]) {
        self.contact.begin(start, dt);
        let normals = self.state.normals().chunks_exact(3);
        let velocities = self.state.velocities.chunks_exact(3);
        let areas = self.cloth.areas();
        for (particle, (normal, velocity)) in normals.zip(velocities).enumerate() {
            // Quadratic drag with the speed of the step's start: linear in the step, and a
            // potential exists.
            let speed: f64 = normal.iter().zip(velocity).map(|(n, v)| n * v).sum();
            self.drag[particle] = self.air * areas[particle] * speed.abs() / dt;
        }
    }

    fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        for (force, mass) in forces.chunks_exact_mut(3).zip(self.cloth.masses()) {
            force.iter_mut().zip(self.gravity).for_each(|(f, g)| *f = mass * g);
        }
        self.workspace.add_forces(&self.cloth, &self.state, positions, forces);
        self.each_drag(positions, |particle, way, normal| {
            let pull = self.drag[particle] * way;
            for axis in 0..3 {
                forces[3 * particle + axis] -= pull * normal[axis];
            }
        });
        self.contact.add_forces(positions, forces);
    }

    fn potential(&mut self, positions: &[f64]) -> f64 {
        let mut drag = 0.0;
        self.each_drag(positions, |particle, way, _| drag += 0.5 * self.drag[particle] * way * way);
        let cloth = self.workspace.potential(&self.cloth, &self.state, positions);
        cloth + self.weight_energy(positions) + drag + self.contact.potential(positions)
    }

    fn stiffness(&mut self, positions: &[f64], kind: Stiffness, matrix: &mut BlockMatrix) {
        let definite = kind == Stiffness::Definite;
        self.workspace.add_stiffness(
            &self.cloth,
            &self.state,
            (positions, definite),
            matrix.values_mut(),
        );
        let offsets = self.cloth.pattern().offsets.as_slice();
        self.each_drag(positions, |particle, _, normal| {
            let drag = self.drag[particle];
            let block: [f64; 9] = std::array::from_fn(|k| drag * normal[k / 3] * normal[k % 3]);
            matrix.add_block(offsets[particle], &block);
        });
        self.contact.add_stiffness(positions, definite, &mut |particle, block| {
            matrix.add_block(offsets[particle], &block);
        });
    }

    fn pattern(&self) -> Pattern {
        self.pattern.clone()
    }

    fn accept(&mut self, positions: &[f64], velocities: &[f64], _dt: f64) {
        let mut air = 0.0;
        self.each_drag(positions, |particle, way, _| air += self.drag[particle] * way * way);
        self.losses.air += air;
        let committed =
            self.workspace.commit(&self.cloth, &mut self.state, (positions, velocities));
        self.losses.friction += committed.dissipated;
    }
}
