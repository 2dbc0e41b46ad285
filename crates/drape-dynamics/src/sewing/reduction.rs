//! Reduction of a sewn world to its independent degrees of freedom.

use drape_implicit::{BlockMatrix, Error, IntegratorState, PreviousState, Sparsity, System};
use drape_scene::SeamPairs;

use crate::sewing::node_map::{
    CoupledPair, Row, coupled_diagonal_pairs, coupled_pairs, reduced_masses, rows, tied_groups,
};
use crate::world::World;

/// Reduction of the particles of a sewn cloth to independent ones.
///
/// The cloth, its contact and its frames have all particles of the panels. Particles that are sewn
/// to each other share one position and one velocity. A tied particle has the interpolated position
/// and velocity of its two ends, and its mass is distributed to the ends.
#[derive(Debug)]
pub(crate) struct Reduction {
    /// Rows of the map from independent particles to all particles.
    pub(super) rows: Vec<Row>,
    pub(super) masses: Vec<f64>,
    pub(super) held: Vec<bool>,
    /// Groups of independent particles that ties join.
    tied_groups: Vec<Vec<u32>>,
    /// Stiffness matrix of all particles.
    pub(super) matrix: BlockMatrix,
    /// Targets of the blocks of `matrix` in the reduced matrix.
    pub(super) targets: Vec<BlockTarget>,
    pub(super) sparsity: Sparsity,
    /// Buffers for positions and for displacements, velocities or forces of all particles.
    pub(super) positions: Vec<f64>,
    pub(super) values: Vec<f64>,
    /// Buffer for fractions of displacements of the independent particles.
    fractions: Vec<f64>,
}

/// Target of a block of the matrix of all particles in the reduced matrix.
#[derive(Debug, Clone, Copy)]
pub(super) struct BlockTarget {
    /// Index of the block.
    pub(super) block: u32,
    /// Index of the block of the reduced matrix to which the block is added.
    pub(super) slot: u32,
    /// Whether the block is transposed.
    pub(super) transposed: bool,
    /// Whether the block couples two particles that are merged. The block and its transpose are
    /// added.
    pub(super) twice: bool,
    /// Factor by which the block is multiplied.
    pub(super) weight: f64,
}

impl BlockTarget {
    /// Returns the pair of independent particles of `pair`, and the target of `block`, whose slot
    /// is not known yet. If `twice`, the transposed block is added too.
    fn new(block: usize, pair: CoupledPair, twice: bool) -> ([usize; 2], Self) {
        let CoupledPair { row, column, weight } = pair;
        let (block, transposed) = (block as u32, row > column);
        ([row, column], Self { block, slot: 0, transposed, twice, weight })
    }
}

