//! Stiffness of a strip: the blocks of the second derivatives of its potential.
//!
//! ```text
//!   shear blocks of corners, bending blocks of triples
//!     →  blocks of neighbours along the yarns and across the cells
//!     →  a row of the matrix per point; its diagonal block is minus the sum of the others
//!
//!   pair_blocks of a point A                       bending_blocks at c couple a, c and b:
//!      D ── C     0: A–D (warp)   2: A–C             a ── c ── b    1, −2, 1
//!      │    │     1: A–B (weft)   3: B–D
//!      A ── B
//! ```
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use drape_fabric::{BatchLaw, LANES, Lanes, Responses};

use crate::kernel::buffers::{StripBuffers, StripTrial};
use crate::layout::columns::{is_vacant, lanes, put};
use crate::layout::grid::{BLOCKS, CornerAtEdge, CornerEdges, NO_BLOCK};
use crate::measure::half::{HALF, IN_HALF, TRANSPOSED};
use crate::measure::vector::dot;

/// Part of the stiffness to compute.
#[derive(Clone, Copy)]
struct StiffnessPart {
    /// Direction of the yarns, or corner of the cells.
    which: usize,
    /// Whether parts that make the matrix indefinite are left out.
    definite: bool,
}

/// Adds the negative derivatives of the forces on the particles of `trial`'s strip to `values`, the
/// blocks of their rows, in N/m.
///
/// The potential is a function of the edges as vectors, so its second derivatives belong to an
/// edge, to the two edges of a corner, or to a triple. Each derivative is computed once and then
/// added to the blocks of the particles at the ends.
#[inline(always)]
pub(crate) fn add_stiffness(
    buffers: &mut StripBuffers,
    trial: &StripTrial<'_>,
    definite: bool,
    values: &mut [f64],
) {
    buffers.load(trial.panel, trial.strip, trial.positions);
    for which in 0..4 {
        compute_shear_blocks(buffers, trial, StiffnessPart { which, definite });
    }
    for which in 0..2 {
        compute_bending_blocks(buffers, trial, StiffnessPart { which, definite });
    }
    for which in 0..2 {
        compute_yarn_blocks(buffers, trial, StiffnessPart { which, definite });
    }
    compute_cell_blocks(buffers, trial);
    sum_rows(buffers, trial, values);
}

/// Computes loads and tangents of one corner of the cells, and the block of its two edges. With the
/// directions `$p$`, `$q$` and lengths `$l_p$`, `$l_q$` of the edges, the block is
///
/// ```math
/// \frac{1}{l_pl_q}\left[t\,qp^T - (tc+g)(pp^T+qq^T) + (tc^2+gc)\,pq^T + g\right],
/// \qquad c = p\cdot q
/// ```
///
/// with load `$g$` and tangent `$t$` times the area. With `part.definite`, `$g$` is left out.
#[inline(always)]
fn compute_shear_blocks(buffers: &mut StripBuffers, trial: &StripTrial<'_>, part: StiffnessPart) {
    let StiffnessPart { which: corner, definite } = part;
    let StripTrial { panel, strip, .. } = *trial;
    let indices = panel.margin - panel.stride - 1..panel.margin + strip.points.len();
    let CornerEdges { warp: to_warp, weft: to_weft } = panel.corner_edges(corner);
    for start in indices.step_by(LANES) {
        let at = strip.batch(start);
        let areas = lanes(&panel.corner_areas[corner], at.panel);
        if is_vacant(areas) {
            put(&mut buffers.corner_loads[corner], start, &[0.0; LANES]);
            put(&mut buffers.corner_tangents[corner], start, &[0.0; LANES]);
            buffers.shear_blocks[corner].put(start, &[[0.0; LANES]; 9]);
            continue;
        }
        // Loads and tangents of the law, times areas.
        let memory = trial.memories.shear[corner].batch(at.cloth);
        let sines = buffers.sines(panel, corner, at);
        let mut responses = Responses::default();
        panel.shear.respond::<true>(&memory, &sines, &mut responses);
        let mut loads = [0.0; LANES];
        let mut slopes = [0.0; LANES];
        for lane in 0..LANES {
            let tangent = responses.tangent[lane];
            let least = if definite && tangent < 0.0 { 0.0 } else { tangent };
            loads[lane] = if definite { 0.0 } else { responses.load[lane] * areas[lane] };
            slopes[lane] = least * areas[lane];
        }
        // Block of the two edges.
        let [warp, weft] = &buffers.edges;
        let (p, q) = (warp.unit.batch(start + to_warp), weft.unit.batch(start + to_weft));
        let warp_inverse = lanes(&warp.inverse, start + to_warp);
        let weft_inverse = lanes(&weft.inverse, start + to_weft);
        let mut blocks = [[0.0; LANES]; 9];
        for lane in 0..LANES {
            let (p, q) = (p.vector(lane), q.vector(lane));
            let (load, slope, cosine) = (loads[lane], slopes[lane], sines[lane]);
            let size = warp_inverse[lane] * weft_inverse[lane];
            let (load, slope) = (load * size, slope * size);
            let mixed = slope * cosine + load;
            let back = cosine * mixed;
            for row in 0..3 {
                for column in 0..3 {
                    let squares = p[row] * p[column] + q[row] * q[column];
                    let diagonal = if row == column { load } else { 0.0 };
                    blocks[3 * row + column][lane] = slope * (q[row] * p[column]) - mixed * squares
                        + back * (p[row] * q[column])
                        + diagonal;
                }
            }
        }
        put(&mut buffers.corner_loads[corner], start, &loads);
        put(&mut buffers.corner_tangents[corner], start, &slopes);
        buffers.shear_blocks[corner].put(start, &blocks);
    }
}

