//! Stiffness of a rim: the blocks of the corners of its triangles and of the nodes of its stencils.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use drape_fabric::{BatchLaw, LANES, Lanes, Responses};

use crate::layout::columns::lanes;
use crate::measure::half::{HALF, IN_HALF, TRANSPOSED};
use crate::rim::connectors::RimShape;
use crate::rim::memories::RimMemories;
use crate::rim::stencils::StencilMeasures;
use crate::rim::triangles::TriangleMeasures;

/// A rim, the memories at the start of the step, and which stiffness is computed.
#[derive(Clone, Copy)]
pub(crate) struct RimStiffness<'a> {
    pub(crate) shape: RimShape<'a>,
    pub(crate) memories: &'a RimMemories,
    /// Whether parts that make the matrix indefinite are left out.
    pub(crate) definite: bool,
}

/// Second derivatives of the potential of a batch of triangles with respect to the columns `$p$`
/// and `$q$` of the deformation gradient, in J.
struct GradientHessian {
    /// Upper halves of the blocks of `$p$` with itself and `$q$` with itself.
    own: [[Lanes; 6]; 2],
    /// Block of `$p$` with `$q$`.
    mixed: [Lanes; 9],
}

/// Adds the derivatives of the forces of a rim, negated, to the blocks of its panel's rows, in N/m.
#[inline(always)]
pub(crate) fn add_stiffness(stiffness: &RimStiffness<'_>, values: &mut [f64]) {
    let RimStiffness { shape, memories, definite } = *stiffness;
    let first = shape.rim.blocks.start;
    let mut put = |slot: u32, block: &[f64; 9]| {
        let start = 9 * (slot as usize - first);
        values[start..start + 9].iter_mut().zip(block).for_each(|(sum, entry)| *sum += entry);
    };
    let triangles = &shape.rim.triangles;
    for start in triangles.batches() {
        let blocks = corner_blocks(stiffness, start);
        for lane in 0..LANES.min(triangles.count - start) {
            for (&slot, block) in triangles.slots[start + lane].iter().zip(&blocks) {
                put(slot, &block.map(|entry| entry[lane]));
            }
        }
    }
    let stencils = &shape.rim.stencils;
    for start in stencils.batches() {
        let measures = StencilMeasures::of(stencils, start, shape.positions, shape.normals);
        let halves = [0, 1].map(|direction| {
            let yarns = &shape.panel.yarns[direction];
            let memory = memories.bending[direction].batch(stencils.base + start);
            measures.bending(yarns, direction).blocks(&memory, 1.0, definite)
        });
        for lane in 0..LANES.min(stencils.count - start) {
            let index = start + lane;
            let [warp, weft] =
                halves.each_ref().map(|halves| IN_HALF.map(|entry| halves[entry][lane]));
            let nodes = stencils.nodes(index);
            let mut slots = stencils.slots[stencils.slot_offsets[index]..].iter();
            for (k, node) in nodes.iter().enumerate() {
                let [v, u] = node.weights;
                let row: [f64; 9] = std::array::from_fn(|k| v * warp[k]);
                let other: [f64; 9] = std::array::from_fn(|k| u * weft[k]);
                for (node, &slot) in nodes[k..].iter().zip(slots.by_ref()) {
                    let [v, u] = node.weights;
                    put(slot, &std::array::from_fn(|k| v * row[k] + u * other[k]));
                }
            }
        }
    }
}

