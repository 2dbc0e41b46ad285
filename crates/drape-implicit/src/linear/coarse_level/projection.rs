//! Projection `Pᵀ A P` of a matrix on the nodes of the coarse grids.

use core::cmp::Ordering;
use core::ops::Range;

use super::interpolation::{Interpolation, Point};
use crate::error::Error;
use crate::linear::block::{self, Block};
use crate::linear::block_matrix::BlockMatrix;
use crate::linear::sparsity::Sparsity;

/// Weighted sums of blocks for each pair of corners of two cells: for each of nine entries, the
/// four corners of the second cell with the first corner of the first cell, then with the next.
type CornerSums = [[f64; 16]; 9];

/// Blocks of the matrix by the cells that their particles lie in, and their places in the coarse
/// matrix.
#[derive(Debug)]
pub(super) struct Projection {
    pairs: Vec<CellPair>,
    blocks: Vec<PointPair>,
}

/// Two cells, or twice the same, with blocks between their particles.
#[derive(Debug)]
struct CellPair {
    /// Target of each pair of corners.
    targets: [Target; 16],
    blocks: Range<usize>,
}

/// Place of a pair of nodes in the coarse matrix.
#[derive(Clone, Copy, Debug)]
struct Target {
    slot: u32,
    /// Order of the two nodes: a block of the coarse matrix is stored for the lower one's row.
    order: Ordering,
}

/// Block of the matrix with the points of its row and column.
#[derive(Clone, Copy, Debug)]
struct PointPair {
    slot: u32,
    row: u32,
    column: u32,
}

impl Projection {
    /// Projection of matrices on a sparsity, and the sparsity of the coarse matrix.
    pub(super) fn new(
        sparsity: &Sparsity,
        interpolation: &Interpolation,
    ) -> Result<(Self, Sparsity), Error> {
        let mut cell_of = vec![0; sparsity.particles()];
        let mut point_of = vec![0; sparsity.particles()];
        for (number, cell) in interpolation.cells.iter().enumerate() {
            for index in cell.points.clone() {
                let particle = interpolation.points[index].particle as usize;
                (cell_of[particle], point_of[particle]) = (number, index as u32);
            }
        }
        let mut blocks = Vec::with_capacity(sparsity.blocks());
        for particle in 0..sparsity.particles() {
            for slot in sparsity.row(particle) {
                let other = sparsity.columns()[slot] as usize;
                let (row, column) = (point_of[particle], point_of[other]);
                let pair = PointPair { slot: slot as u32, row, column };
                blocks.push(([cell_of[particle], cell_of[other]], pair));
            }
        }
        blocks.sort_by_key(|(cells, pair)| (*cells, pair.row, pair.slot));
        let corners = |[first, second]: [usize; 2]| {
            let [first, second] = [first, second].map(|cell| interpolation.cells[cell].nodes);
            core::array::from_fn::<_, 16, _>(|k| [first[k / 4] as usize, second[k % 4] as usize])
        };
        let pairs = || blocks.chunk_by(|a, b| a.0 == b.0);
        let node_pairs = pairs().flat_map(|same| corners(same[0].0));
        let coarse = Sparsity::from_pairs(interpolation.nodes, node_pairs)?;
        let mut first = 0;
        let pairs = pairs().map(|same| {
            let targets = corners(same[0].0).map(|[a, b]| Target {
                slot: coarse.slot(a, b).unwrap_or_default() as u32,
                order: a.cmp(&b),
            });
            first += same.len();
            CellPair { targets, blocks: first - same.len()..first }
        });
        let pairs = pairs.collect();
        let blocks = blocks.into_iter().map(|(_, pair)| pair).collect();
        Ok((Self { pairs, blocks }, coarse))
    }

    /// Adds the projection of a matrix to a coarse matrix.
    #[inline(always)]
    pub(super) fn project(
        &self,
        interpolation: &Interpolation,
        matrix: &BlockMatrix,
        coarse: &mut BlockMatrix,
    ) {
        for CellPair { targets, blocks } in &self.pairs {
            // A block beside the diagonal stands for its transpose too.
            let mut beside: CornerSums = [[0.0; 16]; 9];
            let mut diagonal: CornerSums = [[0.0; 16]; 9];
            for row in self.blocks[blocks.clone()].chunk_by(|a, b| a.row == b.row) {
                let own = &interpolation.points[row[0].row as usize];
                let mut partial = [[0.0; 4]; 9];
                for pair in row {
                    let block = &matrix.blocks()[pair.slot as usize];
                    if pair.row == pair.column {
                        let mut partial = [[0.0; 4]; 9];
                        add_weighted(&mut partial, block, own);
                        add_outer(&mut diagonal, &partial, own);
                    } else {
                        let other = &interpolation.points[pair.column as usize];
                        add_weighted(&mut partial, block, other);
                    }
                }
                add_outer(&mut beside, &partial, own);
            }
            for (corners, target) in targets.iter().enumerate() {
                let [beside, own] = [&beside, &diagonal]
                    .map(|sums| -> Block { core::array::from_fn(|entry| sums[entry][corners]) });
                let slot = target.slot as usize;
                if target.order != Ordering::Greater {
                    coarse.add_block(slot, &beside);
                    coarse.add_block(slot, &own);
                }
                if target.order != Ordering::Less {
                    coarse.add_block(slot, &block::transposed(&beside));
                }
            }
        }
    }
}

/// Adds a block times the weights of the point of its column.
#[inline(always)]
fn add_weighted(partial: &mut [[f64; 4]; 9], block: &Block, column: &Point) {
    for (partial, entry) in partial.iter_mut().zip(block) {
        for (partial, weight) in partial.iter_mut().zip(column.weights) {
            *partial += entry * f64::from(weight);
        }
    }
}

/// Adds weighted blocks times the weights of the point of their row.
#[inline(always)]
fn add_outer(sums: &mut CornerSums, partial: &[[f64; 4]; 9], row: &Point) {
    for (sums, partial) in sums.iter_mut().zip(partial) {
        for (corners, sum) in sums.iter_mut().enumerate() {
            *sum += f64::from(row.weights[corners / 4]) * partial[corners % 4];
        }
    }
}
