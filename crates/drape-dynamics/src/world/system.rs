//! World as the system and the step filter of `drape-implicit`: the adapter between cloth, contact
//! and solver.

use std::sync::atomic::Ordering;

use drape_implicit::{
    AllowedStep, BlockMatrix, MaterialPoint, Sparsity, StepFilter, Stiffness, System, TrialStep,
};

use super::World;
use super::contact::{ALL_PARTICLES, Contact, ContactStep};
use super::energy_balance::StepEnergy;
use crate::world::closing_springs::ClosingSprings;

impl System for World {
    fn particle_count(&self) -> usize {
        self.cloth.particle_count()
    }

    fn masses(&self) -> &[f64] {
        self.cloth.masses()
    }

    fn held(&self) -> &[bool] {
        &self.pins.held
    }

    fn begin(&mut self, end_time: f64, dt: f64, start: &[f64], target: &mut [f64]) {
        let motion_end = self.clock.time(end_time);
        self.pins.begin(end_time, motion_end, target);
        if self.pins.is_steered()
            && let Some(surfaces) = self.contact.surfaces_mut()
        {
            surfaces.set_held(&self.pins.held);
        }

        // While a garment is sewn there is no gravity.
        match &mut self.seams.springs {
            Some(springs) => {
                springs.begin(start, end_time);
                self.gravity.begin_without();
            }
            None => self.gravity.begin(end_time),
        }

        let energy = self.contact.begin(&ContactStep {
            positions: start,
            end_time,
            dt,
            motion_start: self.clock.time(end_time - dt),
            motion_end,
            relaxes: self.momentum.is_active(),
            with_energy: self.balance.is_some(),
            seam_gaps: self.seams.springs.as_ref().map(ClosingSprings::gaps),
        });
        if let (Some(balance), Some(energy)) = (&mut self.balance, energy) {
            balance.begin(energy);
        }

        self.momentum.begin(self.cloth.masses(), &self.state.velocities, dt);
        if self.momentum.is_active() {
            self.air.begin_without();
        } else {
            self.air.begin(&self.cloth, &self.state, dt);
        }
    }

    fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        self.gravity.write_forces(self.cloth.masses(), forces);
        self.external.add_forces(forces);
        self.momentum.forces.add_forces(forces);
        let trial = self.cloth.trial(&self.state, positions).expect(ALL_PARTICLES);
        self.internal.add_forces(trial, forces).expect(ALL_PARTICLES);
        if let Some(springs) = &self.seams.springs {
            springs.add_forces(positions, forces);
        }
        self.pins.springs.add_forces(positions, forces);
        self.air.add_forces(&self.state, positions, forces);
        self.contact.add_forces(positions, forces);
    }

    fn potential(&mut self, positions: &[f64]) -> f64 {
        let drag = self.air.potential(&self.state, positions);
        let trial = self.cloth.trial(&self.state, positions).expect(ALL_PARTICLES);
        let internal = self.internal.potential(trial).expect(ALL_PARTICLES);
        let momentum = self.momentum.forces.potential(positions);
        if let Some(balance) = &mut self.balance {
            balance.note_internal_potential(internal);
        }
        let contact = self.contact.potential(positions);
        let closing =
            self.seams.springs.as_ref().map_or(0.0, |springs| springs.potential(positions));
        let pins = self.pins.springs.potential(positions);
        let weight = self.gravity.potential(self.cloth.masses(), positions);
        let external = self.external.potential(positions);
        internal + weight + momentum + drag + contact + closing + pins + external
    }

    fn stiffness(&mut self, positions: &[f64], kind: Stiffness, matrix: &mut BlockMatrix) {
        let definite = kind == Stiffness::Definite;
        let trial = self.cloth.trial(&self.state, positions).expect(ALL_PARTICLES);
        self.internal.add_stiffness(trial, definite, matrix).expect(ALL_PARTICLES);
        if let Some(springs) = &self.seams.springs {
            springs.add_stiffness(matrix);
        }
        self.pins.springs.add_stiffness(matrix);
        self.air.add_stiffness(&self.state, positions, matrix);
        self.contact.add_stiffness(positions, definite, matrix);
    }

    fn sparsity(&self) -> Sparsity {
        self.internal.sparsity().clone()
    }

    fn sparsity_version(&self) -> u64 {
        self.internal.sparsity_version()
    }

    fn material_points(&self) -> Vec<MaterialPoint> {
        let starts = self.cloth.panel_starts();
        let points = self.cloth.coordinates().iter().zip(self.cloth.spacings());
        points
            .enumerate()
            .map(|(particle, (&coordinates, &spacing))| MaterialPoint {
                sheet: starts.partition_point(|&start| start <= particle) as u32,
                coordinates,
                spacing,
            })
            .collect()
    }

    fn is_cancelled(&self) -> bool {
        self.cancel.as_ref().is_some_and(|cancel| cancel.load(Ordering::Relaxed))
    }

    fn accept(&mut self, positions: &[f64], velocities: &[f64], dt: f64) {
        let energy = self.balance.is_some().then(|| self.step_energy(positions, dt));
        self.contact.commit(positions);
        let internal_friction = self
            .internal
            .commit(&self.cloth, &mut self.state, positions, velocities)
            .expect(ALL_PARTICLES);
        if let (Some(balance), Some(energy)) = (&mut self.balance, energy) {
            let stored = self.internal.stored(&self.cloth, &self.state).expect(ALL_PARTICLES);
            balance.add(&StepEnergy { internal_friction, stored, ..energy });
        }
    }
}

