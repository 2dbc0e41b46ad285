//! Stiffness of a rim: the blocks of the corners of its triangles and of the nodes of its stencils.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use drape_fabric::{BatchLaw, LANES, Lanes, Responses};

use crate::kernel::stiffness::positive_if;
use crate::layout::columns::lanes;
use crate::measure::half::{HALF, IN_HALF, TRANSPOSED};
use crate::rim::connectors::RimShape;
use crate::rim::memories::RimMemories;
use crate::rim::stencils::StencilMeasures;
use crate::rim::triangles::TriangleMeasures;

/// A rim, the memories at the start of the step, and the kind of stiffness to compute.
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
    /// Upper halves of the block of `$p$` with itself and of the block of `$q$` with itself.
    diagonal: [[Lanes; 6]; 2],
    /// Block of `$p$` with `$q$`.
    mixed: [Lanes; 9],
}

/// Adds the negative derivatives of the forces of a rim to `values`, the blocks of its panel's
/// rows, in N/m.
#[inline(always)]
pub(crate) fn add_stiffness(stiffness: &RimStiffness<'_>, values: &mut [f64]) {
    add_triangle_blocks(stiffness, values);
    add_stencil_blocks(stiffness, values);
}

/// Adds `block` to the block at `slot` in `values`, which begin at the block `first`.
#[inline(always)]
fn add_block(values: &mut [f64], first: usize, slot: u32, block: &[f64; 9]) {
    let start = 9 * (slot as usize - first);
    values[start..start + 9].iter_mut().zip(block).for_each(|(sum, entry)| *sum += entry);
}

/// Adds the blocks of the corners of the rim's triangles to `values`.
#[inline(always)]
fn add_triangle_blocks(stiffness: &RimStiffness<'_>, values: &mut [f64]) {
    let first = stiffness.shape.rim.blocks.start;
    let triangles = &stiffness.shape.rim.triangles;
    for start in triangles.batches() {
        let blocks = corner_blocks(stiffness, start);
        for lane in 0..LANES.min(triangles.count - start) {
            for (&slot, block) in triangles.slots[start + lane].iter().zip(&blocks) {
                add_block(values, first, slot, &block.map(|entry| entry[lane]));
            }
        }
    }
}

/// Adds the blocks of the nodes of the rim's stencils to `values`.
#[inline(always)]
fn add_stencil_blocks(stiffness: &RimStiffness<'_>, values: &mut [f64]) {
    let RimStiffness { shape, memories, definite } = *stiffness;
    let first = shape.rim.blocks.start;
    let stencils = &shape.rim.stencils;
    for start in stencils.batches() {
        let measures = StencilMeasures::new(stencils, start, shape.positions, shape.normals);
        let halves = [0, 1].map(|direction| {
            let yarns = &shape.panel.yarns[direction];
            let memory = memories.bending[direction].batch(stencils.base + start);
            measures.bending(yarns, direction).blocks(&memory, 1.0, definite)
        });

        // The block of two nodes is the block of the second difference times both weights.
        for lane in 0..LANES.min(stencils.count - start) {
            let index = start + lane;
            let [warp, weft] =
                halves.each_ref().map(|halves| IN_HALF.map(|entry| halves[entry][lane]));
            let nodes = stencils.nodes(index);
            let mut slots = stencils.slots[stencils.slot_offsets[index]..].iter();
            for (k, node) in nodes.iter().enumerate() {
                let [v, u] = node.weights;
                let warp_row: [f64; 9] = std::array::from_fn(|k| v * warp[k]);
                let weft_row: [f64; 9] = std::array::from_fn(|k| u * weft[k]);
                for (node, &slot) in nodes[k..].iter().zip(slots.by_ref()) {
                    let [v, u] = node.weights;
                    let block = std::array::from_fn(|k| v * warp_row[k] + u * weft_row[k]);
                    add_block(values, first, slot, &block);
                }
            }
        }
    }
}

