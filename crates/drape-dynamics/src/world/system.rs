use drape_implicit::{BlockMatrix, Sparsity, StepFilter, StepLimit, Stiffness, System, TrialStep};

use super::World;
use crate::ledger::Entry;

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

    fn begin(&mut self, end_time: f64, dt: f64, start: &[f64], target: &mut [f64]) {
        self.hold(end_time);
        let time = self.time_of_motion(end_time);
        self.attachments.clear();
        for pin in self.pins.iter().filter(|pin| pin.holds(end_time)) {
            match pin.is_whole() {
                true => pin.place(time, target),
                false => self.attachments.add(pin, time),
            }
        }
        let since = end_time - self.grows_from;
        let grown = if since < self.ramp { (since / self.ramp).max(0.0) } else { 1.0 };
        self.gravity = self.full_gravity.map(|g| grown * g);
        if let Some(stitches) = &mut self.stitches {
            stitches.begin(end_time);
            self.gravity = [0.0; 3];
        }
        if let Some(surfaces) = &mut self.surfaces {
            surfaces.begin(([end_time, time], dt), start);
            if let Some(ledger) = &mut self.ledger {
                (ledger.slip, ledger.push) = (0.0, surfaces.contact.growth_work());
                ledger.barrier = surfaces.contact.potential(start);
                ledger.connectors = None;
            }
        } else {
            self.begin_contact(start, (end_time, dt));
        }
        let momenta = self.brake.chunks_exact_mut(3).zip(self.state.velocities.chunks_exact(3));
        for ((brake, velocity), mass) in momenta.zip(self.cloth.masses()) {
            for (brake, v) in brake.iter_mut().zip(velocity) {
                *brake = -mass * v / dt;
            }
        }
        let normals = self.state.normals().chunks_exact(3);
        let velocities = self.state.velocities.chunks_exact(3);
        let areas = self.cloth.areas();
        for (particle, (normal, velocity)) in normals.zip(velocities).enumerate() {
            // Quadratic drag with the speed of the step's start: linear in the step, and a
            // potential exists.
            let speed: f64 = normal.iter().zip(velocity).map(|(n, v)| n * v).sum();
            let air = if self.creeps { 0.0 } else { self.air };
            self.drag[particle] = air * areas[particle] * speed.abs() / dt;
        }
    }

    fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        for (force, mass) in forces.chunks_exact_mut(3).zip(self.cloth.masses()) {
            force.iter_mut().zip(self.gravity).for_each(|(f, g)| *f = mass * g);
        }
        forces.iter_mut().zip(&self.brake).for_each(|(force, brake)| *force += brake);
        self.bonds.add_forces(&self.cloth, &self.state, positions, forces);
        if let Some(stitches) = &self.stitches {
            stitches.add_forces(positions, forces);
        }
        self.attachments.add_forces(positions, forces);
        self.each_drag(positions, |particle, way, normal| {
            let pull = self.drag[particle] * way;
            for axis in 0..3 {
                forces[3 * particle + axis] -= pull * normal[axis];
            }
        });
        match &mut self.surfaces {
            Some(surfaces) => surfaces.contact.add_forces(positions, forces),
            None => self.contact.add_forces(positions, forces),
        }
    }

    fn potential(&mut self, positions: &[f64]) -> f64 {
        let mut drag = 0.0;
        self.each_drag(positions, |particle, way, _| drag += 0.5 * self.drag[particle] * way * way);
        let cloth = self.bonds.potential(&self.cloth, &self.state, positions);
        let brake: f64 = self.brake.iter().zip(positions).map(|(brake, x)| -brake * x).sum();
        if let Some(ledger) = &mut self.ledger {
            ledger.saw(cloth);
        }
        let contact = match &mut self.surfaces {
            Some(surfaces) => surfaces.contact.potential(positions),
            None => self.contact.potential(positions),
        };
        let threads = self.stitches.as_ref().map_or(0.0, |threads| threads.potential(positions));
        let attached = self.attachments.potential(positions);
        cloth + self.weight_energy(positions) + brake + drag + contact + threads + attached
    }

    fn stiffness(&mut self, positions: &[f64], kind: Stiffness, matrix: &mut BlockMatrix) {
        let definite = kind == Stiffness::Definite;
        self.bonds.add_stiffness(&self.cloth, &self.state, (positions, definite), matrix);
        if let Some(stitches) = &self.stitches {
            stitches.add_stiffness(matrix);
        }
        self.attachments.add_stiffness(matrix);
        self.each_drag(positions, |particle, _, normal| {
            let drag = self.drag[particle];
            let block: [f64; 9] = std::array::from_fn(|k| drag * normal[k / 3] * normal[k % 3]);
            matrix.add_block(matrix.sparsity().row(particle).start, &block);
        });
        match &mut self.surfaces {
            Some(surfaces) => {
                surfaces.contact.add_stiffness(positions, &mut |[i, j], block| {
                    matrix.add_coupling(i, j, block);
                });
            }
            None => self.contact.add_stiffness(positions, definite, &mut |particle, block| {
                matrix.add_block(matrix.sparsity().row(particle).start, &block);
            }),
        }
    }

    fn sparsity(&self) -> Sparsity {
        self.bonds.coupling().clone()
    }

    fn sparsity_version(&self) -> u64 {
        self.bonds.version()
    }

    fn accept(&mut self, positions: &[f64], velocities: &[f64], dt: f64) {
        let entry = self.ledger.is_some().then(|| self.entry(positions, dt));
        if let Some(surfaces) = &mut self.surfaces {
            surfaces.contact.commit(positions);
        }
        let dissipated = self.bonds.commit(&self.cloth, &mut self.state, (positions, velocities));
        if let (Some(ledger), Some(entry)) = (&mut self.ledger, entry) {
            let stored = self.bonds.stored(&self.cloth, &self.state);
            ledger.enter(&Entry { friction: dissipated, stored, ..entry });
        }
    }
}

impl StepFilter for World {
    fn is_nearly_straight(&self, start: f64, end: f64) -> bool {
        let times = [start, end].map(|time| self.time_of_motion(time));
        self.surfaces.as_ref().is_none_or(|surfaces| surfaces.go_straight(times))
    }

    fn limit_step(&mut self, step: TrialStep<'_>) -> StepLimit {
        match &mut self.surfaces {
            Some(surfaces) => surfaces.limit_step(step),
            None => StepLimit::Whole,
        }
    }

    fn set_obstacle_time(&mut self, time: f64) {
        if let Some(surfaces) = &mut self.surfaces {
            surfaces.contact.set_obstacle_time(time);
        }
    }

    fn is_intersection_free(&mut self, positions: &[f64]) -> bool {
        self.surfaces.as_mut().is_none_or(|surfaces| surfaces.is_intersection_free(positions))
    }
}