impl StepFilter for World {
    fn resolves_motion(&self, start: f64, end: f64) -> bool {
        let times = [start, end].map(|time| self.clock.time(time));
        self.contact.surfaces().is_none_or(|surfaces| {
            let resolution = surfaces.resolution();
            surfaces.bodies_are_resolved(times) && self.pins.are_resolved(times, resolution)
        })
    }

    fn limit_step(&mut self, step: TrialStep<'_>) -> AllowedStep {
        match self.contact.surfaces_mut() {
            Some(surfaces) => surfaces.limit_step(step),
            None => AllowedStep::Whole,
        }
    }

    fn set_obstacle_time(&mut self, time: f64) {
        if let Some(surfaces) = self.contact.surfaces_mut() {
            surfaces.open_step().set_obstacle_time(time);
        }
    }

    fn obstacle_work(&mut self, positions: &[f64]) -> f64 {
        let surfaces = self.contact.surfaces_mut();
        surfaces.map_or(0.0, |surfaces| surfaces.body_work(positions))
    }

    fn is_intersection_free(&mut self, positions: &[f64]) -> bool {
        let surfaces = self.contact.surfaces_mut();
        surfaces.is_none_or(|surfaces| surfaces.is_intersection_free(positions))
    }
}

impl World {
    /// Returns the energies of a step of the length `dt`, in s, to the accepted `positions`,
    /// without the entries of the internal forces. Prepares the contact of particles for the next
    /// step.
    fn step_energy(&mut self, positions: &[f64], dt: f64) -> StepEnergy {
        let start = &self.state.positions;
        let masses = self.cloth.masses();
        let springs = self.pins.springs.work(start, positions);
        let balance = self.balance.as_ref();
        let before = balance.map_or_else(Default::default, |balance| balance.contact_at_start());

        let energy = StepEnergy {
            gravity: self.gravity.potential(masses, positions)
                - self.gravity.potential(masses, start),
            external_work: self.external.work(start, positions),
            spring_work: springs.by_force,
            spring_potential_fall: springs.potential_fall,
            body_work: before.body_work,
            air: self.air.energy(&self.state, positions),
            momentum_removal: -self.momentum.forces.work(start, positions),
            ..StepEnergy::default()
        };

        match &mut self.contact {
            Contact::Surfaces(surfaces) => {
                let contact = surfaces.contact.energy(positions).expect(ALL_PARTICLES);
                let potential = contact.potential();
                let contact_at_end = contact.without_friction();
                let friction = contact.friction();
                let dissipated = friction.dissipated;
                StepEnergy {
                    contact: potential - dissipated - before.contact + before.body_work,
                    contact_at_end,
                    body_friction_loss: dissipated,
                    cloth_friction_loss: friction.dissipated_on_cloth,
                    body_friction_potential: dissipated,
                    ..energy
                }
            }
            Contact::Particles(bodies) => {
                let friction = bodies.friction_work(start, positions, dt);
                let potential = friction.contact_potential;
                StepEnergy {
                    contact: potential - before.contact + before.body_work,
                    contact_at_end: potential,
                    body_friction_work: friction.body_work,
                    body_friction_loss: friction.loss,
                    body_friction_potential: friction.potential - potential - before.friction,
                    ..energy
                }
            }
        }
    }
}
