//! System of the independent particles of a sewn world, as the solver sees it.

use drape_implicit::{
    AllowedStep, BlockMatrix, Coupling, MaterialPoint, Sparsity, StepFilter, Stiffness, System,
    TrialStep,
};

use crate::sewing::node_map::{Row, Weight, coupled_pairs};
use crate::sewing::reduction::Reduction;
use crate::world::World;

/// Sewn world with its reduction.
pub(crate) struct ReducedSystem<'a> {
    pub(crate) world: &'a mut World,
    pub(crate) reduction: &'a mut Reduction,
}

impl ReducedSystem<'_> {
    /// Calls `call` with the world and the positions of all its particles. `positions` are the
    /// positions of the independent particles. Returns the result of `call`.
    fn with_all_positions<T>(
        &mut self,
        positions: &[f64],
        call: impl FnOnce(&mut World, &[f64]) -> T,
    ) -> T {
        let mut all = std::mem::take(&mut self.reduction.positions);
        self.reduction.prolong(positions, &mut all);
        let answer = call(self.world, &all);
        self.reduction.positions = all;
        answer
    }
}

impl System for ReducedSystem<'_> {
    fn particle_count(&self) -> usize {
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
        self.with_all_positions(start, |world, positions| {
            ends.copy_from_slice(positions);
            world.begin(end_time, dt, positions, &mut ends);
        });

        let Reduction { rows, held, .. } = &mut *self.reduction;
        held.fill(false);
        let world_held = self.world.held();

        // The ends of a held tied particle move as far as the particle. Ends that are held
        // themselves overwrite this displacement below.
        for (row, end) in held_rows(rows, world_held, &ends).filter(|(row, _)| row.is_tied()) {
            let mut tied_start = [0.0; 3];
            row.interpolate(start, &mut tied_start);
            for Weight { particle, .. } in row.weights() {
                held[particle] = true;
                for axis in 0..3 {
                    let k = 3 * particle + axis;
                    target[k] = start[k] + end[axis] - tied_start[axis];
                }
            }
        }
        for (row, end) in held_rows(rows, world_held, &ends).filter(|(row, _)| !row.is_tied()) {
            held[row.particle()] = true;
            target[3 * row.particle()..][..3].copy_from_slice(end);
        }
        self.reduction.values = ends;
    }

    fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        let mut all = std::mem::take(&mut self.reduction.values);
        self.with_all_positions(positions, |world, positions| world.forces(positions, &mut all));
        forces.fill(0.0);
        for (row, share) in self.reduction.rows.iter().zip(all.chunks_exact(3)) {
            for end in row.weights() {
                let force = &mut forces[3 * end.particle..][..3];
                force.iter_mut().zip(share).for_each(|(force, share)| *force += end.weight * share);
            }
        }
        self.reduction.values = all;
    }

    fn potential(&mut self, positions: &[f64]) -> f64 {
        self.with_all_positions(positions, World::potential)
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

        // Couplings have no blocks in the sparsity, so they are mapped one by one.
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
            // An index out of range reports the missing block, and the step ends with an error.
            matrix.add(usize::MAX, usize::MAX, &[0.0; 9]);
        }
        self.reduction.positions = all;
    }

    fn sparsity(&self) -> Sparsity {
        self.reduction.sparsity.clone()
    }

    fn material_points(&self) -> Vec<MaterialPoint> {
        let all = self.world.material_points();
        let mut points = vec![None; self.reduction.masses.len()];
        for (row, point) in self.reduction.rows.iter().zip(all) {
            if !row.is_tied() {
                points[row.particle()].get_or_insert(point);
            }
        }
        points.into_iter().flatten().collect()
    }

    fn is_cancelled(&self) -> bool {
        self.world.is_cancelled()
    }

    fn accept(&mut self, positions: &[f64], velocities: &[f64], dt: f64) {
        let mut all = std::mem::take(&mut self.reduction.values);
        self.reduction.prolong(velocities, &mut all);
        self.with_all_positions(positions, |world, positions| world.accept(positions, &all, dt));
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
        let limit = self.with_all_positions(step.start, |world, positions| {
            world.limit_step(TrialStep { start: positions, displacements: &mut all, ..step })
        });
        // Contact shortens the displacements of merged and tied particles by a common fraction, up
        // to rounding errors, for which it leaves a margin.
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
        self.with_all_positions(positions, World::obstacle_work)
    }

    fn is_intersection_free(&mut self, positions: &[f64]) -> bool {
        self.with_all_positions(positions, World::is_intersection_free)
    }
}

/// Returns the rows of the particles that are held, each with the three coordinates of the particle
/// in `ends`. `held` says whether each particle is held.
fn held_rows<'a>(
    rows: &'a [Row],
    held: &'a [bool],
    ends: &'a [f64],
) -> impl Iterator<Item = (&'a Row, &'a [f64])> {
    let particles = rows.iter().zip(held).zip(ends.chunks_exact(3));
    particles.filter(|((_, held), _)| **held).map(|((row, _), end)| (row, end))
}

fn transpose(block: &[f64; 9]) -> [f64; 9] {
    std::array::from_fn(|k| block[3 * (k % 3) + k / 3])
}
