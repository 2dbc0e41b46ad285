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

/// Panel on the points of its grid, row by row. Neighbours along a yarn are a fixed step apart, so
/// connectors need no lists.
///
/// A column has one number per point. Before the first point and after the last, it has a margin of
/// two rows and one point, and at its end a batch:
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
/// branch. A point without a particle has the position of the panel's first particle. A connector
/// that does not exist, such as a segment from the end of a row to the start of the next, has an
/// area of zero.
#[derive(Debug, Clone)]
pub(crate) struct GridPanel {
    /// Number of points of the grid.
    pub(crate) points: usize,
    /// Step to the next point along the warp; along the weft it is 1.
    pub(crate) stride: usize,
    /// Index of the first point in a column.
    pub(crate) margin: usize,
    /// Number of the panel's first particle.
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
    /// Index of the panel's columns in the columns of the cloth.
    pub(crate) base: usize,
    /// Blocks of each point with the points at [`GridPanel::block_steps`], or [`NO_BLOCK`].
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
    /// Cloth area of each segment, in m², in a column with the entry at the segment's first point.
    pub(crate) segment_areas: Vec<f64>,
    /// Cloth area of each triple, in m², in a column with the entry at the triple's middle point.
    pub(crate) triple_areas: Vec<f64>,
    /// Column of the rest curvatures that folds add to the triples, at their middle point, in 1/m.
    /// The column is empty without folds.
    pub(crate) folds: Vec<f64>,
    /// Indices of the segments in a column.
    pub(crate) segments: Vec<usize>,
    /// Indices of the triples in a column.
    pub(crate) triples: Vec<usize>,
}

/// Start of a panel: its first particle, and its columns in the columns of the cloth.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PanelStart {
    pub(crate) particle: u32,
    pub(crate) base: usize,
}

/// Corner of a cell at an edge: which of the four corners, the index of its cell, and the index of
/// the crossing edge.
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
    /// Lays out `grid`, a grid of `lattice` in `fabric`, from the numbers in `start` on.
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

        // Particles at their points.
        let mut index_of = vec![None; lattice.coordinates.len()];
        let mut particles = vec![first; length];
        for (point, particle) in grid.points.iter().enumerate() {
            if let Some(particle) = particle {
                index_of[*particle as usize] = Some(margin + point);
                particles[margin + point] = first + particle;
            }
        }

        // Corners of the cells, for shear.
        let mut corner_areas = [(); 4].map(|()| vec![0.0; length]);
        let mut cells = Vec::new();
        for (cell, areas) in lattice.cells.iter().zip(lattice.shear_areas()) {
            let Some(index) = index_of[cell.corners[0] as usize] else { continue };
            cells.push(index);
            for (column, area) in corner_areas.iter_mut().zip(areas) {
                column[index] = area;
            }
        }

        // Segments and triples along both yarns.
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

    /// Looks up the slots of the panel's blocks in `sparsity`.
    pub(crate) fn find_slots(&mut self, sparsity: &Sparsity) {
        let steps = self.block_steps();
        self.slots = (0..self.points)
            .map(|point| steps.map(|step| self.slot(point, step, sparsity)))
            .collect();
    }

    /// Returns the slot of the block of `point` with the point `step` further, or [`NO_BLOCK`].
    fn slot(&self, point: usize, step: usize, sparsity: &Sparsity) -> u32 {
        let index = self.margin + point;
        let next = point + step;
        let both_exist = self.occupied[point] && next < self.points && self.occupied[next];
        let [row, column] = [index, index + step].map(|index| self.particles[index]);
        let block = both_exist.then(|| sparsity.block(row, column)).flatten();
        block.map_or(NO_BLOCK, |block| block as u32)
    }

    /// Returns the steps from a point to the points with which it has a block in the upper half of
    /// the matrix, itself first:
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

    /// Returns the steps from a cell to the two edges of its corner `corner`.
    #[inline(always)]
    pub(crate) fn corner_edges(&self, corner: usize) -> CornerEdges {
        match corner {
            0 => CornerEdges { warp: 0, weft: 0 },
            1 => CornerEdges { warp: 1, weft: 0 },
            2 => CornerEdges { warp: 1, weft: self.stride },
            _ => CornerEdges { warp: 0, weft: self.stride },
        }
    }

    /// Returns the four corners of cells at the edge along `direction` that begins at `index`.
    #[inline(always)]
    pub(crate) fn corners_at_edge(&self, direction: usize, index: usize) -> [CornerAtEdge; 4] {
        let stride = self.stride;
        let corners = if direction == 0 {
            let left = index - 1;
            [
                (0, index, index),
                (3, index, index + stride),
                (1, left, left),
                (2, left, left + stride),
            ]
        } else {
            let below = index - stride;
            [(0, index, index), (1, index, index + 1), (3, below, below), (2, below, below + 1)]
        };
        corners.map(|(corner, cell, other_edge)| CornerAtEdge { corner, cell, other_edge })
    }

    /// Returns the pairs of particles that a connector joins, the lower number first.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = [u32; 2]> {
        let stride = self.stride;
        let [a, b, d, c] = [0, 1, stride, stride + 1];
        let sides = [[a, b], [a, d], [a, c], [b, d], [b, c], [d, c]];
        let cells = self.cells.iter().flat_map(move |&index| {
            sides.map(|side| side.map(|offset| self.particles[index + offset]))
        });
        let triples = self.yarns.iter().flat_map(move |yarns| {
            let starts = yarns.triples.iter().map(|index| index - yarns.step);
            // Between triangles of a rim, neighbours on a yarn share no cell.
            let sides = [[0, yarns.step], [yarns.step, 2 * yarns.step], [0, 2 * yarns.step]];
            starts.flat_map(move |index| {
                sides.map(|side| side.map(|offset| self.particles[index + offset]))
            })
        });
        cells.chain(triples)
    }

    /// Returns the length of a column, with margins and [`LANES`].
    pub(crate) fn length(&self) -> usize {
        self.points + 2 * self.margin + LANES
    }
}
