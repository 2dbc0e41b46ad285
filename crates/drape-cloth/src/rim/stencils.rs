//! Stencils of a rim in batches, and their second differences along both yarns.

use drape_fabric::LANES;

use crate::kernel::bending::BendingLanes;
use crate::layout::columns::{ColumnBatch, VectorLanes, lanes, lanes_if_any};
use crate::layout::grid::Yarns;
use crate::rim::fits::{FittedStencil, StencilNode};

/// Stencils about the nodes of a rim, in columns: curvatures along both yarns.
#[derive(Debug, Clone)]
pub(crate) struct Stencils {
    /// Particle at the middle of each stencil.
    pub(crate) middles: Vec<u32>,
    /// Nodes, one stencil after the other.
    nodes: Vec<StencilNode>,
    /// Index of the first node of each stencil.
    offsets: Vec<usize>,
    /// Areas along warp and weft, in m²; zero in the padding.
    pub(crate) areas: [Vec<f64>; 2],
    /// Rest curvatures that folds add along warp and weft, in 1/m, empty without folds.
    pub(crate) folds: [Vec<f64>; 2],
    /// Slots of the blocks of the nodes 00, 01, …, 11, 12, …, one stencil after the other.
    pub(crate) slots: Vec<u32>,
    /// Index of the first slot of each stencil.
    pub(crate) slot_offsets: Vec<usize>,
    /// Number of stencils.
    pub(crate) count: usize,
    /// Index of the first stencil among the stencils of the cloth.
    pub(crate) base: usize,
}

impl Stencils {
    /// Lays out the stencils `fits` of a panel whose first particle is `first`. Their index in the
    /// cloth begins at `base`.
    pub(crate) fn new(fits: &[FittedStencil], first: u32, base: usize) -> Self {
        let count = fits.len();
        let length = count.next_multiple_of(LANES);
        let mut middles: Vec<u32> = fits.iter().map(|fit| first + fit.middle).collect();
        middles.resize(length, first);
        // Padding stencils have no nodes and no area.
        let (mut nodes, mut offsets) = (Vec::new(), vec![0]);
        for fit in fits {
            nodes.extend(
                fit.nodes.iter().map(|node| StencilNode { node: first + node.node, ..*node }),
            );
            offsets.push(nodes.len());
        }
        offsets.resize(length + 1, nodes.len());
        let areas = [0, 1].map(|direction| {
            let mut areas: Vec<f64> = fits.iter().map(|fit| fit.areas[direction]).collect();
            areas.resize(length, 0.0);
            areas
        });
        let is_folded = fits.iter().any(|fit| fit.folds != [0.0; 2]);
        let folds = [0, 1].map(|direction| {
            let folds = fits.iter().map(|fit| fit.folds[direction]);
            let mut folds: Vec<f64> = folds.filter(|_| is_folded).collect();
            folds.resize(if is_folded { length } else { 0 }, 0.0);
            folds
        });
        let (slots, slot_offsets) = (Vec::new(), Vec::new());
        Self { middles, nodes, offsets, areas, folds, slots, slot_offsets, count, base }
    }

    /// Returns the nodes of the stencil number `index`.
    #[inline(always)]
    pub(crate) fn nodes(&self, index: usize) -> &[StencilNode] {
        &self.nodes[self.offsets[index]..self.offsets[index + 1]]
    }

    /// Returns the first indices of the batches, multiples of [`LANES`].
    pub(crate) fn batches(&self) -> impl Iterator<Item = usize> + use<> {
        (0..self.middles.len()).step_by(LANES)
    }
}

/// Returns the pairs of the `nodes` of a stencil, each with itself and with later ones.
pub(crate) fn pairs(nodes: &[StencilNode]) -> impl Iterator<Item = [u32; 2]> {
    nodes.iter().enumerate().flat_map(|(k, node)| {
        let row = node.node;
        nodes[k..].iter().map(move |column| [row, column.node])
    })
}

/// Second differences of a batch of stencils along both yarns, and the normals at their middles.
pub(crate) struct StencilMeasures<'a> {
    stencils: &'a Stencils,
    start: usize,
    second_differences: [VectorLanes; 2],
    normals: VectorLanes,
}

impl<'a> StencilMeasures<'a> {
    /// Measures the batch of stencils that begins at `start`: `$b = \sum b_i x_i$` along both
    /// yarns, at `positions`.
    #[inline(always)]
    pub(crate) fn new(
        stencils: &'a Stencils,
        start: usize,
        positions: &[f64],
        normals: &[f64],
    ) -> Self {
        let mut measures = Self {
            stencils,
            start,
            second_differences: [VectorLanes::zero(); 2],
            normals: VectorLanes::zero(),
        };

        for lane in 0..LANES {
            let index = start + lane;
            let mut sums = [[0.0; 3]; 2];
            for node in stencils.nodes(index) {
                let position = &positions[3 * node.node as usize..][..3];
                for (sum, weight) in sums.iter_mut().zip(node.weights) {
                    sum.iter_mut().zip(position).for_each(|(sum, x)| *sum += weight * x);
                }
            }
            for (differences, sum) in measures.second_differences.iter_mut().zip(sums) {
                differences.set(lane, sum);
            }
            let normal = &normals[3 * stencils.middles[index] as usize..][..3];
            measures.normals.set(lane, [normal[0], normal[1], normal[2]]);
        }
        measures
    }

    /// Returns the batch as bending connectors along `direction`, with the laws of `yarns`.
    #[inline(always)]
    pub(crate) fn bending<'b>(&'b self, yarns: &'b Yarns, direction: usize) -> BendingLanes<'b> {
        BendingLanes {
            yarns,
            second_differences: self.second_differences[direction],
            normals: ColumnBatch(self.normals.0.each_ref()),
            areas: lanes(&self.stencils.areas[direction], self.start),
            folds: lanes_if_any(&self.stencils.folds[direction], self.start),
        }
    }
}
