//! Sewn world as the solver sees it: a system of its independent particles.

use drape_implicit::{
    AllowedStep, BlockMatrix, Coupling, MaterialPoint, Sparsity, StepFilter, Stiffness, System,
    TrialStep,
};

use crate::sewing::node_map::coupled_pairs;
use crate::sewing::reduction::Reduction;
use crate::world::World;

/// Sewn world with its reduction.
pub(crate) struct ReducedSystem<'a> {
    pub(crate) world: &'a mut World,
    pub(crate) reduction: &'a mut Reduction,
}

impl ReducedSystem<'_> {
    /// Calls with the world and the positions of all its particles.
    fn at<T>(&mut self, positions: &[f64], call: impl FnOnce(&mut World, &[f64]) -> T) -> T {
        let mut all = std::mem::take(&mut self.reduction.positions);
        self.reduction.prolong(positions, &mut all);
        let answer = call(self.world, &all);
        self.reduction.positions = all;
        answer
    }
}

impl System for ReducedSystem<'_> {
    fn particles(&self) -> usize {
        self.reduction.masses.len()
    }

    fn masses(&self) -> &[f64] {
        &self.reduction.masses
    }

    fn held(&self) -> &[bool] {
        &self.reduction.held
    }

    fn begin(&mut self, end_time: f64, dt: f64, start: &[f64], target: &mut [f64]) {
        let mut ends = std::mem::take(&mut self.reduction.values);
        self.at(start, |world, positions| {
            ends.copy_from_slice(positions);
            world.begin(end_time, dt, positions, &mut ends);
        });
        let Reduction { rows, held, .. } = &mut *self.reduction;
        held.fill(false);
        let all = || rows.iter().zip(self.world.held()).zip(ends.chunks_exact(3));
        let fixed = || all().filter(|((_, held), _)| **held).map(|((row, _), end)| (row, end));
        // The ends of a tied particle move as far as it does, unless they are held themselves.
        for (row, end) in fixed().filter(|(row, _)| row.is_tied()) {
            let mut here = [0.0; 3];
            row.interpolate(start, &mut here);
            for own in row.weights() {
                held[own.particle] = true;
                for axis in 0..3 {
                    let k = 3 * own.particle + axis;
                    target[k] = start[k] + end[axis] - here[axis];
                }
            }
        }
        for (row, end) in fixed().filter(|(row, _)| !row.is_tied()) {
            held[row.particle()] = true;
            target[3 * row.particle()..][..3].copy_from_slice(end);
        }
        self.reduction.values = ends;
    }

    fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        let mut all = std::mem::take(&mut self.reduction.values);
        self.at(positions, |world, positions| world.forces(positions, &mut all));
        forces.fill(0.0);
        for (row, own) in self.reduction.rows.iter().zip(all.chunks_exact(3)) {
            for end in row.weights() {
                let force = &mut forces[3 * end.particle..][..3];
                force.iter_mut().zip(own).for_each(|(force, own)| *force += end.weight * own);
            }
        }
        self.reduction.values = all;
    }

    fn potential(&mut self, positions: &[f64]) -> f64 {
        self.at(positions, World::potential)
    }

    fn stiffness(&mut self, positions: &[f64], kind: Stiffness, matrix: &mut BlockMatrix) {
        let mut all = std::mem::take(&mut self.reduction.positions);
        self.reduction.prolong(positions, &mut all);
        let Reduction { matrix: whole, targets, rows, .. } = &mut *self.reduction;
        whole.clear();
        self.world.stiffness(&all, kind, whole);
        for target in &*targets {
            let slot = target.slot as usize;
            let block = whole.blocks()[target.block as usize].map(|entry| target.weight * entry);
            if target.transposed || target.twice {
                matrix.add_block(slot, &transpose(&block));
            }
            if !target.transposed {
                matrix.add_block(slot, &block);
            }
        }
        for Coupling { row, column, block } in whole.couplings() {
            let [row, column] = [row, column].map(|particle| &rows[*particle as usize]);
            for pair in coupled_pairs(row, column) {
                let block = block.map(|entry| pair.weight * entry);
                matrix.add_coupling(pair.row, pair.column, &block);
                if pair.row == pair.column {
                    matrix.add_coupling(pair.row, pair.column, &transpose(&block));
                }
            }
        }
        if whole.outside_sparsity().is_some() {
            // No particle has such a number: the step ends with an error.
            matrix.add(usize::MAX, usize::MAX, &[0.0; 9]);
        }
        self.reduction.positions = all;
    }

    fn sparsity(&self) -> Sparsity {
        self.reduction.sparsity.clone()
    }

    fn material_points(&self) -> Vec<MaterialPoint> {
        let all = self.world.material_points();
        let mut own = vec![None; self.reduction.masses.len()];
        for (row, point) in self.reduction.rows.iter().zip(all) {
            if !row.is_tied() {
                own[row.particle()].get_or_insert(point);
            }
        }
        own.into_iter().flatten().collect()
    }

    fn is_cancelled(&self) -> bool {
        self.world.is_cancelled()
    }

    fn accept(&mut self, positions: &[f64], velocities: &[f64], dt: f64) {
        let mut all = std::mem::take(&mut self.reduction.values);
        self.reduction.prolong(velocities, &mut all);
        self.at(positions, |world, positions| world.accept(positions, &all, dt));
        self.reduction.values = all;
    }
}

impl StepFilter for ReducedSystem<'_> {
    fn resolves_motion(&self, start: f64, end: f64) -> bool {
        self.world.resolves_motion(start, end)
    }

    fn limit_step(&mut self, step: TrialStep<'_>) -> AllowedStep {
        let mut all = std::mem::take(&mut self.reduction.values);
        self.reduction.prolong(step.displacements, &mut all);
        let limit = self.at(step.start, |world, positions| {
            world.limit_step(TrialStep { start: positions, displacements: &mut all, ..step })
        });
        // Contact keeps a common fraction of what merged and tied particles do together, to rounding
        // of its own, for which it leaves room.
        if !limit.is_whole() {
            self.reduction.shorten(&all, step.displacements);
        }
        self.reduction.values = all;
        limit
    }

    fn set_obstacle_time(&mut self, time: f64) {
        self.world.set_obstacle_time(time);
    }

    fn obstacle_work(&mut self, positions: &[f64]) -> f64 {
        self.at(positions, World::obstacle_work)
    }

    fn is_intersection_free(&mut self, positions: &[f64]) -> bool {
        self.at(positions, World::is_intersection_free)
    }
}

fn transpose(block: &[f64; 9]) -> [f64; 9] {
    std::array::from_fn(|k| block[3 * (k % 3) + k / 3])
}
