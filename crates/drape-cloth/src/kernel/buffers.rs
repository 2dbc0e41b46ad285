//! Buffers of a strip, and the measures at its points: edges, strains, sines, second differences.
//!
//! The forces, energy and stiffness kernels share them. The length and the direction of an edge are
//! computed once and serve traction and shear alike.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use std::ops::Range;

use drape_fabric::{LANES, Lanes};

use crate::kernel::bending::BendingLanes;
use crate::kernel::memories::GridMemories;
use crate::layout::columns::{Columns, VectorColumns, VectorLanes, lanes, lanes_if_any, put};
use crate::layout::grid::{CornerEdges, GridPanel, Yarns};
use crate::layout::strip::{BatchIndex, Strip};
use crate::measure::vector::{add, dot, scale, subtract};

/// Length that shorter edges are taken to have, in m. Such edges have no direction. Their forces
/// and derivatives are huge but finite.
pub(crate) const EDGE_MIN: f64 = 1e-100;

/// Intermediate columns of a strip: one number per point of the strip and of the margin around it.
///
/// The index of a point here is its index in the panel's columns less the index of the strip's
/// first point.
#[derive(Debug, Clone)]
pub(crate) struct StripBuffers {
    pub(crate) positions: VectorColumns,
    /// Edges along the warp and the weft, at their first point.
    pub(crate) edges: [Edges; 2],
    /// Tensions of the edges times area over length, in N.
    pub(crate) tensions: [Vec<f64>; 2],
    /// Loads of the corners of the cells times their areas, in J.
    pub(crate) corner_loads: [Vec<f64>; 4],
    /// Moments at the points times area over the square of the segments' length, in N.
    pub(crate) moments: [VectorColumns; 2],
    /// Derivatives of the potential with respect to the edges as vectors, in N.
    pub(crate) edge_gradients: [VectorColumns; 2],
    /// Tangents of the corners of the cells times their areas, in J.
    pub(crate) corner_tangents: [Vec<f64>; 4],
    /// Second derivatives of the potential with respect to the warp and the weft edge of a corner.
    pub(crate) shear_blocks: [Columns<9>; 4],
    /// Second derivatives with respect to the second difference at a point, over the fourth power
    /// of the segments' length.
    pub(crate) bending_blocks: [Columns<6>; 2],
    /// Blocks of pairs of points: of each point with the next along the warp, with the next along
    /// the weft and with the opposite point of its cell, and of the two other points of its cell.
    pub(crate) pair_blocks: [Columns<9>; 4],
}

/// Edges from each point to the next in one direction.
#[derive(Debug, Clone)]
pub(crate) struct Edges {
    pub(crate) length: Vec<f64>,
    pub(crate) inverse: Vec<f64>,
    pub(crate) unit: VectorColumns,
}

/// A strip, the memories at the start of the step, and the trial positions to evaluate.
#[derive(Clone, Copy)]
pub(crate) struct StripTrial<'a> {
    pub(crate) panel: &'a GridPanel,
    pub(crate) strip: &'a Strip,
    pub(crate) memories: &'a GridMemories,
    pub(crate) positions: &'a [f64],
}

impl Edges {
    fn new(length: usize) -> Self {
        Self {
            length: vec![0.0; length],
            inverse: vec![0.0; length],
            unit: VectorColumns::new(length),
        }
    }

    /// Measures the edges from the points `indices` to the points `step` further, at `positions`.
    #[inline(always)]
    fn measure(&mut self, positions: &VectorColumns, step: usize, indices: Range<usize>) {
        for start in indices.step_by(LANES) {
            let (here, next) = (positions.batch(start), positions.batch(start + step));
            let mut length = [0.0; LANES];
            let mut inverse = [0.0; LANES];
            let mut unit = VectorLanes::zero();
            for lane in 0..LANES {
                let span = subtract(next.vector(lane), here.vector(lane));
                let size = dot(span, span).sqrt();
                // Written so that NaN stays NaN, unlike with `max`.
                let size = if size < EDGE_MIN { EDGE_MIN } else { size };
                length[lane] = size;
                inverse[lane] = 1.0 / size;
                unit.set(lane, scale(span, 1.0 / size));
            }
            put(&mut self.length, start, &length);
            put(&mut self.inverse, start, &inverse);
            self.unit.put(start, &unit.0);
        }
    }
}

