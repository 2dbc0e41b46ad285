//! Projection `Pᵀ A P` of a matrix `A` on the nodes of the coarse grids.

use core::cmp::Ordering;
use core::ops::Range;

use super::interpolation::{Interpolation, Point};
use crate::error::Error;
use crate::linear::block::{self, Block};
use crate::linear::block_matrix::BlockMatrix;
use crate::linear::sparsity::Sparsity;

/// Weighted sums of blocks for each pair of corners of two cells. The outer index is the entry of
/// the block. The inner index is four times the corner of the first cell plus the corner of the
/// second.
type CornerSums = [[f64; 16]; 9];

/// Blocks of the matrix by the cells of their particles, and the slots of these cells' nodes in the
/// coarse matrix.
#[derive(Debug)]
pub(super) struct Projection {
    pairs: Vec<CellPair>,
    blocks: Vec<PointPair>,
}

/// Two cells with the blocks between their particles. Both cells may be one and the same.
#[derive(Debug)]
struct CellPair {
    /// Slot of each pair of corners in the coarse matrix.
    targets: [NodePair; 16],
    blocks: Range<usize>,
}

/// Pair of nodes with a block in the coarse matrix.
#[derive(Clone, Copy, Debug)]
struct NodePair {
    slot: u32,
    /// Order of the two nodes. A block of the coarse matrix is stored in the row of the lower node.
    order: Ordering,
}

/// Block of the matrix, with the points of its row and column.
#[derive(Clone, Copy, Debug)]
struct PointPair {
    slot: u32,
    row: u32,
    column: u32,
}

impl Projection {
    /// Returns the projection of matrices with `sparsity` by `interpolation`, and the sparsity of
    /// the coarse matrix.
    ///
    /// # Errors
    /// [`Error::Sparsity`] with too many blocks.
    pub(super) fn new(
        sparsity: &Sparsity,
        interpolation: &Interpolation,
    ) -> Result<(Self, Sparsity), Error> {
        let mut cell_of = vec![0; sparsity.particle_count()];
        let mut point_of = vec![0; sparsity.particle_count()];
        for (number, cell) in interpolation.cells.iter().enumerate() {
            for index in cell.points.clone() {
                let particle = interpolation.points[index].particle as usize;
                (cell_of[particle], point_of[particle]) = (number, index as u32);
            }
        }

        let mut blocks = Vec::with_capacity(sparsity.block_count());
        for particle in 0..sparsity.particle_count() {
            for slot in sparsity.row(particle) {
                let other = sparsity.columns()[slot] as usize;
                let (row, column) = (point_of[particle], point_of[other]);
                let pair = PointPair { slot: slot as u32, row, column };
                blocks.push(([cell_of[particle], cell_of[other]], pair));
            }
        }

        // Blocks between one pair of cells are consecutive, ordered by row.
        blocks.sort_by_key(|(cells, pair)| (*cells, pair.row, pair.slot));
        let mut cell_pairs = Vec::new();
        let mut first = 0;
        for group in blocks.chunk_by(|a, b| a.0 == b.0) {
            cell_pairs.push((interpolation.corner_pairs(group[0].0), first..first + group.len()));
            first += group.len();
        }

        let node_pairs = cell_pairs.iter().flat_map(|(corners, _)| *corners);
        let coarse = Sparsity::from_pairs(interpolation.nodes, node_pairs)?;
        let pairs = cell_pairs.into_iter().map(|(corners, blocks)| {
            let targets = corners.map(|[a, b]| NodePair {
                slot: coarse.slot(a, b).unwrap_or_default() as u32,
                order: a.cmp(&b),
            });
            CellPair { targets, blocks }
        });
        let pairs = pairs.collect();
        let blocks = blocks.into_iter().map(|(_, pair)| pair).collect();
        Ok((Self { pairs, blocks }, coarse))
    }

    /// Adds the projection of `matrix` to the matrix `coarse`.
    #[inline(always)]
    pub(super) fn project(
        &self,
        interpolation: &Interpolation,
        matrix: &BlockMatrix,
        coarse: &mut BlockMatrix,
    ) {
        for CellPair { targets, blocks } in &self.pairs {
            // An off-diagonal block also represents its transpose.
            let mut beside: CornerSums = [[0.0; 16]; 9];
            let mut diagonal: CornerSums = [[0.0; 16]; 9];
            for row in self.blocks[blocks.clone()].chunk_by(|a, b| a.row == b.row) {
                let row_point = &interpolation.points[row[0].row as usize];
                let mut partial = [[0.0; 4]; 9];
                for pair in row {
                    let block = &matrix.blocks()[pair.slot as usize];
                    if pair.row == pair.column {
                        let mut partial = [[0.0; 4]; 9];
                        add_weighted(&mut partial, block, row_point);
                        add_outer(&mut diagonal, &partial, row_point);
                    } else {
                        let column_point = &interpolation.points[pair.column as usize];
                        add_weighted(&mut partial, block, column_point);
                    }
                }
                add_outer(&mut beside, &partial, row_point);
            }

            for (corners, target) in targets.iter().enumerate() {
                let [beside, diagonal] = [&beside, &diagonal]
                    .map(|sums| -> Block { core::array::from_fn(|entry| sums[entry][corners]) });
                let slot = target.slot as usize;
                if target.order != Ordering::Greater {
                    coarse.add_block(slot, &beside);
                    coarse.add_block(slot, &diagonal);
                }
                if target.order != Ordering::Less {
                    coarse.add_block(slot, &block::transposed(&beside));
                }
            }
        }
    }
}

/// Adds `block` times the weights of the point `column` to `partial`.
#[inline(always)]
fn add_weighted(partial: &mut [[f64; 4]; 9], block: &Block, column: &Point) {
    for (partial, entry) in partial.iter_mut().zip(block) {
        for (partial, weight) in partial.iter_mut().zip(column.weights) {
            *partial += entry * f64::from(weight);
        }
    }
}

/// Adds the weighted blocks `partial` times the weights of the point `row` to `sums`.
#[inline(always)]
fn add_outer(sums: &mut CornerSums, partial: &[[f64; 4]; 9], row: &Point) {
    for (sums, partial) in sums.iter_mut().zip(partial) {
        for (corners, sum) in sums.iter_mut().enumerate() {
            *sum += f64::from(row.weights[corners / 4]) * partial[corners % 4];
        }
    }
}
