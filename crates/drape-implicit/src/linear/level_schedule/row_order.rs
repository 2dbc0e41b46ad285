//! Rows of the elimination: the particles by level, each level padded to whole batches.

use super::grouped::Grouped;
use super::partition::Partition;
use crate::linear::lanes::LANES;
use crate::linear::sparsity::Sparsity;

/// Marker of a row without a particle, a lane without a block, or a block outside the sparsity.
pub(crate) const ABSENT: u32 = u32::MAX;

/// Rows of the particles: parts and separators one after the other, each by levels.
#[derive(Debug)]
pub(crate) struct RowOrder {
    /// Row of each particle.
    pub row_of: Vec<u32>,
    /// Particle of each row, or [`ABSENT`] in margins and padding.
    pub particles: Vec<u32>,
    /// First row of each level of each group, and the end of its last level.
    pub levels: Vec<Vec<usize>>,
    /// Whether each row belongs to a separator.
    pub is_separator: Vec<bool>,
}

impl RowOrder {
    pub(crate) fn new(sparsity: &Sparsity, partition: &Partition) -> Self {
        let neighbours = neighbours(sparsity);
        let mut level_of = vec![ABSENT; sparsity.particles()];
        let groups: Vec<Vec<Vec<u32>>> = partition
            .groups
            .iter()
            .map(|group| sorted(group, &neighbours, &mut level_of))
            .collect();
        // The blocks of zeros of a batch may lead as far beyond its target as its run is long. Beside
        // other groups they must not meet these.
        let longest = groups.iter().flatten().map(Vec::len).max().unwrap_or(0);
        let margin = if groups.len() == 1 { 0 } else { longest.next_multiple_of(LANES) };
        let mut order = Self {
            row_of: vec![0; sparsity.particles()],
            particles: vec![ABSENT; LANES.max(margin)],
            levels: Vec::new(),
            is_separator: Vec::new(),
        };
        for (index, group) in groups.into_iter().enumerate() {
            order.add_group(group);
            order.particles.resize(order.particles.len() + margin, ABSENT);
            order.is_separator.resize(order.particles.len(), index % 2 == 1);
        }
        order.particles.resize(order.particles.len() + LANES, ABSENT);
        order.is_separator.resize(order.particles.len(), false);
        order
    }

    fn add_group(&mut self, levels: Vec<Vec<u32>>) {
        let mut starts = Vec::with_capacity(levels.len() + 1);
        for level in levels {
            starts.push(self.particles.len());
            for particle in level {
                self.row_of[particle as usize] = self.particles.len() as u32;
                self.particles.push(particle);
            }
            self.particles.resize(self.particles.len().next_multiple_of(LANES), ABSENT);
        }
        starts.push(self.particles.len());
        self.levels.push(starts);
    }

    /// Key that ascends in the order of elimination.
    #[inline]
    pub(crate) fn rank(&self, row: usize) -> (bool, usize) {
        (self.is_separator[row], row)
    }
}

/// Particles coupled to each particle.
fn neighbours(sparsity: &Sparsity) -> Grouped<u32> {
    let count = sparsity.particles();
    let pairs = (0..count).flat_map(|particle| {
        let others = sparsity.columns()[sparsity.row(particle)][1..].iter();
        others.flat_map(move |&other| [(particle, other), (other as usize, particle as u32)])
    });
    Grouped::new(count, pairs)
}

/// Particles of each level of a group, ascending. `level_of` is all absent on entry and on return.
fn sorted(group: &[u32], neighbours: &Grouped<u32>, level_of: &mut [u32]) -> Vec<Vec<u32>> {
    let mut levels: Vec<Vec<u32>> = Vec::new();
    for &particle in group {
        let earlier =
            neighbours.of(particle as usize).iter().map(|&other| level_of[other as usize]);
        let own = earlier.filter(|&level| level != ABSENT).max().map_or(0, |level| level + 1);
        level_of[particle as usize] = own;
        if own as usize >= levels.len() {
            levels.resize(own as usize + 1, Vec::new());
        }
        levels[own as usize].push(particle);
    }
    // Groups do not wait for each other.
    for &particle in group {
        level_of[particle as usize] = ABSENT;
    }
    // Else no diagonal would lead from a part that is eliminated backwards to a separator.
    levels.iter_mut().for_each(|level| level.sort_unstable());
    levels
}