/// Computes the second derivatives with respect to the second differences, over `$h^4$`, along the
/// direction of `part`.
#[inline(always)]
fn compute_bending_blocks(buffers: &mut StripBuffers, trial: &StripTrial<'_>, part: StiffnessPart) {
    let StiffnessPart { which: direction, definite } = part;
    let StripTrial { panel, strip, .. } = *trial;
    let yarns = &panel.yarns[direction];
    let inverse_square = 1.0 / (yarns.length * yarns.length);
    let indices = panel.margin - yarns.step..panel.margin + strip.points.len() + yarns.step;
    for start in indices.step_by(LANES) {
        let at = strip.batch(start);
        if is_vacant(lanes(&yarns.triple_areas, at.panel)) {
            buffers.bending_blocks[direction].put(start, &[[0.0; LANES]; 6]);
            continue;
        }
        let memory = trial.memories.bending[direction].batch(at.cloth);
        let triples = buffers.triples(yarns, &trial.memories.normals, at);
        let blocks = triples.blocks(&memory, inverse_square, definite);
        buffers.bending_blocks[direction].put(start, &blocks);
    }
}

/// Returns the second derivatives of the potential with respect to the batch of edges from `start`
/// on: the part of the tension and, with the crossing edges `$a$` of the corners at an edge `$e$`
/// of length `$l$`,
///
/// ```math
/// \frac{1}{l^2}\sum\left[t\,aa^T - (tc+g)(ae^T+ea^T) + (tc^2+3gc)\,ee^T - gc\right],
/// \qquad c = a\cdot e
/// ```
#[inline(always)]
fn edge_blocks(
    buffers: &StripBuffers,
    trial: &StripTrial<'_>,
    part: StiffnessPart,
    start: usize,
) -> [Lanes; 6] {
    let StiffnessPart { which: direction, definite } = part;
    let StripTrial { panel, strip, .. } = *trial;
    let yarns = &panel.yarns[direction];
    let (edges, crossing) = (&buffers.edges[direction], &buffers.edges[1 - direction]);
    let at = strip.batch(start);
    let areas = lanes(&yarns.segment_areas, at.panel);
    // An edge without an area is beside no cell, and has no corner either.
    if is_vacant(areas) {
        return [[0.0; LANES]; 6];
    }
    let memory = trial.memories.traction[direction].batch(at.cloth);
    let strains = buffers.strains(yarns, direction, at);
    let mut responses = Responses::default();
    yarns.traction.respond::<true>(&memory, &strains, &mut responses);
    let (units, inverse) = (edges.unit.batch(start), lanes(&edges.inverse, start));
    let rest = 1.0 / yarns.length;

    // Sums over the corners: of aaᵀ, of a, and the factors of eeᵀ and of the identity.
    let mut squares = [[0.0; LANES]; 6];
    let mut mixed = [[0.0; LANES]; 3];
    let mut along = [0.0; LANES];
    let mut across = [0.0; LANES];
    for CornerAtEdge { corner, cell, other_edge } in panel.corners_at_edge(direction, start) {
        let loads = lanes(&buffers.corner_loads[corner], cell);
        let slopes = lanes(&buffers.corner_tangents[corner], cell);
        let crossing_units = crossing.unit.batch(other_edge);
        for lane in 0..LANES {
            let (a, e) = (crossing_units.vector(lane), units.vector(lane));
            let (load, slope, cosine) = (loads[lane], slopes[lane], dot(a, e));
            let both = slope * cosine + load;
            for (sum, (row, column)) in squares.iter_mut().zip(HALF) {
                sum[lane] += slope * (a[row] * a[column]);
            }
            for (sum, a) in mixed.iter_mut().zip(a) {
                sum[lane] += both * a;
            }
            along[lane] += cosine * (both + 2.0 * load);
            across[lane] += cosine * load;
        }
    }

    let mut blocks = [[0.0; LANES]; 6];
    for lane in 0..LANES {
        let e = units.vector(lane);
        let size = inverse[lane] * inverse[lane];
        let stretch = responses.tangent[lane] * areas[lane] * rest * rest;
        let rotate = responses.load[lane] * areas[lane] * rest * inverse[lane];
        let (stretch, rotate) = (positive_if(definite, stretch), positive_if(definite, rotate));
        let identity = rotate - size * across[lane];
        let unit = stretch - rotate + size * along[lane];
        for (k, (row, column)) in HALF.into_iter().enumerate() {
            let mix = mixed[row][lane] * e[column] + e[row] * mixed[column][lane];
            let diagonal = if row == column { identity } else { 0.0 };
            blocks[k][lane] =
                size * (squares[k][lane] - mix) + unit * (e[row] * e[column]) + diagonal;
        }
    }
    blocks
}

