//! A panel on the points of its grid: columns of areas, and the steps from a point to its
//! neighbours.

use drape_fabric::{BendingBatch, Fabric, LANES, ShearBatch, TractionBatch};

use crate::layout::connectors::{BendingConnectors, Segment, Triple, segments};
use crate::layout::sparsity::Sparsity;
use crate::measure::turning_angle::second_difference_of;
use crate::panel::grid::Grid;
use crate::panel::lattice::Lattice;

/// Largest number of blocks in a row of the upper half of the matrix.
pub(crate) const BLOCKS: usize = 7;

/// Slot of a block that does not exist.
pub(crate) const NO_BLOCK: u32 = u32::MAX;

/// Panel on the points of its grid, row by row, so that neighbours along a yarn are a fixed step
/// apart and connectors need no lists.
///
/// A column has one number per point, with a margin of two rows and one point before the first, and
/// the same margin and a batch after the last:
///
/// ```text
///  index  0        margin              margin + points            length
///         │ margin │ row 0 │ row 1 │ … │ last row │ margin │ LANES │
///         2·stride + 1                             2·stride + 1
///
///  point p = row · stride + column;  next along the weft: p + 1,  along the warp: p + stride
/// ```
///
/// The margin lets a kernel read the neighbours of every point, two rows up and down, without a
/// branch. A point without a particle has the position of the panel's first particle, and a
/// connector that does not exist, such as a segment from the end of a row to the start of the next,
/// has an area of zero.
#[derive(Debug, Clone)]
pub(crate) struct GridPanel {
    /// Number of points of the grid.
    pub(crate) points: usize,
    /// Step to the next point along the warp; along the weft it is 1.
    pub(crate) stride: usize,
    /// Index of the first point in a column.
    pub(crate) margin: usize,
    /// Number of its first particle.
    pub(crate) first: usize,
    /// Column of the particles.
    pub(crate) particles: Vec<u32>,
    /// Whether a particle is at each point, without margins.
    pub(crate) occupied: Vec<bool>,
    /// Connectors along the warp and along the weft.
    pub(crate) yarns: [Yarns; 2],
    pub(crate) shear: ShearBatch,
    /// Columns of the areas of each cell's corners (0, 0), (1, 0), (1, 1), (0, 1), at the index of
    /// the first corner, in m².
    pub(crate) corner_areas: [Vec<f64>; 4],
    /// Indices of the cells in a column.
    pub(crate) cells: Vec<usize>,
    /// Index of the panel's columns in those of the cloth.
    pub(crate) base: usize,
    /// Blocks of each point with those at [`GridPanel::block_steps`], or [`NO_BLOCK`].
    pub(crate) slots: Vec<[u32; BLOCKS]>,
}

/// Segments and triples along one direction.
#[derive(Debug, Clone)]
pub(crate) struct Yarns {
    /// Step to the next point.
    pub(crate) step: usize,
    /// Rest length of a segment, in m.
    pub(crate) length: f64,
    pub(crate) traction: TractionBatch,
    pub(crate) bending: BendingBatch,
    /// Second difference at the rest curvature of the bending law, in 1/m.
    pub(crate) rest_second_difference: f64,
    /// Column of the areas of the segments, at their first point, in m².
    pub(crate) segment_areas: Vec<f64>,
    /// Column of the areas of the triples, at their middle point, in m².
    pub(crate) triple_areas: Vec<f64>,
    /// Column of the rest curvatures that folds add to the triples, at their middle point, in 1/m;
    /// empty without folds.
    pub(crate) folds: Vec<f64>,
    /// Indices of the segments in a column.
    pub(crate) segments: Vec<usize>,
    /// Indices of the triples in a column.
    pub(crate) triples: Vec<usize>,
}

/// Begin of a panel: its first particle, and its columns in those of the cloth.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PanelStart {
    pub(crate) particle: u32,
    pub(crate) base: usize,
}

/// Corner of a cell at an edge: which of the four, the index of its cell, and that of its other
/// edge.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CornerAtEdge {
    pub(crate) corner: usize,
    pub(crate) cell: usize,
    pub(crate) other_edge: usize,
}

/// Steps from a cell to the warp edge and the weft edge of one of its corners.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CornerEdges {
    pub(crate) warp: usize,
    pub(crate) weft: usize,
}

