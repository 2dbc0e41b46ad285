//! Rows of the elimination: the particles by level, each level padded to whole batches.

use crate::linear::lanes::LANES;
use crate::linear::sparsity::Sparsity;

/// Marker of a row without a particle, a lane without a block, or a block outside the sparsity.
pub(crate) const ABSENT: u32 = u32::MAX;

/// Rows before the first and, at the least, after the last: the blocks of zeros of a batch may lead
/// that far.
const MARGIN: usize = LANES;

/// Rows of the particles in the order of elimination.
#[derive(Debug)]
pub(crate) struct RowOrder {
    /// Row of each particle.
    pub row_of: Vec<u32>,
    /// Particle of each row, or [`ABSENT`] in margins and padding.
    pub particles: Vec<u32>,
    /// First row of each level, and the end of the last level.
    pub levels: Vec<usize>,
}

impl RowOrder {
    pub(crate) fn new(sparsity: &Sparsity) -> Self {
        let mut row_of = vec![0; sparsity.particles()];
        let mut particles = vec![ABSENT; MARGIN];
        let mut levels = Vec::new();
        for level in sorted(sparsity) {
            levels.push(particles.len());
            for particle in level {
                row_of[particle as usize] = particles.len() as u32;
                particles.push(particle);
            }
            particles.resize(particles.len().next_multiple_of(LANES), ABSENT);
        }
        levels.push(particles.len());
        particles.resize(particles.len() + MARGIN, ABSENT);
        Self { row_of, particles, levels }
    }
}

/// Particles of each level, ascending.
fn sorted(sparsity: &Sparsity) -> Vec<Vec<u32>> {
    let mut level_of = vec![0; sparsity.particles()];
    let mut levels: Vec<Vec<u32>> = Vec::new();
    for particle in 0..sparsity.particles() {
        let own: usize = level_of[particle];
        for slot in sparsity.row(particle).skip(1) {
            let later = &mut level_of[sparsity.columns()[slot] as usize];
            *later = (*later).max(own + 1);
        }
        if own >= levels.len() {
            levels.resize(own + 1, Vec::new());
        }
        levels[own].push(particle as u32);
    }
    levels
}
