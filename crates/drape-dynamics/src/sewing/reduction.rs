//! Reduction of a sewn world to its independent degrees of freedom.

use drape_implicit::{BlockMatrix, Error, IntegratorState, PreviousState, Sparsity, System};
use drape_scene::SeamPairs;

use crate::sewing::node_map::{
    CoupledPair, Row, coupled_pairs, coupled_pairs_of_one, reduced_masses, rows, tied_groups,
};
use crate::world::World;

/// Reduction of the particles of a sewn cloth to independent ones.
///
/// The cloth, its contact and its frames know all particles of the panels. Particles that are sewn
/// to each other have one position and one velocity, and a tied particle has those of a place
/// between two others. Tied particles have no mass of their own.
#[derive(Debug)]
pub(crate) struct Reduction {
    /// Rows of the map from independent particles to all.
    pub(super) rows: Vec<Row>,
    pub(super) masses: Vec<f64>,
    pub(super) held: Vec<bool>,
    /// Groups of independent particles that ties join.
    tied_groups: Vec<Vec<u32>>,
    /// Stiffness of all particles.
    pub(super) matrix: BlockMatrix,
    /// Places of its blocks in the reduced matrix.
    pub(super) targets: Vec<BlockTarget>,
    pub(super) sparsity: Sparsity,
    /// Buffers for positions and for displacements, velocities or forces of all particles.
    pub(super) positions: Vec<f64>,
    pub(super) values: Vec<f64>,
    /// Buffer for fractions of displacements of the independent particles.
    fractions: Vec<f64>,
}

/// Place of a block of the matrix of all particles in the reduced matrix.
#[derive(Debug, Clone, Copy)]
pub(super) struct BlockTarget {
    /// Number of the block.
    pub(super) block: u32,
    /// Number of the block that it is added to.
    pub(super) slot: u32,
    /// Whether it is transposed.
    pub(super) transposed: bool,
    /// Whether it couples two particles that are one, and so is added both ways.
    pub(super) twice: bool,
    /// Factor.
    pub(super) weight: f64,
}

impl Reduction {
    /// Reduces a world by pairs and ties of its particles.
    ///
    /// # Errors
    /// Particles that are not there.
    pub(crate) fn new(world: &World, pairs: &SeamPairs) -> Result<Self, Error> {
        let rows = rows(world.particles(), pairs);
        let masses = reduced_masses(&rows, world.masses());
        let count = masses.len();
        let whole = world.sparsity();
        let mut targets = Vec::with_capacity(whole.blocks());
        let mut add = |slot: usize, twice: bool, pair: CoupledPair| {
            let CoupledPair { row, column, weight } = pair;
            let (block, transposed) = (slot as u32, row > column);
            let target = BlockTarget { block, slot: 0, transposed, twice, weight };
            targets.push(([row, column], target));
        };
        for row in 0..whole.particles() {
            // The first block of a row is that of a particle with itself.
            let start = whole.row(row).start;
            for slot in whole.row(row) {
                if slot == start {
                    coupled_pairs_of_one(&rows[row]).for_each(|pair| add(slot, false, pair));
                    continue;
                }
                let column = whole.columns()[slot] as usize;
                for pair in coupled_pairs(&rows[row], &rows[column]) {
                    add(slot, pair.row == pair.column, pair);
                }
            }
        }
        let sparsity = Sparsity::from_pairs(count, targets.iter().map(|&(pair, _)| pair))?;
        let targets = targets.into_iter().map(|([a, b], target)| {
            let slot = sparsity.slot(a, b).unwrap_or_default() as u32;
            BlockTarget { slot, ..target }
        });
        let numbers = 3 * rows.len();
        Ok(Self {
            tied_groups: tied_groups(&rows, count),
            targets: targets.collect(),
            rows,
            masses,
            held: vec![false; count],
            matrix: BlockMatrix::zeros(whole),
            sparsity,
            positions: vec![0.0; numbers],
            values: vec![0.0; numbers],
            fractions: vec![1.0; count],
        })
    }

    /// Number of independent particles.
    pub(crate) fn particles(&self) -> usize {
        self.masses.len()
    }

    /// Values of the independent particles from those of all.
    pub(crate) fn restrict(&self, values: &[f64]) -> Vec<f64> {
        let mut own = vec![0.0; 3 * self.masses.len()];
        let all = self.rows.iter().zip(values.chunks_exact(3));
        for (row, value) in all.filter(|(row, _)| !row.is_tied()) {
            own[3 * row.particle()..][..3].copy_from_slice(value);
        }
        own
    }

    /// Writes the values of all particles from those of the independent ones.
    pub(crate) fn prolong(&self, values: &[f64], all: &mut [f64]) {
        for (row, value) in self.rows.iter().zip(all.chunks_exact_mut(3)) {
            row.interpolate(values, value);
        }
    }

    /// Value of a particle of the panels, from those of the independent ones.
    pub(crate) fn value_of(&self, particle: usize, values: &[f64]) -> [f64; 3] {
        let mut value = [0.0; 3];
        self.rows[particle].interpolate(values, &mut value);
        value
    }

    /// State of the integrator for all particles from that of the independent ones.
    pub(crate) fn prolonged(&self, state: &IntegratorState) -> IntegratorState {
        let prolong = |values: &[f64]| {
            let mut all = vec![0.0; 3 * self.rows.len()];
            self.prolong(values, &mut all);
            all
        };
        let previous = state.previous.as_ref().map(|previous| PreviousState {
            dt: previous.dt,
            positions: prolong(&previous.positions),
            velocities: prolong(&previous.velocities),
        });
        IntegratorState {
            time: state.time,
            positions: prolong(&state.positions),
            velocities: prolong(&state.velocities),
            previous,
        }
    }

    /// Shortens the displacements of the independent particles to those that are left of the
    /// displacements of all.
    pub(super) fn shorten(&mut self, left: &[f64], displacements: &mut [f64]) {
        let length = |of: &[f64]| of.iter().map(|x| x * x).sum::<f64>();
        let all = || self.rows.iter().zip(left.chunks_exact(3));
        // A tied particle goes a fraction of its displacement if both its ends go the same fraction
        // of theirs.
        if !self.tied_groups.is_empty() {
            self.fractions.fill(1.0);
            for (row, left) in all() {
                let mut whole = [0.0; 3];
                row.interpolate(displacements, &mut whole);
                let (left, whole) = (length(left), length(&whole));
                let fraction = if left < whole { (left / whole).sqrt() } else { 1.0 };
                for end in row.weights() {
                    self.fractions[end.particle] = fraction.min(self.fractions[end.particle]);
                }
            }
        }
        for group in &self.tied_groups {
            let fractions = group.iter().map(|&particle| self.fractions[particle as usize]);
            let fraction = fractions.fold(1.0, f64::min);
            for &particle in group {
                let own = &mut displacements[3 * particle as usize..][..3];
                own.iter_mut().for_each(|x| *x *= fraction);
            }
        }
        for (row, left) in all().filter(|(row, _)| !row.is_tied()) {
            let own = &mut displacements[3 * row.particle()..][..3];
            if length(left) < length(own) {
                own.copy_from_slice(left);
            }
        }
    }
}