/// Returns the second derivatives of the batch of triangles from `start` on, with respect to `$p$`
/// and `$q$`.
///
/// With load `$g$` and tangent `$t$` of the shear, and `$c = \hat{p}\cdot\hat{q}$`, the shear adds
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
    let measures = TriangleMeasures::new(triangles, start, shape.positions);
    let areas = lanes(&triangles.areas, start);

    // Loads and tangents of the shear, times areas.
    let mut shear = Responses::default();
    let memory = memories.shear.batch(index);
    shape.panel.shear.respond::<true>(&memory, &measures.sines, &mut shear);
    let (mut loads, mut slopes) = ([0.0; LANES], [0.0; LANES]);
    for lane in 0..LANES {
        loads[lane] = if definite { 0.0 } else { shear.load[lane] * areas[lane] };
        slopes[lane] = positive_if(definite, shear.tangent[lane]) * areas[lane];
    }

    // Blocks of each column with itself, from tension and shear.
    let mut diagonal_blocks = [[[0.0; LANES]; 6]; 2];
    for direction in 0..2 {
        let mut tension = Responses::default();
        let memory = memories.traction[direction].batch(index);
        let yarns = &shape.panel.yarns[direction];
        yarns.traction.respond::<true>(&memory, &measures.strains[direction], &mut tension);
        for lane in 0..LANES {
            let (p, q) = (measures.unit(direction, lane), measures.unit(1 - direction, lane));
            let inverse = measures.inverse[direction][lane];
            let stretch = positive_if(definite, tension.tangent[lane]) * areas[lane];
            let rotate = positive_if(definite, tension.load[lane]) * areas[lane] * inverse;
            let size = inverse * inverse;
            let (load, slope, cosine) =
                (loads[lane] * size, slopes[lane] * size, measures.sines[lane]);
            let both = slope * cosine + load;
            let along = stretch - rotate + cosine * (both + 2.0 * load);
            let across = rotate - cosine * load;
            for (k, (row, column)) in HALF.into_iter().enumerate() {
                let mixed = q[row] * p[column] + p[row] * q[column];
                let diagonal = if row == column { across } else { 0.0 };
                diagonal_blocks[direction][k][lane] = slope * (q[row] * q[column]) - both * mixed
                    + along * (p[row] * p[column])
                    + diagonal;
            }
        }
    }

    // Block of both columns, from shear alone.
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
    GradientHessian { diagonal: diagonal_blocks, mixed }
}

/// Returns the blocks of the batch of triangles from `start` on: of the corners 00, 01, 02, 11, 12,
/// 22.
#[inline(always)]
fn corner_blocks(stiffness: &RimStiffness<'_>, start: usize) -> [[Lanes; 9]; 6] {
    let GradientHessian { diagonal: [warp, weft], mixed } = gradient_hessian(stiffness, start);
    let [u1, u2, v1, v2] = stiffness.shape.rim.triangles.gradients.batch(start).0;
    let mut blocks = [[[0.0; LANES]; 9]; 6];
    for k in 0..9 {
        let (half, transposed) = (IN_HALF[k], TRANSPOSED[k]);
        for lane in 0..LANES {
            let (u1, u2, v1, v2) = (u1[lane], u2[lane], v1[lane], v2[lane]);
            let (warp, weft) = (warp[half][lane], weft[half][lane]);
            let (mixed, transposed) = (mixed[k][lane], mixed[transposed][lane]);
            // The gradients of the corners sum to zero, since a translation changes nothing.
            let (b, c) = ((v1, u1), (v2, u2));
            let a = (-v1 - v2, -u1 - u2);
            let corner_pairs = [(a, a), (a, b), (a, c), (b, b), (b, c), (c, c)];
            for (block, ((va, ua), (vb, ub))) in blocks.iter_mut().zip(corner_pairs) {
                block[k][lane] = (va * vb) * warp
                    + (ua * ub) * weft
                    + ((va * ub) * mixed + (ua * vb) * transposed);
            }
        }
    }
    blocks
}
