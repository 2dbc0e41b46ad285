use drape_implicit::{
    BlockMatrix, Coupling, Sparsity, StepFilter, StepLimit, Stiffness, System, TrialStep,
};

use super::share::{couples, interpolate};
use super::{Sewn, Weld};
use crate::world::World;

impl Sewn<'_> {
    /// Calls the world with the places of the nodes.
    fn at<T>(&mut self, positions: &[f64], ask: impl FnOnce(&mut World, &[f64]) -> T) -> T {
        let mut places = std::mem::take(&mut self.weld.places);
        self.weld.widen(positions, &mut places);
        let answer = ask(self.world, &places);
        self.weld.places = places;
        answer
    }
}

impl System for Sewn<'_> {
    fn particles(&self) -> usize {
        self.weld.masses.len()
    }

    fn masses(&self) -> &[f64] {
        &self.weld.masses
    }

    fn held(&self) -> &[bool] {
        &self.weld.held
    }

    fn begin(&mut self, end_time: f64, dt: f64, start: &[f64], target: &mut [f64]) {
        let mut ends = std::mem::take(&mut self.weld.others);
        self.at(start, |world, places| {
            ends.copy_from_slice(places);
            world.begin(end_time, dt, places, &mut ends);
        });
        self.weld.held.fill(false);
        let nodes = self.weld.places_of.iter().zip(self.world.held()).zip(ends.chunks_exact(3));
        let held: Vec<_> = nodes.filter(|((_, held), _)| **held).collect();
        // The ends of a tied node go as far as it does, unless they are held themselves.
        let (tied, own): (Vec<_>, Vec<_>) = held.into_iter().partition(|((at, _), _)| at.is_tied());
        for ((place, _), end) in tied.into_iter().chain(own) {
            let mut here = [0.0; 3];
            interpolate(place, start, &mut here);
            for (particle, _) in place.parts() {
                self.weld.held[particle] = true;
                for axis in 0..3 {
                    let k = 3 * particle + axis;
                    target[k] =
                        if place.is_tied() { start[k] + end[axis] - here[axis] } else { end[axis] };
                }
            }
        }
        self.weld.others = ends;
    }

    fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        let mut pulls = std::mem::take(&mut self.weld.others);
        self.at(positions, |world, places| world.forces(places, &mut pulls));
        forces.fill(0.0);
        for (place, pull) in self.weld.places_of.iter().zip(pulls.chunks_exact(3)) {
            for (particle, weight) in place.parts() {
                let force = &mut forces[3 * particle..][..3];
                force.iter_mut().zip(pull).for_each(|(force, pull)| *force += weight * pull);
            }
        }
        self.weld.others = pulls;
    }

    fn potential(&mut self, positions: &[f64]) -> f64 {
        self.at(positions, World::potential)
    }

    fn stiffness(&mut self, positions: &[f64], kind: Stiffness, matrix: &mut BlockMatrix) {
        let mut places = std::mem::take(&mut self.weld.places);
        self.weld.widen(positions, &mut places);
        let Weld { matrix: nodes, goals, places_of, .. } = &mut *self.weld;
        nodes.clear();
        self.world.stiffness(&places, kind, nodes);
        for goal in &*goals {
            let slot = goal.slot as usize;
            let block = nodes.blocks()[goal.from as usize].map(|entry| goal.weight * entry);
            if goal.turned || goal.twice {
                matrix.add_block(slot, &transposed(&block));
            }
            if !goal.turned {
                matrix.add_block(slot, &block);
            }
        }
        for Coupling { row, column, block } in nodes.couplings() {
            let ends = [row, column].map(|node| &places_of[*node as usize]);
            for ([row, column], weight) in couples(ends, false) {
                let block = block.map(|entry| weight * entry);
                matrix.add_coupling(row, column, &block);
                if row == column {
                    matrix.add_coupling(row, column, &transposed(&block));
                }
            }
        }
        if nodes.outside_sparsity().is_some() {
            // No particle has such a number: the step ends with an error.
            matrix.add(usize::MAX, usize::MAX, &[0.0; 9]);
        }
        self.weld.places = places;
    }

    fn sparsity(&self) -> Sparsity {
        self.weld.sparsity.clone()
    }

    fn accept(&mut self, positions: &[f64], velocities: &[f64], dt: f64) {
        let mut speeds = std::mem::take(&mut self.weld.others);
        self.weld.widen(velocities, &mut speeds);
        self.at(positions, |world, places| world.accept(places, &speeds, dt));
        self.weld.others = speeds;
    }
}

impl StepFilter for Sewn<'_> {
    fn is_nearly_straight(&self, start: f64, end: f64) -> bool {
        self.world.is_nearly_straight(start, end)
    }

    fn limit_step(&mut self, step: TrialStep<'_>) -> StepLimit {
        let mut of_nodes = std::mem::take(&mut self.weld.others);
        self.weld.widen(step.displacements, &mut of_nodes);
        let limit = self.at(step.start, |world, places| {
            world.limit_step(TrialStep { start: places, displacements: &mut of_nodes, ..step })
        });
        // Any part of a step that is allowed is allowed too: the shortest is all nodes'.
        if !limit.is_whole() {
            self.weld.shorten(&of_nodes, step.displacements);
        }
        self.weld.others = of_nodes;
        limit
    }

    fn set_obstacle_time(&mut self, time: f64) {
        self.world.set_obstacle_time(time);
    }

    fn is_intersection_free(&mut self, positions: &[f64]) -> bool {
        self.at(positions, World::is_intersection_free)
    }
}

fn transposed(block: &[f64; 9]) -> [f64; 9] {
    std::array::from_fn(|k| block[3 * (k % 3) + k / 3])
}
