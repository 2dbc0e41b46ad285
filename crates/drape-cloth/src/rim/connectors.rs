//! The rim of one panel: its triangles, its stencils, and the blocks that they write.

use std::ops::Range;

use crate::layout::connectors::BendingConnectors;
use crate::layout::grid::{GridPanel, NO_BLOCK};
use crate::layout::sparsity::Sparsity;
use crate::panel::lattice::Lattice;
use crate::rim::fits::{PanelFits, SurfaceTangents};
use crate::rim::neighbourhood::Neighbourhoods;
use crate::rim::stencils::{Stencils, pairs};
use crate::rim::triangles::Triangles;

/// Rim of a panel: traction and shear of its triangles, and bending where no triple of the grid has
/// its middle.
///
/// Indices count over the rims of the cloth. Each rim is padded to a whole number of batches with
/// connectors of no area.
#[derive(Debug, Clone)]
pub(crate) struct Rim {
    /// Index among the rims of the cloth.
    pub(crate) index: usize,
    /// Index of the rim's panel.
    pub(crate) panel: usize,
    /// Particles of the panel, counted over the cloth.
    pub(crate) particles: Range<usize>,
    /// Blocks in the rows of the particles.
    pub(crate) blocks: Range<usize>,
    pub(crate) triangles: Triangles,
    pub(crate) stencils: Stencils,
    /// Tangents of the surface at the nodes that are not the middle of a triple along both yarns.
    pub(crate) tangents: Vec<SurfaceTangents>,
}

/// First numbers of a rim.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct RimStart {
    /// Index of the rim.
    pub(crate) index: usize,
    /// Index of its panel.
    pub(crate) panel: usize,
    /// First particle of its panel.
    pub(crate) particle: u32,
    /// Index of its first triangle.
    pub(crate) triangles: usize,
    /// Index of its first stencil.
    pub(crate) stencils: usize,
}

impl Rim {
    /// Lays out the rim of `lattice` from the numbers in `start` on.
    pub(crate) fn new(
        lattice: &Lattice,
        start: RimStart,
        bending: &[BendingConnectors; 2],
        neighbourhoods: &Neighbourhoods<'_>,
    ) -> Self {
        let first = start.particle;
        let PanelFits { stencils, mut tangents } = PanelFits::new(lattice, neighbourhoods, bending);
        tangents.iter_mut().for_each(|tangents| tangents.shift(first));
        Self {
            index: start.index,
            panel: start.panel,
            particles: first as usize..first as usize + lattice.coordinates.len(),
            blocks: 0..0,
            triangles: Triangles::new(lattice, first, start.triangles),
            stencils: Stencils::new(&stencils, first, start.stencils),
            tangents,
        }
    }

    /// Returns the index after the last triangle, including the padding of `triangles`.
    pub(crate) fn triangles_end(&self) -> usize {
        self.triangles.base + self.triangles.areas.len()
    }

    /// Returns the index after the last stencil, including the padding of `stencils`.
    pub(crate) fn stencils_end(&self) -> usize {
        self.stencils.base + self.stencils.middles.len()
    }

    /// Looks up the slots of the rim's blocks in `sparsity`.
    pub(crate) fn find_slots(&mut self, sparsity: &Sparsity) {
        self.blocks = sparsity.offsets[self.particles.start]..sparsity.offsets[self.particles.end];
        self.triangles.slots = self
            .triangles
            .corners
            .iter()
            .map(|&[a, b, c]| {
                [[a, a], [a, b], [a, c], [b, b], [b, c], [c, c]].map(|pair| slot(sparsity, pair))
            })
            .collect();
        let mut slots = Vec::new();
        self.stencils.slot_offsets = vec![0];
        for index in 0..self.stencils.count {
            slots.extend(pairs(self.stencils.nodes(index)).map(|pair| slot(sparsity, pair)));
            self.stencils.slot_offsets.push(slots.len());
        }
        self.stencils.slots = slots;
    }

    /// Returns the pairs of particles that a connector joins, the lower number first.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = [u32; 2]> {
        let corners = self.triangles.corners.iter();
        let triangles = corners.flat_map(|&[a, b, c]| [[a, b], [a, c], [b, c]]);
        let stencils = (0..self.stencils.count).map(|index| self.stencils.nodes(index));
        triangles.chain(stencils.flat_map(pairs)).filter(|[row, column]| row < column)
    }
}

/// Returns the slot of the block of `row` and `column` in `sparsity`, or [`NO_BLOCK`].
fn slot(sparsity: &Sparsity, [row, column]: [u32; 2]) -> u32 {
    sparsity.block(row, column).map_or(NO_BLOCK, |block| block as u32)
}

/// A rim at given positions.
#[derive(Clone, Copy)]
pub(crate) struct RimShape<'a> {
    pub(crate) rim: &'a Rim,
    pub(crate) panel: &'a GridPanel,
    /// Unit normals, three numbers for each particle. A trial takes them at the start of the step,
    /// a commit at the accepted positions.
    pub(crate) normals: &'a [f64],
    pub(crate) positions: &'a [f64],
}
