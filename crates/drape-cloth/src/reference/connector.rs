//! Segments, corners and triples of a grid, one by one.

use drape_fabric::{BendingLaw, Law, Memory, ShearLaw};

use crate::layout::sparsity::Sparsity;
use crate::measure::bending::{BendingMeasure, BendingResponse};
use crate::measure::block::{Matrix, identity, outer, sum, transposed};
use crate::measure::vector::{Vector, add, dot, scale, subtract, vector_at};

/// Connector: a law, the particles of its measure, and its area.
#[derive(Debug, Clone)]
pub(crate) struct Connector<L, const N: usize> {
    pub(crate) law: L,
    pub(crate) particles: [u32; N],
    /// Rest length of a segment or of the segments of a triple, in m; sign of a corner.
    pub(crate) measure: f64,
    /// Area, in m².
    pub(crate) area: f64,
    /// Rest curvature that folds add to a triple, in 1/m.
    pub(crate) fold: f64,
    pub(crate) memory: Memory,
    /// Blocks of the pairs 00, 11, 01 and, with three particles, 22, 02, 12.
    blocks: [usize; 6],
}

/// Indices in [`Connector::particles`] of the pairs in [`Connector::blocks`].
const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (0, 1), (2, 2), (0, 2), (1, 2)];

/// Edge from one particle to another.
pub(crate) struct Edge {
    pub(crate) length: f64,
    pub(crate) unit: Vector,
}

impl Edge {
    pub(crate) fn new(positions: &[f64], from: u32, to: u32) -> Self {
        let span = subtract(vector_at(positions, to), vector_at(positions, from));
        let length = dot(span, span).sqrt();
        Self { length, unit: scale(span, 1.0 / length) }
    }
}

/// Sine of a corner, its two edges, and the gradients of the sine with respect to their ends.
pub(crate) struct Corner {
    pub(crate) sine: f64,
    warp: Edge,
    weft: Edge,
    pub(crate) warp_gradient: Vector,
    pub(crate) weft_gradient: Vector,
}

/// Blocks of a corner: of the warp end with itself, of the weft end with itself, and of both.
pub(crate) struct CornerBlocks {
    pub(crate) warp: Matrix,
    pub(crate) weft: Matrix,
    pub(crate) mixed: Matrix,
}

impl<L> Connector<L, 2> {
    pub(crate) fn edge(&self, positions: &[f64]) -> Edge {
        Edge::new(positions, self.particles[0], self.particles[1])
    }

    /// Returns the strain of a segment at `positions`.
    pub(crate) fn strain(&self, positions: &[f64]) -> f64 {
        self.edge(positions).length / self.measure - 1.0
    }
}

impl Connector<ShearLaw, 3> {
    pub(crate) fn corner(&self, positions: &[f64]) -> Corner {
        let [centre, warp, weft] = self.particles;
        let warp = Edge::new(positions, centre, warp);
        let weft = Edge::new(positions, centre, weft);
        let cosine = dot(warp.unit, weft.unit);
        let [warp_gradient, weft_gradient] =
            [(&warp, &weft), (&weft, &warp)].map(|(along, crossing)| {
                let across = subtract(crossing.unit, scale(along.unit, cosine));
                scale(across, self.measure / along.length)
            });
        Corner { sine: self.measure * cosine, warp_gradient, weft_gradient, warp, weft }
    }

    /// Returns the blocks of a corner at `positions`. With `definite`, the second derivatives of
    /// the sine are left out.
    pub(crate) fn corner_blocks(&self, positions: &[f64], definite: bool) -> CornerBlocks {
        let Corner { sine, warp, weft, warp_gradient: gp, weft_gradient: gq } =
            self.corner(positions);
        let response = self.law.respond(&self.memory, sine);
        let tangent = self.area * response.tangent;
        if definite {
            let tangent = tangent.max(0.0);
            let [warp, weft, mixed] =
                [(gp, gp), (gq, gq), (gp, gq)].map(|(a, b)| sum([(tangent, outer(a, b))]));
            return CornerBlocks { warp, weft, mixed };
        }
        // Second derivatives of the cosine of the angle between two vectors.
        let (load, sign) = (self.area * response.load, self.measure);
        let cosine = sign * sine;
        let [warp_block, weft_block] = [(&warp, gp), (&weft, gq)].map(|(edge, gradient)| {
            let Edge { length, unit: e } = *edge;
            sum([
                (tangent, outer(gradient, gradient)),
                (-load / length, outer(gradient, e)),
                (-load / length, outer(e, gradient)),
                (-load * sign * cosine / (length * length), across(e)),
            ])
        });
        let (left, right) = (across(warp.unit), across(weft.unit));
        let both = [0, 1, 2].map(|i| [0, 1, 2].map(|j| dot(left[i], right[j])));
        let factor = load * sign / (warp.length * weft.length);
        CornerBlocks {
            warp: warp_block,
            weft: weft_block,
            mixed: sum([(tangent, outer(gp, gq)), (factor, both)]),
        }
    }
}

