use std::ops::Range;

use drape_fabric::{BendingBatch, Fabric, LANES, ShearBatch, TractionBatch};

use crate::angle::bow_of;
use crate::connectors::{Bending, segments};
use crate::{Lattice, Sparsity};

/// Particles of a strip, about: fewer cost more seams between strips, more leave the cache.
const STRIP_POINTS: usize = 1024;

/// Rows of a strip at least: two rows at each of its sides are computed twice.
const STRIP_ROWS: usize = 16;

/// Blocks in a row of the matrix at most.
pub(crate) const BLOCKS: usize = 7;

/// Stands for a block that does not exist.
pub(crate) const NO_BLOCK: u32 = u32::MAX;

/// A panel on the points of its grid, row by row, so that neighbours along a yarn are a fixed step
/// apart and connectors need no lists.
///
/// Columns are one number per point, with a margin of two rows and a batch at both ends. A point
/// without a particle stands where the panel's first particle stands, and a connector that does not
/// exist, such as an edge from the end of a row to the start of the next, has an area of zero.
#[derive(Debug, Clone)]
pub(crate) struct Panel {
    /// Points of the grid.
    pub(crate) points: usize,
    /// Step to the next point along the warp; along the weft it is 1.
    pub(crate) stride: usize,
    /// Place of the first point in a column.
    pub(crate) margin: usize,
    /// Number of its first particle.
    pub(crate) first: usize,
    /// Column of the particles.
    pub(crate) particles: Vec<u32>,
    /// Whether a particle is at the point, without margins.
    pub(crate) occupied: Vec<bool>,
    /// Along the warp and along the weft.
    pub(crate) yarns: [Yarns; 2],
    pub(crate) shear: ShearBatch,
    /// Columns of the areas of each cell's corners (0, 0), (1, 0), (1, 1), (0, 1), kept at the first.
    pub(crate) corners: [Vec<f64>; 4],
    /// Places of the cells in a column.
    pub(crate) cells: Vec<usize>,
    /// Place of the panel's columns in those of the cloth.
    pub(crate) base: usize,
    /// Blocks of each point with those at [`Panel::block_steps`], or [`NO_BLOCK`].
    pub(crate) slots: Vec<[u32; BLOCKS]>,
}

/// Segments and triples along one direction.
#[derive(Debug, Clone)]
pub(crate) struct Yarns {
    /// Step to the next point.
    pub(crate) step: usize,
    /// Rest length of a segment.
    pub(crate) length: f64,
    pub(crate) traction: TractionBatch,
    pub(crate) bending: BendingBatch,
    /// Bow of a triple that has the bending's rest curvature, in m⁻¹.
    pub(crate) rest_bow: f64,
    /// Column of the areas of the segments, kept at their first point.
    pub(crate) segment_areas: Vec<f64>,
    /// Column of the areas of the triples, kept at their middle point.
    pub(crate) triple_areas: Vec<f64>,
    /// Column of what folds add to the rest curvature of the triples, kept at their middle point; none without folds.
    pub(crate) folds: Vec<f64>,
    /// Places of the segments in a column.
    pub(crate) segments: Vec<usize>,
    /// Places of the triples in a column.
    pub(crate) triples: Vec<usize>,
}

/// A run of points that is evaluated as one, whatever the number of threads.
#[derive(Debug, Clone)]
pub(crate) struct Strip {
    /// Place among the strips of the cloth.
    pub(crate) index: usize,
    /// Panel that it is part of.
    pub(crate) panel: usize,
    /// Place of its first point, less the panel's margin, in the columns of the cloth.
    pub(crate) offset: usize,
    /// Points, starting at a multiple of [`LANES`].
    pub(crate) points: Range<usize>,
    /// Particles at the points, counted over the cloth. Those of an outline follow the last strip's.
    pub(crate) particles: Range<usize>,
    /// Blocks in the rows of the particles.
    pub(crate) blocks: Range<usize>,
}

impl Panel {
    /// A panel whose particles are numbered from `first` on and whose columns begin at `base`.
    pub(crate) fn new(
        lattice: &Lattice,
        fabric: &Fabric,
        (first, base): (u32, usize),
        bending: &[Bending; 2],
    ) -> Self {
        let stride = lattice.columns;
        let points = lattice.grid.len();
        let margin = 2 * stride + 1;
        let length = points + 2 * margin + LANES;
        let mut place_of = vec![0; lattice.coordinates.len()];
        let mut particles = vec![first; length];
        for (point, particle) in lattice.grid.iter().enumerate() {
            if let Some(particle) = particle {
                place_of[*particle as usize] = margin + point;
                particles[margin + point] = first + particle;
            }
        }
        let mut corners = [(); 4].map(|()| vec![0.0; length]);
        let mut cells = Vec::new();
        for (cell, areas) in lattice.cells.iter().zip(lattice.sheared()) {
            let place = place_of[cell.corners[0] as usize];
            cells.push(place);
            for (column, area) in corners.iter_mut().zip(areas) {
                column[place] = area;
            }
        }
        let lines = lattice.yarns();
        let [across, along] = lattice.spacing;
        let sides = [(&fabric.warp, along, stride), (&fabric.weft, across, 1)];
        let yarns = [0, 1].map(|direction| {
            let (laws, rest, step) = sides[direction];
            let mut yarns = Yarns {
                step,
                length: rest,
                traction: TractionBatch::new(laws.traction),
                bending: BendingBatch::new(laws.bending),
                rest_bow: bow_of(laws.bending.rest_curvature, rest),
                segment_areas: vec![0.0; length],
                triple_areas: vec![0.0; length],
                folds: vec![0.0; if lattice.folds.is_empty() { 0 } else { length }],
                segments: Vec::new(),
                triples: Vec::new(),
            };
            for ([start, _], area) in segments(lattice, &lines[direction], direction) {
                let place = place_of[start as usize];
                yarns.segments.push(place);
                yarns.segment_areas[place] = area;
            }
            for ([_, middle, _], area) in &bending[direction].triples {
                let place = place_of[*middle as usize];
                yarns.triples.push(place);
                yarns.triple_areas[place] = *area;
            }
            for (node, curvature) in bending[direction].folded.iter().enumerate() {
                yarns.folds[place_of[node]] += curvature;
            }
            yarns
        });
        let occupied: Vec<bool> = lattice.grid.iter().map(Option::is_some).collect();
        Self {
            points,
            stride,
            margin,
            first: first as usize,
            particles,
            occupied,
            yarns,
            shear: ShearBatch::new(fabric.shear),
            corners,
            cells,
            base,
            slots: Vec::new(),
        }
    }

