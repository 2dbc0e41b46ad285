#![allow(clippy::needless_range_loop, reason = "a lane is a place in many arrays")]

use drape_fabric::{BatchLaw, LANES, Lanes, Responses};

use crate::bend::HALF;
use crate::field::{dot, lanes, put};
use crate::panel::{BLOCKS, NO_BLOCK};
use crate::scratch::{Scratch, StripTrial};

/// Place of a full block's entry, row by row, in the upper half.
const IN_HALF: [usize; 9] = [0, 1, 2, 1, 3, 4, 2, 4, 5];

/// Place of a block's entry in its transpose.
const TRANSPOSED: [usize; 9] = [0, 3, 6, 1, 4, 7, 2, 5, 8];

/// Adds the derivatives of the forces on a strip's particles, negated, to the blocks of their rows.
///
/// The potential is a function of the edges as vectors, so its second derivatives belong to an edge,
/// to the two edges of a corner, or to a triple; each is computed once and then adds up in the
/// blocks of the particles at the ends.
#[inline(always)]
pub(crate) fn add_stiffness(
    scratch: &mut Scratch,
    trial: &StripTrial<'_>,
    definite: bool,
    values: &mut [f64],
) {
    scratch.lay((trial.panel, trial.strip), trial.positions);
    for corner in 0..4 {
        turns(scratch, trial, (corner, definite));
    }
    for direction in 0..2 {
        rigidities(scratch, trial, (direction, definite));
    }
    for direction in 0..2 {
        along_yarns(scratch, trial, (direction, definite));
    }
    across_cells(scratch, trial);
    gather(scratch, trial, values);
}

/// Loads and slopes of a corner of the cells, and the block of its two edges `$p$`, `$q$`,
///
/// ```math
/// \frac{1}{l_pl_q}\left[t\,qp^T - (tc+g)(pp^T+qq^T) + (tc^2+gc)\,pq^T + g\right],\qquad c = p\cdot q
/// ```
///
/// where `$g$` and `$t$` are load and slope times the area. Without `$g$` it is definite.
#[inline(always)]
fn turns(scratch: &mut Scratch, trial: &StripTrial<'_>, (corner, definite): (usize, bool)) {
    let StripTrial { panel, strip, .. } = *trial;
    let places = panel.margin - panel.stride - 1..panel.margin + strip.points.len();
    let (to_warp, to_weft) = panel.corner_edges(corner);
    for start in places.step_by(LANES) {
        let memory = trial.history.shear[corner].batch(strip.offset + start);
        let sines = scratch.sines(panel, corner, (start, strip));
        let mut responses = Responses::default();
        panel.shear.respond::<true>(&memory, &sines, &mut responses);
        let areas = lanes(&panel.corners[corner], strip.points.start + start);
        let mut loads = [0.0; LANES];
        let mut slopes = [0.0; LANES];
        for lane in 0..LANES {
            let tangent = responses.tangent[lane];
            let least = if definite && tangent < 0.0 { 0.0 } else { tangent };
            loads[lane] = if definite { 0.0 } else { responses.load[lane] * areas[lane] };
            slopes[lane] = least * areas[lane];
        }
        let [warp, weft] = &scratch.edges;
        let (p, q) = (warp.unit.from(start + to_warp), weft.unit.from(start + to_weft));
        let warp_inverse = lanes(&warp.inverse, start + to_warp);
        let weft_inverse = lanes(&weft.inverse, start + to_weft);
        let mut blocks = [[0.0; LANES]; 9];
        for lane in 0..LANES {
            let (p, q) = (p.at(lane), q.at(lane));
            let (load, slope, cosine) = (loads[lane], slopes[lane], sines[lane]);
            let size = warp_inverse[lane] * weft_inverse[lane];
            let (load, slope) = (load * size, slope * size);
            let mixed = slope * cosine + load;
            let back = cosine * mixed;
            for row in 0..3 {
                for column in 0..3 {
                    let squares = p[row] * p[column] + q[row] * q[column];
                    let one = if row == column { load } else { 0.0 };
                    blocks[3 * row + column][lane] = slope * (q[row] * p[column]) - mixed * squares
                        + back * (p[row] * q[column])
                        + one;
                }
            }
        }
        put(&mut scratch.corners[corner], start, &loads);
        put(&mut scratch.slopes[corner], start, &slopes);
        scratch.turns[corner].put(start, &blocks);
    }
}

