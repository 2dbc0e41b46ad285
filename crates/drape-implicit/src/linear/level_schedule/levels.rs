//! Levels of groups of particles.

use super::grouped::Grouped;
use crate::linear::sparsity::Sparsity;

/// Computation of levels: the couplings of a sparsity, and work space.
pub(super) struct Levels {
    /// Particles coupled to each particle.
    neighbours: Grouped<u32>,
    /// Level of each particle of the current group, `None` for all other particles.
    level_of: Vec<Option<u32>>,
}

impl Levels {
    /// Collects the neighbours of each particle of `sparsity`.
    pub(super) fn new(sparsity: &Sparsity) -> Self {
        let count = sparsity.particle_count();
        let pairs = (0..count).flat_map(|particle| {
            let others = sparsity.later(particle).iter();
            others.flat_map(move |&other| [(particle, other), (other as usize, particle as u32)])
        });
        Self { neighbours: Grouped::new(count, pairs), level_of: vec![None; count] }
    }

    /// Returns the particles of each level of `group`, ascending within each level. `group` lists
    /// its particles in the order of elimination. Couplings to other groups do not count.
    pub(super) fn levels_of(&mut self, group: &[u32]) -> Vec<Vec<u32>> {
        let Self { neighbours, level_of } = self;
        let mut levels: Vec<Vec<u32>> = Vec::new();
        for &particle in group {
            let neighbours = neighbours.group(particle as usize).iter();
            let earlier = neighbours.filter_map(|&neighbour| level_of[neighbour as usize]);
            let level = earlier.max().map_or(0, |last| last + 1);
            level_of[particle as usize] = Some(level);
            if level as usize >= levels.len() {
                levels.resize(level as usize + 1, Vec::new());
            }
            levels[level as usize].push(particle);
        }

        for &particle in group {
            level_of[particle as usize] = None;
        }
        // Without ascending order no diagonal would lead from a part that is eliminated backwards
        // to a separator.
        levels.iter_mut().for_each(|level| level.sort_unstable());
        levels
    }
}
