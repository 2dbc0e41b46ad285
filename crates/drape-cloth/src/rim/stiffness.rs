#![allow(clippy::needless_range_loop, reason = "a lane is a place in many arrays")]

use drape_fabric::{BatchLaw, LANES, Lanes, Responses};

use crate::bend::HALF;
use crate::field::lanes;
use crate::rim::RimTrial;
use crate::rim::bow::Bowed;
use crate::rim::strain::Strain;

/// Place of a full block's entry, row by row, in the upper half.
const IN_HALF: [usize; 9] = [0, 1, 2, 1, 3, 4, 2, 4, 5];

/// Adds the derivatives of the forces of a rim, negated, to the blocks of its panel's rows.
#[inline(always)]
pub(crate) fn add_stiffness(trial: &RimTrial<'_>, definite: bool, values: &mut [f64]) {
    let first = trial.rim.blocks.start;
    let mut put = |slot: u32, block: &[f64; 9]| {
        let place = 9 * (slot as usize - first);
        values[place..place + 9].iter_mut().zip(block).for_each(|(sum, entry)| *sum += entry);
    };
    let triangles = &trial.rim.triangles;
    for start in (0..triangles.areas.len()).step_by(LANES) {
        let blocks = corner_blocks(trial, (start, definite));
        for lane in 0..LANES.min(triangles.count - start) {
            for (&slot, block) in triangles.slots[start + lane].iter().zip(&blocks) {
                put(slot, &block.map(|entry| entry[lane]));
            }
        }
    }
    let stencils = &trial.rim.stencils;
    for start in (0..stencils.middles.len()).step_by(LANES) {
        let bowed = Bowed::of(stencils, start, (trial.positions, trial.normals));
        let halves = [0, 1].map(|direction| {
            let yarns = &trial.panel.yarns[direction];
            let memory = trial.history.rim.bending[direction].batch(stencils.base + start);
            bowed.bend(yarns, (stencils, start, direction)).blocks(&memory, 1.0, definite)
        });
        for lane in 0..LANES.min(stencils.count - start) {
            let place = start + lane;
            let [warp, weft] =
                halves.each_ref().map(|halves| IN_HALF.map(|entry| halves[entry][lane]));
            let parts = stencils.parts(place);
            let mut slots = stencils.slots[stencils.slot_offsets[place]..].iter();
            for (k, part) in parts.iter().enumerate() {
                let [v, u] = part.weights;
                let row: [f64; 9] = std::array::from_fn(|k| v * warp[k]);
                let other: [f64; 9] = std::array::from_fn(|k| u * weft[k]);
                for (part, &slot) in parts[k..].iter().zip(slots.by_ref()) {
                    let [v, u] = part.weights;
                    put(slot, &std::array::from_fn(|k| v * row[k] + u * other[k]));
                }
            }
        }
    }
}

