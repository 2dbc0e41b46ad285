//! Memories of many connectors in columns of numbers, and views of a batch of memories.

use serde::{Deserialize, Serialize};

use crate::batch::lanes::{LANES, Lanes};
use crate::laws::law::Memory;

/// Number of columns of [`Memories`]: the deformation, the loads of the two friction elements, the
/// largest deformation, and the two numbers of [`Toe`].
const COLUMNS: usize = 6;
const POSITION: usize = 0;
const FRICTION: [usize; 2] = [1, 2];
const PEAK: usize = 3;
const TOE: [usize; 2] = [4, 5];

/// Memories of many connectors, in columns. [`Memory`] is the memory of one connector.
///
/// [`BatchLaw::memories`](crate::BatchLaw::memories) returns new memories, and
/// [`BatchLaw::commit`](crate::BatchLaw::commit) advances them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Memories([Vec<f64>; COLUMNS]);

/// Read-only view of the memories of [`LANES`] neighbouring connectors.
#[derive(Debug, Clone, Copy)]
pub struct MemoryBatch<'a>([&'a Lanes; COLUMNS]);

/// Mutable view of the memories of consecutive connectors.
#[derive(Debug)]
pub struct MemoriesMut<'a>([&'a mut [f64]; COLUMNS]);

/// Memory of one lane, without the friction.
#[derive(Debug, Clone, Copy)]
pub struct LaneMemory {
    /// Deformation at the last commit, in the unit of the deformation.
    pub position: f64,
    /// Largest deformation so far, in the unit of the deformation.
    pub peak: f64,
    /// Priming zone after the largest deformation.
    pub toe: Toe,
}

/// Priming zone of a yarn after its largest elongation. Stored with the memory, because its
/// computation needs an exponential. Constant for laws without a priming zone.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Toe {
    /// Deformation at which the priming zone ends, in the unit of the deformation.
    pub end: f64,
    /// Derivative of the friction's weight in the priming zone, per deformation.
    pub weight_slope: f64,
}

/// Deformations and peaks of a batch at a commit, and the loads of its friction elements. An absent
/// element has no loads.
pub(crate) struct CommittedBatch<'a> {
    pub(crate) positions: &'a Lanes,
    pub(crate) peaks: &'a Lanes,
    pub(crate) friction: [Option<&'a Lanes>; 2],
}

/// Returns the numbers of the batch that begins at the index `start` of `column`.
fn lanes(column: &[f64], start: usize) -> &Lanes {
    column[start..].first_chunk().expect("columns are padded by a batch beyond the last connector")
}

impl Memories {
    /// Appends the memories of `count` connectors that were never deformed, with the given `toe`.
    pub(crate) fn append(&mut self, count: usize, toe: Toe) {
        let length = self.0[POSITION].len() + count;
        let virgin = [0.0, 0.0, 0.0, 0.0, toe.end, toe.weight_slope];
        for (column, value) in self.0.iter_mut().zip(virgin) {
            column.resize(length, value);
        }
    }

    /// Writes the memory of the connector `index`, without friction loads.
    pub(crate) fn set_frictionless(&mut self, index: usize, lane: LaneMemory) {
        let LaneMemory { position, peak, toe } = lane;
        let memory = [position, 0.0, 0.0, peak, toe.end, toe.weight_slope];
        for (column, value) in self.0.iter_mut().zip(memory) {
            column[index] = value;
        }
    }

    /// Returns whether the columns of `other` have the lengths of these columns.
    #[must_use]
    pub fn has_lengths_of(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).all(|(column, other)| column.len() == other.len())
    }

    /// Returns the memory of the connector `index`.
    #[must_use]
    pub fn get(&self, index: usize) -> Memory {
        Memory {
            position: self.0[POSITION][index],
            friction: FRICTION.map(|column| self.0[column][index]),
            peak: self.0[PEAK][index],
        }
    }

    /// Returns all memories in order.
    pub fn iter(&self) -> impl Iterator<Item = Memory> {
        (0..self.0[POSITION].len()).map(|index| self.get(index))
    }

    /// Returns the deformations at the last commit, in the unit of the deformation.
    #[must_use]
    pub fn positions(&self) -> &[f64] {
        &self.0[POSITION]
    }

    /// Returns the [`LANES`] memories from the index `start` on, which must exist.
    #[inline(always)]
    #[must_use]
    pub fn batch(&self, start: usize) -> MemoryBatch<'_> {
        MemoryBatch(self.0.each_ref().map(|column| lanes(column, start)))
    }

    /// Returns all memories from the index `start` on, mutably.
    #[must_use]
    pub fn tail_mut(&mut self, start: usize) -> MemoriesMut<'_> {
        MemoriesMut(self.0.each_mut().map(|column| &mut column[start..]))
    }
}

impl MemoriesMut<'_> {
    /// Splits the view into the first `count` memories and the remaining memories.
    #[must_use]
    pub fn split(self, count: usize) -> (Self, Self) {
        let [a, b, c, d, e, f] = self.0.map(|column| column.split_at_mut(count));
        (Self([a.0, b.0, c.0, d.0, e.0, f.0]), Self([a.1, b.1, c.1, d.1, e.1, f.1]))
    }

    /// Returns the [`LANES`] memories from the index `start` on.
    #[inline(always)]
    pub(crate) fn batch(&self, start: usize) -> MemoryBatch<'_> {
        MemoryBatch(self.0.each_ref().map(|column| lanes(column, start)))
    }

    /// Writes the deformations, peaks and friction loads of the batch that begins at `start`.
    #[inline(always)]
    pub(crate) fn write(&mut self, start: usize, committed: CommittedBatch<'_>) {
        self.write_column(POSITION, start, committed.positions);
        self.write_column(PEAK, start, committed.peaks);
        for (column, loads) in FRICTION.into_iter().zip(committed.friction) {
            if let Some(loads) = loads {
                self.write_column(column, start, loads);
            }
        }
    }

    /// Writes the numbers of one column of the batch that begins at `start`.
    #[inline(always)]
    fn write_column(&mut self, column: usize, start: usize, values: &Lanes) {
        self.0[column][start..start + LANES].copy_from_slice(values);
    }

    /// Recomputes the toes of the batch that begins at `start` from its peaks. `toe` returns the
    /// priming zone after a largest deformation.
    #[inline(always)]
    pub(crate) fn update_toes(&mut self, start: usize, toe: impl Fn(f64) -> Toe) {
        for index in start..start + LANES {
            let toe = toe(self.0[PEAK][index]);
            for (column, value) in TOE.into_iter().zip([toe.end, toe.weight_slope]) {
                self.0[column][index] = value;
            }
        }
    }
}

impl<'a> MemoryBatch<'a> {
    /// Returns the deformations at the last commit.
    #[inline(always)]
    pub(crate) fn position(&self) -> &'a Lanes {
        self.0[POSITION]
    }

    /// Returns the loads of the friction `element`, 0 or 1.
    #[inline(always)]
    pub(crate) fn friction(&self, element: usize) -> &'a Lanes {
        self.0[FRICTION[element]]
    }

    /// Returns the memory of `lane`.
    #[inline(always)]
    pub(crate) fn lane(&self, lane: usize) -> LaneMemory {
        let [end, weight_slope] = TOE.map(|column| self.0[column][lane]);
        LaneMemory {
            position: self.0[POSITION][lane],
            peak: self.0[PEAK][lane],
            toe: Toe { end, weight_slope },
        }
    }
}