/// Computes the blocks of neighbours along a yarn, in the direction of `part`.
#[inline(always)]
fn compute_yarn_blocks(buffers: &mut StripBuffers, trial: &StripTrial<'_>, part: StiffnessPart) {
    let direction = part.which;
    let StripTrial { panel, strip, .. } = *trial;
    let step = panel.yarns[direction].step;
    let indices = panel.margin - step..panel.margin + strip.points.len();
    for start in indices.step_by(LANES) {
        let edges = edge_blocks(buffers, trial, part, start);
        let bending = &buffers.bending_blocks[direction];
        let (here, next) = (bending.batch(start), bending.batch(start + step));
        let mut blocks = [[0.0; LANES]; 9];
        for (k, block) in blocks.iter_mut().enumerate() {
            let half = IN_HALF[k];
            for lane in 0..LANES {
                block[lane] = -edges[half][lane] - 2.0 * (here.0[half][lane] + next.0[half][lane]);
            }
        }

        // The sign of a corner's block, and whether it is transposed, follow from which ends of its
        // two edges meet at the corner.
        let [corner_0, corner_1, corner_2, corner_3] = &buffers.shear_blocks;
        let [minus, minus_transposed, plus, plus_transposed] = if direction == 0 {
            let left = start - 1;
            [
                corner_2.batch(left),
                corner_0.batch(start),
                corner_3.batch(start),
                corner_1.batch(left),
            ]
        } else {
            let below = start - panel.stride;
            [
                corner_0.batch(start),
                corner_2.batch(below),
                corner_3.batch(below),
                corner_1.batch(start),
            ]
        };
        for (k, block) in blocks.iter_mut().enumerate() {
            let transposed = TRANSPOSED[k];
            for lane in 0..LANES {
                block[lane] += (plus.0[k][lane] - minus.0[k][lane])
                    + (plus_transposed.0[transposed][lane] - minus_transposed.0[transposed][lane]);
            }
        }
        buffers.pair_blocks[direction].put(start, &blocks);
    }
}