/// Returns the projection across the unit vector `e`, `$1 - ee^T$`.
pub(crate) fn across(e: Vector) -> Matrix {
    sum([(1.0, identity()), (-1.0, outer(e, e))])
}

impl<L, const N: usize> Connector<L, N> {
    /// Returns a connector of `particles` without memory, with an area of one. `measure` is its
    /// rest length, in m, or its sign. `sparsity` gives its blocks.
    pub(crate) fn new(law: L, particles: [u32; N], measure: f64, sparsity: &Sparsity) -> Self {
        // A segment has only the first three pairs.
        let blocks = PAIRS.map(|(i, j)| {
            let (Some(&a), Some(&b)) = (particles.get(i), particles.get(j)) else {
                return usize::MAX;
            };
            sparsity.block(a.min(b), a.max(b)).unwrap_or(usize::MAX)
        });
        Self { law, particles, measure, area: 1.0, fold: 0.0, memory: Memory::default(), blocks }
    }

    /// Returns the connector with `area`, in m².
    pub(crate) fn with_area(self, area: f64) -> Self {
        Self { area, ..self }
    }

    /// Returns the connector with `fold`, a rest curvature that folds add, in 1/m.
    pub(crate) fn with_fold(self, fold: f64) -> Self {
        Self { fold, ..self }
    }

    /// Adds the block of one of the [`PAIRS`] to `values`, the stiffness matrix.
    pub(crate) fn add_block(&self, pair: usize, block: Matrix, values: &mut [f64]) {
        let (i, j) = PAIRS[pair];
        let lower = self.particles[i] > self.particles[j];
        let block = if lower { transposed(block) } else { block };
        let values = &mut values[9 * self.blocks[pair]..][..9];
        for (value, entry) in values.iter_mut().zip(block.as_flattened()) {
            *value += entry;
        }
    }
}

impl Connector<BendingLaw, 3> {
    fn bending(&self, positions: &[f64], normals: &[f64]) -> BendingMeasure {
        let [before, middle, after] = self.particles.map(|p| vector_at(positions, p));
        let difference = subtract(add(before, after), scale(middle, 2.0));
        BendingMeasure {
            second_difference: scale(difference, 1.0 / (self.measure * self.measure)),
            normal: vector_at(normals, self.particles[1]),
            length: self.measure,
        }
    }

    /// Returns the curvature at `positions` about the middle particle's normal, in 1/m.
    pub(crate) fn curvature(&self, positions: &[f64], normals: &[f64]) -> f64 {
        self.bending(positions, normals).curvature()
    }

    /// Returns energy per area and derivatives with respect to the second difference at
    /// `positions`.
    pub(crate) fn respond(
        &self,
        positions: &[f64],
        normals: &[f64],
        definite: bool,
    ) -> BendingResponse {
        let measure = self.bending(positions, normals);
        if self.fold != 0.0 {
            return measure.respond_folded(&self.law, &self.memory, self.fold, definite);
        }
        measure.respond(&self.law, &self.memory, definite)
    }
}

/// Advances `memory` to the deformation `to`. Returns the energy dissipated per area, in J/m².
pub(crate) fn commit_memory(law: &impl Law, memory: &mut Memory, to: f64) -> f64 {
    let after = law.commit(memory, to);
    let lost = law.work(memory, to) - (law.stored(&after) - law.stored(memory));
    *memory = after;
    lost
}