#[inline(always)]
fn rigidities(scratch: &mut Scratch, trial: &StripTrial<'_>, (direction, definite): (usize, bool)) {
    let StripTrial { panel, strip, .. } = *trial;
    let yarns = &panel.yarns[direction];
    let inverse_square = 1.0 / (yarns.length * yarns.length);
    let places = panel.margin - yarns.step..panel.margin + strip.points.len() + yarns.step;
    for start in places.step_by(LANES) {
        let memory = trial.history.bending[direction].batch(strip.offset + start);
        let bend = scratch.bend(yarns, &trial.history.normals, (start, strip));
        let blocks = bend.blocks(&memory, inverse_square, definite);
        scratch.rigidities[direction].put(start, &blocks);
    }
}

/// Second derivatives of the potential with respect to the edges: tension, and with
/// `$a$` the other edges of the corners around an edge `$e$`
///
/// ```math
/// \frac{1}{l^2}\sum\left[t\,aa^T - (tc+g)(ae^T+ea^T) + (tc^2+3gc)\,ee^T - gc\right],\qquad c = a\cdot e
/// ```
#[inline(always)]
fn edge_blocks(
    scratch: &Scratch,
    trial: &StripTrial<'_>,
    (direction, definite): (usize, bool),
    start: usize,
) -> [Lanes; 6] {
    let StripTrial { panel, strip, .. } = *trial;
    let yarns = &panel.yarns[direction];
    let (edges, other) = (&scratch.edges[direction], &scratch.edges[1 - direction]);
    let memory = trial.history.traction[direction].batch(strip.offset + start);
    let strains = scratch.strains(yarns, direction, (start, strip));
    let mut responses = Responses::default();
    yarns.traction.respond::<true>(&memory, &strains, &mut responses);
    let areas = lanes(&yarns.segment_areas, strip.points.start + start);
    let (units, inverse) = (edges.unit.from(start), lanes(&edges.inverse, start));
    let rest = 1.0 / yarns.length;

    // Sums over the corners: the matrix, the vector, and the factors of eeᵀ and of one.
    let mut squares = [[0.0; LANES]; 6];
    let mut mixed = [[0.0; LANES]; 3];
    let mut along = [0.0; LANES];
    let mut across = [0.0; LANES];
    for (corner, cell, edge) in panel.around(direction, start) {
        let loads = lanes(&scratch.corners[corner], cell);
        let slopes = lanes(&scratch.slopes[corner], cell);
        let others = other.unit.from(edge);
        for lane in 0..LANES {
            let (a, e) = (others.at(lane), units.at(lane));
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
        let e = units.at(lane);
        let size = inverse[lane] * inverse[lane];
        let stretch = responses.tangent[lane] * areas[lane] * rest * rest;
        let turn = responses.load[lane] * areas[lane] * rest * inverse[lane];
        let positive = |x: f64| if definite && x < 0.0 { 0.0 } else { x };
        let (stretch, turn) = (positive(stretch), positive(turn));
        let one = turn - size * across[lane];
        let unit = stretch - turn + size * along[lane];
        for (k, (row, column)) in HALF.into_iter().enumerate() {
            let mix = mixed[row][lane] * e[column] + e[row] * mixed[column][lane];
            let on = if row == column { one } else { 0.0 };
            blocks[k][lane] = size * (squares[k][lane] - mix) + unit * (e[row] * e[column]) + on;
        }
    }
    blocks
}

/// Blocks of neighbours along a yarn.
#[inline(always)]
fn along_yarns(
    scratch: &mut Scratch,
    trial: &StripTrial<'_>,
    (direction, definite): (usize, bool),
) {
    let StripTrial { panel, strip, .. } = *trial;
    let step = panel.yarns[direction].step;
    let places = panel.margin - step..panel.margin + strip.points.len();
    for start in places.step_by(LANES) {
        let edges = edge_blocks(scratch, trial, (direction, definite), start);
        let rigidities = &scratch.rigidities[direction];
        let (here, next) = (rigidities.from(start), rigidities.from(start + step));
        let mut blocks = [[0.0; LANES]; 9];
        for (k, block) in blocks.iter_mut().enumerate() {
            let half = IN_HALF[k];
            for lane in 0..LANES {
                block[lane] = -edges[half][lane] - 2.0 * (here.0[half][lane] + next.0[half][lane]);
            }
        }
        // The sign of a corner's block, and whether it is turned, follow from which end of its two
        // edges the corner is at.
        let turns = |corner: usize, cell: usize| scratch.turns[corner].from(cell);
        let [less, less_turned, more, more_turned] = if direction == 0 {
            let left = start - 1;
            [turns(2, left), turns(0, start), turns(3, start), turns(1, left)]
        } else {
            let below = start - panel.stride;
            [turns(0, start), turns(2, below), turns(3, below), turns(1, start)]
        };
        for (k, block) in blocks.iter_mut().enumerate() {
            let turned = TRANSPOSED[k];
            for lane in 0..LANES {
                block[lane] += (more.0[k][lane] - less.0[k][lane])
                    + (more_turned.0[turned][lane] - less_turned.0[turned][lane]);
            }
        }
        scratch.blocks[direction].put(start, &blocks);
    }
}

/// Blocks of the particles across a cell: of its first with its third, and of its second with its
/// fourth.
#[inline(always)]
fn across_cells(scratch: &mut Scratch, trial: &StripTrial<'_>) {
    let StripTrial { panel, strip, .. } = *trial;
    let places = panel.margin - panel.stride - 1..panel.margin + strip.points.len();
    for start in places.step_by(LANES) {
        let [first, second, third, fourth] = &scratch.turns;
        let (first, second) = (first.from(start), second.from(start));
        let (third, fourth) = (third.from(start), fourth.from(start));
        let mut blocks = [[[0.0; LANES]; 9]; 2];
        for k in 0..9 {
            let turned = TRANSPOSED[k];
            for lane in 0..LANES {
                blocks[0][k][lane] = -second.0[turned][lane] - fourth.0[k][lane];
                blocks[1][k][lane] = first.0[turned][lane] + third.0[k][lane];
            }
        }
        scratch.blocks[2].put(start, &blocks[0]);
        scratch.blocks[3].put(start, &blocks[1]);
    }
}

/// Adds the blocks to the rows of the strip's particles. A row adds up to nothing, because nothing
/// depends on where the cloth as a whole is: that gives its first block.
#[inline(always)]
fn gather(scratch: &Scratch, trial: &StripTrial<'_>, values: &mut [f64]) {
    let StripTrial { panel, strip, .. } = *trial;
    let stride = panel.stride;
    let [warp, weft, third, second] = &scratch.blocks;
    let [warp_bends, weft_bends] = &scratch.rigidities;
    for (batch, slots) in panel.slots[strip.points.clone()].chunks(LANES).enumerate() {
        let start = panel.margin + batch * LANES;
        let next = [weft.from(start), second.from(start - 1), warp.from(start), third.from(start)];
        let before = [
            weft.from(start - 1),
            second.from(start - stride),
            warp.from(start - stride),
            third.from(start - stride - 1),
        ];
        let far = [weft_bends.from(start + 1), warp_bends.from(start + stride)];
        let far_before = [weft_bends.from(start - 1), warp_bends.from(start - stride)];
        let mut own = [[0.0; LANES]; 6];
        for (k, (row, column)) in HALF.into_iter().enumerate() {
            let (entry, turned) = (3 * row + column, 3 * column + row);
            let [a, b, c, d] = &next;
            let (a, b, c, d) = (a.0[entry], b.0[entry], c.0[entry], d.0[entry]);
            let [e, f, g, h] = &before;
            let (e, f, g, h) = (e.0[turned], f.0[turned], g.0[turned], h.0[turned]);
            let (i, j) = (far[0].0[k], far[1].0[k]);
            let (l, m) = (far_before[0].0[k], far_before[1].0[k]);
            for lane in 0..LANES {
                let near = (a[lane] + e[lane]) + (b[lane] + f[lane]);
                let cell = (c[lane] + g[lane]) + (d[lane] + h[lane]);
                let bends = (i[lane] + l[lane]) + (j[lane] + m[lane]);
                own[k][lane] = -(near + cell + bends);
            }
        }
        let [near, slant, up, over] = &next;
        let rows: [[&Lanes; 9]; BLOCKS] = [
            whole(own.each_ref()),
            near.0,
            whole(far[0].0),
            slant.0,
            up.0,
            over.0,
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

/// A symmetric block from its upper half.
#[inline(always)]
fn whole(half: [&Lanes; 6]) -> [&Lanes; 9] {
    let [a, b, c, d, e, f] = half;
    [a, b, c, b, d, e, c, e, f]
}