/// Computes the blocks of the particles across a cell: of its first with its third, and of its
/// second with its fourth.
#[inline(always)]
fn compute_cell_blocks(buffers: &mut StripBuffers, trial: &StripTrial<'_>) {
    let StripTrial { panel, strip, .. } = *trial;
    let indices = panel.margin - panel.stride - 1..panel.margin + strip.points.len();
    for start in indices.step_by(LANES) {
        let [first, second, third, fourth] = &buffers.shear_blocks;
        let (first, second) = (first.batch(start), second.batch(start));
        let (third, fourth) = (third.batch(start), fourth.batch(start));
        let mut blocks = [[[0.0; LANES]; 9]; 2];
        for k in 0..9 {
            let transposed = TRANSPOSED[k];
            for lane in 0..LANES {
                blocks[0][k][lane] = -second.0[transposed][lane] - fourth.0[k][lane];
                blocks[1][k][lane] = first.0[transposed][lane] + third.0[k][lane];
            }
        }
        buffers.pair_blocks[2].put(start, &blocks[0]);
        buffers.pair_blocks[3].put(start, &blocks[1]);
    }
}

/// Adds the blocks to the rows of the strip's particles in `values`. The blocks of a row sum to
/// zero, because a translation of the whole cloth changes nothing. This gives the diagonal block.
#[inline(always)]
fn sum_rows(buffers: &StripBuffers, trial: &StripTrial<'_>, values: &mut [f64]) {
    let StripTrial { panel, strip, .. } = *trial;
    let stride = panel.stride;
    let [warp, weft, third, second] = &buffers.pair_blocks;
    let [warp_bending, weft_bending] = &buffers.bending_blocks;
    for (batch, slots) in panel.slots[strip.points.clone()].chunks(LANES).enumerate() {
        let start = panel.margin + batch * LANES;
        let next =
            [weft.batch(start), second.batch(start - 1), warp.batch(start), third.batch(start)];
        let before = [
            weft.batch(start - 1),
            second.batch(start - stride),
            warp.batch(start - stride),
            third.batch(start - stride - 1),
        ];
        let far = [weft_bending.batch(start + 1), warp_bending.batch(start + stride)];
        let far_before = [weft_bending.batch(start - 1), warp_bending.batch(start - stride)];

        // Diagonal block: minus the sum of all other blocks of the row, on both sides.
        let mut diagonal = [[0.0; LANES]; 6];
        for (k, (row, column)) in HALF.into_iter().enumerate() {
            let (entry, transposed) = (3 * row + column, 3 * column + row);
            let [a, b, c, d] = &next;
            let (a, b, c, d) = (a.0[entry], b.0[entry], c.0[entry], d.0[entry]);
            let [e, f, g, h] = &before;
            let [e, f, g, h] = [e, f, g, h].map(|block| block.0[transposed]);
            let (i, j) = (far[0].0[k], far[1].0[k]);
            let (l, m) = (far_before[0].0[k], far_before[1].0[k]);
            for lane in 0..LANES {
                let pairs = (a[lane] + e[lane]) + (b[lane] + f[lane]);
                let across = (c[lane] + g[lane]) + (d[lane] + h[lane]);
                let bending = (i[lane] + l[lane]) + (j[lane] + m[lane]);
                diagonal[k][lane] = -(pairs + across + bending);
            }
        }

        // The blocks of the upper half go to their slots, in the order of `block_steps`.
        let [right, up_left, up, up_right] = &next;
        let rows: [[&Lanes; 9]; BLOCKS] = [
            whole(diagonal.each_ref()),
            right.0,
            whole(far[0].0),
            up_left.0,
            up.0,
            up_right.0,
            whole(far[1].0),
        ];
        for (lane, slots) in slots.iter().enumerate() {
            for (slot, block) in slots.iter().zip(&rows) {
                if *slot != NO_BLOCK {
                    let first = 9 * (*slot as usize - strip.blocks.start);
                    for (value, entry) in values[first..first + 9].iter_mut().zip(block) {
                        *value += entry[lane];
                    }
                }
            }
        }
    }
}

/// Returns a symmetric block from `half`, its upper half.
#[inline(always)]
fn whole(half: [&Lanes; 6]) -> [&Lanes; 9] {
    let [a, b, c, d, e, f] = half;
    [a, b, c, b, d, e, c, e, f]
}

/// Returns `value`, or zero if it is negative and only a `definite` part is wanted.
#[inline(always)]
pub(crate) fn positive_if(definite: bool, value: f64) -> f64 {
    if definite && value < 0.0 { 0.0 } else { value }
}