impl GridPanel {
    /// Lays out a grid of a panel.
    pub(crate) fn new(
        (lattice, grid): (&Lattice, &Grid),
        fabric: &Fabric,
        start: PanelStart,
        bending: &[BendingConnectors; 2],
    ) -> Self {
        let first = start.particle;
        let stride = grid.columns;
        let points = grid.points.len();
        let margin = 2 * stride + 1;
        let length = points + 2 * margin + LANES;
        let mut index_of = vec![None; lattice.coordinates.len()];
        let mut particles = vec![first; length];
        for (point, particle) in grid.points.iter().enumerate() {
            if let Some(particle) = particle {
                index_of[*particle as usize] = Some(margin + point);
                particles[margin + point] = first + particle;
            }
        }
        let mut corner_areas = [(); 4].map(|()| vec![0.0; length]);
        let mut cells = Vec::new();
        for (cell, areas) in lattice.cells.iter().zip(lattice.shear_areas()) {
            let Some(index) = index_of[cell.corners[0] as usize] else { continue };
            cells.push(index);
            for (column, area) in corner_areas.iter_mut().zip(areas) {
                column[index] = area;
            }
        }
        let lines = grid.yarns();
        let [across, along] = grid.spacing;
        let sides = [(&fabric.warp, along, stride), (&fabric.weft, across, 1)];
        let yarns = [0, 1].map(|direction| {
            let (laws, rest, step) = sides[direction];
            let mut yarns = Yarns {
                step,
                length: rest,
                traction: TractionBatch::new(laws.traction),
                bending: BendingBatch::new(laws.bending),
                rest_second_difference: second_difference_of(laws.bending.rest_curvature, rest),
                segment_areas: vec![0.0; length],
                triple_areas: vec![0.0; length],
                folds: vec![0.0; if lattice.folds.is_empty() { 0 } else { length }],
                segments: Vec::new(),
                triples: Vec::new(),
            };
            for Segment { ends, area } in segments(lattice, &lines[direction], direction) {
                let Some(index) = index_of[ends[0] as usize] else { continue };
                yarns.segments.push(index);
                yarns.segment_areas[index] = area;
            }
            for Triple { particles, area } in &bending[direction].triples {
                let Some(index) = index_of[particles[1] as usize] else { continue };
                yarns.triples.push(index);
                yarns.triple_areas[index] = *area;
            }
            for (node, curvature) in bending[direction].folds.iter().enumerate() {
                index_of[node].iter().for_each(|&index| yarns.folds[index] += curvature);
            }
            yarns
        });
        let occupied: Vec<bool> = grid.points.iter().map(Option::is_some).collect();
        Self {
            points,
            stride,
            margin,
            first: (first + grid.particles().next().unwrap_or(0)) as usize,
            particles,
            occupied,
            yarns,
            shear: ShearBatch::new(fabric.shear),
            corner_areas,
            cells,
            base: start.base,
            slots: Vec::new(),
        }
    }

    /// Looks up the slots of the panel's blocks.
    pub(crate) fn find_slots(&mut self, sparsity: &Sparsity) {
        let steps = self.block_steps();
        let slot = |point: usize, step: usize| {
            let index = self.margin + point;
            let other = point + step;
            let there = self.occupied[point] && other < self.points && self.occupied[other];
            let [row, column] = [index, index + step].map(|index| self.particles[index]);
            let block = there.then(|| sparsity.block(row, column)).flatten();
            block.map_or(NO_BLOCK, |block| block as u32)
        };
        self.slots = (0..self.points).map(|point| steps.map(|step| slot(point, step))).collect();
    }

    /// Steps from a point to those that it has a block with in the upper half of the matrix, itself
    /// first:
    ///
    /// ```text
    ///      6
    ///   3  4  5         0: the point itself; 1, 2: along the weft; 4, 6: along the warp;
    ///      0  1  2      3, 5: across the cells
    /// ```
    pub(crate) fn block_steps(&self) -> [usize; BLOCKS] {
        let stride = self.stride;
        [0, 1, 2, stride - 1, stride, stride + 1, 2 * stride]
    }

    /// Returns the steps from a cell to the two edges of one of its corners.
    #[inline(always)]
    pub(crate) fn corner_edges(&self, corner: usize) -> CornerEdges {
        match corner {
            0 => CornerEdges { warp: 0, weft: 0 },
            1 => CornerEdges { warp: 1, weft: 0 },
            2 => CornerEdges { warp: 1, weft: self.stride },
            _ => CornerEdges { warp: 0, weft: self.stride },
        }
    }

    /// Returns the four corners of cells at the edge of a direction that begins at `index`.
    #[inline(always)]
    pub(crate) fn corners_at_edge(&self, direction: usize, index: usize) -> [CornerAtEdge; 4] {
        let stride = self.stride;
        let at = |corner, cell, other_edge| CornerAtEdge { corner, cell, other_edge };
        if direction == 0 {
            let left = index - 1;
            [
                at(0, index, index),
                at(3, index, index + stride),
                at(1, left, left),
                at(2, left, left + stride),
            ]
        } else {
            let below = index - stride;
            [
                at(0, index, index),
                at(1, index, index + 1),
                at(3, below, below),
                at(2, below, below + 1),
            ]
        }
    }

    /// Pairs of particles that a connector joins, the first of each less than the second.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = [u32; 2]> {
        let pair =
            |index: usize, ends: [usize; 2]| ends.map(|offset| self.particles[index + offset]);
        let stride = self.stride;
        let [a, b, d, c] = [0, 1, stride, stride + 1];
        let sides = [[a, b], [a, d], [a, c], [b, d], [b, c], [d, c]];
        let cells = self.cells.iter();
        let cells = cells.flat_map(move |&index| sides.map(|side| pair(index, side)));
        let ends = self.yarns.iter().flat_map(move |yarns| {
            let starts = yarns.triples.iter().map(|index| index - yarns.step);
            // Between triangles of a rim, neighbours on a yarn share no cell.
            let sides = [[0, yarns.step], [yarns.step, 2 * yarns.step], [0, 2 * yarns.step]];
            starts.flat_map(move |index| sides.map(|side| pair(index, side)))
        });
        cells.chain(ends)
    }

    /// Length of a column.
    pub(crate) fn length(&self) -> usize {
        self.points + 2 * self.margin + LANES
    }
}