/// Second derivatives of the potential with respect to `$p$` and `$q$`, in J: of each with itself in halves, and mixed.
///
/// With load `$g$` and slope `$t$` of the shear, and `$c = \hat{p}\cdot\hat{q}$`, those of the shear are
///
/// ```math
/// \frac{1}{|p|^2}\left[t\,\hat{q}\hat{q}^T - (tc+g)(\hat{q}\hat{p}^T+\hat{p}\hat{q}^T)
/// + (tc^2+3gc)\,\hat{p}\hat{p}^T - gc\right],\qquad
/// \frac{1}{|p||q|}\left[t\,\hat{q}\hat{p}^T - (tc+g)(\hat{p}\hat{p}^T+\hat{q}\hat{q}^T)
/// + (tc^2+gc)\,\hat{p}\hat{q}^T + g\right]
/// ```
#[inline(always)]
fn second(trial: &RimTrial<'_>, (start, definite): (usize, bool)) -> ([[Lanes; 6]; 2], [Lanes; 9]) {
    let triangles = &trial.rim.triangles;
    let history = &trial.history.rim;
    let place = triangles.base + start;
    let strain = Strain::of(triangles, start, trial.positions);
    let areas = lanes(&triangles.areas, start);
    let positive = |x: f64| if definite && x < 0.0 { 0.0 } else { x };
    let mut shear = Responses::default();
    trial.panel.shear.respond::<true>(&history.shear.batch(place), &strain.sines, &mut shear);
    let (mut loads, mut slopes) = ([0.0; LANES], [0.0; LANES]);
    for lane in 0..LANES {
        loads[lane] = if definite { 0.0 } else { shear.load[lane] * areas[lane] };
        slopes[lane] = positive(shear.tangent[lane]) * areas[lane];
    }
    let mut own = [[[0.0; LANES]; 6]; 2];
    for direction in 0..2 {
        let mut tension = Responses::default();
        let memory = history.traction[direction].batch(place);
        let yarns = &trial.panel.yarns[direction];
        yarns.traction.respond::<true>(&memory, &strain.strains[direction], &mut tension);
        for lane in 0..LANES {
            let (p, q) = (strain.unit(direction, lane), strain.unit(1 - direction, lane));
            let inverse = strain.inverse[direction][lane];
            let stretch = positive(tension.tangent[lane]) * areas[lane];
            let turn = positive(tension.load[lane]) * areas[lane] * inverse;
            let size = inverse * inverse;
            let (load, slope, cosine) =
                (loads[lane] * size, slopes[lane] * size, strain.sines[lane]);
            let both = slope * cosine + load;
            let along = stretch - turn + cosine * (both + 2.0 * load);
            let across = turn - cosine * load;
            for (k, (row, column)) in HALF.into_iter().enumerate() {
                let mixed = q[row] * p[column] + p[row] * q[column];
                let one = if row == column { across } else { 0.0 };
                own[direction][k][lane] = slope * (q[row] * q[column]) - both * mixed
                    + along * (p[row] * p[column])
                    + one;
            }
        }
    }
    let mut mixed = [[0.0; LANES]; 9];
    for lane in 0..LANES {
        let (p, q) = (strain.unit(0, lane), strain.unit(1, lane));
        let size = strain.inverse[0][lane] * strain.inverse[1][lane];
        let (load, slope, cosine) = (loads[lane] * size, slopes[lane] * size, strain.sines[lane]);
        let both = slope * cosine + load;
        for row in 0..3 {
            for column in 0..3 {
                let squares = p[row] * p[column] + q[row] * q[column];
                let one = if row == column { load } else { 0.0 };
                mixed[3 * row + column][lane] = slope * (q[row] * p[column]) - both * squares
                    + cosine * both * (p[row] * q[column])
                    + one;
            }
        }
    }
    (own, mixed)
}

/// Blocks of a batch of triangles: of the corners 00, 01, 02, 11, 12, 22.
#[inline(always)]
fn corner_blocks(trial: &RimTrial<'_>, kind: (usize, bool)) -> [[Lanes; 9]; 6] {
    let ([warp, weft], mixed) = second(trial, kind);
    let [u1, u2, v1, v2] = trial.rim.triangles.gradients.from(kind.0).0;
    let mut blocks = [[[0.0; LANES]; 9]; 6];
    for k in 0..9 {
        let (half, turned) = (IN_HALF[k], 3 * (k % 3) + k / 3);
        for lane in 0..LANES {
            let (u1, u2, v1, v2) = (u1[lane], u2[lane], v1[lane], v2[lane]);
            let (warp, weft) = (warp[half][lane], weft[half][lane]);
            let (mixed, turned) = (mixed[k][lane], mixed[turned][lane]);
            let block = |(va, ua): (f64, f64), (vb, ub): (f64, f64)| {
                (va * vb) * warp + (ua * ub) * weft + ((va * ub) * mixed + (ua * vb) * turned)
            };
            // The first corner's gradients are those of the two others, negated: nothing depends on where the
            // triangle is.
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
