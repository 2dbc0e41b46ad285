//! Rows of the elimination: the particles ordered by level, each level padded to whole batches.

use super::levels::Levels;
use super::partition::Partition;
use crate::linear::lanes::LANES;
use crate::linear::sparsity::Sparsity;

/// Marker of a row without a particle, a lane without a block, or a block outside the sparsity.
pub(crate) const ABSENT: u32 = u32::MAX;

/// Rows of the particles: parts and separators one after another, each ordered by level.
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
    /// Returns the rows of the particles of `sparsity`, divided by `partition`.
    pub(crate) fn new(sparsity: &Sparsity, partition: &Partition) -> Self {
        let mut levels = Levels::new(sparsity);
        let groups = partition.groups.iter().map(|group| levels.levels_of(group));
        let groups: Vec<Vec<Vec<u32>>> = groups.collect();

        // The blocks of zeros of a batch may extend beyond the target by the length of the run. The
        // margin keeps these blocks out of neighbouring groups.
        let longest = groups.iter().flatten().map(Vec::len).max().unwrap_or(0);
        let margin = if groups.len() == 1 { 0 } else { longest.next_multiple_of(LANES) };
        let mut order = Self {
            row_of: vec![0; sparsity.particle_count()],
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

    /// Adds the rows of a group with the given `levels`.
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

    /// Returns a key of `row` that ascends in the order of elimination.
    #[inline]
    pub(crate) fn rank(&self, row: usize) -> (bool, usize) {
        (self.is_separator[row], row)
    }
}
