//! Memories of the connectors of the rims.

use drape_fabric::{BatchLaw, Memories, MemoriesMut};
use serde::{Deserialize, Serialize};

use crate::layout::grid::GridPanel;
use crate::rim::connectors::Rim;

/// Memories of the connectors of the rims, rim after rim. Each rim is padded to a whole number of
/// batches.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct RimMemories {
    /// Memories of the triangles along warp and weft.
    pub(crate) traction: [Memories; 2],
    /// Memories of the shear of the triangles.
    pub(crate) shear: Memories,
    /// Memories of the stencils along warp and weft.
    pub(crate) bending: [Memories; 2],
}

/// Mutable memories of consecutive rims.
pub(crate) struct RimMemoriesMut<'a> {
    pub(crate) traction: [MemoriesMut<'a>; 2],
    pub(crate) shear: MemoriesMut<'a>,
    pub(crate) bending: [MemoriesMut<'a>; 2],
}

impl RimMemories {
    /// Returns the memories of `rims` that have never been deformed.
    pub(crate) fn new(rims: &[Rim], panels: &[GridPanel]) -> Self {
        let mut memories = Self::default();
        for rim in rims {
            let panel = &panels[rim.panel];
            let (triangles, stencils) = (rim.triangles.areas.len(), rim.stencils.middles.len());
            for (direction, yarns) in panel.yarns.iter().enumerate() {
                yarns.traction.append_memories(&mut memories.traction[direction], triangles);
                yarns.bending.append_memories(&mut memories.bending[direction], stencils);
            }
            panel.shear.append_memories(&mut memories.shear, triangles);
        }
        memories
    }

    /// Returns whether `other` has as many connectors of each kind.
    pub(crate) fn has_lengths_of(&self, other: &Self) -> bool {
        let pairs = self.traction.iter().zip(&other.traction);
        let pairs = pairs.chain([(&self.shear, &other.shear)]);
        pairs
            .chain(self.bending.iter().zip(&other.bending))
            .all(|(memories, others)| memories.has_lengths_of(others))
    }

    /// Returns mutable access to all memories, as [`RimMemoriesMut`].
    pub(crate) fn all_mut(&mut self) -> RimMemoriesMut<'_> {
        RimMemoriesMut {
            traction: self.traction.each_mut().map(|m| m.tail_mut(0)),
            shear: self.shear.tail_mut(0),
            bending: self.bending.each_mut().map(|m| m.tail_mut(0)),
        }
    }
}

impl RimMemoriesMut<'_> {
    /// Splits off the memories of the rims from `from` up to `to`, exclusive. Returns them and the
    /// remaining ones.
    pub(crate) fn split(self, from: &Rim, to: &Rim) -> [Self; 2] {
        let triangles = to.triangles.base - from.triangles.base;
        let stencils = to.stencils.base - from.stencils.base;
        let ([a, b], c, [d, e]) = (self.traction, self.shear, self.bending);
        let [a, b, c] = [a, b, c].map(|memories| memories.split(triangles));
        let [d, e] = [d, e].map(|memories| memories.split(stencils));
        let head = Self { traction: [a.0, b.0], shear: c.0, bending: [d.0, e.0] };
        [head, Self { traction: [a.1, b.1], shear: c.1, bending: [d.1, e.1] }]
    }
}