/// Returns the second derivatives with respect to `$p$` and `$q$`.
///
/// With load `$g$` and tangent `$t$` of the shear, and `$c = \hat{p}\cdot\hat{q}$`, those of the
/// shear are
///
/// ```math
/// \frac{1}{|p|^2}\left[t\,\hat{q}\hat{q}^T - (tc+g)(\hat{q}\hat{p}^T+\hat{p}\hat{q}^T)
/// + (tc^2+3gc)\,\hat{p}\hat{p}^T - gc\right],\qquad
/// \frac{1}{|p||q|}\left[t\,\hat{q}\hat{p}^T - (tc+g)(\hat{p}\hat{p}^T+\hat{q}\hat{q}^T)
/// + (tc^2+gc)\,\hat{p}\hat{q}^T + g\right]
/// ```
#[inline(always)]
fn gradient_hessian(stiffness: &RimStiffness<'_>, start: usize) -> GradientHessian {
    let RimStiffness { shape, memories, definite } = *stiffness;
    let triangles = &shape.rim.triangles;
    let index = triangles.base + start;
    let measures = TriangleMeasures::of(triangles, start, shape.positions);
    let areas = lanes(&triangles.areas, start);
    let positive = |x: f64| if definite && x < 0.0 { 0.0 } else { x };
    let mut shear = Responses::default();
    let memory = memories.shear.batch(index);
    shape.panel.shear.respond::<true>(&memory, &measures.sines, &mut shear);
    let (mut loads, mut slopes) = ([0.0; LANES], [0.0; LANES]);
    for lane in 0..LANES {
        loads[lane] = if definite { 0.0 } else { shear.load[lane] * areas[lane] };
        slopes[lane] = positive(shear.tangent[lane]) * areas[lane];
    }
    let mut own = [[[0.0; LANES]; 6]; 2];
    for direction in 0..2 {
        let mut tension = Responses::default();
        let memory = memories.traction[direction].batch(index);
        let yarns = &shape.panel.yarns[direction];
        yarns.traction.respond::<true>(&memory, &measures.strains[direction], &mut tension);
        for lane in 0..LANES {
            let (p, q) = (measures.unit(direction, lane), measures.unit(1 - direction, lane));
            let inverse = measures.inverse[direction][lane];
            let stretch = positive(tension.tangent[lane]) * areas[lane];
            let rotate = positive(tension.load[lane]) * areas[lane] * inverse;
            let size = inverse * inverse;
            let (load, slope, cosine) =
                (loads[lane] * size, slopes[lane] * size, measures.sines[lane]);
            let both = slope * cosine + load;
            let along = stretch - rotate + cosine * (both + 2.0 * load);
            let across = rotate - cosine * load;
            for (k, (row, column)) in HALF.into_iter().enumerate() {
                let mixed = q[row] * p[column] + p[row] * q[column];
                let diagonal = if row == column { across } else { 0.0 };
                own[direction][k][lane] = slope * (q[row] * q[column]) - both * mixed
                    + along * (p[row] * p[column])
                    + diagonal;
            }
        }
    }
    let mut mixed = [[0.0; LANES]; 9];
    for lane in 0..LANES {
        let (p, q) = (measures.unit(0, lane), measures.unit(1, lane));
        let size = measures.inverse[0][lane] * measures.inverse[1][lane];
        let (load, slope, cosine) = (loads[lane] * size, slopes[lane] * size, measures.sines[lane]);
        let both = slope * cosine + load;
        for row in 0..3 {
            for column in 0..3 {
                let squares = p[row] * p[column] + q[row] * q[column];
                let diagonal = if row == column { load } else { 0.0 };
                mixed[3 * row + column][lane] = slope * (q[row] * p[column]) - both * squares
                    + cosine * both * (p[row] * q[column])
                    + diagonal;
            }
        }
    }
    GradientHessian { own, mixed }
}

/// Returns the blocks of a batch of triangles: of the corners 00, 01, 02, 11, 12, 22.
#[inline(always)]
fn corner_blocks(stiffness: &RimStiffness<'_>, start: usize) -> [[Lanes; 9]; 6] {
    let GradientHessian { own: [warp, weft], mixed } = gradient_hessian(stiffness, start);
    let [u1, u2, v1, v2] = stiffness.shape.rim.triangles.gradients.batch(start).0;
    let mut blocks = [[[0.0; LANES]; 9]; 6];
    for k in 0..9 {
        let (half, transposed) = (IN_HALF[k], TRANSPOSED[k]);
        for lane in 0..LANES {
            let (u1, u2, v1, v2) = (u1[lane], u2[lane], v1[lane], v2[lane]);
            let (warp, weft) = (warp[half][lane], weft[half][lane]);
            let (mixed, transposed) = (mixed[k][lane], mixed[transposed][lane]);
            let block = |(va, ua): (f64, f64), (vb, ub): (f64, f64)| {
                (va * vb) * warp + (ua * ub) * weft + ((va * ub) * mixed + (ua * vb) * transposed)
            };
            // The gradients of the corners sum to zero, since a translation changes nothing.
            let (b, c) = ((v1, u1), (v2, u2));
            let a = (-v1 - v2, -u1 - u2);
            for (sum, (one, other)) in
                blocks.iter_mut().zip([(a, a), (a, b), (a, c), (b, b), (b, c), (c, c)])
            {
                sum[k][lane] = block(one, other);
            }
        }
    }
    blocks
}