    /// Looks up the places of the panel's blocks.
    pub(crate) fn connect(&mut self, sparsity: &Sparsity) {
        let steps = self.block_steps();
        let slot = |point: usize, step: usize| {
            let place = self.margin + point;
            let other = point + step;
            let there = self.occupied[point] && other < self.points && self.occupied[other];
            let [row, column] = [place, place + step].map(|place| self.particles[place]);
            let block = there.then(|| sparsity.block(row, column)).flatten();
            block.map_or(NO_BLOCK, |block| block as u32)
        };
        self.slots = (0..self.points).map(|point| steps.map(|step| slot(point, step))).collect();
    }

    /// Steps from a point to those that it has a block with, itself first.
    pub(crate) fn block_steps(&self) -> [usize; BLOCKS] {
        let stride = self.stride;
        [0, 1, 2, stride - 1, stride, stride + 1, 2 * stride]
    }

    /// Steps from a cell to the warp and the weft edge of one of its corners.
    #[inline(always)]
    pub(crate) fn corner_edges(&self, corner: usize) -> (usize, usize) {
        match corner {
            0 => (0, 0),
            1 => (1, 0),
            2 => (1, self.stride),
            _ => (0, self.stride),
        }
    }

    /// The corners at an edge: which of its cell, the place of the cell, and that of the corner's
    /// other edge.
    #[inline(always)]
    pub(crate) fn around(&self, direction: usize, place: usize) -> [(usize, usize, usize); 4] {
        let stride = self.stride;
        if direction == 0 {
            let left = place - 1;
            [
                (0, place, place),
                (3, place, place + stride),
                (1, left, left),
                (2, left, left + stride),
            ]
        } else {
            let below = place - stride;
            [(0, place, place), (1, place, place + 1), (3, below, below), (2, below, below + 1)]
        }
    }

    /// Pairs of particles that a connector joins.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = (u32, u32)> {
        let pair = |place: usize, (from, to): (usize, usize)| {
            (self.particles[place + from], self.particles[place + to])
        };
        let stride = self.stride;
        let [a, b, d, c] = [0, 1, stride, stride + 1];
        let sides = [(a, b), (a, d), (a, c), (b, d), (b, c), (d, c)];
        let cells = self.cells.iter();
        let cells = cells.flat_map(move |&place| sides.map(|side| pair(place, side)));
        let ends = self.yarns.iter().flat_map(move |yarns| {
            let places = yarns.triples.iter().map(|place| place - yarns.step);
            // Between triangles of a rim, neighbours on a yarn share no cell.
            let sides = [(0, yarns.step), (yarns.step, 2 * yarns.step), (0, 2 * yarns.step)];
            places.flat_map(move |place| sides.map(|side| pair(place, side)))
        });
        cells.chain(ends)
    }

    /// Length of a column.
    pub(crate) fn length(&self) -> usize {
        self.points + 2 * self.margin + LANES
    }

    /// Cuts the points into strips of about the same length, and puts them to those of other panels: one, or an even
    /// number, which two threads share alike, of three quarters of the wanted length at the least.
    pub(crate) fn cut(&self, panel: usize, sparsity: &Sparsity, strips: &mut Vec<Strip>) {
        let wanted = STRIP_POINTS.max(STRIP_ROWS * self.stride);
        let pairs = (self.points as f64 / (2 * wanted) as f64 + 0.25) as usize;
        let count = (2 * pairs).max(1);
        let length = self.points.div_ceil(count).next_multiple_of(LANES);
        let mut first = self.first;
        for start in (0..self.points).step_by(length) {
            let points = start..(start + length).min(self.points);
            let occupied = self.occupied[points.clone()].iter().filter(|o| **o);
            let particles = first..first + occupied.count();
            first = particles.end;
            strips.push(Strip {
                index: strips.len(),
                panel,
                offset: self.base + start,
                blocks: sparsity.offsets[particles.start]..sparsity.offsets[particles.end],
                points,
                particles,
            });
        }
    }
}

impl Strip {
    /// Places of a point and its margins, at most, where the panel's margin is given.
    pub(crate) fn reach(&self, margin: usize) -> usize {
        self.points.len() + 2 * margin + LANES
    }
}