impl StripBuffers {
    pub(crate) fn new(length: usize) -> Self {
        Self {
            positions: VectorColumns::new(length),
            edges: [Edges::new(length), Edges::new(length)],
            tensions: [(); 2].map(|()| vec![0.0; length]),
            corner_loads: [(); 4].map(|()| vec![0.0; length]),
            moments: [(); 2].map(|()| VectorColumns::new(length)),
            edge_gradients: [(); 2].map(|()| VectorColumns::new(length)),
            corner_tangents: [(); 4].map(|()| vec![0.0; length]),
            shear_blocks: [(); 4].map(|()| Columns::new(length)),
            bending_blocks: [(); 2].map(|()| Columns::new(length)),
            pair_blocks: [(); 4].map(|()| Columns::new(length)),
        }
    }

    /// Copies the `positions` of `strip` of `panel` and of its margin into columns, and measures
    /// the edges.
    #[inline(always)]
    pub(crate) fn load(&mut self, panel: &GridPanel, strip: &Strip, positions: &[f64]) {
        let count = strip.points.len();
        let length = count + 2 * panel.margin + LANES;
        let particles = &panel.particles[strip.points.start..][..length];
        let [x, y, z] = &mut self.positions.0;
        let columns = x[..length].iter_mut().zip(&mut y[..length]).zip(&mut z[..length]);
        for (((x, y), z), &particle) in columns.zip(particles) {
            let position = &positions[3 * particle as usize..][..3];
            (*x, *y, *z) = (position[0], position[1], position[2]);
        }
        let (from, to) = (panel.margin - panel.stride - 1, panel.margin + count);
        let [warp, weft] = &mut self.edges;
        warp.measure(&self.positions, panel.stride, from..to + 1);
        weft.measure(&self.positions, 1, from..to + panel.stride);
    }

    /// Returns the strains of a batch of segments at `at`, zero for segments that do not exist.
    #[inline(always)]
    pub(crate) fn strains(&self, yarns: &Yarns, direction: usize, at: BatchIndex) -> Lanes {
        let length = lanes(&self.edges[direction].length, at.buffer);
        let areas = lanes(&yarns.segment_areas, at.panel);
        let inverse = 1.0 / yarns.length;
        let mut strains = [0.0; LANES];
        for lane in 0..LANES {
            strains[lane] = if areas[lane] == 0.0 { 0.0 } else { length[lane] * inverse - 1.0 };
        }
        strains
    }

    /// Returns the second differences `$b = (x_a - 2x_c + x_b)/h^2$` at the batch of points from
    /// `start` on.
    #[inline(always)]
    fn second_differences(&self, yarns: &Yarns, start: usize) -> VectorLanes {
        let [before, here, after] = [start - yarns.step, start, start + yarns.step]
            .map(|start| self.positions.batch(start));
        let inverse_square = 1.0 / (yarns.length * yarns.length);
        let mut differences = VectorLanes::zero();
        for lane in 0..LANES {
            let ends = add(before.vector(lane), after.vector(lane));
            let difference = subtract(ends, scale(here.vector(lane), 2.0));
            differences.set(lane, scale(difference, inverse_square));
        }
        differences
    }

    /// Returns the batch of triples at `at`, about `normals`, as [`BendingLanes`].
    #[inline(always)]
    pub(crate) fn triples<'a>(
        &self,
        yarns: &'a Yarns,
        normals: &'a VectorColumns,
        at: BatchIndex,
    ) -> BendingLanes<'a> {
        BendingLanes {
            yarns,
            second_differences: self.second_differences(yarns, at.buffer),
            normals: normals.batch(at.cloth),
            areas: lanes(&yarns.triple_areas, at.panel),
            folds: lanes_if_any(&yarns.folds, at.panel),
        }
    }

    /// Returns the sines of the shear angle at `corner`, one of the four corners, of the batch of
    /// cells at `at`. Cells that do not exist have a sine of zero.
    ///
    /// The edges point along rising `u` and `v` at all four corners, so the sines have one sign.
    #[inline(always)]
    pub(crate) fn sines(&self, panel: &GridPanel, corner: usize, at: BatchIndex) -> Lanes {
        let CornerEdges { warp, weft } = panel.corner_edges(corner);
        let warp = self.edges[0].unit.batch(at.buffer + warp);
        let weft = self.edges[1].unit.batch(at.buffer + weft);
        let areas = lanes(&panel.corner_areas[corner], at.panel);
        let mut sines = [0.0; LANES];
        for lane in 0..LANES {
            let sine = dot(warp.vector(lane), weft.vector(lane));
            sines[lane] = if areas[lane] == 0.0 { 0.0 } else { sine };
        }
        sines
    }
}
