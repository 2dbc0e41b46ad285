//! Levels of groups of particles.

use super::grouped::Grouped;
use crate::linear::sparsity::Sparsity;

/// Computation of levels: the couplings of a sparsity, and work space.
pub(super) struct Levels {
    /// Particles coupled to each particle.
    neighbours: Grouped<u32>,
    /// Level of each particle of the group in hand, none for all others.
    level_of: Vec<Option<u32>>,
}

impl Levels {
    pub(super) fn new(sparsity: &Sparsity) -> Self {
        let count = sparsity.particles();
        let pairs = (0..count).flat_map(|particle| {
            let others = sparsity.later(particle).iter();
            others.flat_map(move |&other| [(particle, other), (other as usize, particle as u32)])
        });
        Self { neighbours: Grouped::new(count, pairs), level_of: vec![None; count] }
    }

    /// Particles of each level of a group, ascending. The group is given in the order of
    /// elimination; couplings to other groups do not count.
    pub(super) fn of(&mut self, group: &[u32]) -> Vec<Vec<u32>> {
        let Self { neighbours, level_of } = self;
        let mut levels: Vec<Vec<u32>> = Vec::new();
        for &particle in group {
            let near = neighbours.of(particle as usize).iter();
            let earlier = near.filter_map(|&other| level_of[other as usize]);
            let own = earlier.max().map_or(0, |level| level + 1);
            level_of[particle as usize] = Some(own);
            if own as usize >= levels.len() {
                levels.resize(own as usize + 1, Vec::new());
            }
            levels[own as usize].push(particle);
        }
        for &particle in group {
            level_of[particle as usize] = None;
        }
        // Else no diagonal would lead from a part that is eliminated backwards to a separator.
        levels.iter_mut().for_each(|level| level.sort_unstable());
        levels
    }
}
