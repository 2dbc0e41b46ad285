//! Memories of the connectors on the grids of a cloth, and the normals that bending is measured
//! about.

use drape_fabric::{BatchLaw, Memories, MemoriesMut};
use serde::{Deserialize, Serialize};

use crate::layout::columns::VectorColumns;
use crate::layout::grid::GridPanel;

/// Memories of the connectors, and the normals at the last commit, in columns. The columns hold
/// panel after panel, each with its margins.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct GridMemories {
    /// Memories of the segments along warp and weft.
    pub(crate) traction: [Memories; 2],
    /// Memories of the four corners of the cells.
    pub(crate) shear: [Memories; 4],
    /// Memories of the triples along warp and weft.
    pub(crate) bending: [Memories; 2],
    /// Unit normals of the surface.
    pub(crate) normals: VectorColumns,
}

/// Mutable memories of consecutive strips.
pub(crate) struct GridMemoriesMut<'a> {
    pub(crate) traction: [MemoriesMut<'a>; 2],
    pub(crate) shear: [MemoriesMut<'a>; 4],
    pub(crate) bending: [MemoriesMut<'a>; 2],
}

/// Mutable memories from a given index to the end, and all normals.
pub(crate) struct GridTail<'a> {
    pub(crate) memories: GridMemoriesMut<'a>,
    pub(crate) normals: &'a VectorColumns,
}

impl GridMemories {
    /// Returns the memories of `panels` that have never been deformed.
    pub(crate) fn new(panels: &[GridPanel]) -> Self {
        let mut memories = Self {
            traction: Default::default(),
            shear: Default::default(),
            bending: Default::default(),
            normals: VectorColumns::new(panels.iter().map(GridPanel::length).sum()),
        };
        for panel in panels {
            let length = panel.length();
            for (direction, yarns) in panel.yarns.iter().enumerate() {
                yarns.traction.append_memories(&mut memories.traction[direction], length);
                yarns.bending.append_memories(&mut memories.bending[direction], length);
            }
            for corner in &mut memories.shear {
                panel.shear.append_memories(corner, length);
            }
        }
        memories
    }

    /// Returns whether `other` has as many connectors of each kind.
    pub(crate) fn has_lengths_of(&self, other: &Self) -> bool {
        let pairs = self.traction.iter().zip(&other.traction);
        let mut pairs = pairs
            .chain(self.shear.iter().zip(&other.shear))
            .chain(self.bending.iter().zip(&other.bending));
        self.normals.has_lengths_of(&other.normals)
            && pairs.all(|(memories, others)| memories.has_lengths_of(others))
    }

    /// Returns mutable access to all memories from index `start` on, and the normals.
    pub(crate) fn tail_mut(&mut self, start: usize) -> GridTail<'_> {
        let memories = GridMemoriesMut {
            traction: self.traction.each_mut().map(|m| m.tail_mut(start)),
            shear: self.shear.each_mut().map(|m| m.tail_mut(start)),
            bending: self.bending.each_mut().map(|m| m.tail_mut(start)),
        };
        GridTail { memories, normals: &self.normals }
    }
}

impl GridMemoriesMut<'_> {
    /// Splits off the first `count` memories of each kind. Returns them and the remaining ones.
    pub(crate) fn split(self, count: usize) -> [Self; 2] {
        let ([a, b], [c, d, e, f], [g, h]) = (self.traction, self.shear, self.bending);
        let [a, b, c, d, e, f, g, h] = [a, b, c, d, e, f, g, h].map(|m| m.split(count));
        let head = Self { traction: [a.0, b.0], shear: [c.0, d.0, e.0, f.0], bending: [g.0, h.0] };
        let tail = Self { traction: [a.1, b.1], shear: [c.1, d.1, e.1, f.1], bending: [g.1, h.1] };
        [head, tail]
    }
}