impl Reduction {
    /// Reduces `world` by the pairs and ties `pairs` of its particles.
    ///
    /// # Errors
    /// Returns an error if a particle of `pairs` does not exist.
    pub(crate) fn new(world: &World, pairs: &SeamPairs) -> Result<Self, Error> {
        let rows = rows(world.particle_count(), pairs);
        let masses = reduced_masses(&rows, world.masses());
        let count = masses.len();
        let whole = world.sparsity();
        let mut targets = Vec::with_capacity(whole.block_count());
        for row in 0..whole.particle_count() {
            // The first block of a row is the diagonal block.
            let start = whole.row(row).start;
            for block in whole.row(row) {
                if block == start {
                    let pairs = coupled_diagonal_pairs(&rows[row]);
                    targets.extend(pairs.map(|pair| BlockTarget::new(block, pair, false)));
                    continue;
                }
                let column = whole.columns()[block] as usize;
                let pairs = coupled_pairs(&rows[row], &rows[column]);
                targets.extend(
                    pairs.map(|pair| BlockTarget::new(block, pair, pair.row == pair.column)),
                );
            }
        }

        // The slots are known once all pairs are.
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

    /// Returns the number of independent particles, which is the length of `masses`.
    pub(crate) fn particle_count(&self) -> usize {
        self.masses.len()
    }

    /// Returns the independent particle of `particle`, which is not tied.
    pub(crate) fn independent_particle(&self, particle: usize) -> usize {
        self.rows[particle].particle()
    }

    /// Returns the values of the independent particles from the `values` of all particles, three
    /// numbers each.
    pub(crate) fn restrict(&self, values: &[f64]) -> Vec<f64> {
        let mut restricted = vec![0.0; 3 * self.masses.len()];
        let particles = self.rows.iter().zip(values.chunks_exact(3));
        for (row, value) in particles.filter(|(row, _)| !row.is_tied()) {
            restricted[3 * row.particle()..][..3].copy_from_slice(value);
        }
        restricted
    }

    /// Writes the values of all particles to `all`, from the `values` of the independent particles,
    /// three numbers each.
    pub(crate) fn prolong(&self, values: &[f64], all: &mut [f64]) {
        for (row, value) in self.rows.iter().zip(all.chunks_exact_mut(3)) {
            row.interpolate(values, value);
        }
    }

    /// Returns the value of `particle` of the panels from the `values` of the independent
    /// particles.
    pub(crate) fn value_of(&self, particle: usize, values: &[f64]) -> [f64; 3] {
        let mut value = [0.0; 3];
        self.rows[particle].interpolate(values, &mut value);
        value
    }

    /// Returns the integrator state of all particles from the `state` of the independent particles.
    pub(crate) fn prolonged(&self, state: &IntegratorState) -> IntegratorState {
        let previous = state.previous.as_ref().map(|previous| PreviousState {
            dt: previous.dt,
            positions: self.prolonged_values(&previous.positions),
            velocities: self.prolonged_values(&previous.velocities),
        });
        IntegratorState {
            time: state.time,
            positions: self.prolonged_values(&state.positions),
            velocities: self.prolonged_values(&state.velocities),
            previous,
        }
    }

    /// Returns the values of all particles from the `values` of the independent particles.
    fn prolonged_values(&self, values: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; 3 * self.rows.len()];
        self.prolong(values, &mut all);
        all
    }

    /// Shortens the `displacements` of the independent particles so that no particle moves farther
    /// than its displacement in `allowed`, which has all particles.
    pub(super) fn shorten(&mut self, allowed: &[f64], displacements: &mut [f64]) {
        // A tied particle moves by a fraction of its displacement if both its ends move by this
        // fraction of their displacements.
        if !self.tied_groups.is_empty() {
            self.fractions.fill(1.0);
            for (row, allowed) in self.rows.iter().zip(allowed.chunks_exact(3)) {
                let mut wanted = [0.0; 3];
                row.interpolate(displacements, &mut wanted);
                let (allowed_square, wanted_square) = (square(allowed), square(&wanted));
                let fraction = if allowed_square < wanted_square {
                    (allowed_square / wanted_square).sqrt()
                } else {
                    1.0
                };
                for end in row.weights() {
                    self.fractions[end.particle] = fraction.min(self.fractions[end.particle]);
                }
            }
        }

        // All particles that ties join move by a common fraction.
        for group in &self.tied_groups {
            let fractions = group.iter().map(|&particle| self.fractions[particle as usize]);
            let fraction = fractions.fold(1.0, f64::min);
            for &particle in group {
                let displacement = &mut displacements[3 * particle as usize..][..3];
                displacement.iter_mut().for_each(|x| *x *= fraction);
            }
        }

        let particles = self.rows.iter().zip(allowed.chunks_exact(3));
        for (row, allowed) in particles.filter(|(row, _)| !row.is_tied()) {
            let displacement = &mut displacements[3 * row.particle()..][..3];
            if square(allowed) < square(displacement) {
                displacement.copy_from_slice(allowed);
            }
        }
    }
}

/// Returns the squared length of `vector`.
fn square(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>()
}
